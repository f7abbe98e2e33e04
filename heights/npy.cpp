// SPDX-License-Identifier: BSD-3-Clause
// NPY, NumPy's own format, versions 1 to 3: a magic, the header's length, a Python dictionary, the numbers row by row.

#include <charconv>
#include <fstream>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "forceshade/heights/byte_order.h"
#include "forceshade/heights/samples.h"

namespace forceshade::heights {
namespace {

constexpr std::size_t kLongestHeader = 1 << 16;

std::string read_header(std::ifstream& in, const std::filesystem::path& file) {
  std::array<unsigned char, 12> head{};
  in.read(reinterpret_cast<char*>(head.data()), 10);
  if (in && (head[6] < 1 || head[6] > 3 || head[7] != 0))
    throw Error(file,
                "is of NPY version " + std::to_string(head[6]) + '.' + std::to_string(head[7]) + "; expected 1.0, 2.0 or 3.0");
  std::size_t length = head[8] + 256U * head[9];
  if (head[6] >= 2) {
    in.read(reinterpret_cast<char*>(&head[10]), 2);
    length += (std::size_t{head[10]} << 16) + (std::size_t{head[11]} << 24);
  }
  if (!in || length > kLongestHeader) throw Error(file, "has no NPY header");
  std::string header(length, '\0');
  if (!in.read(header.data(), static_cast<std::streamsize>(length))) throw Error(file, "is truncated");
  return header;
}

// The numbers of an array, which fill the rest of the file.
template <class T>
std::vector<T> read_numbers(std::ifstream& in, std::size_t count, bool reversed, const std::filesystem::path& file) {
  std::vector<T> numbers(count);
  if (!in.read(reinterpret_cast<char*>(numbers.data()), static_cast<std::streamsize>(count * sizeof(T))))
    throw Error(file, "is truncated");
  if (in.peek() != EOF) throw Error(file, "goes on after its last number");
  if (reversed) reverse_bytes(numbers);
  return numbers;
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
// value is a text in quotes, a list in round brackets, or a word.
std::optional<std::map<std::string, std::string>> entries_of(std::string_view header) {
  Front at(header);
  std::map<std::string, std::string> entries;
  if (!at.take("{")) return std::nullopt;
  for (at.skip(' '); !at.take("}"); at.skip(' ')) {
    const auto key = at.take("'") ? at.until('\'') : std::nullopt;
    if (!key || !at.take(":")) return std::nullopt;
    at.skip(' ');
    const char end = at.take("'") ? '\'' : at.take("(") ? ')' : ',';
    const auto value = at.until(end);
    if (!value || !entries.emplace(*key, *value).second || (end != ',' && !at.take(","))) return std::nullopt;
  }
  at.skip(' ');
  at.take("\n");
  const bool is_known = entries.contains("descr") && entries.contains("fortran_order") && entries.contains("shape");
  return at.empty() && is_known && entries.size() == 3 ? std::optional(entries) : std::nullopt;
}

// "ROWS, COLUMNS" and nothing else.
std::optional<std::array<std::uint64_t, 2>> two_numbers(std::string_view tuple) {
  Front at(tuple);
  const auto rows = at.number();
  if (!rows || !at.take(",")) return std::nullopt;
  at.skip(' ');
  const auto columns = at.number();
  return columns && at.empty() ? std::optional(std::array{*rows, *columns}) : std::nullopt;
}

}  // namespace

Samples read_npy(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  const std::string header = read_header(in, file);
  const auto entries = entries_of(header);
  if (!entries) throw Error(file, "has no NPY header: expected a dictionary of descr, fortran_order and shape");
  const std::string &type = entries->at("descr"), &order = entries->at("fortran_order");
  const bool is_little = type.starts_with('<'), is_binary64 = type.ends_with("f8");
  if (type != "<f4" && type != ">f4" && type != "<f8" && type != ">f8")
    throw Error(file, "holds numbers of type " + type + "; expected binary32 or binary64: <f4, >f4, <f8 or >f8");
  if (order != "False") throw Error(file, "is not stored row by row: expected fortran_order False, got " + order);
  const auto shape = two_numbers(entries->at("shape"));
  if (!shape) throw Error(file, "is of shape (" + entries->at("shape") + "); expected two dimensions");
  const bool reversed = is_little != (std::endian::native == std::endian::little);
  Samples samples = allocate(file, (*shape)[1], (*shape)[0], is_binary64 ? 8 : 4, 1);
  const auto fill = [&](const auto& numbers) {
    for (std::uint32_t row = 0; row < samples.rows; ++row)
      for (std::uint32_t column = 0; column < samples.columns; ++column)
        samples.row_from_top(row)[column] = static_cast<float>(numbers[std::size_t{row} * samples.columns + column]);
  };
  if (is_binary64)
    fill(read_numbers<double>(in, samples.values.size(), reversed, file));
  else
    fill(read_numbers<float>(in, samples.values.size(), reversed, file));
  return samples;
}

}  // namespace forceshade::heights
