// SPDX-License-Identifier: BSD-3-Clause
#include "properties/worst_tick.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "fast/domain.h"
#include "fast/meshes/session.h"
#include "properties/built_or_throw.h"
#include "properties/positions.h"
#include "rendering/largest_fan.h"

namespace forceshade::properties {
namespace {

using Eigen::Vector3d;

constexpr int kMostLooks = fast::Slips<fast::FilteredStages>::kMostLooks;
constexpr int kTries = 800;
constexpr std::int64_t kMostLooksInAll = 1 << 20;  // with these, no further try begins
constexpr std::uint64_t kSeed = 1;

Vector3d point(const float* at) {
  return Eigen::Vector3f(at).cast<double>();
}

class Search : private Draws {
 public:
  explicit Search(const MeshRendering& rendering)
      : Draws(kSeed),
        mesh_(built_or_throw(fast::Mesh::build(rendering))),
        contact_(fast::contact_in(mesh_, rendering.contact)),
        largest_fan_(mesh_.first_around(mesh::vertex_of_most(rendering.mesh()).first)) {
    Vector3d low = Vector3d::Constant(std::numeric_limits<double>::infinity()), high = -low;
    for (const fast::Face& face : mesh_.all_faces())
      for (const auto& corner : face.corner) {
        low = low.cwiseMin(point(corner.data()));
        high = high.cwiseMax(point(corner.data()));
      }
    size_ = (high - low).norm();
  }

  WorstTick run() {
    for (int i = 0; i < kTries && looks_ < kMostLooksInAll; ++i)
      if (i % 4 == 0)
        cross();
      else if (i % 4 == 1)
        go_along();
      else
        vary_worst();
    return worst_;
  }

 private:
  bool one_in(std::uint64_t n) { return bits() % n == 0; }
  // mm, of every size up to that of the mesh.
  double any_length() { return size_ * std::ldexp(uniform(0.5, 1), -static_cast<int>(bits() % 24)); }

  // At the vertex of most triangles, of a valley, or any.
  fast::HalfEdge half_edge() {
    constexpr int kLooksForValley = 32;
    const auto any = [&] { return static_cast<fast::HalfEdge>(bits() % (3 * std::uint64_t{mesh_.faces()})); };
    fast::HalfEdge h = any();
    const std::uint64_t kind = bits() % 4;
    if (kind == 0) return largest_fan_;
    for (int i = 0; kind == 1 && i < kLooksForValley; ++i, h = any())
      if (mesh_.twin(h) != fast::kRim && mesh_.face(fast::face_of(h)).fold(fast::corner_of(h)) == fast::Fold::narrow) break;
    return h;
  }
  Vector3d start(fast::HalfEdge h) const { return point(mesh_.start_point(h)); }
  // Along an edge, to a vertex, an axis or a diagonal of two or three, or any.
  Vector3d direction(fast::HalfEdge h) {
    const auto sign = [&] { return static_cast<double>(bits() % 3) - 1; };
    Vector3d along = start(fast::next(h)) - start(h);
    const std::uint64_t kind = bits() % 4;
    if (kind == 1) along = start(half_edge()) - start(h);
    if (kind == 2) along = {sign(), sign(), sign()};
    if (kind == 3 || along.norm() == 0) along = {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
    return (one_in(2) ? 1 : -1) * along.normalized();
  }
  // A corner, or a point of the edge.
  Vector3d place(fast::HalfEdge h) { return start(h) + (one_in(2) ? 0 : uniform(0, 1)) * (start(fast::next(h)) - start(h)); }

  // From one side of the mesh to the other, and on.
  void cross() {
    const fast::HalfEdge h = half_edge();
    const Vector3d at = place(h), along = direction(h), aside = direction(h);
    fast::Arrival god_object;
    tick(god_object, at - size_ * along);
    const double off = any_length();
    for (int i = 0; i < 2; ++i) tick(god_object, at + size_ * along + off * aside);
  }
  // On the surface, with the hand behind it.
  void go_along() {
    const fast::HalfEdge h = half_edge();
    const Vector3d at = place(h), along = direction(h), first = start(h);
    const Vector3d normal = (start(fast::next(h)) - first).cross(start(fast::previous(h)) - first).normalized() * any_length();
    fast::Arrival god_object;
    tick(god_object, at + normal);
    tick(god_object, at - normal);
    const double far = one_in(2) ? size_ : any_length();
    for (int i = 0; i < 2; ++i) tick(god_object, at - normal + far * along);
  }
  void vary_worst() {
    fast::Arrival god_object = before_worst_;
    Vector3d to = point(worst_position_.data());
    const double off = any_length();
    for (double& coordinate : to)
      if (!one_in(3)) coordinate += off * uniform(-1, 1);
    tick(god_object, to);
  }

  void tick(fast::Arrival& god_object, const Vector3d& to) {
    std::array<float, 3> position{};
    for (Eigen::Index i = 0; i < 3; ++i) {
      constexpr auto kMost = static_cast<double>(fast::kLargestCoordinate);
      position[static_cast<std::size_t>(i)] = fast::quantised(static_cast<float>(std::clamp(to[i], -kMost, kMost)));
    }
    const fast::Arrival before = god_object;
    fast::Stage stage{};
    mesh::Tick tick;
    fast::advance_filtered(mesh_, god_object, position, 1, mesh::Shading::none, contact_, stage, tick);
    looks_ += god_object.looks;
    worst_.is_unfinished |= tick.status == Status::unfinished && god_object.looks >= kMostLooks;
    if (god_object.looks + god_object.moves <= worst_.looks + worst_.moves) return;
    worst_.looks = god_object.looks;
    worst_.moves = god_object.moves;
    before_worst_ = before;
    worst_position_ = position;
  }

  const fast::Mesh mesh_;
  const mesh::Contact contact_;
  const fast::HalfEdge largest_fan_;
  double size_ = 0;  // mm, from corner to corner
  std::int64_t looks_ = 0;
  WorstTick worst_;
  fast::Arrival before_worst_;
  std::array<float, 3> worst_position_{};
};

}  // namespace

WorstTick worst_tick(const MeshRendering& rendering) {
  return Search(rendering).run();
}

std::string words_of(const WorstTick& worst) {
  return "the longest tick that a search found looks at " + std::to_string(worst.looks) + " triangles in " +
         std::to_string(worst.moves) + (worst.moves == 1 ? " move" : " moves") + "; none begins a move after " +
         std::to_string(kMostLooks) + " looks, and " +
         (worst.is_unfinished ? "some were unfinished for that reason" : "none was unfinished for that reason");
}

}  // namespace forceshade::properties
