// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Reads height maps from files: TOML, and grids from greyscale PNG, TIFF and PFM images or NPY arrays of two dimensions,
// distinguished by how the file begins. The library is forceshade::heights, of the component heights; it needs libpng, libtiff
// and toml++.
//
//   const heights::Spec spec = heights::read_spec("examples/leather.toml");
//   const auto built = fast::HeightMapField::build(spec.map, spec.mode, 0.5F);  // N/mm; of fast.h
//   const auto grid = heights::load({.file = "leather.png", .pitch = 0.1F, .scale = 0.5F});  // mm
//   std::printf("%u x %u\n", grid->columns, grid->rows);
//
// Lengths are in mm. Third-party files may be read: no size that a file declares is believed before the file could hold it.
//
// Errors: every function throws Error, which names the file, and the line and key where there are any.
//
// Threads: the functions keep no state, and may run at once.
//
// Not promised: that a number is in its domain, which is looked at when the map is built. The formats:
// rendering/heights/formats.md.

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "forceshade/error.h"
#include "forceshade/height_map.h"

namespace forceshade::heights {

struct Source {
  std::filesystem::path file;
  float pitch = 0;  // mm between samples
  // mm: the height of white in a PNG or a TIFF of unsigned numbers, where black is 0; of 1 in all other files. Negative turns
  // the surface upside down; its size is at least 2^-30 mm, below which every height would be read as 0.
  float scale = 0;
  height::Edge edge = height::Edge::clamp;
  height::Interpolant interpolant = height::Interpolant::cubic_spline;
  std::optional<float> shortest_wavelength =
      std::nullopt;  // mm: shorter waves are taken out first (rendering/heights/formats.md)
};

// The picture as it is seen from above: its first row has the largest y. For a spline the values are the coefficients that
// interpolate the heights. Throws Error; then it has allocated no more than some 1100 times the file's size, nor more than a
// grid of 2^26 samples takes, whatever the file declares. Nothing that a file says of orientation, scale or further pages is
// left out without a word: rendering/heights/formats.md says what is applied and what is refused.
std::shared_ptr<const height::Grid> load(const Source& source);

struct Spec {
  HeightMap map;
  height::Mode mode;
};

// Files of grids are taken relative to `file`. Throws Error, which names the line, the key, what was expected and what was got;
// the domains of the numbers are checked when a field is built.
Spec read_spec(const std::filesystem::path& file);

// The lines of a part and of its keys, for messages about a number that is out of its domain.
struct PartLines {
  std::uint32_t part = 0;
  std::map<std::string, std::uint32_t> keys;

  // The line of the number that a ParameterError calls so, "sigma" for sigma_mm; the line of the part where no one key has it.
  std::uint32_t of(std::string parameter) const;
};
struct Lines {
  std::vector<PartLines> parts, surface;
};

// Throws Error.
Lines lines_of_parts(const std::filesystem::path& file);

}  // namespace forceshade::heights
