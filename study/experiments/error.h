// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// An error in a file of an experiment, in words for its editor.

#include <cstddef>
#include <filesystem>
#include <string>

#include "forceshade/bad_input.h"

namespace forceshade::experiments {

// "FILE: reason", or "FILE:LINE: reason" where a line is known; the reason names the key or column, what was expected and what
// was got.
class Error : public files::BadInput {
 public:
  Error(const std::filesystem::path& file, const std::string& reason) : BadInput(file.string() + ": " + reason) {}
  Error(const std::filesystem::path& file, std::size_t line, const std::string& reason)
      : BadInput(file.string() + ":" + std::to_string(line) + ": " + reason) {}
};

}  // namespace forceshade::experiments
