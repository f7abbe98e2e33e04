// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The one exception for what is refused: a text, a file or a value in it, a file that cannot be written, a device.
//
//   try {
//     const auto spec = heights::read_spec("bump.toml");  // of heights.h
//   } catch (const Error& error) {
//     std::puts(error.what());  // where, what was expected, and what was got
//   }
//
// Not promised: the words. What comes from a user or a file may hold any bytes in them.

#if __cplusplus < 202002L
#error "forceshade is in C++20: expected -std=c++20 or later"
#endif

#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

namespace forceshade {

// what() says where (a file and its line, or an option), what was expected and what was got.
class Error : public std::runtime_error {
 public:
  enum class Lines { one, several };

  // Lines::several: such as the faults of a mesh, each a line; what comes from a file is printable already, so that no name
  // can begin a line.
  explicit Error(const std::string& reason, Lines lines = Lines::one) : runtime_error(reason), lines_(lines) {}

  // "FILE: reason", and "FILE:LINE: reason" where the line is known, not 0, which is the one that an editor shows.
  Error(const std::filesystem::path& file, const std::string& reason) : Error(file.string(), "", reason) {}
  Error(const std::filesystem::path& file, std::size_t line, const std::string& reason)
      : Error(file.string(), line == 0 ? "" : std::string(":") + std::to_string(line), reason) {}

  // The words behind the file and its line.
  std::string_view reason() const noexcept { return std::string_view(what()).substr(begin_); }
  bool has_lines() const noexcept { return lines_ == Lines::several; }

 private:
  Error(const std::string& file, const std::string& line, const std::string& reason)
      : runtime_error(file + line + ": " + reason), begin_(file.size() + line.size() + 2) {}

  std::size_t begin_ = 0;
  Lines lines_ = Lines::one;
};

}  // namespace forceshade
