// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A file that appears under its name whole or not at all.

#include <memory>
#include <ostream>
#include <string>
#include <string_view>

#include "forceshade/error.h"

namespace forceshade::files {

// what() names the path and the system's reason.
struct OutputError : Error {
  using Error::Error;
};

// Writes to PATH.partial-XXXXXXXX beside PATH; commit() puts it in the place of PATH, and without commit() nothing is left.
// Only a process that is killed leaves the partial file, and a commit() that fails because another program has written PATH
// meanwhile. A symbolic link keeps being one: what it points to is replaced, or
// made where it is not there. What is_written_directly() is written to as a shell does it.
class OutputFile {
 public:
  explicit OutputFile(std::string path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  // Throws OutputError from the insertion that fails, so that a full disk ends a long run at once.
  std::ostream& stream() noexcept { return stream_; }

  // Call once, last: flushes, has the bytes and then the new name reach the disk. Throws OutputError.
  void commit();

 private:
  class Buffer;

  std::string path_;
  std::string partial_path_;  // empty when writing directly
  std::unique_ptr<Buffer> buffer_;
  std::ostream stream_;
};

// Writes the file whole or not at all; "-" is standard output. Throws OutputError.
void write_file(const std::string& path, const std::string& text);

// True if this names standard output (not in order with std::cout): "-", /dev/stdout, /dev/fd/1.
bool is_standard_output(const std::string& path);

// True if a file of this name cannot be replaced, but only be written to: standard output, another open descriptor such as
// /dev/fd/3 or what a shell puts in the place of >(COMMAND), a named pipe, a device such as /dev/null. Not a folder.
bool is_written_directly(const std::string& path);

// The name at the end of the symbolic links that begin at this one, whether or not there is a file. Throws OutputError where
// they lead in a circle.
std::string followed(const std::string& path);

// The path and this ending. Of a name that becomes too long for a file system, the last characters make room. Two
// such names may become one.
std::string with_ending(const std::string& path, std::string_view ending);

// PATH.partial-XXXXXXXX with eight random hexadecimal digits.
std::string partial_name(const std::string& path);

// The path under which a partial file, or a file in a partial folder, will appear: messages name that.
std::string final_name(const std::string& path);

// The names of the files in this folder reach the disk, where its file system can do that. Throws OutputError.
void sync_folder(const std::string& folder);

// The error to throw: `path: cannot DO: reason`. `reason` is an errno.
OutputError output_failure(const std::string& path, const std::string& what, int reason);

// The name with small letters of ASCII for capital ones: where two have the same, some file systems have one file.
std::string folded_name(std::string name);

// ".npy" for a file FILE.npy, and for FILE.NPY.
std::string format_ending(const std::string& path);

}  // namespace forceshade::files
