// SPDX-License-Identifier: BSD-3-Clause
// NPY, NumPy's own format, versions 1 to 3: a magic, the header's length, a Python dictionary, the numbers row by row.

#include <fstream>
#include <regex>

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

}  // namespace

Samples read_npy(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  const std::string header = read_header(in, file);
  std::smatch type, shape;
  const auto has = [&](std::smatch& found, const char* pattern) {
    return std::regex_search(header, found, std::regex(pattern));
  };
  if (!has(type, "'descr': *'([<>])f([48])'")) throw Error(file, "holds no binary32 or binary64 numbers");
  std::smatch order;
  if (!has(order, "'fortran_order': *False")) throw Error(file, "is not stored row by row");
  if (!has(shape, "'shape': *\\(([0-9]{1,10}), *([0-9]{1,10})\\)")) throw Error(file, "has not two dimensions");
  const bool is_binary64 = type[2] == "8", reversed = (type[1] == "<") != (std::endian::native == std::endian::little);
  Samples samples = allocate(file, std::stoull(shape[2]), std::stoull(shape[1]), is_binary64 ? 8 : 4, 1);
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
