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

rc::Seq<Eigen::Vector3f> simpler_positions(const Eigen::Vector3f& position) {
  std::vector<Eigen::Vector3f> candidates;
  for (const int i : {1, 0, 2})
    for (const float value : simpler(position[i])) {
      candidates.push_back(position);
      candidates.back()[i] = value;
    }
  return rc::seq::fromContainer(std::move(candidates));
}

template <class Source>
Eigen::Vector3f valid_position(Source& source) {
  for (;;) {
    const Eigen::Vector3f position = source.next().position;
    if (is_valid(position)) return position;
  }
}

template <class Corner>
rc::Seq<std::vector<Corner>> with_fewer_corners(const std::vector<Corner>& polygon) {
  std::vector<std::vector<Corner>> smaller;
  for (std::size_t i = 0; polygon.size() > 3 && i < polygon.size(); ++i) {
    smaller.push_back(polygon);
    smaller.back().erase(smaller.back().begin() + static_cast<std::ptrdiff_t>(i));
  }
  return rc::seq::fromContainer(std::move(smaller));
}

}  // namespace

Eigen::Vector3f NearbyPair::b(const LawClaims& claims) const {
  if (across_axis) {
    const auto d = static_cast<float>(claims.d);
    return {-a.x(), a.y(), -d - (a.z() + d)};
  }
  return {neighbour(a.x(), x_steps), a.y(), neighbour(a.z(), z_steps)};
}

rc::Gen<Eigen::Vector3f> position_of(const reference::Law& law) {
  return [law](const rc::Random& random, int) {
    PositionSource source(law, rc::Random(random).next());
    return rc::shrinkable::shrinkRecur(source.next().position, &simpler_positions);
  };
}

rc::Gen<NearbyPair> pair_of(const reference::Law& law) {
  return [law](const rc::Random& random, int) {
    rc::Random r(random);
    PositionSource source(law, r.next());
    const std::uint64_t steps = r.next();
    const LawClaims claims(law);
    const NearbyPair pair{valid_position(source), static_cast<int>(steps % 7) - 3, static_cast<int>(steps / 7 % 7) - 3,
                          claims.has_cylinder() && steps / 49 % 4 == 0};
    return rc::shrinkable::shrinkRecur(pair, [](const NearbyPair& p) {
      return rc::seq::map(simpler_positions(p.a), [p](const Eigen::Vector3f& a) {
        NearbyPair simpler_pair = p;
        simpler_pair.a = a;
        return simpler_pair;
      });
    });
  };
}

Eigen::Vector3f Neighbours::b() const {
  return {neighbour(a.x(), steps[0]), neighbour(a.y(), steps[1]), neighbour(a.z(), steps[2])};
}

rc::Gen<Eigen::Vector3f> position_of(const HeightTarget& map) {
  return [map](const rc::Random& random, int) {
    HeightPositionSource source(map.law, map.claims, rc::Random(random).next());
    return rc::shrinkable::shrinkRecur(source.next().position, &simpler_positions);
  };
}

rc::Gen<Neighbours> neighbours_on(const HeightTarget& map) {
  return [map](const rc::Random& random, int) {
    rc::Random r(random);
    HeightPositionSource source(map.law, map.claims, r.next());
    const std::uint64_t steps = r.next();
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
    return rc::shrinkable::shrinkRecur(pair, [](const Neighbours& p) {
      return rc::seq::map(simpler_positions(p.a), [p](const Eigen::Vector3f& a) { return Neighbours{a, p.steps}; });
    });
  };
}

rc::Gen<std::vector<Eigen::Vector3f>> polygon_of(const HeightTarget& map) {
  return [map](const rc::Random& random, int) {
    rc::Random r(random);
    HeightPositionSource source(map.law, map.claims, r.next());
    const auto uniform = [&r](double low, double high) {
      return low + (high - low) * static_cast<double>(r.next() >> 11) * 0x1p-53;
    };
    const std::array<float, 2> middle = r.next() % 2 == 0 ? source.on_a_line() : source.anywhere();
    const double size = map.claims.parts[r.next() % map.claims.parts.size()].reach * std::exp2(-uniform(0, 10));
    std::vector<Eigen::Vector3f> polygon(3 + r.next() % 4);
    for (Eigen::Vector3f& corner : polygon) {
      const auto within = [](double coordinate) { return static_cast<float>(kept_in_domain(coordinate)); };
      const float x = within(static_cast<double>(middle[0]) + uniform(-1, 1) * size);
      const float y = within(static_cast<double>(middle[1]) + uniform(-1, 1) * size);
      corner = {x, y, within(source.surface({x, y}) - uniform(-0.2, 1) * std::min(size, 5.0))};
    }
    return rc::shrinkable::shrinkRecur(polygon, &with_fewer_corners<Eigen::Vector3f>);
  };
}

rc::Gen<std::vector<PathPoint>> polygon_of(const reference::Law& law) {
  return [law](const rc::Random& random, int) {
    rc::Random r(random);
    const LawClaims claims(law);
    const auto uniform = [&r](double low, double high) {
      return low + (high - low) * static_cast<double>(r.next() >> 11) * 0x1p-53;
    };
    const double width = claims.w > 0 ? static_cast<double>(claims.w) : 30;
    const double depth = claims.w > 0 ? static_cast<double>(claims.h) + width / 8 : 5;
    std::vector<PathPoint> polygon(3 + r.next() % 6);
    for (PathPoint& corner : polygon) {
      const double x = uniform(-0.7, 0.7) * width;
      const double z = static_cast<double>(claims.surface(static_cast<long double>(x))) - uniform(-0.2, 1) * depth;
      corner = {kept_in_domain(x), kept_in_domain(z)};  // outside there is no force
    }
    return rc::shrinkable::shrinkRecur(polygon, &with_fewer_corners<PathPoint>);
  };
}

std::ostream& operator<<(std::ostream& out, const NearbyPair& pair) {
  out << show(pair.a);
  if (pair.across_axis) return out << ", and its mirror image in the axis";
  return out << ", and " << pair.x_steps << " and " << pair.z_steps << " binary32 steps away in x and z";
}

std::ostream& operator<<(std::ostream& out, const Neighbours& pair) {
  return out << show(pair.a) << ", and " << pair.steps[0] << ", " << pair.steps[1] << " and " << pair.steps[2]
             << " binary32 steps away";
}

std::ostream& operator<<(std::ostream& out, const PathPoint& point) {
  return out << '(' << point.x << ", " << point.z << ')';
}

}  // namespace forceshade::properties
