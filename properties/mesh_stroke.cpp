// SPDX-License-Identifier: BSD-3-Clause
// Strokes that draw energy from the shading of a mesh, by trial: the fast path gives the forces, so what is found was felt.

#include <Eigen/Geometry>
#include <algorithm>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <numeric>

#include "properties/built_or_throw.h"
#include "properties/mesh_energy.h"

namespace forceshade::properties {
namespace {

using Digits100 = boost::multiprecision::cpp_bin_float_100;

constexpr std::size_t kTriangles = 16;             // that are tried
constexpr double kTicksToTry = 400;                // of a stroke
constexpr double kMostTicks = 4e6;                 // of the one that is returned
constexpr double kShareOfSampling = 0.01;          // of its work
constexpr double kAbove = 0.01;                    // of the depth: how far above the surface a stroke begins and ends
constexpr double kBelow = 0.995;                   // of the depth: a stroke, since positions are rounded
constexpr double kInset = 0.98;                    // of the way from the centre to a corner
constexpr std::array<double, 3> kLonger{1, 3, 9};  // beyond the triangle, for flat parts of a mesh

MeshPosition rounded(const Eigen::Vector3d& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}
// The corners of a stroke from a to b, points of a triangle with this unit normal.
std::vector<MeshPosition> corners_of(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& normal,
                                     double depth) {
  const Eigen::Vector3d above = kAbove * depth * normal, below = -kBelow * depth * normal;
  return {rounded(a + above), rounded(a + below), rounded(b + below), rounded(b + above), rounded(a + above)};
}

double length_of(const std::vector<MeshPosition>& corners) {
  double length = 0;
  for (std::size_t i = 1; i < corners.size(); ++i) length += (vector_of(corners[i]) - vector_of(corners[i - 1])).norm();
  return length;
}

// Positions along the stroke, no farther apart than `step`.
template <typename Take>
void walk(const std::vector<MeshPosition>& corners, double step, const Take& take) {
  for (std::size_t i = 1; i < corners.size(); ++i) {
    const Eigen::Vector3d from = vector_of(corners[i - 1]), by = vector_of(corners[i]) - from;
    const double pieces = std::ceil(by.norm() / step);
    for (double k = 0; k < pieces; ++k) take(rounded(from + k / pieces * by));
  }
  take(corners.back());
}

class Tried {
 public:
  Tried(const MeshRendering& rendering, double depth)
      : open_(built_or_throw(fast::GodObject::build(rendering))),
        K_(static_cast<double>(rendering.stiffness)),
        strongest_(K_ * depth) {}

  // mJ by the trapezoid rule; nothing where the god-object is farther off than the depth, or is not free in the end.
  std::optional<double> work(const std::vector<MeshPosition>& corners) const {
    auto session = open_.open();
    Eigen::Vector3d last = vector_of(corners.front()), push = Eigen::Vector3d::Zero();
    double work = 0;
    bool is_good = true, is_free = true;
    walk(corners, length_of(corners) / kTicksToTry, [&](const MeshPosition& position) {
      const mesh::Tick tick = session->tick(position);
      const Eigen::Vector3d force = vector_of(tick.force), p = vector_of(position);
      work += 0.5 * (push + force).dot(p - last);
      is_good &= force.norm() <= strongest_;
      is_free = tick.status == Status::free;
      last = p;
      push = force;
    });
    if (!is_good || !is_free) return std::nullopt;
    return work;
  }

  // Its work and ticks, in steps so small that sampling is a small share of `about`, mJ.
  void measure(MeshStroke& stroke, double about, const Monitor& monitor) const {
    const double ticks =
        std::clamp(K_ * stroke.length * stroke.length / (2 * kShareOfSampling * about), kTicksToTry, kMostTicks);
    auto session = open_.open();
    Digits100 work = 0, squares = 0;
    MeshPosition last{};
    std::array<float, 3> push{};
    walk(stroke.corners, stroke.length / ticks, [&](const MeshPosition& position) {
      if (stroke.ticks++ > 0)
        for (std::size_t i = 0; i < 3; ++i) {
          const Digits100 step = Digits100(position[i]) - last[i];
          work += push[i] * step;
          squares += step * step;
        }
      push = session->tick(position).force;
      last = position;
      if (stroke.ticks % 1024 == 0) monitor.at(std::min(1.0, static_cast<double>(stroke.ticks) / ticks));
    });
    stroke.work = static_cast<double>(work);
    stroke.sampling = static_cast<double>(Digits100(K_ / 2 * squares));
  }

 private:
  fast::GodObject open_;
  double K_, strongest_;  // N/mm, N
};

}  // namespace

MeshStroke best_stroke(const MeshRendering& rendering, const LargestTurns& turns, double depth, double length,
                       const Monitor& monitor) {
  const mesh::TriangleMesh& mesh = rendering.mesh();
  const auto corner = [&](std::uint32_t t, std::size_t i) { return vector_of(mesh.vertices[mesh.triangles[t][i]]); };
  // The energy of a stroke along the longest side for its length, but for the turn's changes.
  const auto promise = [&](std::uint32_t t) {
    const double side = std::max(
        {(corner(t, 0) - corner(t, 1)).norm(), (corner(t, 1) - corner(t, 2)).norm(), (corner(t, 2) - corner(t, 0)).norm()});
    return turns.of_triangle[t] * side / (side + depth);
  };
  std::vector<std::uint32_t> order(mesh.triangles.size());
  std::iota(order.begin(), order.end(), 0U);
  const std::size_t count = std::min(kTriangles, order.size());
  std::ranges::partial_sort(order, order.begin() + static_cast<std::ptrdiff_t>(count), [&](std::uint32_t a, std::uint32_t b) {
    return std::pair(promise(a), b) > std::pair(promise(b), a);
  });

  const Tried tried(rendering, depth);
  MeshStroke best;
  double most = 0, work_of_best = 0;
  for (std::size_t n = 0; n < count; ++n) {
    monitor.at(0.5 * static_cast<double>(n) / static_cast<double>(count));
    const std::uint32_t t = order[n];
    const Eigen::Vector3d normal = unit_normal(mesh, t).direction;
    const Eigen::Vector3d centre = (corner(t, 0) + corner(t, 1) + corner(t, 2)) / 3;
    std::vector<Eigen::Vector3d> points{centre};
    for (std::size_t i = 0; i < 3; ++i)
      for (const double share : {kInset, kInset / 2}) points.push_back(centre + share * (corner(t, i) - centre));
    for (const Eigen::Vector3d& a : points)
      for (const Eigen::Vector3d& b : points)
        for (const double longer : kLonger) {
          if (a == b) continue;
          const Eigen::Vector3d middle = (a + b) / 2;
          const auto corners = corners_of(middle + longer * (a - middle), middle + longer * (b - middle), normal, depth);
          const double size = length_of(corners);
          if (!(size <= length)) continue;
          const auto work = tried.work(corners);
          if (!work || *work / size <= most) continue;
          most = *work / size;
          work_of_best = *work;
          best = {.triangle = t, .corners = corners, .length = size};
        }
  }
  if (!best.corners.empty()) {
    best.along = (vector_of(best.corners[2]) - vector_of(best.corners[1])).norm();
    tried.measure(best, work_of_best, monitor.part(0.5, 1));
  }
  return best;
}

}  // namespace forceshade::properties
