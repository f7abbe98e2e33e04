// SPDX-License-Identifier: BSD-3-Clause
// PFM: "Pf", columns, rows, a number whose sign tells the byte order (negative: the smallest first), then binary32 numbers from
// the bottom row up (Paul Debevec, 2001).

#include <fstream>

#include "forceshade/heights/byte_order.h"
#include "forceshade/heights/samples.h"

namespace forceshade::heights {

Samples read_pfm(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string magic;
  std::uint64_t columns = 0, rows = 0;
  double scale = 0;
  in >> magic >> columns >> rows >> scale;
  if (!in || magic != "Pf" || scale == 0 || in.get() == EOF) throw Error(file, "has no PFM header");
  Samples samples = allocate(file, columns, rows, sizeof(float), 1);
  const auto bytes = static_cast<std::streamsize>(samples.values.size() * sizeof(float));
  if (!in.read(reinterpret_cast<char*>(samples.values.data()), bytes)) throw Error(file, "is truncated");
  if ((scale < 0) != (std::endian::native == std::endian::little)) reverse_bytes(samples.values);
  return samples;
}

}  // namespace forceshade::heights
