// SPDX-License-Identifier: BSD-3-Clause
// Properties of the god-object on drawn sets of triangles (docs/soups.md), whose cases RapidCheck draws and makes simpler. A
// renderer that is wrong in one way is found by the property that is for it.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <functional>
#include <limits>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "properties/positions.h"
#include "tests/properties/soup_walks.h"
#include "tests/support/drawn.h"
#include "tests/support/with_rapidcheck.h"

namespace forceshade::properties {
namespace {

using Part = std::vector<mesh::TrianglePoints>;  // a tetrahedron, or one triangle

// Most on a lattice, so that parts cross, touch, stand on each other and coincide.
struct SoupCase {
  std::vector<Part> parts;
  bool is_closed = false;  // of tetrahedra
  mesh::Sides sides = mesh::Sides::front;
  std::vector<MeshPosition> path;
  MeshPosition beside{};  // the end of a trembling hand's way from the path's last position

  Walk walk() const {
    mesh::TriangleMesh mesh;
    for (const Part& part : parts)
      for (const mesh::TrianglePoints& points : part) {
        const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
        mesh.vertices.insert(mesh.vertices.end(), points.begin(), points.end());
        mesh.triangles.push_back({first, first + 1, first + 2});
      }
    return {{std::get<mesh::CheckedMesh>(mesh::check_any(std::move(mesh))), {}, sides, mesh::Shading::none, 0.3F, {}},
            is_closed,
            path,
            beside};
  }
};

class SoupDraws : private Draws {
 public:
  using Draws::Draws;

  SoupCase drawn() {
    SoupCase its;
    step_ = std::array{4.0F, 3.0F, 1.0F, 0.1F}[below(4)];
    span_ = std::array{1, 1, 2}[below(3)];
    is_general_ = below(3) == 0;
    its.is_closed = below(3) != 0;
    its.sides = below(2) == 0 ? mesh::Sides::front : mesh::Sides::both;
    for (std::size_t left = its.is_closed ? 1 + below(4) : 2 + below(9); left > 0; --left)
      its.parts.push_back(its.is_closed ? tetrahedron() : Part{triangle()});
    MeshPosition last = below(3) == 0 ? middle_of(its.parts.front()) : node(2 * span_);
    for (int i = 0; i < kPositions; ++i) {
      if (below(12) != 0) last = position(its, last);
      its.path.push_back(last);
    }
    its.beside = last;
    const float reach = std::array{0x1p-23F, 0x1p-20F, 0.01F, 0.3F}[below(4)] * step_;
    for (float& c : its.beside) c += around(reach);
    return its;
  }

 private:
  static constexpr int kPositions = 24;

  std::size_t below(std::size_t count) { return bits() % count; }
  float around(float size) { return static_cast<float>(uniform(-1, 1)) * size; }
  MeshPosition node(int most) {
    MeshPosition node;
    for (float& c : node)
      c = step_ * static_cast<float>(static_cast<int>(below(static_cast<std::size_t>(2 * most + 1))) - most);
    return node;
  }
  mesh::Vertex vertex() {
    mesh::Vertex its = node(span_);
    if (is_general_)
      for (float& c : its) c += around(step_);
    return its;
  }
  mesh::TrianglePoints triangle() {
    mesh::TrianglePoints points{};
    do
      for (mesh::Vertex& corner : points) corner = vertex();
    while (!mesh::has_area(points));
    return points;
  }
  Part tetrahedron() {
    const auto [a, b, c] = triangle();
    mesh::Vertex d = vertex();
    while (mesh::side_of(a, b, c, d) == 0) d = vertex();
    if (mesh::side_of(a, b, c, d) > 0) return {{{a, c, b}, {a, b, d}, {b, c, d}, {a, d, c}}};
    return {{{a, b, c}, {a, d, b}, {b, d, c}, {a, c, d}}};
  }
  static MeshPosition middle_of(const Part& part) {
    MeshPosition sum{};
    for (const mesh::TrianglePoints& t : part)
      for (const mesh::Vertex& corner : t)
        for (std::size_t i = 0; i < 3; ++i) sum[i] += corner[i];
    for (float& c : sum) c /= 3 * static_cast<float>(part.size());
    return sum;
  }
  MeshPosition position(const SoupCase& its, MeshPosition at) {
    switch (below(8)) {
      case 0:
      case 1: return node(2 * span_);
      case 2:
        at = node(4 * span_);
        for (float& c : at) c /= 2;
        return at;
      case 3: {
        const mesh::TrianglePoints& t = its.parts[below(its.parts.size())].front();
        for (std::size_t i = 0; i < 3; ++i) at[i] = (t[0][i] + t[1][i]) / 2;
        return at;
      }
      case 4:
        for (float& c : at) c = around(2 * step_ * static_cast<float>(span_));
        return at;
      default: {
        const float reach = std::array{0.3F, 0.1F, 0x1p-20F, 0x1p-24F}[below(4)] * step_;
        for (float& c : at) c += around(reach);
        return at;
      }
    }
  }

  float step_ = 1;
  int span_ = 1;
  bool is_general_ = false;  // no lattice
};

Generator<SoupCase> soup_case() {
  return {[](std::uint64_t seed) { return SoupDraws(seed).drawn(); },
          [](const SoupCase& its) {
            std::vector<SoupCase> simpler;
            for (auto& parts : shorter(its.parts, 1))
              simpler.push_back({parts, its.is_closed, its.sides, its.path, its.beside});
            for (auto& path : shorter(its.path, 1)) simpler.push_back({its.parts, its.is_closed, its.sides, path, its.beside});
            return simpler;
          }};
}

// Those that RapidCheck refutes.
std::set<std::string> refuted(const Open& open, int cases, Counts& counts, bool is_told = false) {
  std::set<std::string> names;
  for (const auto& [name, property] : kProperties) {
    const PropertyResult result = tests::run_with_rapidcheck(
        name, cases, 4, [&, check = property](Chooser& choose) { return check(choose(soup_case()).walk(), open, counts); });
    if (is_told) {
      EXPECT_TRUE(result.held) << name << ": " << result.counterexample;
    }
    if (!result.held) names.insert(name);
  }
  return names;
}

TEST(soup_properties, hold_of_the_real_time_side_on_drawn_sets_of_triangles) {
  Counts counts;
  EXPECT_EQ(refuted(in_real_time, static_cast<int>(tests::drawn(1600)), counts, true), std::set<std::string>{});
  for (const auto& [what, count] : counts) std::printf("  %7zu %s\n", count, what.c_str());
  for (const char* what :
       {"regular", "irregular", "touching", "flights", "windings", "windings inside", "rests", "swings in contact"})
    EXPECT_GT(counts[what], 0U) << what;
}

// Answers as the real-time side does, changed.
class ChangedSession final : public fast::TickSession {
 public:
  // Is given how often the position has changed, whether its position is that of the tick before, and the right session.
  using Change =
      std::function<mesh::Tick(int changes, bool is_repeated, const MeshPosition& position, fast::TickSession& right)>;

  ChangedSession(std::unique_ptr<fast::TickSession> right, Change change)
      : right_(std::move(right)), change_(std::move(change)) {}

  mesh::Tick tick(const MeshPosition& position) noexcept override {
    const bool is_repeated = std::exchange(last_, position) == position;
    changes_ += is_repeated ? 0 : 1;
    return change_(changes_, is_repeated, position, *right_);
  }
  fast::Stage stage() const noexcept override { return right_->stage(); }
  void resume(const mesh::GodObject& state) noexcept override { right_->resume(state); }

 private:
  std::unique_ptr<fast::TickSession> right_;
  Change change_;
  int changes_ = 0;
  MeshPosition last_{std::numeric_limits<float>::infinity()};
};

std::set<std::string> refuted_if(const ChangedSession::Change& change) {
  Counts counts;
  return refuted(
      [&](const MeshRendering& rendering) { return std::make_unique<ChangedSession>(in_real_time(rendering), change); }, 60,
      counts);
}

TEST(soup_properties, find_a_renderer_that_is_wrong) {
  using Names = std::set<std::string>;
  EXPECT_EQ(refuted_if([](int, bool, const MeshPosition& position, fast::TickSession& right) {
              mesh::Tick tick = right.tick(position);
              if (tick.status == Status::contact) ++tick.moves;
              return tick;
            }),
            Names{"both sides are equal"})
      << "it counts a move too many";
  EXPECT_TRUE(refuted_if([](int number, bool, const MeshPosition& position, fast::TickSession& right) {
                if (number % 5 == 4) right.resume({});
                return right.tick(position);
              }).contains("nothing passes"))
      << "it forgets its side";
  EXPECT_EQ(refuted_if([](int, bool is_repeated, const MeshPosition& position, fast::TickSession& right) {
              mesh::Tick tick = right.tick(position);
              if (is_repeated) tick.force[2] *= 0.5F;
              return tick;
            }),
            (Names{"both sides are equal", "rests are idempotent"}))
      << "it lets a hand at rest sink in";
  EXPECT_EQ(refuted_if([](int number, bool, const MeshPosition& position, fast::TickSession& right) {
              mesh::Tick tick = right.tick(position);
              if (number > 24 && tick.status == Status::contact) tick.after.parameter[0] += static_cast<std::uint32_t>(number);
              return tick;
            }),
            Names{"rests do not creep"})
      << "it goes on by a step of the grid in each swing";
}

}  // namespace
}  // namespace forceshade::properties
