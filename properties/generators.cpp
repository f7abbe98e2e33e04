// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/properties/generators.h"

#include <algorithm>
#include <cmath>

#include "forceshade/properties/binary32.h"

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

bool is_valid(const Eigen::Vector3f& position) {
  return (position.array().abs() <= 1e4F).all();
}

Eigen::Vector3f valid_position(PositionSource& source) {
  for (;;) {
    const Eigen::Vector3f position = source.next().position;
    if (is_valid(position)) return position;
  }
}

}  // namespace

Eigen::Vector3f NearbyPair::b(const Shape& shape) const {
  if (across_axis) {
    const auto d = static_cast<float>(shape.d);
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
    const Shape shape(law);
    const NearbyPair pair{valid_position(source), static_cast<int>(steps % 7) - 3, static_cast<int>(steps / 7 % 7) - 3,
                          shape.has_cylinder() && steps / 49 % 4 == 0};
    return rc::shrinkable::shrinkRecur(pair, [](const NearbyPair& p) {
      return rc::seq::map(simpler_positions(p.a), [p](const Eigen::Vector3f& a) {
        NearbyPair simpler_pair = p;
        simpler_pair.a = a;
        return simpler_pair;
      });
    });
  };
}

rc::Gen<std::vector<PathPoint>> polygon_of(const reference::Law& law) {
  return [law](const rc::Random& random, int) {
    rc::Random r(random);
    const Shape shape(law);
    const auto uniform = [&r](double low, double high) {
      return low + (high - low) * static_cast<double>(r.next() >> 11) * 0x1p-53;
    };
    const double width = shape.w > 0 ? static_cast<double>(shape.w) : 30;
    const double depth = shape.w > 0 ? static_cast<double>(shape.h) + width / 8 : 5;
    std::vector<PathPoint> polygon(3 + r.next() % 6);
    for (PathPoint& corner : polygon) {
      const double x = uniform(-0.7, 0.7) * width;
      const double z = static_cast<double>(shape.surface(static_cast<long double>(x))) - uniform(-0.2, 1) * depth;
      corner = {std::clamp(x, -1e4, 1e4), std::clamp(z, -1e4, 1e4)};  // outside there is no force
    }
    return rc::shrinkable::shrinkRecur(polygon, [](const std::vector<PathPoint>& p) {
      std::vector<std::vector<PathPoint>> smaller;
      for (std::size_t i = 0; p.size() > 3 && i < p.size(); ++i) {
        smaller.push_back(p);
        smaller.back().erase(smaller.back().begin() + static_cast<std::ptrdiff_t>(i));
      }
      return rc::seq::fromContainer(std::move(smaller));
    });
  };
}

std::ostream& operator<<(std::ostream& out, const NearbyPair& pair) {
  out << show(pair.a);
  if (pair.across_axis) return out << ", and its mirror image in the axis";
  return out << ", and " << pair.x_steps << " and " << pair.z_steps << " binary32 steps away in x and z";
}

std::ostream& operator<<(std::ostream& out, const PathPoint& point) {
  return out << '(' << point.x << ", " << point.z << ')';
}

}  // namespace forceshade::properties
