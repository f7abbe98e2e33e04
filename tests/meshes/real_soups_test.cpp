// SPDX-License-Identifier: BSD-3-Clause
// Meshes that others have made and that are not regular are rendered by both sides alike, and what docs/soups.md says follows
// is judged by other means: nothing passes a wall, and rests are idempotent. FORCESHADE_REAL_SOUPS names a folder of mesh
// files, of which docs/tables/real-meshes.csv lists some with their sources; without it, made meshes stand in for them.
// FORCESHADE_DRAWS=4 goes 1920 ticks on each.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <optional>
#include <random>
#include <ranges>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "forceshade/fast.h"
#include "forceshade/meshes.h"
#include "forceshade/reference.h"
#include "rendering/meshes/make.h"
#include "tests/meshes/passing.h"
#include "tests/meshes/rendering.h"
#include "tests/meshes/uncut.h"
#include "tests/support/drawn.h"

namespace forceshade::tests {
namespace {

using mesh::Vertex;

int ticks_of_each() {
  return static_cast<int>(drawn(480));
}

struct NamedMesh {
  std::string name;
  std::optional<mesh::TriangleMesh> mesh;  // nothing: it could not be read
  std::string refusal = {};
};

mesh::TriangleMesh moved(mesh::TriangleMesh mesh, const Vertex& by) {
  for (Vertex& vertex : mesh.vertices)
    for (std::size_t axis = 0; axis < 3; ++axis) vertex[axis] += by[axis];
  return mesh;
}

mesh::TriangleMesh together(mesh::TriangleMesh all, const mesh::TriangleMesh& other) {
  const auto before = static_cast<std::uint32_t>(all.vertices.size());
  all.vertices.insert(all.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const auto& [a, b, c] : other.triangles) all.triangles.push_back({before + a, before + b, before + c});
  return all;
}

std::vector<NamedMesh> made_meshes() {
  const mesh::TriangleMesh cube = mesh::cube(10), ball = mesh::icosphere(3, 6);
  return {{"two cubes side by side", together(cube, moved(cube, {10, 2, 0}))},
          {"a ball in a cube's corner", together(cube, moved(ball, {5, 5, 5}))},
          {"a ball twice", together(ball, ball)},
          {"a wall in a box", together(cube, mesh::thin_wall(10, 10, 3, 3))},
          {"a torus through a torus", together(mesh::torus(8, 3, 12, 8), moved(mesh::torus(8, 3, 12, 8), {8, 0, 0}))}};
}

std::vector<NamedMesh> meshes() {
  const char* const folder = std::getenv("FORCESHADE_REAL_SOUPS");
  if (folder == nullptr) return made_meshes();
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) files.push_back(entry.path());
  std::ranges::sort(files);
  std::vector<NamedMesh> all;
  for (const std::string& file : files) {
    NamedMesh one{std::filesystem::relative(file, folder), {}};
    try {
      one.mesh = mesh::load(file, mesh::Unit::mm);
    } catch (const Error& error) {
      one.refusal = std::string(error.what()).substr(file.size() + 2);
      std::ranges::replace(one.refusal, ',', ';');
    }
    all.push_back(std::move(one));
  }
  return all;
}

class Judge {
 public:
  Judge(const mesh::TriangleMesh& mesh, mesh::Sides sides, std::uint64_t seed) : sides_(sides), random_(seed) {
    for (const auto& [a, b, c] : mesh.triangles)
      if (const mesh::TrianglePoints points{mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]}; mesh::has_area(points))
        used_.push_back(points);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto [low, high] =
          std::ranges::minmax(used_ | std::views::transform([&](const mesh::TrianglePoints& t) { return t[0][axis]; }));
      low_[axis] = low, high_[axis] = high;
    }
  }

  double size() const { return std::hypot(high_[0] - low_[0], high_[1] - low_[1], high_[2] - low_[2]); }
  double uniform(double from, double to) { return std::uniform_real_distribution(from, to)(random_); }

  // A position at a triangle, so far in front of it, and a direction.
  std::pair<std::array<double, 3>, std::array<double, 3>> at_a_triangle(double height) {
    const mesh::TrianglePoints& t = used_[random_() % used_.size()];
    const double a = uniform(0, 1), b = uniform(0, 1 - a);
    std::array<double, 3> u{}, v{}, n{}, at{};
    for (std::size_t i = 0; i < 3; ++i) {
      u[i] = double(t[1][i]) - double(t[0][i]), v[i] = double(t[2][i]) - double(t[0][i]);
      at[i] = double(t[0][i]) + a * u[i] + b * v[i];
    }
    for (std::size_t i = 0; i < 3; ++i) n[i] = u[(i + 1) % 3] * v[(i + 2) % 3] - u[(i + 2) % 3] * v[(i + 1) % 3];
    const double length = std::hypot(n[0], n[1], n[2]);
    for (std::size_t i = 0; i < 3; ++i) at[i] += height * (n[i] /= length);
    return {at, n};
  }

  std::optional<int> winding(const Vertex& x) { return tests::winding(used_, x, random_); }
  bool passes(const Vertex& from, const Vertex& to) const { return tests::passes(used_, sides_, from, to); }

 private:
  mesh::Sides sides_;
  std::mt19937_64 random_;
  std::vector<mesh::TrianglePoints> used_;
  Vertex low_{}, high_{};
};

struct Counts {
  int free = 0, touching = 0, unfinished = 0, most_moves = 0, windings = 0, flights = 0, rests = 0;
};

// A stroke: from in front of a triangle through it and along it, some of them far.
class Hand {
 public:
  explicit Hand(Judge& judge) : judge_(judge) {}
  Vertex next() {
    const double size = judge_.size();
    if (left_-- == 0) {
      left_ = 8;
      std::tie(at_, along_) = judge_.at_a_triangle(size * 0.01);
      for (double& component : along_) component *= -0.03;  // past the surface, then aside
    } else {
      for (std::size_t i = 0; i < 3; ++i) at_[i] += size * along_[i];
      if (left_ == 7)
        for (double& component : along_) component = judge_.uniform(-0.04, 0.04);
    }
    Vertex position{};
    for (std::size_t i = 0; i < 3; ++i) position[i] = static_cast<float>(std::clamp(at_[i], -1e4, 1e4));
    return position;
  }

 private:
  Judge& judge_;
  int left_ = 0;
  std::array<double, 3> at_{}, along_{};
};

void expect_same(const mesh::Tick& other, const mesh::Tick& tick, const std::string& what) {
  EXPECT_EQ(other.after, tick.after) << what;
  EXPECT_EQ(other.force, tick.force) << what;
}

Counts judged(const mesh::CheckedMesh& checked, const std::string& name) {
  const mesh::Sides sides = mesh::usual_sides(checked);
  const bool is_closed = sides == mesh::Sides::front;
  const MeshRendering rendering{checked, mesh::corner_normals(checked, 60).normals, sides, mesh::Shading::vertex_scheme, 0.5F,
                                {}};
  const auto god_object = tests::built(reference::GodObject::build(rendering));
  const auto session = tests::built(fast::GodObject::build(rendering)).open();
  Judge judge(checked.mesh(), sides, 1);
  Hand hand(judge);
  mesh::GodObject state;
  std::optional<int> wound;  // at the last free position
  Counts counts;
  for (int i = 0; i < ticks_of_each(); ++i) {
    const Vertex position = hand.next();
    const mesh::Tick tick = god_object.step(state, position), in_real_time = session->tick(position);
    expect_same(in_real_time, tick, name + ": both sides");
    EXPECT_EQ(in_real_time.status, tick.status) << name;
    EXPECT_EQ(in_real_time.moves, tick.moves) << name;
    counts.most_moves = std::max<int>(counts.most_moves, tick.moves);
    ++(tick.status == Status::free ? counts.free : tick.status == Status::contact ? counts.touching : counts.unfinished);
    if (tick.status == Status::free && is_closed) {
      const std::optional<int> winds = judge.winding(tick.after.position);
      if (winds && wound) {
        EXPECT_LE(*winds, *wound) << name << ", tick " << i;
        ++counts.windings;
      }
      wound = winds;
    }
    if (state.place == mesh::Place::free && tick.status == Status::free && tick.moves == 1) {
      EXPECT_FALSE(judge.passes(state.position, tick.after.position)) << name << ", tick " << i;
      ++counts.flights;
    }
    if (tick.status == Status::contact) {
      expect_same(god_object.step(tick.after, position), tick, name + ": a rest that is repeated");
      ++counts.rests;
    }
    state = tick.after;
  }
  return counts;
}

TEST(real_soups, are_rendered_and_nothing_passes_a_wall) {
  std::map<std::string, int> all;
  std::printf("name,triangles,kind,sides,ticks,free,touching,unfinished,most moves,windings,flights,rests,ms a tick\n");
  for (const auto& [name, triangles, refusal] : meshes()) {
    if (!triangles) {
      std::printf("%s,,not read: %s\n", name.c_str(), refusal.c_str());
      ++all["not read"];
      continue;
    }
    const auto checked = mesh::check_any(*triangles);
    const auto* any = std::get_if<mesh::CheckedMesh>(&checked);
    if (any == nullptr) {
      std::printf("%s,%zu,no face with an area\n", name.c_str(), triangles->triangles.size());
      ++all["without area"];
      continue;
    }
    ++all["rendered"];
    ++all[any->is_regular() ? "regular" : "irregular"];
    const auto begin = std::chrono::steady_clock::now();
    const Counts its = judged(*any, name);
    const double ms =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count() / ticks_of_each();
    std::printf("%s,%zu,%s,%s,%d,%d,%d,%d,%d,%d,%d,%d,%.2f\n", name.c_str(), triangles->triangles.size(),
                any->is_regular() ? "regular" : "any set", std::string(name_of(mesh::usual_sides(*any))).c_str(),
                ticks_of_each(), its.free, its.touching, its.unfinished, its.most_moves, its.windings, its.flights, its.rests,
                ms);
    std::fflush(stdout);
    all["ticks"] += ticks_of_each();
    all["unfinished"] += its.unfinished;
    all["touching"] += its.touching;
    all["windings"] += its.windings;
    all["flights"] += its.flights;
    all["rests"] += its.rests;
  }
  for (const auto& [what, count] : all) std::printf("%s: %d\n", what.c_str(), count);
  for (const char* what : {"irregular", "touching", "windings", "flights", "rests"}) EXPECT_GT(all[what], 0) << what;
}

}  // namespace
}  // namespace forceshade::tests
