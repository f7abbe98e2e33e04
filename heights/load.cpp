// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/heights/load.h"

#include <cmath>
#include <fstream>
#include <string>

#include "forceshade/heights/band_limit.h"
#include "forceshade/heights/coefficients.h"
#include "forceshade/heights/samples.h"

namespace forceshade::heights {
namespace {

constexpr float kLargest = 1e4F, kSmallest = 0x1p-30F;  // mm: docs/height-maps.md; below the smallest is 0

Samples read(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw Error(file, "cannot be opened");
  std::string head(8, '\0');
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  if (head == "\x89PNG\r\n\x1a\n") return read_png(file);
  if (head.starts_with(std::string("II*\0", 4)) || head.starts_with(std::string("MM\0*", 4))) return read_tiff(file);
  if (head.starts_with("Pf")) return read_pfm(file);
  if (head.starts_with("\x93NUMPY")) return read_npy(file);
  throw Error(file, "is none of PNG, TIFF, greyscale PFM and NPY");
}

void to_millimetres(Samples& samples, const Source& source) {
  for (std::size_t i = 0; i < samples.values.size(); ++i) {
    float& value = samples.values[i];
    const float height = value * source.scale;
    if (!(std::fabs(height) <= kLargest)) {
      const std::size_t row = samples.rows - 1 - i / samples.columns, column = i % samples.columns;
      throw Error(source.file, "row " + std::to_string(row) + ", column " + std::to_string(column) + " holds " +
                                   std::to_string(value) + ", which is no height within 10000 mm");
    }
    value = std::fabs(height) < kSmallest ? 0 : height;
  }
}

std::uint32_t largest_prime_factor(std::uint32_t n) {
  for (std::uint32_t factor = 2; factor * factor <= n; ++factor)
    while (n % factor == 0 && n > factor) n /= factor;
  return n;
}

// Shorter waves than four samples a spline does not hold, and the transform's time grows with the largest prime factor.
void take_out_short_waves(Samples& samples, const Source& source) {
  const float shortest = *source.shortest_wavelength, least = 4 * source.pitch;
  if (!(shortest >= least && shortest <= kLargest))
    throw Error(source.file, "is to lose waves shorter than " + std::to_string(shortest) + " mm; expected 4 pitches, " +
                                 std::to_string(least) + " mm, to 10000 mm");
  for (const std::uint32_t count : {samples.columns, samples.rows})
    if (largest_prime_factor(count) > 100)
      throw Error(source.file, std::to_string(count) + " columns or rows cannot be band-limited in reasonable time; cut some " +
                                   "off until no prime factor is over 100");
  limit_band(samples.values, samples.columns, samples.rows, source.edge,
             static_cast<double>(shortest) / static_cast<double>(source.pitch));
}

}  // namespace

Samples allocate(const std::filesystem::path& file, std::uint64_t columns, std::uint64_t rows, std::uint64_t bytes_per_sample,
                 std::uint64_t most_expansion) {
  constexpr std::uint64_t kMost = 1U << 15;
  const std::string size = std::to_string(columns) + " x " + std::to_string(rows);
  if (columns < 2 || rows < 2 || columns > kMost || rows > kMost)
    throw Error(file, "declares " + size + " samples; expected 2 to 32768 each way");
  if (columns * rows > kMostSamples)
    throw Error(file, "declares " + size + " samples; expected " + std::to_string(kMostSamples) + " in all at most");
  const std::uint64_t bytes = std::filesystem::file_size(file);
  if (columns * rows * bytes_per_sample > bytes * most_expansion)
    throw Error(file, "declares " + size + " samples, more than its " + std::to_string(bytes) + " bytes can hold");
  return {static_cast<std::uint32_t>(columns), static_cast<std::uint32_t>(rows), std::vector<float>(columns * rows)};
}

std::shared_ptr<const height::Grid> load(const Source& source) {
  if (!(std::fabs(source.scale) >= kSmallest && std::isfinite(source.scale)))
    throw Error(source.file, "is to be scaled by " + std::to_string(source.scale) +
                                 " mm; expected a finite number of at least 2^-30 mm in size");
  Samples samples = read(source.file);
  to_millimetres(samples, source);
  if (source.shortest_wavelength) take_out_short_waves(samples, source);
  if (source.interpolant == height::Interpolant::cubic_spline) {
    make_coefficients(samples.values, samples.columns, samples.rows, source.edge);
    for (float& value : samples.values) {
      if (std::fabs(value) > kLargest) throw Error(source.file, "needs spline coefficients beyond 10000 mm");
      if (std::fabs(value) < kSmallest) value = 0;
    }
  }
  return std::make_shared<const height::Grid>(
      height::Grid{samples.columns, samples.rows, source.pitch, source.edge, source.interpolant, std::move(samples.values)});
}

}  // namespace forceshade::heights
