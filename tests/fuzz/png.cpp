// SPDX-License-Identifier: BSD-3-Clause
#include <zlib.h>

#include "tests/fuzz/grid_file.h"

namespace {

// With the checksum of every chunk put right, so that what is behind them is reached.
std::string with_checksums(std::string png) {
  const auto byte = [&](std::size_t at) { return static_cast<std::size_t>(static_cast<unsigned char>(png[at])); };
  for (std::size_t at = 8; at + 12 <= png.size();) {
    const std::size_t length = (byte(at) << 24) + (byte(at + 1) << 16) + (byte(at + 2) << 8) + byte(at + 3);
    if (length > png.size() - at - 12) break;
    const uLong sum = crc32(0, reinterpret_cast<const Bytef*>(&png[at + 4]), static_cast<uInt>(length + 4));
    for (std::size_t i = 0; i < 4; ++i) png[at + 8 + length + i] = static_cast<char>(sum >> (24 - 8 * i) & 0xFF);
    at += length + 12;
  }
  return png;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace forceshade::fuzz;
  constexpr const char* kMagic = "\x89PNG\r\n\x1a\n";
  load_grid(text_of(data, size), kMagic);
  return load_grid(with_checksums(std::string(text_of(data, size))), kMagic);
}
