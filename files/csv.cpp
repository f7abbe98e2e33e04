// SPDX-License-Identifier: BSD-3-Clause
#include "files/csv.h"

#include <csv.h>
#include <locale.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <new>
#include <optional>
#include <system_error>
#include <utility>

#include "files/file_kind.h"
#include "files/printable.h"
#include "text/joined.h"
#include "text/letters.h"

namespace forceshade::files {
namespace {

constexpr int kEnd = std::char_traits<char>::eof();

std::optional<std::size_t> first_byte_not_utf8(std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t size = character_size(text.substr(at));
    if (size == 0) return at;
    at += size;
  }
  return std::nullopt;
}

std::string hex(unsigned char byte) {
  std::array<char, 8> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "0x%02x", static_cast<unsigned>(byte));
  return buffer.data();
}

// In quotes, on one line, and short enough to read.
std::string in_quotes(std::string_view text) {
  constexpr std::size_t kLongest = 60;
  std::size_t size = 0;
  while (size < text.size() && size < kLongest) size += std::max<std::size_t>(character_size(text.substr(size)), 1);
  return '"' + printable(text.substr(0, size)) + (size < text.size() ? "...\"" : "\"");
}

void convert(const char* text, locale_t locale, float& value) {
  value = strtof_l(text, nullptr, locale);
}
void convert(const char* text, locale_t locale, double& value) {
  value = strtod_l(text, nullptr, locale);
}

// from_chars decides what a number looks like. Its value is used only for decimals in range: libstdc++ 12 rounds some
// subnormal hexfloats wrongly (0x5.fbdaa4p-131), and out of range it does not distinguish too large from too small.
template <class T>
std::optional<T> parse(const std::string& text) {
  std::string_view digits = text;
  const bool has_sign = digits.starts_with('+') || digits.starts_with('-');
  const bool is_hex = digits.substr(has_sign ? 1 : 0).starts_with("0x") || digits.substr(has_sign ? 1 : 0).starts_with("0X");
  if (is_hex)
    digits.remove_prefix(has_sign ? 3 : 2);
  else if (digits.starts_with('+'))
    digits.remove_prefix(1);

  constexpr std::string_view kHexStart = "0123456789abcdefABCDEF.";
  if (is_hex && (digits.empty() || kHexStart.find(digits.front()) == std::string_view::npos)) return std::nullopt;
  if (text.starts_with('+') && digits.starts_with('-')) return std::nullopt;

  T value{};
  const auto format = is_hex ? std::chars_format::hex : std::chars_format::general;
  const auto [end, code] = std::from_chars(digits.data(), digits.data() + digits.size(), value, format);
  if (end != digits.data() + digits.size() || code == std::errc::invalid_argument) return std::nullopt;
  if (is_hex || code == std::errc::result_out_of_range) {
    static const locale_t c_locale = newlocale(LC_ALL_MASK, "C", nullptr);
    convert(text.c_str(), c_locale, value);
  }
  return value;
}

// The name of the character that divides the columns of a header without commas; empty where no known one does.
std::string separator_of(const std::vector<std::string>& header) {
  if (header.size() != 1) return "";
  for (const auto& [separator, name] : {std::pair{';', "semicolons"}, {'\t', "tabs"}, {'|', "bars"}})
    if (header.front().find(separator) != std::string::npos) return name;
  return "";
}

// A name in small letters, without blanks at its ends.
std::string plain_name(std::string text) {
  text.erase(text.find_last_not_of(' ') + 1);
  text.erase(0, text.find_first_not_of(' '));
  return small_letters(text);
}

// 1,5 for 1.5
bool has_decimal_comma(std::string text) {
  if (std::ranges::count(text, ',') != 1) return false;
  std::ranges::replace(text, ',', '.');
  return parse<double>(text).has_value();
}

// Commas in the place of blanks; false where the line is a remark.
bool divide_at_blanks(std::string& line) {
  std::string divided;
  for (std::size_t at = line.find_first_not_of(" \t"); at < line.size();) {
    const std::size_t end = std::min(line.find_first_of(" \t", at), line.size());
    divided += (divided.empty() ? "" : ",") + line.substr(at, end - at);
    at = line.find_first_not_of(" \t", end);
  }
  line = std::move(divided);
  return !line.starts_with('#') && !line.starts_with('%');
}

}  // namespace

void Reader::FreeParser::operator()(csv_parser* parser) const noexcept {
  csv_free(parser);
  delete parser;
}

// noexcept, since an exception must not cross the C library: out of memory ends the program here, and rows are short.
void Reader::on_field(void* text, std::size_t size, void* self) noexcept {
  auto& reader = *static_cast<Reader*>(self);
  if (reader.field_count_ == reader.fields_.size()) reader.fields_.emplace_back();
  reader.fields_[reader.field_count_++].assign(static_cast<const char*>(text), size);
}

void Reader::on_row(int, void* self) noexcept {
  static_cast<Reader*>(self)->row_complete_ = true;
}

// The error of the line that was read last, whose next byte is not of a text. Some kinds of file show only in the bytes behind
// it.
Error Reader::no_text(unsigned char byte, std::size_t at, std::string_view words) const {
  std::string behind(static_cast<std::size_t>(std::clamp<std::streamsize>(in_.in_avail(), 0, 16)), '\0');
  if (line_ == 1) in_.sgetn(behind.data(), static_cast<std::streamsize>(behind.size()));
  const std::string kind = line_ == 1 ? binary_kind(line_text_ + static_cast<char>(byte) + behind) : "";
  if (!kind.empty()) return Error(file_ + ": expected a CSV file, got " + kind);
  return error(line_, "byte " + std::to_string(at + 1) + ": " + std::string(words) + hex(byte));
}

Error Reader::error(std::size_t line, std::string_view words) const {
  std::string kind;
  if (line == 1 && line_ == 1 && !line_text_.empty()) {
    kind = binary_kind(line_text_);
    if (kind.empty()) kind = text_kind(line_text_);
  }
  if (!kind.empty() && kind != kCsvFile) return Error(file_ + ": expected a CSV file, got " + kind);
  return Error(file_ + ':' + std::to_string(line) + ": " + std::string(words));
}

Error Reader::unexpected(std::size_t i, std::string_view expected) const {
  return error(row_line_, "column " + std::to_string(place_[i] + 1) + " (" + columns_[i] + "): expected " +
                              std::string(expected) + ", got " + in_quotes(text(i)));
}

Reader::Reader(std::istream& in, std::string file, std::vector<std::string> columns, const std::vector<std::string>& optional,
               Layout layout)
    : in_(*in.rdbuf()), file_(std::move(file)), columns_(std::move(columns)), parser_(new csv_parser), layout_(layout) {
  if (csv_init(parser_.get(), CSV_STRICT) != 0) throw std::bad_alloc();
  csv_set_term_func(parser_.get(), [](unsigned char c) -> int { return c == '\n'; });

  name_columns("expected " + std::string(layout == Layout::csv ? "a header row with" : "rows with the") + " columns " +
               joined(columns_, ", "));
  const std::size_t required = columns_.size();
  columns_.insert(columns_.end(), optional.begin(), optional.end());
  for (const std::string& column : columns_) {
    const bool is_optional = place_.size() >= required;
    auto found = std::find(header_.begin(), header_.end(), column);
    // Reset is read as reset, too: nobody would notice that the column was left out.
    if (found == header_.end() && is_optional) found = std::ranges::find(header_, column, plain_name);
    if (found == header_.end() && is_optional) {
      place_.push_back(kNowhere);
      continue;
    }
    if (const std::string separator = separator_of(header_); found == header_.end() && !separator.empty())
      throw error(row_line_, "expected commas between the columns, and points in decimals, got " + separator + " in " +
                                 in_quotes(header_.front()));
    if (found == header_.end())
      throw error(row_line_, "no column " + column + ": expected columns " + joined(columns_, ", ") + ", got " +
                                 in_quotes(joined(header_, ", ")));
    const auto again = std::ranges::find_if(header_, [&](const std::string& name) {
      return &name != &*found && (name == *found || (is_optional && plain_name(name) == column));
    });
    const auto [first, second] = std::minmax(found, again);
    const auto number = [&](auto at) { return std::to_string(at - header_.begin() + 1); };
    if (again != header_.end())
      throw error(row_line_, "columns " + number(first) + " and " + number(second) + " are both called " + column);
    place_.push_back(static_cast<std::size_t>(found - header_.begin()));
  }
}

void Reader::expect_no_other_column() const {
  for (std::size_t i = 0; i < header_.size(); ++i)
    if (std::find(columns_.begin(), columns_.end(), header_[i]) == columns_.end())
      throw error(row_line_, "column " + std::to_string(i + 1) + ": expected one of " + joined(columns_, ", ") + ", got " +
                                 in_quotes(header_[i]));
}

void Reader::name_columns(std::string_view words) {
  const auto says_comma = [&] {
    return layout_ == Layout::csv && line_ == 1 && (line_text_ == "sep=,\n" || line_text_ == "\"sep=,\"\n");
  };
  if (!read_row() || (says_comma() && !read_row())) throw error(1, std::string(words) + ", got an empty file");
  header_.assign(fields_.begin(), fields_.begin() + static_cast<std::ptrdiff_t>(field_count_));
  if (layout_ == Layout::csv) return;
  for (std::size_t i = 0; i < header_.size(); ++i) header_[i] = std::to_string(i + 1);
  is_row_read_ = true;
}

bool Reader::next() {
  if (!std::exchange(is_row_read_, false) && !read_row()) return false;
  const std::string expected = "expected " + std::to_string(header_.size()) + " fields, got " + std::to_string(field_count_);
  if (field_count_ < header_.size())
    throw error(row_line_,
                expected + ": column " + std::to_string(field_count_ + 1) + " (" + header_[field_count_] + ") is missing");
  if (field_count_ > header_.size())
    throw error(row_line_, expected + ": column " + std::to_string(header_.size() + 1) + " has no name in the header" +
                               (field_count_ == 2 * header_.size() ? "; a decimal is written with a point, not a comma" : ""));
  return true;
}

// The next physical line without its end, in line_text_; false at the end of the file.
bool Reader::read_line() try {
  line_text_.clear();
  int c = in_.sbumpc();
  if (c == kEnd) return false;
  ++line_;
  for (; c != kEnd && c != '\n'; c = in_.sbumpc()) {
    const auto byte = static_cast<unsigned char>(c);
    const bool ends_line = byte == '\r' && (in_.sgetc() == '\n' || in_.sgetc() == kEnd);
    if (ends_line) continue;
    if ((byte < 0x20 && byte != '\t') || byte == 0x7F)
      throw no_text(byte, line_text_.size(), "expected text, got the control character ");
    if (line_text_.size() == kLongestRow)
      throw error(line_, "expected at most " + std::to_string(kLongestRow) + " bytes in a row, got more");
    line_text_ += static_cast<char>(byte);
  }
  if (const auto at = first_byte_not_utf8(line_text_))
    throw no_text(static_cast<unsigned char>(line_text_[*at]), *at, "expected UTF-8 text, got ");
  if (line_ == 1 && line_text_.starts_with(kByteOrderMark)) line_text_.erase(0, kByteOrderMark.size());
  return true;
} catch (const std::ios_base::failure& failure) {
  throw error(line_ + 1, "cannot read: " + failure.code().message());
}

// One row, which may span lines where a quoted field does; false at the end of the file.
bool Reader::read_row() {
  field_count_ = 0;
  row_complete_ = false;
  std::size_t row_size = 0;
  while (!row_complete_) {
    if (!read_line()) {
      if (row_size == 0) return false;
      throw error(row_line_, "expected a closing quote in the row that begins here, got the end of the file");
    }
    if (row_size == 0) {
      if (line_text_.find_first_not_of(" \t") == std::string::npos) continue;
      row_line_ = line_;
    }
    if (layout_ == Layout::without_header && !divide_at_blanks(line_text_)) continue;
    line_text_ += '\n';
    row_size += line_text_.size();
    if (row_size > kLongestRow + 1)
      throw error(row_line_,
                  "expected at most " + std::to_string(kLongestRow) + " bytes in a row, got more: is a quote left open?");
    if (csv_parse(parser_.get(), line_text_.data(), line_text_.size(), on_field, on_row, this) == line_text_.size()) continue;
    if (csv_error(parser_.get()) == CSV_ENOMEM) throw std::bad_alloc();
    throw error(line_, "column " + std::to_string(field_count_ + 1) +
                           ": expected quotes around a whole field and doubled inside it, got a stray one");
  }
  return true;
}

const std::string& Reader::text(std::size_t i) const {
  return fields_[place_[i]];
}

template <class T>
T Reader::number(std::size_t i) const {
  if (const auto value = parse<T>(text(i))) return *value;
  throw unexpected(i, has_decimal_comma(text(i)) ? "a number with a decimal point" : "a number");
}

float Reader::binary32(std::size_t i) const {
  return number<float>(i);
}

double Reader::binary64(std::size_t i) const {
  return number<double>(i);
}

}  // namespace forceshade::files
