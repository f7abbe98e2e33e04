// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A file that appears under its name whole or not at all.

#include <memory>
#include <ostream>
#include <stdexcept>
#include <string>

namespace forceshade::csv {

// what() names the path and the system's reason.
struct OutputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Writes to PATH.partial-XXXXXXXX beside PATH; commit() puts it in the place of PATH, and without commit() nothing is left.
// A symbolic link keeps being one: what it points to is replaced. Written to directly are "-", which is standard output
// (not in order with std::cout), and an existing PATH that is no regular file, such as /dev/null or a pipe.
class OutputFile {
 public:
  explicit OutputFile(std::string path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  // Throws OutputError from the insertion that fails, so that a full disk ends a long run at once.
  std::ostream& stream() noexcept { return stream_; }

  // Call once, last: flushes, has the bytes reach the disk, renames. Throws OutputError.
  void commit();

 private:
  class Buffer;

  std::string path_;
  std::string partial_path_;  // empty when writing directly
  std::unique_ptr<Buffer> buffer_;
  std::ostream stream_;
};

}  // namespace forceshade::csv
