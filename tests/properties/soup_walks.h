// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A hand's path on a set of triangles, and what must hold on it (docs/soups.md): both sides are equal, nothing passes a wall, a
// rest that is repeated stays, and a hand that trembles does not make it creep.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "forceshade/fast.h"
#include "forceshade/meshes.h"
#include "forceshade/reference.h"
#include "properties/binary32.h"
#include "properties/mesh_properties.h"
#include "tests/meshes/passing.h"
#include "tests/meshes/rendering.h"
#include "tests/meshes/uncut.h"

namespace forceshade::properties {

// A hand's path on a set of triangles.
struct Walk {
  MeshRendering rendering;
  bool is_closed = false;  // no triangle has a rim
  std::vector<MeshPosition> path;
  MeshPosition beside{};  // the end of a trembling hand's way from the path's last position

  // Those with an area.
  std::vector<mesh::TrianglePoints> triangles() const {
    std::vector<mesh::TrianglePoints> all;
    const auto& [vertices, triangles] = rendering.checked.mesh();
    for (const auto& [a, b, c] : triangles)
      if (const mesh::TrianglePoints points{vertices[a], vertices[b], vertices[c]}; mesh::has_area(points))
        all.push_back(points);
    return all;
  }
};

using Open = std::function<std::unique_ptr<fast::TickSession>(const MeshRendering& rendering)>;

inline std::unique_ptr<fast::TickSession> in_real_time(const MeshRendering& rendering) {
  return tests::built(fast::GodObject::build(rendering)).open();
}

// Numbers of the cases that a property is about.
using Counts = std::map<std::string, std::size_t>;

inline bool is_alike(const mesh::Tick& a, const mesh::Tick& b) {
  return a.status == b.status && a.after == b.after && std::equal(a.force.begin(), a.force.end(), b.force.begin(), same_bits);
}

inline std::string at(const Walk& its, std::size_t tick) {
  std::string words = "tick " + std::to_string(tick) + " of";
  for (const auto& [x, y, z] : its.path) words += " (" + show(x) + ", " + show(y) + ", " + show(z) + ')';
  words += " mm on";
  const std::vector<mesh::TrianglePoints> triangles = its.triangles();
  for (std::size_t i = 0; i < std::min<std::size_t>(triangles.size(), 100); ++i)
    for (const auto& [x, y, z] : triangles[i]) words += " (" + show(x) + ", " + show(y) + ", " + show(z) + ')';
  return words + ": ";
}

inline Violation both_sides_are_equal(const Walk& its, const Open& open, Counts& counts) {
  const auto god_object = tests::built(reference::GodObject::build(its.rendering));
  const auto session = open(its.rendering);
  mesh::GodObject state;
  for (std::size_t i = 0; i < its.path.size(); ++i) {
    const mesh::Tick expected = god_object.step(state, its.path[i]), is = session->tick(its.path[i]);
    if (!is_alike(is, expected) || is.moves != expected.moves) return at(its, i) + "the sides differ";
    state = expected.after;
    ++counts[its.rendering.checked.is_regular() ? "regular" : "irregular"];
    if (expected.status == Status::contact) ++counts["touching"];
    if (expected.status == Status::unfinished) ++counts["unfinished"];
    counts["most moves"] = std::max<std::size_t>(counts["most moves"], expected.moves);
  }
  return std::nullopt;
}

// The turns of a closed surface around a free hand never get more, nor fewer where it blocks both ways. A free hand goes
// straight through no triangle from a side that blocks.
inline Violation nothing_passes(const Walk& its, const Open& open, Counts& counts) {
  const auto session = open(its.rendering);
  const std::vector<mesh::TrianglePoints> triangles = its.triangles();
  std::mt19937_64 random(1);
  std::optional<int> wound;
  mesh::GodObject before;
  for (std::size_t i = 0; i < its.path.size(); ++i) {
    const mesh::Tick tick = session->tick(its.path[i]);
    if (tick.status == Status::free) {
      if (before.place == mesh::Place::free && tick.moves == 1) {
        ++counts["flights"];
        if (tests::passes(triangles, its.rendering.sides, before.position, tick.after.position))
          return at(its, i) + "a flight passes a wall";
      }
      const std::optional<int> winds = its.is_closed ? tests::winding(triangles, tick.after.position, random) : std::nullopt;
      if (winds && wound) {
        ++counts["windings"];
        if (*winds != 0) ++counts["windings inside"];
        if (*winds > *wound || (*winds < *wound && its.rendering.sides == mesh::Sides::both))
          return at(its, i) + "the hand has passed a wall";
      }
      if (winds) wound = winds;
    }
    before = tick.after;
  }
  return std::nullopt;
}

inline Violation rests_are_idempotent(const Walk& its, const Open& open, Counts& counts) {
  const auto session = open(its.rendering);
  for (std::size_t i = 0; i < its.path.size(); ++i) {
    const mesh::Tick first = session->tick(its.path[i]);
    if (first.status != Status::contact) continue;
    ++counts["rests"];
    if (!is_alike(session->tick(its.path[i]), first)) return at(its, i) + "a repeated position changes the rest";
  }
  return std::nullopt;
}

// After a few swings between two positions each swing ends where the one before it did.
inline Violation rests_do_not_creep(const Walk& its, const Open& open, Counts& counts) {
  constexpr int kSettling = 4, kSwings = 12;
  const auto session = open(its.rendering);
  for (const MeshPosition& position : its.path) session->tick(position);
  mesh::Tick before;
  for (int swing = 0; swing < kSwings; ++swing) {
    session->tick(its.beside);
    const mesh::Tick now = session->tick(its.path.back());
    if (swing >= kSettling) {
      if (now.status == Status::contact) ++counts["swings in contact"];
      if (!is_alike(now, before)) return at(its, its.path.size()) + "swing " + std::to_string(swing) + " ends elsewhere";
    }
    before = now;
  }
  return std::nullopt;
}

using SoupProperty = Violation (*)(const Walk& its, const Open& open, Counts& counts);
inline const std::array<std::pair<const char*, SoupProperty>, 4> kProperties{{{"both sides are equal", both_sides_are_equal},
                                                                              {"nothing passes", nothing_passes},
                                                                              {"rests are idempotent", rests_are_idempotent},
                                                                              {"rests do not creep", rests_do_not_creep}}};

}  // namespace forceshade::properties
