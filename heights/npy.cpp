// SPDX-License-Identifier: BSD-3-Clause
// NPY, NumPy's own format, versions 1 to 3: a magic, the header's length, a Python dictionary, the numbers row by row.

#include <charconv>
#include <fstream>
#include <optional>
#include <string_view>

#include "forceshade/heights/byte_order.h"
#include "forceshade/heights/samples.h"

namespace forceshade::heights {
namespace {

constexpr std::size_t kLongestHeader = 1 << 16;

std::string read_header(std::ifstream& in, const std::filesystem::path& file) {
  std::array<unsigned char, 12> head{};
  in.read(reinterpret_cast<char*>(head.data()), 10);
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

// What follows `'key':` and spaces; empty if nothing does.
std::string_view value_of(std::string_view dictionary, const std::string& key) {
  const std::size_t at = dictionary.find("'" + key + "':");
  if (at == std::string_view::npos) return {};
  dictionary.remove_prefix(at + key.size() + 3);
  dictionary.remove_prefix(std::min(dictionary.find_first_not_of(' '), dictionary.size()));
  return dictionary;
}

// "(ROWS, COLUMNS)" and nothing else.
std::optional<std::array<std::uint64_t, 2>> two_numbers(std::string_view tuple) {
  std::array<std::uint64_t, 2> numbers{};
  const char* at = tuple.data();
  const char* const end = at + tuple.size();
  const auto take = [&](char wanted) { return at != end && *at == wanted && ++at != nullptr; };
  const auto number = [&](std::uint64_t& to) {
    const auto [after, error] = std::from_chars(at, end, to);
    at = after;
    return error == std::errc();
  };
  if (!take('(') || !number(numbers[0]) || !take(',')) return std::nullopt;
  while (take(' ')) continue;
  if (!number(numbers[1]) || !take(')')) return std::nullopt;
  return numbers;
}

}  // namespace

Samples read_npy(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  const std::string header = read_header(in, file);
  const std::string_view type = value_of(header, "descr");
  const bool is_little = type.starts_with("'<"), is_binary64 = type.substr(0, 5).ends_with("f8'");
  if (!(is_little || type.starts_with("'>")) || !(is_binary64 || type.substr(0, 5).ends_with("f4'")))
    throw Error(file, "holds no binary32 or binary64 numbers");
  if (!value_of(header, "fortran_order").starts_with("False")) throw Error(file, "is not stored row by row");
  const auto shape = two_numbers(value_of(header, "shape"));
  if (!shape) throw Error(file, "has not two dimensions");
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
