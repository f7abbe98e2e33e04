// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Files that appear in a folder together or not at all.

#include <filesystem>
#include <string>

#include "files/output_file.h"

namespace forceshade::files {

// Files are written into a partial folder: PATH.partial-XXXXXXXX beside a PATH that is not there, PATH/.partial-XXXXXXXX in one
// that is. commit() puts them in place once every byte of them has reached the disk: a new PATH by one rename; in a PATH that
// is there one rename follows the other, and if one fails, those before it are undone. Without commit() nothing is left; only
// a process that is killed leaves the partial folder, which nothing reads.
class OutputFolder {
 public:
  // Makes the folders that PATH is in, where they are missing. Throws OutputError.
  explicit OutputFolder(const std::filesystem::path& path);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  // The partial folder, for writers of files by path; all are to be OutputFiles. It may have folders of its own.
  const std::filesystem::path& so_far() const noexcept { return partial_; }

  // One file. Throws OutputError, which names the file in PATH.
  void write(const std::string& name, const std::string& text) const;

  // Call once, last. A file of the same name is replaced; anything else of that name, such as a folder or a symbolic link, is
  // an error. Throws OutputError, and then PATH is as it was.
  void commit();

 private:
  void put_in_place() const;

  std::filesystem::path path_, partial_;
  bool is_there_ = false;
};

}  // namespace forceshade::files
