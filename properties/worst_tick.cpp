// SPDX-License-Identifier: BSD-3-Clause
#include "properties/worst_tick.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>

#include "fast/domain.h"
#include "fast/meshes/session.h"
#include "fast/soups/god_object.h"
#include "fast/soups/session.h"
#include "properties/built_or_throw.h"
#include "properties/positions.h"
#include "rendering/largest_fan.h"

namespace forceshade::properties {
namespace {

using Eigen::Vector3d;

constexpr int kMostLooks = fast::Slips<fast::FilteredStages>::kMostLooks;
constexpr int kTries = 800;
constexpr std::int64_t kMostLooksInAll = 1 << 20;  // with these, no further try begins
constexpr std::uint64_t kSeedOfLookout = 1;

Vector3d point(const float* at) {
  return Eigen::Vector3f(at).cast<double>();
}

// A regular mesh.
class Regular {
 public:
  using State = fast::Arrival;

  explicit Regular(const MeshRendering& rendering)
      : mesh_(built_or_throw(fast::Mesh::build(rendering))), contact_(fast::contact_in(mesh_, rendering.contact)) {}

  std::uint32_t faces() const { return mesh_.faces(); }
  Vector3d start(fast::HalfEdge h) const { return point(mesh_.start_point(h)); }
  fast::HalfEdge first_around(std::uint32_t vertex) const { return mesh_.first_around(vertex); }
  bool is_valley(fast::HalfEdge h) const {
    return mesh_.twin(h) != fast::kRim && mesh_.face(fast::face_of(h)).fold(fast::corner_of(h)) == fast::Fold::narrow;
  }
  WorstTick tick(State& god_object, const std::array<float, 3>& position) const {
    fast::Stage stage{};
    mesh::Tick tick;
    fast::advance_filtered(mesh_, god_object, position, 1, mesh::Shading::none, contact_, stage, tick);
    return {god_object.looks, god_object.moves, tick.status == Status::unfinished && god_object.looks >= kMostLooks};
  }

 private:
  const fast::Mesh mesh_;
  const mesh::Contact contact_;
};

// Any set of triangles.
class Irregular {
 public:
  using State = fast::soups::State;

  explicit Irregular(const MeshRendering& rendering)
      : mesh_(rendering.mesh()),
        session_(std::make_unique<fast::soups::Session>(fast::soups::soup_of(rendering), 1.0F, false)) {}

  std::uint32_t faces() const { return static_cast<std::uint32_t>(mesh_.triangles.size()); }
  Vector3d start(fast::HalfEdge h) const { return point(mesh_.vertices[mesh_.triangles[h / 3][h % 3]].data()); }
  fast::HalfEdge first_around(std::uint32_t vertex) const {
    fast::HalfEdge h = 0;
    while (mesh_.triangles[h / 3][h % 3] != vertex) ++h;
    return h;
  }
  bool is_valley(fast::HalfEdge) const { return true; }
  WorstTick tick(State& god_object, const std::array<float, 3>& position) const {
    session_->resume(god_object);
    const fast::soups::Tick tick = session_->tick(position);
    god_object = tick.after;
    const int looks = static_cast<int>(session_->looks());
    return {looks, tick.moves, tick.status == Status::unfinished && looks >= kMostLooks};
  }

 private:
  const mesh::TriangleMesh& mesh_;
  const std::unique_ptr<fast::soups::Session> session_;
};

template <class Surface>
class TickLookout : private Draws {
 public:
  explicit TickLookout(const MeshRendering& rendering)
      : Draws(kSeedOfLookout),
        mesh_(rendering),
        largest_fan_(mesh_.first_around(mesh::vertex_of_most(rendering.mesh()).first)) {
    Vector3d low = Vector3d::Constant(std::numeric_limits<double>::infinity()), high = -low;
    for (fast::HalfEdge h = 0; h < 3 * mesh_.faces(); ++h) {
      low = low.cwiseMin(start(h));
      high = high.cwiseMax(start(h));
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
  using State = typename Surface::State;

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
      if (mesh_.is_valley(h)) break;
    return h;
  }
  Vector3d start(fast::HalfEdge h) const { return mesh_.start(h); }
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
    State god_object;
    tick(god_object, at - size_ * along);
    const double off = any_length();
    for (int i = 0; i < 2; ++i) tick(god_object, at + size_ * along + off * aside);
  }
  // On the surface, with the hand behind it.
  void go_along() {
    const fast::HalfEdge h = half_edge();
    const Vector3d at = place(h), along = direction(h), first = start(h);
    const Vector3d normal = (start(fast::next(h)) - first).cross(start(fast::previous(h)) - first).normalized() * any_length();
    State god_object;
    tick(god_object, at + normal);
    tick(god_object, at - normal);
    const double far = one_in(2) ? size_ : any_length();
    for (int i = 0; i < 2; ++i) tick(god_object, at - normal + far * along);
  }
  void vary_worst() {
    State god_object = before_worst_;
    Vector3d to = point(worst_position_.data());
    const double off = any_length();
    for (double& coordinate : to)
      if (!one_in(3)) coordinate += off * uniform(-1, 1);
    tick(god_object, to);
  }

  void tick(State& god_object, const Vector3d& to) {
    std::array<float, 3> position{};
    for (Eigen::Index i = 0; i < 3; ++i) {
      constexpr auto kMost = static_cast<double>(fast::kLargestCoordinate);
      position[static_cast<std::size_t>(i)] = fast::quantised(static_cast<float>(std::clamp(to[i], -kMost, kMost)));
    }
    const State before = god_object;
    const WorstTick its = mesh_.tick(god_object, position);
    looks_ += its.looks;
    worst_.is_unfinished |= its.is_unfinished;
    if (its.looks + its.moves <= worst_.looks + worst_.moves) return;
    worst_.looks = its.looks;
    worst_.moves = its.moves;
    before_worst_ = before;
    worst_position_ = position;
  }

  const Surface mesh_;
  const fast::HalfEdge largest_fan_;
  double size_ = 0;  // mm, from corner to corner
  std::int64_t looks_ = 0;
  WorstTick worst_;
  State before_worst_;
  std::array<float, 3> worst_position_{};
};

}  // namespace

WorstTick worst_tick(const MeshRendering& rendering) {
  return rendering.checked.is_regular() ? TickLookout<Regular>(rendering).run() : TickLookout<Irregular>(rendering).run();
}

std::string words_of(const WorstTick& worst) {
  return "the longest tick that a search found looks at " + std::to_string(worst.looks) + " triangles in " +
         std::to_string(worst.moves) + (worst.moves == 1 ? " move" : " moves") + "; none begins a move after " +
         std::to_string(kMostLooks) + " looks, and " +
         (worst.is_unfinished ? "some were unfinished for that reason" : "none was unfinished for that reason");
}

}  // namespace forceshade::properties
