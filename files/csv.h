// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Reads named columns of a CSV stream row by row; errors name file, line and column.

#include <cstddef>
#include <istream>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "files/input_file.h"
#include "text/number_text.h"

struct csv_parser;

namespace forceshade::files {

// UTF-8 with or without a byte order mark, lines ended by LF or CRLF, blank lines skipped, spaces around a field dropped,
// quotes as in RFC 4180, every row as long as the header, in front of which Excel's sep=, may stand. A row of more than
// kLongestRow bytes is an error, so that neither a binary file nor a forgotten quote fills the memory.
class Reader {
 public:
  static constexpr std::size_t kLongestRow = std::size_t{1} << 20;

  // without_header: no row of names, and blanks between the numbers: the columns are called 1, 2 and so on, and lines that
  // begin with # or % are skipped.
  enum class Layout { csv, without_header };

  // Reads the header row. `file` is what messages call the stream. Index i below is an index into `columns` followed by
  // `optional`; the file may have them in any order, and others beside them.
  Reader(std::istream& in, std::string file, std::vector<std::string> columns, const std::vector<std::string>& optional = {},
         Layout layout = Layout::csv);

  // True if the file has this column; only then may the functions below be called with it.
  bool has(std::size_t i) const { return place_[i] != kNowhere; }

  // Throws Error for a column beside those that were named, in a file that may have no others.
  void expect_no_other_column() const;

  // Goes to the next row; false after the last one. Throws Error, after which the reader is of no further use.
  bool next();

  // The line of the file in which the current row begins, from 1.
  std::size_t line() const noexcept { return row_line_; }

  const std::string& text(std::size_t i) const;

  // The nearest number, ties to even: 1e39 is infinite and 1e-60 is zero in binary32. Decimal (1.5, +2e-3),
  // hexfloat (0x1.8p+3), nan and inf; anything else throws unexpected(i, "a number").
  float binary32(std::size_t i) const;
  double binary64(std::size_t i) const;

  // The error to throw when the field is not what the caller needs.
  Error unexpected(std::size_t i, std::string_view expected) const;

 private:
  struct FreeParser {
    void operator()(csv_parser* parser) const noexcept;
  };

  static void on_field(void* text, std::size_t size, void* self) noexcept;
  static void on_row(int terminator, void* self) noexcept;

  bool read_line();
  bool read_row();
  void name_columns(std::string_view words);
  Error error(std::size_t line, std::string_view words) const;
  Error no_text(unsigned char byte, std::size_t at, std::string_view words) const;
  template <class T>
  T number(std::size_t i) const;

  std::streambuf& in_;
  std::string file_;
  std::vector<std::string> columns_;
  std::unique_ptr<csv_parser, FreeParser> parser_;
  std::string line_text_;
  std::size_t line_ = 0;
  std::size_t row_line_ = 0;
  bool row_complete_ = false;
  Layout layout_;
  bool is_row_read_ = false;         // the next one already
  std::vector<std::string> fields_;  // the first field_count_ belong to the current row, the rest keep their memory
  std::size_t field_count_ = 0;
  std::vector<std::string> header_;
  static constexpr std::size_t kNowhere = static_cast<std::size_t>(-1);
  std::vector<std::size_t> place_;  // place_[i]: where in a row columns_[i] is
};

}  // namespace forceshade::files
