// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Arrays and pictures of heights as other programs write them.

#include <gtest/gtest.h>
#include <tiffio.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace forceshade::tests {

template <class T>
std::string bytes(const std::vector<T>& numbers) {
  return {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(T)};
}

inline std::string npy(const std::string& dictionary, const std::string& numbers) {
  std::string header = "{" + dictionary + "}";
  header.resize((header.size() + 10 + 63) / 64 * 64 - 10, ' ');
  std::string file("\x93NUMPY\x01\x00", 8);
  file.push_back(static_cast<char>(header.size() % 256));
  file.push_back(static_cast<char>(header.size() / 256));
  return file.append(header).append(numbers);
}

inline std::string npy_of(const std::string& type, const std::string& shape, const std::string& numbers,
                          const std::string& fortran_order = "False") {
  return npy("'descr': '" + type + "', 'fortran_order': " + fortran_order + ", 'shape': " + shape + ", ", numbers);
}

struct TiffOptions {
  int compression = COMPRESSION_NONE;
  std::uint32_t tile = 0;   // samples each way; 0: in strips
  const char* mode = "wl";  // b: the largest byte first
  int predictor = PREDICTOR_NONE;
  const char* no_data = nullptr;  // GDAL's tags
  const char* metadata = nullptr;
  std::array<double, 3> scale = {};  // GeoTIFF's, unless they are 0
  std::array<double, 16> matrix = {};
  std::vector<double> points = {};
  std::vector<std::uint16_t> keys = {};
  const char* description = nullptr;                                // ImageJ's
  bool other_types = false;                                         // the scale as FLOAT, the keys as LONG
  const char* xmp = nullptr;                                        // Adobe's
  std::vector<std::pair<std::uint32_t, std::uint32_t>> known = {};  // tags of libtiff's with their number
  std::vector<std::pair<std::uint32_t, std::uint32_t>> others =
      {};  // tags that it does not know, and how many numbers each has
};

// The first row is the top one.
template <class T>
void write_tiff(const std::filesystem::path& file, std::uint32_t columns, std::uint32_t rows, const std::vector<T>& values,
                const TiffOptions& options = {}) {
  TIFF* tiff = TIFFOpen(file.c_str(), options.mode);
  ASSERT_NE(tiff, nullptr);
  TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, columns);
  TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, rows);
  TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, static_cast<int>(8 * sizeof(T)));
  TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, 1);
  TIFFSetField(tiff, TIFFTAG_SAMPLEFORMAT,
               std::is_floating_point_v<T> ? SAMPLEFORMAT_IEEEFP
               : std::is_signed_v<T>       ? SAMPLEFORMAT_INT
                                           : SAMPLEFORMAT_UINT);
  TIFFSetField(tiff, TIFFTAG_COMPRESSION, options.compression);
  TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
  if (options.predictor != PREDICTOR_NONE) TIFFSetField(tiff, TIFFTAG_PREDICTOR, options.predictor);
  const bool other = options.other_types;
  const TIFFFieldInfo tags[]{
      {42113, -1, -1, TIFF_ASCII, FIELD_CUSTOM, 1, 0, const_cast<char*>("GDAL_NODATA")},
      {33550, -1, -1, other ? TIFF_FLOAT : TIFF_DOUBLE, FIELD_CUSTOM, 1, 1, const_cast<char*>("ModelPixelScale")},
      {34264, -1, -1, TIFF_DOUBLE, FIELD_CUSTOM, 1, 1, const_cast<char*>("ModelTransformation")},
      {42112, -1, -1, TIFF_ASCII, FIELD_CUSTOM, 1, 0, const_cast<char*>("GDAL_METADATA")},
      {33922, -1, -1, TIFF_DOUBLE, FIELD_CUSTOM, 1, 1, const_cast<char*>("ModelTiepoint")},
      {34735, -1, -1, other ? TIFF_LONG : TIFF_SHORT, FIELD_CUSTOM, 1, 1, const_cast<char*>("GeoKeyDirectory")}};
  TIFFMergeFieldInfo(tiff, tags, 6);
  if (options.no_data) TIFFSetField(tiff, tags[0].field_tag, options.no_data);
  if (options.metadata) TIFFSetField(tiff, tags[3].field_tag, options.metadata);
  if (options.scale[0] != 0) {
    const std::array<float, 3> floats{static_cast<float>(options.scale[0]), static_cast<float>(options.scale[1]),
                                      static_cast<float>(options.scale[2])};
    TIFFSetField(tiff, tags[1].field_tag, 3, other ? static_cast<const void*>(floats.data()) : options.scale.data());
  }
  if (options.matrix[15] != 0) TIFFSetField(tiff, tags[2].field_tag, 16, options.matrix.data());
  if (!options.points.empty()) TIFFSetField(tiff, tags[4].field_tag, options.points.size(), options.points.data());
  if (!options.keys.empty()) {
    const std::vector<std::uint32_t> longs(options.keys.begin(), options.keys.end());
    TIFFSetField(tiff, tags[5].field_tag, longs.size(), other ? static_cast<const void*>(longs.data()) : options.keys.data());
  }
  if (options.description) TIFFSetField(tiff, TIFFTAG_IMAGEDESCRIPTION, options.description);
  if (options.xmp) TIFFSetField(tiff, TIFFTAG_XMLPACKET, static_cast<std::uint32_t>(std::strlen(options.xmp)), options.xmp);
  for (const auto& [tag, number] : options.known) TIFFSetField(tiff, tag, number);
  for (const auto& [tag, count] : options.others) {
    const TIFFFieldInfo field{tag, -1, -1, TIFF_LONG, FIELD_CUSTOM, 1, 1, const_cast<char*>("Other")};
    TIFFMergeFieldInfo(tiff, &field, 1);
    const std::vector<std::uint32_t> numbers(count, 7);
    TIFFSetField(tiff, tag, count, numbers.data());
  }
  const std::uint32_t size = options.tile;
  if (size > 0) {
    TIFFSetField(tiff, TIFFTAG_TILEWIDTH, size);
    TIFFSetField(tiff, TIFFTAG_TILELENGTH, size);
  }
  for (std::uint32_t row = 0; size == 0 && row < rows; ++row) {
    std::vector<T> line(values.begin() + static_cast<std::ptrdiff_t>(row * columns),
                        values.begin() + static_cast<std::ptrdiff_t>((row + 1) * columns));
    ASSERT_EQ(TIFFWriteScanline(tiff, line.data(), row, 0), 1);
  }
  for (std::uint32_t top = 0; size > 0 && top < rows; top += size)
    for (std::uint32_t left = 0; left < columns; left += size) {
      // Samples beyond the picture are no heights of it.
      std::vector<T> tile(std::size_t{size} * size, static_cast<T>(99));
      for (std::uint32_t j = 0; j < std::min(size, rows - top); ++j)
        for (std::uint32_t i = 0; i < std::min(size, columns - left); ++i)
          tile[j * size + i] = values[(top + j) * columns + left + i];
      ASSERT_GT(TIFFWriteTile(tiff, tile.data(), left, top, 0, 0), 0);
    }
  TIFFClose(tiff);
}

}  // namespace forceshade::tests
