// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What a height map U(x, y) is made of: numbers only. What each number means, its unit and its domain: docs/height-maps.md.

#include <array>
#include <cstdint>
#include <memory>
#include <string_view>
#include <variant>
#include <vector>

namespace forceshade::height {

// (x, y): the centre, mm.
struct Plane {
  float slope_x = 0, slope_y = 0;  // mm/mm
  float height = 0;                // mm, above the origin
};
struct Cone {
  float x = 0, y = 0;
  float height = 0, radius = 0;  // mm: at the apex, of the rim
};
struct CylinderCap {
  float x = 0;                  // the axis is parallel to y
  float radius = 0, width = 0;  // mm: of the cylinder, of the chord on the plane
};
struct SphereCap {
  float x = 0, y = 0;
  float radius = 0, width = 0;  // mm: of the sphere, of the circle on the plane (its diameter)
};
struct Gaussian {
  float x = 0, y = 0;
  float height = 0, sigma = 0;  // mm
};
struct Grating {
  float height = 0;              // mm: from the mean to a crest
  float wave_x = 0, wave_y = 0;  // rad/mm
  float phase = 0;               // rad
};

// Straight lines from knot to knot, level beyond the first and the last; the same for every y.
struct Knot {
  float x = 0, height = 0;  // mm
};
struct Polygons {
  std::vector<Knot> knots;  // by x
};

enum class Interpolant { bilinear, cubic_spline };
enum class Edge { clamp, tile };

// A sampled map. `values` are heights for Interpolant::bilinear, spline coefficients for cubic_spline; row by row from the
// smallest y, each row from the smallest x. Sample (i, j) lies at ((i - (columns - 1)/2)·pitch, (j - (rows - 1)/2)·pitch).
struct Grid {
  std::uint32_t columns = 0, rows = 0;
  float pitch = 0;  // mm
  Edge edge = Edge::clamp;
  Interpolant interpolant = Interpolant::cubic_spline;
  std::vector<float> values;  // mm
};

using Shape = std::variant<Plane, Cone, CylinderCap, SphereCap, Gaussian, Grating, Polygons, std::shared_ptr<const Grid>>;

struct Part {
  Shape shape;
  bool negated = false;  // a dent for a bump
};

// What turns a map into a force field (docs/height-maps.md).
enum class Rendering { true_height, force_shaded, conservative };

struct RenderingName {
  Rendering rendering;
  std::string_view name;
};

inline constexpr std::array<RenderingName, 3> kRenderings{{
    {Rendering::true_height, "height-map"},
    {Rendering::force_shaded, "height-map-shaded"},
    {Rendering::conservative, "height-map-conservative"},
}};

constexpr std::string_view name_of(Rendering rendering) {
  return kRenderings[static_cast<std::size_t>(rendering)].name;
}

}  // namespace forceshade::height

namespace forceshade {

// The sum of its parts.
struct HeightMap {
  std::vector<height::Part> parts;
  std::vector<height::Part> surface{};  // what a force-shaded map's depth is measured from, a sum too; empty: the flat plane
};

}  // namespace forceshade
