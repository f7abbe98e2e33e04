// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The reference god-object on paths that another program has computed: every column of every tick, unshaded and shaded.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <ranges>
#include <string>
#include <string_view>
#include <vector>

#include "forceshade/reference.h"
#include "tests/meshes/god_object_paths.h"
#include "tests/meshes/rendering.h"

namespace forceshade::tests {

// The places and sides that paths have reached.
struct Reached {
  // Every place, both sides and these.
  void expect_all(const std::vector<std::string>& others) {
    std::printf("  %d paths, %d ticks, at most %d moves in one\n", paths, ticks, most_moves);
    const auto expect = [&](std::string_view name) {
      const int count = of[std::string(name)];
      std::printf("  %7d %s\n", count, std::string(name).c_str());
      EXPECT_GT(count, 0) << name;
    };
    std::ranges::for_each(std::views::drop(mesh::kPlaceNames, 2), expect);
    std::ranges::for_each(mesh::kSideNames, expect);
    std::ranges::for_each(others, expect);
  }

  int paths = 0, ticks = 0, most_moves = 0;
  std::map<std::string, int> of;
};

// By the contact rule friction where the path has materials.
inline reference::GodObject god_object_of(const GodObjectPath& path, mesh::Shading shading) {
  MeshRendering rendering = shaded(path.mesh, path.normals, path.sides, path.stiffness);
  rendering.shading = shading;
  rendering.materials = path.materials;
  if (!path.materials.list.empty()) rendering.contact = mesh::Contact::friction;
  return built(reference::GodObject::build(rendering));
}

// So many digits that rounding them once more, as the standard library does, is rounding the exact force.
inline void expect_decimals_of(const mesh::Tick& tick, const reference::DecimalMapForce& decimals, const std::string& place) {
  const std::array<std::string, 3> texts{decimals.x, decimals.y, decimals.z};
  for (std::size_t axis = 0; axis < 3; ++axis)
    EXPECT_EQ(std::strtof(texts[axis].c_str(), nullptr), tick.force[axis]) << place << ": " << texts[axis];
}

inline void expect_same(const GodObjectPath& path, Reached& reached) {
  constexpr unsigned kDigits = 400;
  reference::GodObjectSession session(god_object_of(path, mesh::Shading::none));
  const reference::GodObject with_scheme = god_object_of(path, mesh::Shading::vertex_scheme);
  for (const PathTick& row : path.ticks) {
    mesh::Tick expected_shaded = row.tick;
    expected_shaded.force = row.shaded;
    const mesh::GodObject before = session.state();
    const mesh::Tick with_shading = with_scheme.step(before, row.position), tick = session.step(row.position);
    if (reached.ticks % 8 == 0) {
      expect_decimals_of(tick, session.decimal(kDigits), row.place);
      expect_decimals_of(with_shading, with_scheme.decimal(before, row.position, kDigits), row.place);
    }
    ASSERT_TRUE(is_same(tick, row.tick)) << row.place << ": " << show(tick) << ", expected " << show(row.tick);
    ASSERT_TRUE(is_same(with_shading, expected_shaded))
        << row.place << ": shaded " << show(with_shading) << ", expected " << show(expected_shaded);
    ++reached.ticks;
    reached.most_moves = std::max<int>(reached.most_moves, tick.moves);
    ++reached.of[std::string(mesh::kTickStatusNames[static_cast<std::size_t>(tick.status)])];
    if (tick.status == Status::invalid || tick.status == Status::free) continue;
    ++reached.of[std::string(mesh::kPlaceNames[static_cast<std::size_t>(tick.after.place)])];
    ++reached.of[std::string(mesh::kSideNames[static_cast<std::size_t>(tick.after.side)])];
    reached.of["slipping"] += tick.after.is_slipping;
    reached.of["shading turns the force"] += tick.force != with_shading.force;
  }
  ++reached.paths;
}

}  // namespace forceshade::tests
