// SPDX-License-Identifier: BSD-3-Clause
#include <bit>
#include <cmath>
#include <fstream>
#include <limits>
#include <string>
#include <string_view>

#include "files/file_kind.h"
#include "forceshade/heights.h"
#include "rendering/heights/band_limit.h"
#include "rendering/heights/coefficients.h"
#include "rendering/heights/samples.h"
#include "text/number_text.h"

namespace forceshade::heights {
namespace {

using namespace std::string_view_literals;

constexpr float kLargest = 1e4F, kSmallest = 0x1p-30F;  // mm: docs/height-maps.md; below the smallest is 0

Samples read(const Source& source) {
  const std::filesystem::path& file = source.file;
  if (files::is_named_pipe(file.string())) throw Error(file, "is a named pipe; expected a file");  // which would be waited on
  std::ifstream in(file, std::ios::binary);
  if (!in) throw Error(file, "cannot be opened");
  std::string head(1024, '\0');
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(in.gcount()));
  if (head.starts_with(files::kLfsBeginning)) throw Error(file, "is " + std::string(files::kLfsPointer));
  if (head.starts_with("\x89PNG\r\n\x1a\n")) return read_png(source);
  // The second two are those of BigTIFF.
  for (const std::string_view tiff : {"II*\0"sv, "MM\0*"sv, "II+\0"sv, "MM\0+"sv})
    if (head.starts_with(tiff)) return read_tiff(source);
  if (head.starts_with("Pf")) return read_pfm(source);
  if (head.starts_with("\x93NUMPY")) return read_npy(source);
  throw Error(file, "expected a PNG, TIFF, greyscale PFM or NPY file, got " + files::kind_of_file(head));
}

std::uint32_t largest_prime_factor(std::uint32_t n) {
  for (std::uint32_t factor = 2; factor * factor <= n; ++factor)
    while (n % factor == 0 && n > factor) n /= factor;
  return n;
}

// Shorter waves than four samples a spline does not hold, and the transform's time grows with the largest prime factor.
void take_out_short_waves(Samples& samples, const Source& source) {
  const float length = *source.shortest_wavelength, least = 4 * source.pitch;
  if (!(length >= least && length <= kLargest))
    throw Error(source.file, "is to lose waves shorter than " + shortest(length) + " mm; expected 4 pitches, " +
                                 shortest(least) + " mm, to 10000 mm");
  for (const std::uint32_t count : {samples.columns, samples.rows})
    if (largest_prime_factor(count) > 100)
      throw Error(source.file, std::to_string(count) + " columns or rows cannot be band-limited in reasonable time; cut some " +
                                   "off until no prime factor is over 100");
  limit_band(samples.values, samples.columns, samples.rows, source.edge,
             static_cast<double>(length) / static_cast<double>(source.pitch));
}

}  // namespace

float height_of(double number, float scale) noexcept {
  const auto factor = static_cast<double>(scale);
  const double product = number * factor;
  if (!(std::fabs(product) < 2.0 * static_cast<double>(kLargest))) return std::numeric_limits<float>::infinity();
  // The product of two binary32 numbers is exact. Any other is rounded to odd in binary64, that is to the neighbour whose last
  // bit is 1 unless it is exact: rounding that to binary32 gives what rounding the exact product once would (Boldo and
  // Melquiond 2008: 53 >= 24 + 2 bits).
  const double error = std::fma(number, factor, -product);
  if (error == 0 || (std::bit_cast<std::uint64_t>(product) & 1U) == 1) return static_cast<float>(product);
  return static_cast<float>(std::nextafter(product, std::copysign(std::numeric_limits<double>::infinity(), error)));
}

void Samples::put(std::uint32_t row, std::uint32_t column, double number) {
  const auto refused = [&](const std::string& why) {
    return Error(source->file, "row " + std::to_string(row) + ", column " + std::to_string(column) + why);
  };
  if (no_data && (number == *no_data || (std::isnan(number) && std::isnan(*no_data))))
    throw refused(" has no data, by the number that the file declares for that (GDAL_NODATA); expected a height");
  const float height = height_of(number, source->scale);
  if (!(std::fabs(height) <= kLargest)) throw refused(" holds " + shortest(number) + ", which is no height within 10000 mm");
  values[std::size_t{rows - 1 - row} * columns + column] = std::fabs(height) < kSmallest ? 0 : height;
}

Samples allocate(const Source& source, std::uint64_t columns, std::uint64_t rows, std::uint64_t bytes_per_sample,
                 std::uint64_t most_expansion) {
  const std::filesystem::path& file = source.file;
  constexpr std::uint64_t kMost = 1U << 15;
  const std::string size = std::to_string(columns) + " x " + std::to_string(rows);
  if (columns < 2 || rows < 2 || columns > kMost || rows > kMost)
    throw Error(file, "declares " + size + " samples; expected 2 to 32768 each way");
  if (columns * rows > kMostSamples)
    throw Error(file, "declares " + size + " samples; expected " + std::to_string(kMostSamples) + " in all at most");
  const std::uint64_t bytes = std::filesystem::file_size(file);
  if (columns * rows * bytes_per_sample > bytes * most_expansion)
    throw Error(file, "declares " + size + " samples, more than its " + std::to_string(bytes) + " bytes can hold");
  return {&source, static_cast<std::uint32_t>(columns), static_cast<std::uint32_t>(rows),
          std::vector<float>(static_cast<std::size_t>(columns * rows))};
}

std::shared_ptr<const height::Grid> load(const Source& source) {
  if (!(std::fabs(source.scale) >= kSmallest && std::isfinite(source.scale)))
    throw Error(source.file,
                "is to be scaled by " + shortest(source.scale) + " mm; expected a finite number of at least 2^-30 mm in size");
  Samples samples = read(source);
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
