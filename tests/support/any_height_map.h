// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The generator of height maps themselves.

#include <algorithm>
#include <bit>
#include <cmath>
#include <memory>

#include "properties/positions.h"
#include "properties/rendered.h"

namespace forceshade::tests {

struct AnyHeightMap {
  HeightMap map;
  height::Mode mode = height::Mode::true_height;
  float stiffness = 1;  // N/mm
};

class HeightShapes : private properties::Draws {
 public:
  explicit HeightShapes(std::uint64_t seed) : Draws(seed) {}

  AnyHeightMap next() {
    AnyHeightMap any;
    for (std::uint64_t i = bits() % 3 + 1; i > 0; --i) any.map.parts.push_back({shape(), is_one_of(4)});
    any.mode = height::kModes[bits() % height::kModes.size()].mode;
    const bool is_shaded = any.mode == height::Mode::force_shaded;
    for (std::uint64_t i = is_shaded ? bits() % 3 : 0; i > 0; --i) any.map.surface.push_back({shape(), is_one_of(4)});
    any.stiffness = size(1e-3F, 1e3F, 0.5F);
    return any;
  }

 private:
  bool is_one_of(std::uint64_t number) { return bits() % number == 0; }
  // Within [low, high], positive: any bit pattern, or up to some times `usual`.
  float size(float low, float high, float usual) {
    if (is_one_of(2)) return std::clamp(static_cast<float>(uniform(0.1, 4)) * usual, low, high);
    const auto first = std::bit_cast<std::uint32_t>(low), last = std::bit_cast<std::uint32_t>(high);
    return std::bit_cast<float>(first + static_cast<std::uint32_t>(bits() % (last - first + 1)));
  }
  // A number of either sign, or zero.
  float number(float largest, float usual, float smallest = 0x1p-126F) {
    const std::uint64_t choice = bits() % 8;
    if (choice == 0) return 0;
    const float value = size(smallest, largest, usual);
    return choice % 2 == 0 ? value : -value;
  }
  float coordinate() { return number(reference::kDomainEnd, 3); }
  float height() { return number(1e4F, 1); }

  height::Shape shape() {
    float radius = 0;  // of a cap, which is drawn before its chord
    const auto drawn = [&](const auto& number) {
      const float value = this->drawn(number.meaning, radius);
      if (number.meaning == height::Meaning::radius) radius = value;
      return value;
    };
    return height::shape_of_kind(
        bits() % height::kKinds, drawn, [&] { return polygons(); }, [&] { return grid(); });
  }

  float drawn(height::Meaning meaning, float radius) {
    switch (meaning) {
      case height::Meaning::centre: return coordinate();
      case height::Meaning::height: return height();
      case height::Meaning::slope: return number(1e3F, 0.5F);
      case height::Meaning::wave: return number(1e3F, 3);
      case height::Meaning::reach: return size(1e-3F, 1e4F, 2);
      case height::Meaning::radius: return size(0.1F, 1e4F, 5);
      case height::Meaning::chord: break;
    }
    return size(1e-3F, std::nextafter(2 * radius, 0.0F), radius);
  }

  height::Shape polygons() {
    height::Polygons polygons;
    float x = number(5e3F, 3);
    for (std::uint64_t i = 2 + bits() % 5; i > 0; --i) {
      polygons.knots.push_back({x, number(1e4F, 1, 0x1p-30F)});
      x += size(2e-3F, 500, 2);
    }
    return polygons;
  }

  height::Shape grid() {
    height::Grid grid{static_cast<std::uint32_t>(2 + bits() % 8),
                      static_cast<std::uint32_t>(2 + bits() % 8),
                      size(1e-3F, 1e2F, 0.5F),
                      is_one_of(2) ? height::Edge::clamp : height::Edge::tile,
                      is_one_of(2) ? height::Interpolant::bilinear : height::Interpolant::cubic_spline,
                      {}};
    const float usual = size(0x1p-30F, 1e4F, 0.5F);
    const auto any_value = [&] {
      const std::uint64_t choice = bits() % 8;
      const float value = size(0x1p-30F, 1e4F, usual);
      return choice == 0 ? 0 : choice % 2 == 0 ? value : -value;
    };
    for (std::size_t i = 0; i < std::size_t{grid.columns} * grid.rows; ++i) grid.values.push_back(any_value());
    const auto at = [&](std::uint32_t i, std::uint32_t j) -> float& { return grid.values[std::size_t{j} * grid.columns + i]; };
    const auto change = [&](const auto& value) {
      for (std::uint32_t j = 0; j < grid.rows; ++j)
        for (std::uint32_t i = 0; i < grid.columns; ++i) at(i, j) = value(i, j);
    };
    // Grids on which small or missing steps cause errors: level along one axis, steps in the last places only, one step.
    const float base = any_value();
    switch (bits() % 8) {
      case 0: change([&](std::uint32_t i, std::uint32_t) { return at(i, 0); }); break;
      case 1: change([&](std::uint32_t, std::uint32_t j) { return at(0, j); }); break;
      case 2:
        change([&](std::uint32_t, std::uint32_t) {
          const float value = std::fabs(base) * (1 - 0x1p-23F * static_cast<float>(bits() % 4));
          return base == 0 ? 0 : std::copysign(std::max(value, 0x1p-30F), base);
        });
        break;
      case 3: {
        const float step = any_value();
        change([&](std::uint32_t i, std::uint32_t j) { return i == grid.columns / 2 && j == grid.rows / 2 ? step : base; });
        break;
      }
      default: break;
    }
    return std::make_shared<const height::Grid>(std::move(grid));
  }
};

// One to three parts of any kind, numbers by bit pattern within their domains or of a hand's size, grids of few samples. Every
// one can be built. Simpler ones have fewer parts.
inline properties::Generator<AnyHeightMap> any_height_map() {
  return {[](std::uint64_t seed) { return HeightShapes(seed).next(); },
          [](const AnyHeightMap& any) {
            std::vector<AnyHeightMap> simpler;
            for (const std::vector<height::Part>& parts : properties::shorter(any.map.parts, 1)) {
              simpler.push_back(any);
              simpler.back().map.parts = parts;
            }
            return simpler;
          }};
}

}  // namespace forceshade::tests
