// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/csv/output_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <random>
#include <streambuf>
#include <system_error>
#include <utility>

namespace forceshade::csv {
namespace {

OutputError failure(const std::string& path, const std::string& what, int reason) {
  return OutputError(path + ": cannot " + what + ": " + std::generic_category().message(reason));
}

std::string partial_name(const std::string& path) {
  std::array<char, 9> digits{};
  std::snprintf(digits.data(), digits.size(), "%08x", static_cast<unsigned>(std::random_device{}()));
  return path + ".partial-" + digits.data();
}

}  // namespace

// A std::filebuf does not say why a write failed, and cannot be fsynced.
class OutputFile::Buffer : public std::streambuf {
 public:
  Buffer(std::string path, int descriptor) : path_(std::move(path)), descriptor_(descriptor) { empty(); }
  ~Buffer() override { ::close(descriptor_); }
  Buffer(const Buffer&) = delete;
  Buffer& operator=(const Buffer&) = delete;

  void write_out() {
    for (const char* from = pbase(); from != pptr();) {
      const ssize_t written = ::write(descriptor_, from, static_cast<std::size_t>(pptr() - from));
      if (written >= 0)
        from += written;
      else if (errno != EINTR)
        throw failure(path_, "write", errno);
    }
    empty();
  }

  void reach_disk() {
    if (::fsync(descriptor_) != 0) throw failure(path_, "write", errno);
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

  std::string path_;
  int descriptor_;
  std::array<char, 1 << 16> bytes_;
};

OutputFile::OutputFile(std::string path) : path_(std::move(path)), stream_(nullptr) {
  namespace fs = std::filesystem;
  std::error_code ignored;
  int descriptor = -1;
  if (path_ == "-") {
    path_ = "standard output";
    descriptor = ::dup(STDOUT_FILENO);
  } else {
    if (fs::is_symlink(path_, ignored) && fs::exists(path_, ignored)) path_ = fs::canonical(path_);
    if (fs::exists(path_, ignored) && !fs::is_regular_file(path_, ignored)) {
      descriptor = ::open(path_.c_str(), O_WRONLY | O_CLOEXEC);
    } else {
      do {
        partial_path_ = partial_name(path_);
        descriptor = ::open(partial_path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
      } while (descriptor < 0 && errno == EEXIST);
    }
  }
  if (descriptor < 0) throw failure(path_, "open for writing", errno);
  buffer_ = std::make_unique<Buffer>(path_, descriptor);
  stream_.rdbuf(buffer_.get());
  stream_.exceptions(std::ios_base::badbit);
}

OutputFile::~OutputFile() {
  if (!partial_path_.empty()) ::unlink(partial_path_.c_str());
}

void OutputFile::commit() {
  if (!stream_) throw OutputError(path_ + ": cannot write: an earlier write failed");
  buffer_->write_out();
  if (partial_path_.empty()) return;
  buffer_->reach_disk();
  if (::rename(partial_path_.c_str(), path_.c_str()) != 0) throw failure(path_, "replace", errno);
  partial_path_.clear();
}

}  // namespace forceshade::csv
