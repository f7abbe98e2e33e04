// SPDX-License-Identifier: BSD-3-Clause
#include "files/input_file.h"

#include <cerrno>
#include <system_error>

#include "files/file_kind.h"

namespace forceshade::files {

std::ifstream open_input(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw Error(path + ": cannot open: " + std::generic_category().message(errno));
  return in;
}

std::ifstream open_file(const std::string& path) {
  if (is_folder(path)) throw Error(path + ": cannot open: Is a directory");
  if (is_named_pipe(path)) throw Error(path + ": cannot open: it is a named pipe; expected a file");
  return open_input(path);
}

}  // namespace forceshade::files
