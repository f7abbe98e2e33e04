// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Files that appear in a folder together or not at all.

#include <filesystem>
#include <string>

#include "files/output_file.h"

namespace forceshade::files {

// Files are written into a partial folder: PATH.partial-00000000 beside a PATH that is not there, PATH/.partial-00000000 in one
// that is; of a name of PATH that is cut, the digits are made of the whole name. commit() puts them in place once every byte of
// them has reached the disk: a new PATH by one rename; in a PATH that is there one rename follows the other, and if one fails,
// those before it are undone. Without commit() nothing is left; only a process that is killed leaves the partial folder, which
// nothing reads, and which the next one for the same PATH removes.
//
// The partial folder is locked (flock), so that one PATH has one OutputFolder at a time, in this process and in all of the
// machine. A command that works for long makes its OutputFolder before the work. A file system without such locks, as NFS is,
// gives every OutputFolder a partial folder of its own; there the second commit() of a new PATH fails.
class OutputFolder {
 public:
  // Makes the folders that PATH is in, where they are missing. Throws OutputError, also where another OutputFolder has PATH.
  explicit OutputFolder(const std::filesystem::path& path);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  // PATH, without a slash at its end.
  const std::filesystem::path& path() const noexcept { return path_; }

  // The partial folder, for writers of files by path; all are to be OutputFiles. It may have folders of its own.
  const std::filesystem::path& so_far() const noexcept { return partial_; }

  // True where PATH is not there, or is a folder that holds nothing.
  bool is_for_an_empty_path() const;

  // One file. Throws OutputError, which names the file in PATH.
  void write(const std::string& name, const std::string& text) const;

  // Call once, last. A file of the same name is replaced; anything else of that name, such as a folder or a symbolic link, is
  // an error. Throws OutputError, and then PATH is as it was.
  void commit();

 private:
  bool has_claimed(const std::filesystem::path& partial);
  void give_up();
  void put_in_place() const;

  std::filesystem::path path_, partial_;
  bool is_there_ = false;
  int lock_ = -1;  // descriptor of the partial folder
};

}  // namespace forceshade::files
