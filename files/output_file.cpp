// SPDX-License-Identifier: BSD-3-Clause
#include "files/output_file.h"

#include <fcntl.h>
#include <linux/magic.h>
#include <poll.h>
#include <sys/stat.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <climits>
#include <cstdio>
#include <filesystem>
#include <locale>
#include <optional>
#include <regex>
#include <streambuf>
#include <string_view>
#include <system_error>
#include <tuple>
#include <utility>

#include "system/system.h"
#include "text/letters.h"
#include "text/number_text.h"

namespace forceshade::files {
namespace {

namespace fs = std::filesystem;

// A name in a folder of open descriptors, such as /proc/1234/fd/3.
struct OpenDescriptor {
  std::string name;
  std::optional<int> number;  // of this process
};

bool is_of_proc(const fs::path& folder) {
  struct statfs about {};
  return ::statfs(folder.c_str(), &about) == 0 && about.f_type == PROC_SUPER_MAGIC;
}

constexpr int kMostLinks = 40;  // as the kernel has it

// The links are followed one by one, because what an entry of /proc/PID/fd points to need not be a path: pipe:[4711].
std::optional<OpenDescriptor> open_descriptor(fs::path path) {
  std::error_code error;
  for (int links = 0; links < kMostLinks && fs::is_symlink(path, error); ++links) {
    const fs::path folder = fs::canonical(path.has_parent_path() ? path.parent_path() : ".", error);
    if (error) break;
    if (is_of_proc(folder) && folder.filename() == "fd") {
      OpenDescriptor found{folder / path.filename(), std::nullopt};
      if (folder == fs::path("/proc") / std::to_string(::getpid()) / "fd")
        found.number = number_in<int>(path.filename().native());
      return found;
    }
    path = folder / fs::read_symlink(path, error);
    if (error) break;
  }
  return std::nullopt;
}

// Opened again, a file of which a part was written would be overwritten from its beginning.
int opened(const OpenDescriptor& found) {
  if (!found.number) return ::open(found.name.c_str(), O_WRONLY | O_CLOEXEC);
  const int flags = ::fcntl(*found.number, F_GETFL);
  if (flags >= 0 && (flags & O_ACCMODE) == O_RDONLY) errno = EBADF;
  return flags < 0 || (flags & O_ACCMODE) == O_RDONLY ? -1 : ::fcntl(*found.number, F_DUPFD_CLOEXEC, 0);
}

// The device and number of a file, its size and when it was written; none where there is no file.
using FileIdentity = std::optional<std::tuple<dev_t, ino_t, off_t, time_t, long>>;

FileIdentity identity_of(const std::string& path) {
  struct stat about {};
  if (::stat(path.c_str(), &about) != 0) return std::nullopt;
  return std::tuple(about.st_dev, about.st_ino, about.st_size, about.st_mtim.tv_sec, about.st_mtim.tv_nsec);
}

}  // namespace

OutputError output_failure(const std::string& path, const std::string& what, int reason) {
  return OutputError(final_name(path) + ": cannot " + what + ": " + std::generic_category().message(reason));
}

std::string followed(const std::string& path) {
  fs::path at = path;
  std::error_code error;
  for (int links = 0; fs::is_symlink(at, error); ++links) {
    if (links == kMostLinks) throw output_failure(path, "open for writing", ELOOP);
    at = at.parent_path() / fs::read_symlink(at, error);
  }
  return at;
}

std::string with_ending(const std::string& path, std::string_view ending) {
  const std::size_t begin = path.rfind('/') + 1;  // 0 where there is none
  std::size_t end = std::min(path.size(), begin + NAME_MAX - ending.size());
  while (end < path.size() && end > begin && (static_cast<unsigned char>(path[end]) & 0xc0U) == 0x80U) --end;
  return path.substr(0, end).append(ending);
}

std::string partial_name(const std::string& path) {
  std::array<char, 32> ending{};
  std::snprintf(ending.data(), ending.size(), ".partial-%08x", static_cast<unsigned>(system::random()));
  return with_ending(path, ending.data());
}

std::string final_name(const std::string& path) {
  static const std::regex partial("/\\.partial-[0-9a-f]{8}(?=/)|\\.partial-[0-9a-f]{8}(?=/|$)");
  return std::regex_replace(path, partial, "");
}

void sync_folder(const std::string& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  // EINVAL: a file system that has nothing to sync.
  const bool is_synced = descriptor >= 0 && (::fsync(descriptor) == 0 || errno == EINVAL);
  const int reason = errno;
  if (descriptor >= 0) ::close(descriptor);
  if (!is_synced) throw output_failure(folder, "sync", reason);
}

void write_file(const std::string& path, const std::string& text) {
  OutputFile file(path);
  file.stream() << text;
  file.commit();
}

bool is_standard_output(const std::string& path) {
  if (path == "-") return true;
  const auto found = open_descriptor(path);
  return found && found->number == STDOUT_FILENO;
}

bool is_written_directly(const std::string& path) {
  if (path == "-" || open_descriptor(path)) return true;
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

// A std::filebuf does not say why a write failed, and cannot be fsynced.
class OutputFile::Buffer : public std::streambuf {
 public:
  Buffer(std::string path, int descriptor) : path_(std::move(path)), before_(identity_of(path_)), descriptor_(descriptor) {
    empty();
  }
  ~Buffer() override {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  Buffer(const Buffer&) = delete;
  Buffer& operator=(const Buffer&) = delete;

  void write_out() {
    for (const char* from = pbase(); from != pptr();) {
      const ssize_t written = ::write(descriptor_, from, static_cast<std::size_t>(pptr() - from));
      if (written >= 0)
        from += written;
      else if (errno == EAGAIN)
        wait_for_room();
      else if (errno != EINTR)
        throw output_failure(path_, "write", errno);
    }
    empty();
  }

  void reach_disk() {
    if (::fsync(descriptor_) != 0) throw output_failure(path_, "write", errno);
  }

  // Another program has put a file of its own there, or has written to the one that was there.
  bool is_taken() const {
    const FileIdentity now = identity_of(path_);
    return now && now != before_;
  }

  // Some file systems say only here that a write failed.
  void close() {
    if (::close(std::exchange(descriptor_, -1)) != 0) throw output_failure(path_, "write", errno);
  }

 protected:
  int_type overflow(int_type c) override {
    write_out();
    return traits_type::eq_int_type(c, traits_type::eof()) ? traits_type::not_eof(c) : sputc(traits_type::to_char_type(c));
  }

  int sync() override {
    write_out();
    return 0;
  }

 private:
  void empty() { setp(bytes_.data(), bytes_.data() + bytes_.size()); }

  // A pipe that another program made non-blocking.
  void wait_for_room() const {
    pollfd room{descriptor_, POLLOUT, 0};
    ::poll(&room, 1, -1);
  }

  std::string path_;
  FileIdentity before_;
  int descriptor_;
  std::array<char, 1 << 16> bytes_;
};

OutputFile::OutputFile(std::string path) : path_(std::move(path)), stream_(nullptr) {
  std::error_code ignored;
  int descriptor = -1;
  if (path_ == "-") {
    path_ = "standard output";
    descriptor = ::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 0);
  } else if (const auto found = open_descriptor(path_)) {
    descriptor = opened(*found);
  } else {
    path_ = followed(path_);
    if (fs::exists(path_, ignored) && !fs::is_regular_file(path_, ignored)) {
      descriptor = ::open(path_.c_str(), O_WRONLY | O_CLOEXEC);
    } else {
      do {
        partial_path_ = partial_name(path_);
        descriptor = ::open(partial_path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
      } while (descriptor < 0 && errno == EEXIST);
    }
  }
  if (descriptor < 0) throw output_failure(path_, "open for writing", errno);
  buffer_ = std::make_unique<Buffer>(path_, descriptor);
  stream_.rdbuf(buffer_.get());
  stream_.imbue(std::locale::classic());  // a program may have another one, with points between thousands
  stream_.exceptions(std::ios_base::badbit);
}

OutputFile::~OutputFile() {
  if (!partial_path_.empty()) ::unlink(partial_path_.c_str());
}

void OutputFile::commit() {
  if (!stream_) throw OutputError(final_name(path_) + ": cannot write: an earlier write failed");
  buffer_->write_out();
  if (!partial_path_.empty()) buffer_->reach_disk();
  buffer_->close();
  if (partial_path_.empty()) return;
  // The work of neither is lost: the other file stays, and so does the partial one, under its name.
  if (buffer_->is_taken())
    throw OutputError(final_name(path_) + ": another program has written it meanwhile; what this one wrote is in " +
                      std::exchange(partial_path_, ""));
  if (::rename(partial_path_.c_str(), path_.c_str()) != 0) throw output_failure(path_, "replace", errno);
  partial_path_.clear();
  const fs::path folder = fs::path(path_).parent_path();
  sync_folder(folder.empty() ? "." : folder);
}

std::string folded_name(std::string name) {
  return small_letters(name);
}

std::string format_ending(const std::string& path) {
  return folded_name(std::filesystem::path(path).extension());
}

}  // namespace forceshade::files
