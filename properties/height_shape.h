// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What docs/height-maps.md says of a height map beside its height: where it has kinks, how steep it is and how fast its
// gradient turns. Bounds and places in binary64, for properties and aim, not for decisions.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "forceshade/reference/height_map_field.h"

namespace forceshade::properties {

// Over all positions within some reach of a place.
struct Bend {
  double rate = 0;    // 1/mm: bounds the norm of the gradient's derivative wherever there is one
  bool kink = false;  // the gradient may jump
};

struct Rim {
  double x, y, radius;  // mm
};

// The grid lines of one axis: (index - (count - 1)/2)·pitch.
struct Lines {
  double pitch = 0;  // mm
  std::uint32_t count = 0;

  double at(long index) const { return (static_cast<double>(index) - 0.5 * (count - 1.0)) * pitch; }
  double distance(double coordinate) const;  // mm, to the nearest one
};

// One part of a map.
struct PartShape {
  std::string kind;
  double steepest = 0;  // mm/mm: bounds the gradient's length
  std::function<Bend(double x, double y, double reach)> bend = [](auto...) { return Bend{}; };
  std::vector<std::string> kinks = {};  // where the gradient jumps, in words
  double x = 0, y = 0, reach = 20;      // mm: its middle, and how far from there to look
  std::vector<float> xs = {}, ys = {};  // mm: coordinates at which something changes
  std::optional<Rim> rim = std::nullopt;
  std::optional<Lines> columns = std::nullopt, rows = std::nullopt;  // of a grid
};

struct HeightShape {
  height::Rendering rendering;
  double stiffness;  // N/mm
  bool is_conservative;
  double steepest = 0;           // mm/mm: bounds the length of the gradient that the direction comes from
  double steepest_surface = 0;   // and of that of the surface which depth is measured from
  std::vector<PartShape> parts;  // of the map, then of a surface of its own
  std::size_t map_parts;

  explicit HeightShape(const reference::HeightMapField& law);

  // Of the gradient that the direction comes from.
  Bend bend(double x, double y, double reach) const;

  // Where the force jumps, in words; none where it is continuous.
  std::vector<std::string> jumps() const;
};

}  // namespace forceshade::properties
