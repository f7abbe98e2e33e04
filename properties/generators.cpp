// SPDX-License-Identifier: BSD-3-Clause
#include "properties/generators.h"

#include <algorithm>
#include <cmath>

#include "properties/binary32.h"

namespace forceshade::properties {
namespace {

// The same number with fewer and fewer significant bits, 0 first.
std::vector<float> simpler(float value) {
  if (value == 0) return {};
  std::vector<float> candidates{0.0F};
  if (!std::isfinite(value)) return candidates;
  int exponent = 0;
  const float fraction = std::frexp(value, &exponent);
  for (const int bits : {1, 2, 4, 8, 12, 16, 20, 23}) {
    const float rounded = std::ldexp(std::round(std::ldexp(fraction, bits)), exponent - bits);
    if (rounded != value) candidates.push_back(rounded);
  }
  return candidates;
}

std::vector<Eigen::Vector3f> simpler_positions(const Eigen::Vector3f& position) {
  std::vector<Eigen::Vector3f> candidates;
  for (const int i : {1, 0, 2})
    for (const float value : simpler(position[i])) {
      candidates.push_back(position);
      candidates.back()[i] = value;
    }
  return candidates;
}

template <class Source>
Eigen::Vector3f valid_position(Source& source) {
  for (;;) {
    const Eigen::Vector3f position = source.next().position;
    if (is_valid(position)) return position;
  }
}

template <class Corner>
std::vector<std::vector<Corner>> with_fewer_corners(const std::vector<Corner>& polygon) {
  return shorter(polygon, 3);
}

// The same pairs at simpler positions.
template <class Pair>
std::vector<Pair> at_simpler_positions(const Pair& pair) {
  std::vector<Pair> pairs;
  for (const Eigen::Vector3f& a : simpler_positions(pair.a)) {
    pairs.push_back(pair);
    pairs.back().a = a;
  }
  return pairs;
}

}  // namespace

Eigen::Vector3f NearbyPair::b(const LawClaims& claims) const {
  if (across_axis) {
    const auto d = static_cast<float>(claims.d);
    return {-a.x(), a.y(), -d - (a.z() + d)};
  }
  return {neighbour(a.x(), x_steps), a.y(), neighbour(a.z(), z_steps)};
}

Generator<Eigen::Vector3f> position_of(const reference::Law& law) {
  return {[law](std::uint64_t seed) { return PositionSource(law, seed).next().position; }, &simpler_positions};
}

Generator<NearbyPair> pair_of(const reference::Law& law) {
  const auto draw = [law](std::uint64_t seed) {
    Draws draws(seed);
    PositionSource source(law, draws.bits());
    const std::uint64_t steps = draws.bits();
    const LawClaims claims(law);
    const NearbyPair pair{valid_position(source), static_cast<int>(steps % 7) - 3, static_cast<int>(steps / 7 % 7) - 3,
                          claims.has_cylinder() && steps / 49 % 4 == 0};
    return pair;
  };
  return {draw, &at_simpler_positions<NearbyPair>};
}

Eigen::Vector3f Neighbours::b() const {
  return {neighbour(a.x(), steps[0]), neighbour(a.y(), steps[1]), neighbour(a.z(), steps[2])};
}

Generator<Eigen::Vector3f> position_of(const HeightTarget& map) {
  return {[map](std::uint64_t seed) { return HeightPositionSource(map.law, map.claims, seed).next().position; },
          &simpler_positions};
}

Generator<Neighbours> neighbours_on(const HeightTarget& map) {
  const auto draw = [map](std::uint64_t seed) {
    Draws draws(seed);
    HeightPositionSource source(map.law, map.claims, draws.bits());
    const std::uint64_t steps = draws.bits();
    Neighbours pair{valid_position(source), {}};
    if (steps % 2 == 0) {
      const std::array<float, 2> line = source.on_a_line();
      const Eigen::Vector3f moved(line[0], line[1], pair.a.z());
      if (is_valid(moved)) pair.a = moved;
    }
    std::uint64_t rest = steps / 2;
    for (int& step : pair.steps) {
      step = static_cast<int>(rest % 7) - 3;
      rest /= 7;
    }
    return pair;
  };
  return {draw, &at_simpler_positions<Neighbours>};
}

Generator<std::vector<Eigen::Vector3f>> polygon_of(const HeightTarget& map) {
  const auto draw = [map](std::uint64_t seed) {
    Draws draws(seed);
    HeightPositionSource source(map.law, map.claims, draws.bits());
    const std::array<float, 2> middle = draws.bits() % 2 == 0 ? source.on_a_line() : source.anywhere();
    const double size = map.claims.parts[draws.bits() % map.claims.parts.size()].reach * std::exp2(-draws.uniform(0, 10));
    std::vector<Eigen::Vector3f> polygon(3 + draws.bits() % 4);
    for (Eigen::Vector3f& corner : polygon) {
      const auto within = [](double coordinate) { return static_cast<float>(kept_in_domain(coordinate)); };
      const float x = within(static_cast<double>(middle[0]) + draws.uniform(-1, 1) * size);
      const float y = within(static_cast<double>(middle[1]) + draws.uniform(-1, 1) * size);
      corner = {x, y, within(source.surface({x, y}) - draws.uniform(-0.2, 1) * std::min(size, 5.0))};
    }
    return polygon;
  };
  return {draw, &with_fewer_corners<Eigen::Vector3f>};
}

Generator<std::vector<PathPoint>> polygon_of(const reference::Law& law) {
  const auto draw = [law](std::uint64_t seed) {
    Draws draws(seed);
    const LawClaims claims(law);
    const double width = claims.w > 0 ? static_cast<double>(claims.w) : 30;
    const double depth = claims.w > 0 ? static_cast<double>(claims.h) + width / 8 : 5;
    std::vector<PathPoint> polygon(3 + draws.bits() % 6);
    for (PathPoint& corner : polygon) {
      const double x = draws.uniform(-0.7, 0.7) * width;
      const double z = static_cast<double>(claims.surface(static_cast<long double>(x))) - draws.uniform(-0.2, 1) * depth;
      corner = {kept_in_domain(x), kept_in_domain(z)};  // outside there is no force
    }
    return polygon;
  };
  return {draw, &with_fewer_corners<PathPoint>};
}

}  // namespace forceshade::properties
