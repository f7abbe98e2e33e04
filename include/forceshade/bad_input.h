// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The one exception for input that cannot be used: a text, a file or a value in it.
//
//   try {
//     const auto spec = heights::read_spec("bump.toml");  // of heights.h
//   } catch (const files::BadInput& error) {
//     std::puts(error.what());  // where, what was expected, and what was got
//   }
//
// Not promised: the words. What comes from a user or a file may hold any bytes in them.

#if __cplusplus < 202002L
#error "forceshade is in C++20: expected -std=c++20 or later"
#endif

#include <stdexcept>
#include <string>

namespace forceshade::files {

// what() says where (a file and its line, or an option), what was expected and what was got.
class BadInput : public std::runtime_error {
 public:
  enum class Lines { one, several };

  // Lines::several: such as the faults of a mesh, each a line; what comes from a file is printable already, so that no name
  // can begin a line.
  explicit BadInput(const std::string& words, Lines lines = Lines::one) : runtime_error(words), lines_(lines) {}

  bool has_lines() const { return lines_ == Lines::several; }

 private:
  Lines lines_;
};

}  // namespace forceshade::files
