// SPDX-License-Identifier: BSD-3-Clause
#include "files/npy.h"

#include <array>

namespace forceshade::files {

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
