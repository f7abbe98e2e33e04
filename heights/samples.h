// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What the readers of the formats share.

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "forceshade/heights/load.h"

namespace forceshade::heights {

// Numbers as the file has them, the first row that of the smallest y. Integers are scaled to [0, 1].
struct Samples {
  std::uint32_t columns = 0, rows = 0;
  std::vector<float> values;

  float* row_from_top(std::uint32_t row) { return &values[std::size_t{rows - 1 - row} * columns]; }
};

// The most samples of a grid: 8192 x 8192, for instance. They take 0.27 GB, and 0.54 GB more while a spline is made of them.
inline constexpr std::uint64_t kMostSamples = std::uint64_t{1} << 26;

// Room for a grid of the size that a file declares: refused unless each size is 2 to 2^15, both together are kMostSamples at
// most, and the file could hold as many bytes, at `most_expansion` bytes a byte.
Samples allocate(const std::filesystem::path& file, std::uint64_t columns, std::uint64_t rows, std::uint64_t bytes_per_sample,
                 std::uint64_t most_expansion);

// Deflate's and LZW's most: a code of a bit or so for 258 bytes, or of 12 for up to 4096.
inline constexpr std::uint64_t kCompressed = 1100;

Samples read_png(const std::filesystem::path& file);
Samples read_tiff(const std::filesystem::path& file);
Samples read_pfm(const std::filesystem::path& file);
Samples read_npy(const std::filesystem::path& file);

}  // namespace forceshade::heights
