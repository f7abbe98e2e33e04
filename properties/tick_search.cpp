// SPDX-License-Identifier: BSD-3-Clause
#include "properties/tick_search.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>

#include "properties/built_or_throw.h"
#include "properties/positions.h"

namespace forceshade::properties {
namespace {

using Eigen::Vector3d;

constexpr double kStep = 0.999;                             // of a step, since positions are rounded
constexpr std::array<double, 3> kInwards{0.01, 0.5, 0.95};  // of a step: from the border into the first region
constexpr double kToMiddle = 0.002;                         // of the way from a corner to the middle of all
constexpr std::size_t kCorners = 16;                        // of a pair that are tried, those with the largest change
constexpr int kTurns = 256;                                 // stretches of the random walk
constexpr int kTicks = 256;                                 // of a stretch
constexpr std::uint64_t kSeed = 1;

class Search {
 public:
  Search(const MeshRendering& rendering, const HandStep& hand, TickChanges& changes)
      : mesh_(rendering.mesh()),
        open_(built_or_throw(fast::GodObject::build(rendering))),
        hand_(hand),
        stiffness_(static_cast<double>(rendering.stiffness)),
        changes_(changes) {
    for (const double x : {-1, 0, 1})
      for (const double y : {-1, 0, 1})
        for (const double z : {-1, 0, 1})
          if (x != 0 || y != 0 || z != 0) directions_.push_back(Vector3d(x, y, z).normalized());
  }

  void begin() {
    session_ = open_.open();
    last_.reset();
  }

  // to: mm, no farther than a step from the last.
  void tick(const Vector3d& to) {
    const MeshPosition position{static_cast<float>(to.x()), static_cast<float>(to.y()), static_cast<float>(to.z())};
    const mesh::Tick tick = session_->tick(position);
    const Vector3d force = vector_of(tick.force);
    const double D = force.norm() / stiffness_;
    const bool is_in = tick.status == Status::contact && D <= hand_.depth && D > 2 * grid_reach(mesh_, tick.after) / kGridAngle;
    if (is_in && last_) {
      changes_.moves = std::max(changes_.moves, unsigned{tick.moves});
      note(changes_.force, (force - last_->force).norm(), position);
      note(changes_.turn, std::atan2(force.cross(last_->force).norm(), force.dot(last_->force)) * 180 / std::numbers::pi,
           position);
    }
    last_.reset();
    if (is_in) last_ = Last{position, force};
  }

  // Goes straight from a free position to p, in the surface, and then a step in each direction.
  void from(const Vector3d& p, const Vector3d& D, const Vector3d& towards) {
    const Vector3d way = 1.05 * D;
    const double count = std::ceil(way.norm() / (kStep * hand_.step)) + 1;
    for (std::size_t i = 0; i <= directions_.size(); ++i) {
      begin();
      for (double k = 0; k <= count; ++k) tick(p + (1 - k / count) * way);
      tick(p + kStep * hand_.step * (i < directions_.size() ? directions_[i] : towards.normalized()));
    }
  }

  void walk(Draws draws, const Monitor& monitor) {
    const auto unit = [&] { return Vector3d(draws.uniform(-1, 1), draws.uniform(-1, 1), draws.uniform(-1, 1)).normalized(); };
    for (int turn = 0; turn < kTurns; ++turn) {
      monitor.at(static_cast<double>(turn) / kTurns);
      const auto t = static_cast<std::uint32_t>(draws.bits() % mesh_.triangles.size());
      const Vector3d n = unit_normal(mesh_, t).direction;
      const auto corner = [&](std::size_t i) { return vector_of(mesh_.vertices[mesh_.triangles[t][i]]); };
      Vector3d p = (corner(0) + corner(1) + corner(2)) / 3 + hand_.step * n;
      Vector3d along = unit();
      begin();
      for (int i = 0; i < kTicks; ++i) {
        tick(p);
        // Along the surface, and towards a depth that is drawn; now and then another way.
        if (draws.bits() % 16 == 0) along = unit();
        const Vector3d push = last_ ? last_->force.normalized() : Vector3d(n);
        const double now = last_ ? last_->force.norm() / (stiffness_ * hand_.depth) : 0;
        const Vector3d to = along - along.dot(push) * push + (now < draws.uniform(0, 1.2) ? -1 : 1) * push;
        p += kStep * hand_.step * to.normalized();
      }
    }
  }

 private:
  struct Last {
    MeshPosition position;
    Vector3d force;
  };

  void note(Change& change, double size, const MeshPosition& position) const {
    if (!(size > change.found)) return;
    change.found = size;
    change.at = {last_->position, position};
  }

  const mesh::TriangleMesh& mesh_;
  fast::GodObject open_;
  HandStep hand_;
  double stiffness_;  // N/mm
  TickChanges& changes_;
  std::vector<Vector3d> directions_;
  std::unique_ptr<fast::TickSession> session_;
  std::optional<Last> last_;
};

}  // namespace

void search_changes(const MeshRendering& rendering, const HandStep& hand, const std::vector<SuspectPair>& pairs,
                    TickChanges& changes, const Monitor& monitor) {
  Search search(rendering, hand, changes);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    monitor.at(0.5 * static_cast<double>(i) / static_cast<double>(pairs.size()));
    const SuspectPair& pair = pairs[i];
    Vector3d middle = Vector3d::Zero();
    for (const Vector3d& corner : pair.corners) middle += corner / static_cast<double>(pair.corners.size());
    std::vector<Vector3d> corners = pair.corners;
    std::ranges::stable_sort(corners, std::ranges::greater(),
                             [&](const Vector3d& p) { return (pair.first(p) - pair.second(p)).norm(); });
    corners.resize(std::min(kCorners, corners.size()));
    for (const Vector3d& corner : corners)
      for (const double inwards : kInwards) {
        const Vector3d q = corner + kToMiddle * (middle - corner) + inwards * hand.step * pair.inwards, D = pair.first(q);
        const Vector3d p = q + std::max(0.0, 1 - kStep * hand.depth / D.norm()) * D;  // no deeper than hand.depth
        const Vector3d first = pair.first(p), second = pair.second(p);
        search.from(p, first, second - first);
        search.from(p, second, first - second);
      }
  }
  search.walk(Draws(kSeed), monitor.part(0.5, 1));
}

}  // namespace forceshade::properties
