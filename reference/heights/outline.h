// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The properties of a part beside its height, of docs/height-maps.md: its kinks, its steepness, and the speed at which its
// gradient turns. Bounds and places in binary64, for properties and aim, not for decisions. Each kind has an outline_of() in
// its own header.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "forceshade/height_map.h"

namespace forceshade::reference {

// Over all positions within some reach of a place.
struct GradientChange {
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
  // mm, to the nearest one
  double distance(double coordinate) const {
    const double place = coordinate / pitch + 0.5 * (count - 1.0);
    return std::fabs(place - std::round(place)) * pitch;
  }
};

// One part of a map.
struct Outline {
  std::string kind;
  double steepest = 0;  // mm/mm: bounds the gradient's length
  std::function<GradientChange(double x, double y, double reach)> gradient_change = [](auto...) { return GradientChange{}; };
  std::vector<std::string> kinks = {};  // the places where the gradient jumps, in words
  double x = 0, y = 0, reach = 20;      // mm: its middle, and how far from there to look
  std::vector<float> xs = {}, ys = {};  // mm: coordinates at which something changes
  std::optional<Rim> rim = std::nullopt;
  std::optional<Lines> columns = std::nullopt, rows = std::nullopt;  // of a grid
};

Outline outline(const height::Part& part);

inline constexpr double kOutlineSlack = 1e-11;  // mm: more than binary64 loses on any coordinate

inline float placed(float centre) {
  return std::fabs(centre) < 0x1p-30F ? 0 : centre;
}

inline Outline round_outline(std::string_view kind, float x, float y, float radius) {
  const float cx = placed(x), cy = placed(y);
  Outline outline{.kind = std::string(kind), .x = static_cast<double>(cx), .y = static_cast<double>(cy)};
  outline.reach = 1.3 * static_cast<double>(radius);
  outline.xs = {cx, cx - radius, cx + radius};
  outline.ys = {cy, cy - radius, cy + radius};
  return outline;
}

}  // namespace forceshade::reference
