// SPDX-License-Identifier: BSD-3-Clause
// PFM: "Pf", columns, rows, a number whose sign gives the byte order (negative: the smallest first), then binary32 numbers from
// the bottom row up (Paul Debevec, 2001). The words of the header may end in CRLF; the numbers fill the rest of the file.

#include <cctype>
#include <fstream>
#include <string>

#include "rendering/heights/byte_order.h"
#include "rendering/heights/samples.h"
#include "text/number_text.h"

namespace forceshade::heights {
namespace {

constexpr std::size_t kLongestWord = 32;

// White space, then a word, then the one character of white space that ends it.
std::string word_of(std::ifstream& in) {
  std::string word;
  in >> std::ws;
  for (int c = in.peek(); c != EOF && std::isspace(c) == 0 && word.size() <= kLongestWord; c = in.peek())
    word += static_cast<char>(in.get());
  return std::isspace(in.get()) != 0 ? word : "";
}

template <class T>
T number_of(std::ifstream& in, const std::filesystem::path& file, const char* expected) {
  const std::string word = word_of(in);
  if (const auto number = number_in<T>(word)) return *number;
  throw Error(file, "has no PFM header: expected " + std::string(expected) + ", got \"" + word + '"');
}

}  // namespace

Samples read_pfm(const Source& source) {
  const std::filesystem::path& file = source.file;
  std::ifstream in(file, std::ios::binary);
  if (word_of(in) != "Pf") throw Error(file, "has no PFM header: expected the word Pf");
  const auto columns = number_of<std::uint64_t>(in, file, "a number of columns");
  const auto rows = number_of<std::uint64_t>(in, file, "a number of rows");
  const auto scale = number_of<double>(in, file, "1 or -1");
  // Its size would be a second scale beside the caller's, and writers do not agree on what it means.
  if (scale != 1 && scale != -1)
    throw Error(file, "declares a scale of " + shortest(scale) + "; expected 1 or -1, whose sign is the order of bytes");
  Samples samples = allocate(source, columns, rows, sizeof(float), 1);
  std::vector<float> row(samples.columns);
  const std::uint64_t bytes = samples.values.size() * sizeof(float), held = std::filesystem::file_size(file);
  in.unget();
  if (in.get() == '\r' && in.peek() == '\n') in.get();
  const auto begin = static_cast<std::uint64_t>(in.tellg());
  if (held > begin + bytes)
    throw Error(file, "goes on for " + std::to_string(held - begin - bytes) + " bytes after its last number");
  for (std::uint32_t up = 0; up < samples.rows; ++up) {
    if (!in.read(reinterpret_cast<char*>(row.data()), static_cast<std::streamsize>(row.size() * sizeof(float))))
      throw Error(file, "is truncated");
    if ((scale < 0) != (std::endian::native == std::endian::little)) reverse_bytes(row);
    samples.put_row(samples.rows - 1 - up, [&](std::size_t column) { return static_cast<double>(row[column]); });
  }
  return samples;
}

}  // namespace forceshade::heights
