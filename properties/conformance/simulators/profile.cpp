// SPDX-License-Identifier: BSD-3-Clause
#include "properties/conformance/simulators/profile.h"

#include <algorithm>
#include <limits>
#include <random>

namespace forceshade::conformance::simulators {
namespace {

constexpr double kHalfWidth = 1.2;

Profile divided(const Profile& profile, unsigned parts) {
  Profile all{profile.front()};
  for (std::size_t i = 1; i < profile.size(); ++i)
    for (unsigned part = 1; part <= parts; ++part)
      all.push_back(profile[i - 1] + (profile[i] - profile[i - 1]) * (static_cast<double>(part) / parts));
  return all;
}

bool is_rising(Diagonals diagonals, std::size_t cell) {
  return diagonals == Diagonals::rising || (diagonals == Diagonals::alternating && cell % 2 == 0);
}

// In [-1, 1), the same on every machine.
double drawn(std::mt19937_64& random) {
  return static_cast<double>(random() >> 11U) * 0x1p-52 - 1;
}

}  // namespace

GroundMesh mesh_of(const Profile& profile, const Tessellation& tessellation) {
  const Profile line = divided(profile, tessellation.along);
  const unsigned across = tessellation.across;
  const double cell = 2 * kHalfWidth / across;
  std::mt19937_64 random(1);
  GroundMesh mesh;
  for (std::size_t i = 0; i < line.size(); ++i)
    for (unsigned j = 0; j <= across; ++j) {
      Eigen::Vector3d vertex(line[i].x(), -kHalfWidth + cell * j, line[i].y());
      if (i > 0 && i + 1 < line.size() && j > 0 && j < across && tessellation.moved > 0)
        vertex += tessellation.moved * cell * Eigen::Vector3d(drawn(random), drawn(random), 0);
      mesh.vertices.push_back(vertex);
    }
  for (std::uint32_t i = 0; i + 1 < line.size(); ++i)
    for (std::uint32_t j = 0; j < across; ++j) {
      const std::uint32_t a = i * (across + 1) + j, d = a + 1, b = a + across + 1, c = b + 1;
      const bool rising = is_rising(tessellation.diagonals, i + j);
      mesh.triangles.push_back({a, b, rising ? c : d});
      mesh.triangles.push_back({rising ? a : b, c, d});
    }
  return mesh;
}

Nearest nearest(const Profile& profile, const Eigen::Vector3d& centre) {
  const Eigen::Vector2d at(centre.x(), centre.z());
  Nearest found{std::numeric_limits<double>::infinity()};
  double height = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < profile.size(); ++i) {
    const Eigen::Vector2d from = profile[i - 1], part = profile[i] - from;
    const double share = std::clamp(part.dot(at - from) / part.squaredNorm(), 0.0, 1.0);
    const Eigen::Vector2d way = at - (from + share * part);
    if (way.norm() < found.distance) found = {way.norm(), Eigen::Vector3d(way.x(), 0, way.y()) / way.norm()};
    if (std::min(from.x(), profile[i].x()) <= at.x() && at.x() <= std::max(from.x(), profile[i].x()))
      height = std::max(
          height, part.x() == 0 ? std::max(from.y(), profile[i].y()) : from.y() + part.y() * (at.x() - from.x()) / part.x());
  }
  if (at.y() < height) found = {-found.distance, -found.normal};
  return found;
}

}  // namespace forceshade::conformance::simulators
