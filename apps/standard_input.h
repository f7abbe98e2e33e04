// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Standard input, as commands read it, in the place of a file.

#include <fstream>
#include <istream>
#include <string>

#include "files/input_file.h"

namespace forceshade::apps {

// A wait for it ends with Interrupted where a signal comes that is to end the work; std::cin would wait on, or call it an
// error. Any other failure is a std::ios_base::failure.
std::istream& standard_input();

inline bool is_standard_input(const std::string& file) {
  return file == "-";
}

// The file's name in messages.
inline std::string name_of_input(const std::string& file) {
  return is_standard_input(file) ? "standard input" : file;
}

// The file of this name, or standard input for "-".
class InputFile {
 public:
  // Throws as `open` does.
  explicit InputFile(const std::string& file, std::ifstream (*open)(const std::string&) = files::open_input)
      : name_(name_of_input(file)), is_file_(!is_standard_input(file)) {
    if (is_file_) file_ = open(file);
  }

  std::istream& stream() { return is_file_ ? file_ : standard_input(); }
  const std::string& name() const { return name_; }  // in messages

 private:
  std::string name_;
  bool is_file_;
  std::ifstream file_;
};

}  // namespace forceshade::apps
