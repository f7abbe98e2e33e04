// SPDX-License-Identifier: BSD-3-Clause
// The god-object on any set of triangles, in exact numbers, against the paths of a program that shares nothing with it
// (tests/golden/make_soup_golden.py), and on meshes against those of the programs of meshes.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "reference/soups/god_object.h"
#include "tests/meshes/god_object_paths.h"
#include "tests/meshes/soup_paths.h"
#include "tests/support/drawn.h"
#include "text/number_text.h"

namespace forceshade::reference::soups {
namespace {

constexpr float kStiffness = 0.3F;  // of every path, N/mm

using Force = std::array<float, 3>;

Force rounded(const std::array<meshes::RootSum, 3>& force) {
  return {meshes::nearest_binary32(force[0]), meshes::nearest_binary32(force[1]), meshes::nearest_binary32(force[2])};
}

using tests::words;

std::string words(const Place& place) {
  static constexpr std::array kNames{"free", "v", "e", "t", "c", "ee", "ef", "fff", "q"};
  std::string text = kNames[static_cast<std::size_t>(place.kind)];
  if (place.kind == PlaceKind::foot) text += std::string(" ") + kNames[static_cast<std::size_t>(place.of_foot)];
  for (const std::size_t number : place.numbers) text += ' ' + std::to_string(number);
  return text;
}

// The name of a cell; the lowest triangle and the number 0 are left out.
std::string words(const Soup& soup, const State& state) {
  const auto& [triangle, is_behind, number] = state.cell;
  const bool is_lowest = triangle == Star(soup, point_of(soup, *state.place)).triangles().front()->number;
  std::string text = is_behind ? "b" : "f";
  if (!is_lowest || number > 0) text += ' ' + std::to_string(triangle);
  return number > 0 ? text + ' ' + std::to_string(number) : text;
}

// One session on a soup; its ticks as lines of the stored paths.
class Session {
 public:
  Session(Soup soup, mesh::CornerNormals normals) : soup_(std::move(soup)), normals_(std::move(normals)) {}

  Tick step(const std::array<float, 3>& position) {
    Tick made = tick(soup_, state_, position);
    state_ = made.after;
    return made;
  }
  Force force(const Tick& tick) const { return tick.rest ? rounded(exact_force(*tick.rest, kStiffness)) : Force{}; }
  Force shaded(const Tick& tick) const { return tick.rest ? rounded(exact_force(*tick.rest, kStiffness, normals_)) : Force{}; }

  std::string line(const std::array<float, 3>& position) {
    const std::string where = words(position) + ',';
    if (!std::ranges::all_of(position, [](float x) { return std::abs(x) <= 1e4F; })) return where + 'i';
    const Tick made = step(position);
    std::string text = where + std::to_string(made.moves) + (made.status == Status::unfinished ? "u" : "");
    if (made.status == Status::free) return text;
    text += ',' + words(*made.after.place) + ',' + words(soup_, made.after);
    const Force plain = force(made), turned = shaded(made);
    if (plain == Force{} && turned == Force{}) return text;
    return text + ',' + words(plain) + (plain == turned ? "" : ',' + words(turned));
  }

 private:
  Soup soup_;
  mesh::CornerNormals normals_;
  State state_;
};

TEST(soups, every_column_is_that_of_another_program) {
  std::size_t paths = 0, ticks = 0;
  std::map<std::string, std::size_t> places;
  for (const auto& entry : std::filesystem::directory_iterator(FORCESHADE_SOURCE_DIR "/tests/golden/soups")) {
    const tests::SoupPath path = tests::read_soup_path(entry.path());
    Session session(Soup(path.mesh, path.sides), path.normals);
    for (std::size_t i = 0; i < tests::drawn(path.ticks.size()); ++i) {
      ASSERT_EQ(session.line(tests::position_of(path.ticks[i])), path.ticks[i])
          << entry.path().filename() << ", tick " << i + 1;
      ++ticks;
      if (const auto comma = std::ranges::count(path.ticks[i], ','); comma > 1) {
        const std::size_t begin = path.ticks[i].find(',', path.ticks[i].find(',') + 1) + 1;
        ++places[path.ticks[i].substr(begin, path.ticks[i].find(' ', begin) - begin)];
      }
    }
    ++paths;
  }
  std::printf("  %zu paths, %zu ticks\n", paths, ticks);
  for (const char* const place : {"v", "e", "t", "c", "ee", "ef", "fff", "q"}) {
    std::printf("  %7zu %s\n", places[place], place);
    EXPECT_GT(places[place], 0U) << place;
  }
}

// The first ticks of a path on a mesh, with friction where it has materials.
void expect_same(const tests::GodObjectPath& path) {
  std::vector<mesh::Material> materials;
  for (const std::uint32_t i : path.materials.of_triangle) materials.push_back(path.materials.list[i]);
  Session session(Soup(path.mesh, {path.sides}, materials), path.normals);
  for (std::size_t i = 0; i < tests::drawn(path.ticks.size()); ++i) {
    const tests::PathTick& row = path.ticks[i];
    if (row.tick.status == Status::invalid) continue;
    const Tick made = session.step(row.position);
    const bool is_off = made.after.place->kind == PlaceKind::free;
    ASSERT_EQ(made.status, row.tick.status) << row.place;
    ASSERT_EQ(made.moves, row.tick.moves) << row.place;
    ASSERT_EQ(is_off ? "-" : words(*made.after.place), tests::feature_text(row.tick.after)) << row.place;
    ASSERT_EQ(!is_off && std::get<1>(made.after.cell), row.tick.after.side == mesh::Side::back) << row.place;
    ASSERT_EQ(!materials.empty() && made.after.is_slipping, row.tick.after.is_slipping) << row.place;
    ASSERT_EQ(session.force(made), row.tick.force) << row.place;
    ASSERT_EQ(session.shaded(made), row.shaded) << row.place;
  }
}

TEST(soups, a_mesh_is_a_soup_with_the_same_paths) {
  const std::string meshes = FORCESHADE_SOURCE_DIR "/tests/golden/god_object",
                    rough = FORCESHADE_SOURCE_DIR "/tests/golden/friction";
  for (const std::string& name : tests::god_object_paths_in(meshes)) expect_same(tests::read_god_object_path(meshes, name));
  for (const std::string& name : tests::friction_paths_in(rough)) expect_same(tests::read_friction_path(meshes, rough, name));
}

}  // namespace
}  // namespace forceshade::reference::soups
