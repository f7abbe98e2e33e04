// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A sampled height map from an image or array file: greyscale PNG, TIFF and PFM, or NPY of two dimensions, distinguished by how
// the file begins. Whole and binary numbers of 8 to 64 bits: the table in formats.md says how each becomes a height.

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "files/bad_input.h"
#include "rendering/height_map.h"

namespace forceshade::heights {

// "FILE: reason".
class Error : public files::BadInput {
 public:
  Error(const std::filesystem::path& file, const std::string& reason) : BadInput(file.string() + ": " + reason) {}
};

struct Source {
  std::filesystem::path file;
  float pitch = 0;  // mm between samples
  // mm: the height of white in a PNG or a TIFF of unsigned numbers, where black is 0; of 1 in all other files. Negative turns
  // the surface upside down; its size is at least 2^-30 mm, below which every height would be read as 0.
  float scale = 0;
  height::Edge edge = height::Edge::clamp;
  height::Interpolant interpolant = height::Interpolant::cubic_spline;
  std::optional<float> shortest_wavelength =
      std::nullopt;  // mm: shorter waves are taken out first (rendering/heights/band_limit.h)
};

// The picture as it is seen from above: its first row has the largest y. For a spline the values are the coefficients that
// interpolate the heights. Throws Error; then it has allocated no more than some 1100 times the file's size, nor more than a
// grid of 2^26 samples takes, whatever the file declares. Nothing that a file says of orientation, scale or further pages is
// left out without a word: formats.md says what is applied and what is refused.
std::shared_ptr<const height::Grid> load(const Source& source);

}  // namespace forceshade::heights
