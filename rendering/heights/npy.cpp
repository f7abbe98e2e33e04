// SPDX-License-Identifier: BSD-3-Clause
// NPY, NumPy's own format, versions 1 to 3: a magic, the header's length, a Python dictionary, the numbers row by row or
// column by column.

#include <algorithm>
#include <charconv>
#include <fstream>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "rendering/heights/byte_order.h"
#include "rendering/heights/samples.h"

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

// The heights of an array, whose numbers fill the rest of the file.
template <class T>
void read_numbers(std::ifstream& in, bool reversed, bool by_column, Samples& samples) {
  std::vector<T> numbers(samples.values.size());
  if (!in.read(reinterpret_cast<char*>(numbers.data()), static_cast<std::streamsize>(numbers.size() * sizeof(T))))
    throw Error(samples.source->file, "is truncated");
  if (in.peek() != EOF) throw Error(samples.source->file, "goes on after its last number");
  if (reversed) reverse_bytes(numbers);
  // Whole numbers beyond 2^53 are no heights at any scale, so it does not matter how they are rounded here.
  for (std::uint32_t row = 0; row < samples.rows; ++row)
    samples.put_row(row, [&](std::size_t column) {
      return static_cast<double>(
          numbers[by_column ? column * samples.rows + row : std::size_t{row} * samples.columns + column]);
    });
}

struct Type {
  std::string_view name;  // as NumPy writes it, behind the character of the byte order
  std::uint64_t bytes;
  void (*read)(std::ifstream& in, bool reversed, bool by_column, Samples& samples);
};
constexpr std::array<Type, 10> kTypes{{{"u1", 1, &read_numbers<std::uint8_t>},
                                       {"u2", 2, &read_numbers<std::uint16_t>},
                                       {"u4", 4, &read_numbers<std::uint32_t>},
                                       {"u8", 8, &read_numbers<std::uint64_t>},
                                       {"i1", 1, &read_numbers<std::int8_t>},
                                       {"i2", 2, &read_numbers<std::int16_t>},
                                       {"i4", 4, &read_numbers<std::int32_t>},
                                       {"i8", 8, &read_numbers<std::int64_t>},
                                       {"f4", 4, &read_numbers<float>},
                                       {"f8", 8, &read_numbers<double>}}};

// A number of one byte has no order of bytes, which NumPy writes as |.
const Type* type_named(std::string_view name) {
  for (const Type& type : kTypes)
    if (name.substr(std::min<std::size_t>(1, name.size())) == type.name &&
        (type.bytes == 1 ? name[0] == '|' : name[0] == '<' || name[0] == '>'))
      return &type;
  return nullptr;
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

Samples read_npy(const Source& source) {
  const std::filesystem::path& file = source.file;
  std::ifstream in(file, std::ios::binary);
  const std::string header = read_header(in, file);
  const auto entries = entries_of(header);
  if (!entries) throw Error(file, "has no NPY header: expected a dictionary of descr, fortran_order and shape");
  const std::string &name = entries->at("descr"), &order = entries->at("fortran_order");
  const Type* type = type_named(name);
  if (type == nullptr)
    throw Error(file,
                "holds numbers of type " + name + "; expected |u1, |i1, or < or > and one of u2, u4, u8, i2, i4, i8, f4, f8");
  if (order != "False" && order != "True") throw Error(file, "has fortran_order " + order + "; expected True or False");
  const auto shape = two_numbers(entries->at("shape"));
  if (!shape) throw Error(file, "is of shape (" + entries->at("shape") + "); expected two dimensions");
  const bool is_little = !name.starts_with('>');
  Samples samples = allocate(source, (*shape)[1], (*shape)[0], type->bytes, 1);
  type->read(in, is_little != (std::endian::native == std::endian::little), order == "True", samples);
  return samples;
}

}  // namespace forceshade::heights
