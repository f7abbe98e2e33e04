// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/identity/height_identity.h"

#include <array>
#include <span>
#include <utility>

#include "forceshade/identity/digest.h"
#include "forceshade/vocabulary/number_text.h"

namespace forceshade::properties {
namespace {

// A part as it is told: its kind, its numbers under their keys in a TOML file, and a grid's samples.
struct Told {
  std::string kind;
  std::vector<std::pair<std::string_view, float>> numbers;
  std::vector<std::pair<std::string_view, std::string_view>> words = {};
  std::span<const float> samples = {};
};

Told told(const height::Plane& p) {
  return {"plane", {{"slope_x", p.slope_x}, {"slope_y", p.slope_y}, {"height_mm", p.height}}};
}
Told told(const height::Cone& c) {
  return {"cone", {{"x_mm", c.x}, {"y_mm", c.y}, {"height_mm", c.height}, {"radius_mm", c.radius}}};
}
Told told(const height::CylinderCap& c) {
  return {"cylinder-cap", {{"x_mm", c.x}, {"radius_mm", c.radius}, {"width_mm", c.width}}};
}
Told told(const height::SphereCap& c) {
  return {"sphere-cap", {{"x_mm", c.x}, {"y_mm", c.y}, {"radius_mm", c.radius}, {"width_mm", c.width}}};
}
Told told(const height::Gaussian& g) {
  return {"gaussian", {{"x_mm", g.x}, {"y_mm", g.y}, {"height_mm", g.height}, {"sigma_mm", g.sigma}}};
}
Told told(const height::Grating& g) {
  return {"grating",
          {{"height_mm", g.height}, {"wave_x_rad_per_mm", g.wave_x}, {"wave_y_rad_per_mm", g.wave_y}, {"phase_rad", g.phase}}};
}
Told told(const height::Polygons& p) {
  Told words{"polygons", {}};
  for (const height::Knot& knot : p.knots) {
    words.numbers.emplace_back("x_mm", knot.x);
    words.numbers.emplace_back("height_mm", knot.height);
  }
  return words;
}
Told told(const std::shared_ptr<const height::Grid>& g) {
  // At most 2^15 columns and rows: binary32 numbers.
  return {"grid",
          {{"columns", static_cast<float>(g->columns)}, {"rows", static_cast<float>(g->rows)}, {"pitch_mm", g->pitch}},
          {{"edge", g->edge == height::Edge::tile ? "tile" : "clamp"},
           {"interpolant", g->interpolant == height::Interpolant::bilinear ? "bilinear" : "cubic-spline"}},
          g->values};
}

Told told(const height::Part& part) {
  Told words = std::visit([](const auto& shape) { return told(shape); }, part.shape);
  if (part.negated) words.words.emplace_back("negated", "true");
  return words;
}

struct Role {
  std::string words;
  const std::vector<height::Part>* parts;
};
std::array<Role, 2> roles(const HeightMap& map) {
  return {{{"", &map.parts}, {"depth from ", &map.surface}}};
}

}  // namespace

HeightIdentity identity_of(const HeightMap& map, height::Rendering rendering, float stiffness) {
  Digest digest;
  for (const auto& [role, parts] : roles(map))
    for (const height::Part& part : *parts) {
      const Told words = told(part);
      digest.line(role + words.kind);
      for (const auto& [key, value] : words.numbers) {
        digest.line(std::string(key));
        digest.number(value);
      }
      for (const auto& [key, word] : words.words) digest.line(std::string(key) + ' ' + std::string(word));
      digest.line(std::to_string(words.samples.size()));
      for (const float sample : words.samples) digest.number(sample);
    }
  return {digest.hex(), rendering, stiffness};
}

std::vector<std::string> words_of(const HeightMap& map) {
  std::vector<std::string> lines;
  for (const auto& [role, parts] : roles(map))
    for (const height::Part& part : *parts) {
      const Told words = told(part);
      std::string line = role + words.kind + ':';
      for (const auto& [key, value] : words.numbers) line += ' ' + std::string(key) + ' ' + shortest(value) + ',';
      for (const auto& [key, word] : words.words) line += ' ' + std::string(key) + ' ' + std::string(word) + ',';
      line.pop_back();
      lines.push_back(std::move(line));
    }
  return lines;
}

}  // namespace forceshade::properties
