// SPDX-License-Identifier: BSD-3-Clause
// NPY, NumPy's own format: the numbers row by row or column by column.

#include "files/npy.h"

#include <algorithm>
#include <fstream>
#include <string_view>

#include "rendering/heights/byte_order.h"
#include "rendering/heights/samples.h"

namespace forceshade::heights {
namespace {

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

files::NpyHead head_of(std::ifstream& in, const std::filesystem::path& file) try {
  return files::read_npy_head(in);
} catch (const Error& fault) {
  throw Error(file, fault.what());
}

}  // namespace

Samples read_npy(const Source& source) {
  const std::filesystem::path& file = source.file;
  std::ifstream in(file, std::ios::binary);
  const files::NpyHead head = head_of(in, file);
  const Type* type = type_named(head.type);
  if (type == nullptr)
    throw Error(file, "holds numbers of type " + head.type +
                          "; expected |u1, |i1, or < or > and one of u2, u4, u8, i2, i4, i8, f4, f8");
  if (head.shape.size() != 2) throw Error(file, "is of shape (" + head.shape_text + "); expected two dimensions");
  const bool is_little = !head.type.starts_with('>');
  Samples samples = allocate(source, head.shape[1], head.shape[0], type->bytes, 1);
  type->read(in, is_little != (std::endian::native == std::endian::little), head.is_by_column, samples);
  return samples;
}

}  // namespace forceshade::heights
