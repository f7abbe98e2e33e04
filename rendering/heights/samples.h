// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Declarations shared by the readers of the formats.

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "forceshade/heights.h"

namespace forceshade::heights {

// Heights in mm, the first row that of the smallest y.
struct Samples {
  const Source* source = nullptr;
  std::uint32_t columns = 0, rows = 0;
  std::vector<float> values;
  std::optional<double> no_data = std::nullopt;  // the sample that stands for a place without data (GDAL_NODATA)

  // The height at this place is height_of(number), or 0 where that is below 2^-30 mm in size. The first row is the top one.
  // Throws Error with the place and the number where it is no height.
  void put(std::uint32_t row, std::uint32_t column, double number);

  // Puts a row of samples, made of one number for each column: read_number(column).
  template <class ReadNumber>
  void put_row(std::uint32_t row, const ReadNumber& read_number) {
    for (std::uint32_t column = 0; column < columns; ++column) put(row, column, read_number(column));
  }
};

// The binary32 number nearest to number * scale, in mm: rounded once, also where binary32 cannot hold the number. Not finite
// where the product is not, or is beyond 2e4 mm.
float height_of(double number, float scale) noexcept;

// The most samples of a grid: 8192 x 8192, for instance. They take 0.27 GB, and 0.54 GB more while a spline is made of them.
inline constexpr std::uint64_t kMostSamples = std::uint64_t{1} << 26;

// Room for a grid of the size that a file declares: refused unless each size is 2 to 2^15, both together are kMostSamples at
// most, and the file could hold as many bytes, at `most_expansion` bytes a byte.
Samples allocate(const Source& source, std::uint64_t columns, std::uint64_t rows, std::uint64_t bytes_per_sample,
                 std::uint64_t most_expansion);

// Deflate's and LZW's most: a code of a bit or so for 258 bytes, or of 12 for up to 4096.
inline constexpr std::uint64_t kCompressed = 1100;

Samples read_png(const Source& source);
Samples read_tiff(const Source& source);
Samples read_pfm(const Source& source);
Samples read_npy(const Source& source);

// The map of a file for --height-map, where each grid has the heights of its samples, as for Interpolant::bilinear, in the
// place of coefficients. Throws Error.
HeightMap read_heights(const std::filesystem::path& file);

}  // namespace forceshade::heights
