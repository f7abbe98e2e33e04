// SPDX-License-Identifier: BSD-3-Clause
#include "files/written_once.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <iterator>
#include <optional>

#include "files/output_file.h"

namespace forceshade::files {
namespace {

namespace fs = std::filesystem;

// Hidden, so that no listing takes it for the file; removed whatever happens, but for a process that is killed.
struct Draft {
  fs::path path;
  explicit Draft(const fs::path& final_path)
      : path(partial_name((final_path.parent_path() / (std::string(1, '.') + final_path.filename().string())).string())) {}
  ~Draft() { ::unlink(path.c_str()); }
  Draft(const Draft&) = delete;
  Draft& operator=(const Draft&) = delete;
};

void write_draft(const Draft& draft, const fs::path& named, const std::string& text) {
  const int descriptor = ::open(draft.path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (descriptor < 0) throw output_failure(named, "open for writing", errno);
  int reason = 0;
  for (std::size_t done = 0; done < text.size() && reason == 0;) {
    const ssize_t written = ::write(descriptor, text.data() + done, text.size() - done);
    if (written >= 0)
      done += static_cast<std::size_t>(written);
    else if (errno != EINTR)
      reason = errno;
  }
  if (reason == 0 && ::fsync(descriptor) != 0) reason = errno;
  // Some file systems say only here that a write failed.
  if (::close(descriptor) != 0 && reason == 0) reason = errno;
  if (reason != 0) throw output_failure(named, "write", reason);
}

std::optional<std::string> bytes_of(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) return std::nullopt;
  return std::string(std::istreambuf_iterator<char>(stream), {});
}

}  // namespace

bool is_same_file(const fs::path& a, const fs::path& b) {
  struct stat of_a {
  }, of_b{};
  return ::stat(a.c_str(), &of_a) == 0 && ::stat(b.c_str(), &of_b) == 0 && of_a.st_dev == of_b.st_dev &&
         of_a.st_ino == of_b.st_ino;
}

Written write_once(const fs::path& path, const std::string& text) {
  const Draft draft(path);
  write_draft(draft, path, text);
  Written result = Written::now;
  // Over NFS the answer to a link that was made may be lost, and the second request is then refused: the names say what is so.
  if (::link(draft.path.c_str(), path.c_str()) != 0) {
    const int reason = errno;
    if (!is_same_file(draft.path, path)) {
      const auto there = bytes_of(path);
      if (!there) throw output_failure(path, "link", reason);
      result = *there == text ? Written::before : Written::differs;
    }
  }
  sync_folder(path.parent_path());
  return result;
}

}  // namespace forceshade::files
