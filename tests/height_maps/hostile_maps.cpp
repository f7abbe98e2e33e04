// SPDX-License-Identifier: BSD-3-Clause
#include "tests/height_maps/hostile_maps.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace forceshade::tests {

using height::Edge;
using height::Interpolant;

float HostileMaps::any_size(float low, float high) {
  const auto first = std::bit_cast<std::uint32_t>(low), last = std::bit_cast<std::uint32_t>(high);
  return std::bit_cast<float>(first + static_cast<std::uint32_t>(pick(last - first + 1)));
}

float HostileMaps::coordinate() {
  switch (pick(6)) {
    case 0: return 0;
    case 1: return either_sign(one_of({0.5F, 1, 2, 3, 4, 5, 6, 12}));
    case 2: return either_sign(one_of({0x1p-30F, 0x1p-31F, 0x1.8p-30F, 1e4F, 0x1p13F, 0.1F}));
    case 3: return either_sign(any_size(0x1p-30F, 1e4F));
    default: return uniform(-10, 10);
  }
}

float HostileMaps::height() {
  switch (pick(6)) {
    case 0: return either_sign(one_of({0.5F, 1, 2, 0.25F, 3}));
    case 1: return either_sign(one_of({0x1p-30F, 0x1p-24F, 1e4F, 0x1p-12F}));
    case 2: return either_sign(any_size(0x1p-30F, 1e4F));
    case 3: return once_in(4) ? 0 : 1;
    default: return uniform(-3, 3);
  }
}

float HostileMaps::reach() {
  switch (pick(5)) {
    case 0: return one_of({0.2F, 0.25F, 1, 2, 5, 10, 13});
    case 1: return one_of({1e-3F, 0x1p-9F, 1e4F, 0x1p13F, 100});
    case 2: return any_size(1e-3F, 1e4F);
    default: return uniform(0.01F, 8);
  }
}

// Down to the smallest binary32: a number that the domain bounds from above only.
float HostileMaps::tiny_or_any() {
  return either_sign(any_size(0x1p-149F, 1e3F));
}

height::Shape HostileMaps::shape() {
  const auto high = [&] { return once_in(8) ? tiny_or_any() : height(); };
  const auto slope = [&] {
    return once_in(12)  ? tiny_or_any()
           : once_in(2) ? 0
           : once_in(2) ? either_sign(one_of({0.75F, 1, 0.5F, 2, 1e3F}))
                        : uniform(-2, 2);
  };
  const auto wave = [&] { return once_in(3) ? 0 : once_in(2) ? either_sign(one_of({1, 2, 0.5F, 1e3F})) : uniform(-20, 20); };
  const std::uint64_t kind = pick(height::kKinds + 1);
  if (kind == height::kKinds) return height::Plane{0, 0, high()};
  float radius = 1;
  const auto drawn = [&](const auto& number) {
    switch (number.meaning) {
      case height::Meaning::centre: return coordinate();
      case height::Meaning::height: return high();
      case height::Meaning::slope: return slope();
      case height::Meaning::wave: return wave();
      case height::Meaning::reach: return reach();
      case height::Meaning::radius: return radius = std::max(reach(), 0.1F);
      case height::Meaning::chord: break;
    }
    return std::clamp(radius * one_of({0.5F, 1, 1.5F, 1.6F, 0x1.fffffep0F}), 1e-3F, std::nextafter(2 * radius, 0.0F));
  };
  return height::shape_of_kind(
      kind, drawn, [&] { return polygons(); }, [&] { return grid(); });
}

height::Shape HostileMaps::polygons() {
  height::Polygons polygons;
  float x = std::clamp(coordinate(), -5e3F, 5e3F);
  const float level = height();
  for (std::uint64_t i = 2 + pick(4); i > 0; --i) {
    polygons.knots.push_back({x, once_in(2) ? level : height()});
    x += std::clamp(reach(), 2e-3F, 500.0F) + (std::fabs(x) > 100 ? 0.1F : 0);
  }
  return polygons;
}

height::Shape HostileMaps::grid() {
  height::Grid grid{static_cast<std::uint32_t>(2 + pick(6)),
                    static_cast<std::uint32_t>(2 + pick(6)),
                    once_in(2) ? one_of({0.25F, 0.3F, 1e-3F, 100, 1}) : uniform(0.01F, 3),
                    once_in(2) ? Edge::clamp : Edge::tile,
                    once_in(3) ? Interpolant::bilinear : Interpolant::cubic_spline,
                    {}};
  const std::uint64_t pattern = pick(6);
  const float level = height(), other = height(), high = either_sign(uniform(5e3F, 1e4F));
  for (std::uint32_t j = 0; j < grid.rows; ++j)
    for (std::uint32_t i = 0; i < grid.columns; ++i) {
      switch (pattern) {
        case 0: grid.values.push_back(level); break;
        case 1: grid.values.push_back(i % 2 == 0 ? level : other); break;
        case 2: grid.values.push_back(j % 3 == 0 ? level : other); break;
        case 3: grid.values.push_back(i == 1 && j == 1 ? other : level); break;
        case 4: grid.values.push_back(std::nextafter(high, either_sign(2e4F))); break;
        default: grid.values.push_back(height());
      }
    }
  return std::make_shared<const height::Grid>(std::move(grid));
}

height::Part HostileMaps::relative_of(height::Part part) {
  const std::uint64_t choice = pick(5);
  if (choice != 0) part.negated = !part.negated;
  std::visit(
      [&](auto& shape) {
        if constexpr (requires { shape.x; })
          if (choice == 2) shape.x = -shape.x;
        if constexpr (requires { shape.y; })
          if (choice == 3) shape.y = -shape.y;
        if constexpr (requires { shape.height; })
          if (choice == 4) shape.height = height();
        if constexpr (requires { shape.phase; })
          if (choice == 3) shape.phase = -shape.phase;
      },
      part.shape);
  return part;
}

std::vector<height::Part> HostileMaps::sum() {
  std::vector<height::Part> parts;
  const std::uint64_t count = once_in(12) ? 1 + pick(16) : 1 + pick(4);
  for (std::uint64_t i = 0; i < count; ++i)
    parts.push_back(i > 0 && once_in(2) ? relative_of(parts[pick(i)]) : height::Part{shape(), once_in(4)});
  return parts;
}

HostileMap HostileMaps::next_map() {
  const height::Mode mode = height::kModes[pick(height::kModes.size())].mode;
  const float stiffness = once_in(2) ? one_of({1, 0.5F, 1.5F, 0.75F, 1e3F, 1e-3F}) : any_size(1e-3F, 1e3F);
  HostileMap one{{sum()}, mode, stiffness};
  if (mode == height::Mode::force_shaded && once_in(3)) one.map.surface = sum();
  return one;
}

HostileMaps::Spot HostileMaps::spot_of(const height::Part& part) {
  Spot spot{0, 0, 5};
  std::visit(
      [&](const auto& shape) {
        if constexpr (requires { shape.x; }) spot.x = shape.x;
        if constexpr (requires { shape.y; }) spot.y = shape.y;
        if constexpr (requires { shape.sigma; }) spot.reach = shape.sigma;
        if constexpr (requires { shape.radius; }) spot.reach = shape.radius;
        if constexpr (requires { shape.width; }) spot.reach = shape.width / 2;
        if constexpr (requires { shape.knots; }) spot.x = shape.knots[pick(shape.knots.size())].x;
        if constexpr (requires { shape->pitch; }) spot.reach = 3 * shape->pitch;
      },
      part.shape);
  return spot;
}

float HostileMaps::coordinate_on(const HostileMap& on, float Spot::*axis) {
  const auto& parts = !on.map.surface.empty() && once_in(3) ? on.map.surface : on.map.parts;
  const Spot spot = spot_of(parts[pick(parts.size())]);
  switch (pick(8)) {
    case 0: return coordinate();
    case 1: return spot.*axis;
    case 2: return spot.*axis + either_sign(spot.reach) * one_of({1, 0.6F, 0.8F, 0.5F});
    case 3: return spot.*axis + either_sign(spot.reach * std::exp2(uniform(0, 12)));  // a Gaussian's tail
    case 4: return std::round(2 * uniform(-8, 8)) / 2;
    case 5: return spot.*axis + uniform(-1, 1) * std::exp2(uniform(-30, 0));
    default: return spot.*axis + uniform(-1.5F, 1.5F) * spot.reach;
  }
}

// Few bits, so that the force of a level place is a tie; or anything.
float HostileMaps::height_without_surface() {
  switch (pick(4)) {
    case 0: return std::bit_cast<float>(static_cast<std::uint32_t>(random_()));
    case 1: return std::ldexp(-1 - std::ldexp(static_cast<float>(1 + pick(4)), -23), static_cast<int>(pick(12)) - 6);
    case 2: return std::round(16 * uniform(-4, 4)) / 16;
    default: return height();
  }
}

float HostileMaps::beside_surface(float z) {
  switch (pick(5)) {
    case 0: return z;
    case 1: return once_in(2) ? std::nextafter(z, 2e4F) : std::nextafter(z, -2e4F);
    case 2: return std::round(256 * (z - uniform(0, 2))) / 256;
    case 3: return z - std::ldexp(1 + std::ldexp(static_cast<float>(pick(4)), -23), static_cast<int>(pick(24)) - 20);
    default: return z - uniform(0, 2);
  }
}

}  // namespace forceshade::tests
