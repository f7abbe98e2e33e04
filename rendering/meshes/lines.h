// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A file as lines, and a line as words: in little memory, whatever the file holds.

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <string_view>

#include "forceshade/meshes.h"

namespace forceshade::mesh {

// Takes words, which white space separates, from the front of a line.
class Words {
 public:
  explicit Words(std::string_view line) : rest_(line) {}

  // Empty where no word is left.
  std::string_view next();

  // The rest of the line, without white space around it.
  std::string_view rest() const;

 private:
  std::string_view rest_;
};

// These may stand before the first word of a text, and between its words and lines.
inline constexpr std::string_view kBlank = " \t\v\f\r\n";

// Lines end in LF, CRLF or CR. A byte order mark in front of the first is no part of it.
class Lines {
 public:
  static constexpr std::size_t kLongest = std::size_t{1} << 20;  // bytes

  // Throws Error unless the file is a regular one that can be opened.
  explicit Lines(const std::filesystem::path& file);

  // Goes to the next line; false after the last one. Throws Error where a line is longer than kLongest.
  bool next();

  // Goes to the next line that has a word in front of any #. False after the last one.
  bool next_with_words();

  std::string_view line() const { return line_; }
  std::uint64_t number() const { return number_; }        // of the line, from 1
  std::uint64_t file_size() const { return file_size_; }  // bytes
  // Bytes of the file in front of the line after this one.
  std::uint64_t position() const { return position_; }

  // "FILE: line 12: REASON".
  Error error(const std::string& reason) const;
  // "FILE: line 12: expected EXPECTED, got "WORD"", or ... "the line ends" where the word is empty. A long word is cut.
  Error unexpected(const std::string& expected, std::string_view word) const;
  // "FILE: line 12: the file ends here; expected EXPECTED", or "FILE: is empty; expected EXPECTED".
  Error ended(const std::string& expected) const;

 private:
  bool fill();

  std::filesystem::path file_;
  std::ifstream in_;
  std::uint64_t file_size_;
  std::size_t room_;  // of the buffer
  std::unique_ptr<char[]> buffer_;
  std::size_t begin_ = 0, end_ = 0;  // of what was read and is in no line yet
  std::string_view line_;
  std::uint64_t number_ = 0, position_ = 0;
};

// A word of a file as a message shows it. A zero byte, which would end the message where it is printed, becomes \x00.
std::string in_quotes(std::string_view word);

// The size of a regular file. Throws Error.
std::uint64_t size_of(const std::filesystem::path& file);

}  // namespace forceshade::mesh
