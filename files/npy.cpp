// SPDX-License-Identifier: BSD-3-Clause
#include "files/npy.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <optional>
#include <utility>

namespace forceshade::files {
namespace {

constexpr std::size_t kLongestHeader = 1 << 16;
constexpr std::array<unsigned char, 6> kMagic{0x93, 'N', 'U', 'M', 'P', 'Y'};

std::string read_header(std::istream& in) {
  std::array<unsigned char, 12> head{};
  in.read(reinterpret_cast<char*>(head.data()), 10);
  if (!in || !std::equal(kMagic.begin(), kMagic.end(), head.begin())) throw Error("has no NPY header");
  if (head[6] < 1 || head[6] > 3 || head[7] != 0)
    throw Error("is of NPY version " + std::to_string(head[6]) + '.' + std::to_string(head[7]) + "; expected 1.0, 2.0 or 3.0");
  std::size_t length = head[8] + 256U * head[9];
  if (head[6] >= 2) {
    in.read(reinterpret_cast<char*>(&head[10]), 2);
    length += (std::size_t{head[10]} << 16) + (std::size_t{head[11]} << 24);
  }
  if (!in || length > kLongestHeader) throw Error("has no NPY header");
  std::string header(length, '\0');
  if (!in.read(header.data(), static_cast<std::streamsize>(length))) throw Error("is truncated");
  return header;
}

// Reads a text from its front.
class Front {
 public:
  explicit Front(std::string_view text) : text_(text) {}

  bool take(std::string_view expected) {
    if (!text_.starts_with(expected)) return false;
    text_.remove_prefix(expected.size());
    return true;
  }
  // All in front of the character, which goes too; nothing if there is none.
  std::optional<std::string> until(char end) {
    const std::size_t size = text_.find(end);
    if (size == std::string_view::npos) return std::nullopt;
    std::string taken(text_.substr(0, size));
    text_.remove_prefix(size + 1);
    return taken;
  }
  void skip(char space) {
    while (text_.starts_with(space)) text_.remove_prefix(1);
  }
  std::optional<std::uint64_t> number() {
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(text_.data(), text_.data() + text_.size(), value);
    if (error != std::errc()) return std::nullopt;
    text_.remove_prefix(static_cast<std::size_t>(end - text_.data()));
    return value;
  }
  bool empty() const { return text_.empty(); }

 private:
  std::string_view text_;
};

// The three entries that NumPy writes, each once and in any order, and no other: {'key': value, ...}, spaces, a line's end. A
// value is a text in quotes, a list in brackets, or a word.
std::optional<std::map<std::string, std::string>> entries_of(std::string_view header) {
  Front at(header);
  std::map<std::string, std::string> entries;
  if (!at.take("{")) return std::nullopt;
  for (at.skip(' '); !at.take("}"); at.skip(' ')) {
    const auto key = at.take("'") ? at.until('\'') : std::nullopt;
    if (!key || !at.take(":")) return std::nullopt;
    at.skip(' ');
    const bool is_list = at.take("[");
    const char end = is_list ? ']' : at.take("'") ? '\'' : at.take("(") ? ')' : ',';
    auto value = at.until(end);
    if (value && is_list) *value = '[' + *value + ']';
    if (!value || !entries.emplace(*key, *value).second || (end != ',' && !at.take(","))) return std::nullopt;
  }
  at.skip(' ');
  at.take("\n");
  const bool is_known = entries.contains("descr") && entries.contains("fortran_order") && entries.contains("shape");
  return at.empty() && is_known && entries.size() == 3 ? std::optional(entries) : std::nullopt;
}

// "3, 4", "3," or nothing.
std::optional<std::vector<std::uint64_t>> numbers_of(std::string_view tuple) {
  Front at(tuple);
  std::vector<std::uint64_t> numbers;
  while (!at.empty()) {
    const auto number = at.number();
    if (!number || (!at.take(",") && !at.empty())) return std::nullopt;
    numbers.push_back(*number);
    at.skip(' ');
  }
  return numbers;
}

}  // namespace

NpyHead read_npy_head(std::istream& in) {
  auto entries = entries_of(read_header(in));
  if (!entries) throw Error("has no NPY header: expected a dictionary of descr, fortran_order and shape");
  const std::string &order = entries->at("fortran_order"), &shape = entries->at("shape");
  if (order != "False" && order != "True") throw Error("has fortran_order " + order + "; expected True or False");
  auto numbers = numbers_of(shape);
  if (!numbers) throw Error("is of shape (" + shape + "); expected whole numbers");
  return {entries->at("descr"), order == "True", shape, std::move(*numbers)};
}

// The magic word, the version, the length of a header that ends the first multiple of 64 bytes, the header.
std::string npy_header(std::string_view layout, std::uint64_t rows) {
  std::string header =
      "{'descr': " + std::string(layout) + ", 'fortran_order': False, 'shape': (" + std::to_string(rows) + ",), }";
  constexpr std::size_t kPreamble = 10;
  header.append(63 - (kPreamble + header.size()) % 64, ' ');
  header += '\n';
  const std::array length{static_cast<char>(header.size() & 0xFF), static_cast<char>(header.size() >> 8)};
  return std::string("\x93NUMPY\x01\x00", 8) + std::string(length.data(), 2) + header;
}

}  // namespace forceshade::files
