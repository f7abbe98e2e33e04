// SPDX-License-Identifier: BSD-3-Clause
// The time of a tick on sets of triangles, beside that of the plain renderer where they are a mesh, and what building takes:
// forceshade_soup_bench. With `large`, a set of 10^7 triangles is built, too.

#include <cmath>
#include <ctime>
#include <memory>
#include <string_view>

#include "fast/meshes/session.h"
#include "fast/soups/session.h"
#include "forceshade/meshes.h"
#include "tests/bench/mesh_workloads.h"
#include "tests/bench/timing.h"

namespace forceshade::bench {
namespace {

using Position = std::array<float, 3>;
constexpr std::size_t kTicks = 20000;

struct Set {
  const char* name;
  mesh::TriangleMesh mesh;
  mesh::Sides sides;
  std::vector<Position> approach, contact;
};

void add_box(mesh::TriangleMesh& mesh, const Position& low, const Position& high) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (unsigned i = 0; i < 8; ++i)
    mesh.vertices.push_back(
        {(i & 1) != 0 ? high[0] : low[0], (i & 2) != 0 ? high[1] : low[1], (i & 4) != 0 ? high[2] : low[2]});
  constexpr std::uint32_t kFaces[][3]{{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                                      {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  for (const auto& [a, b, c] : kFaces) mesh.triangles.push_back({first + a, first + b, first + c});
}

template <class At>
std::vector<Position> path(const At& at) {
  std::vector<Position> path;
  for (std::size_t i = 0; i < kTicks; ++i) path.push_back(at(static_cast<float>(i)));
  return path;
}

// Two boxes of which a face is common; the hand goes to and fro over the seam, 0.3 mm deep.
Set boxes() {
  Set set{"touching boxes", {}, mesh::Sides::front, {{5, 5, 1}}, {}};
  add_box(set.mesh, {-10, -10, -10}, {0, 10, 0});
  add_box(set.mesh, {0, -10, -10}, {10, 10, 0});
  set.contact = path([](float i) { return Position{9 * std::sin(i * 0.011F), 8 * std::sin(i * 0.0071F), -0.3F}; });
  return set;
}

// Pages of 10 by 16 mm on one spine; the hand goes to and fro between two, along the spine and into it.
Set book(int pages) {
  Set set{pages == 10 ? "book of 10 pages" : "book of 100 pages",
          {{{0, 0, -8}, {0, 0, 8}}, {}},
          mesh::Sides::both,
          {{5, 1, 0}},
          {}};
  for (int k = 0; k < pages; ++k) {
    const float angle = 6.2831853F * static_cast<float>(k) / static_cast<float>(pages);
    const auto first = static_cast<std::uint32_t>(set.mesh.vertices.size());
    for (const float z : {-8.0F, 8.0F}) set.mesh.vertices.push_back({10 * std::cos(angle), 10 * std::sin(angle), z});
    set.mesh.triangles.push_back({0, first + 1, first});
    set.mesh.triangles.push_back({0, 1, first + 1});
  }
  set.contact = path([](float i) { return Position{2 + 2.5F * std::sin(i * 0.02F), -0.3F, 5 * std::sin(i * 0.004F)}; });
  return set;
}

// Two sheets of n by n cells that cross each other aslant; the hand goes along the valley that they make, and out of it.
Set crossing_sheets(std::uint32_t n) {
  Set set{"crossing sheets", {}, mesh::Sides::both, {{0, 0, 20}}, {}};
  for (const float slope : {0.5F, -0.7F}) {
    const auto first = static_cast<std::uint32_t>(set.mesh.vertices.size());
    for (std::uint32_t i = 0; i <= n; ++i)
      for (std::uint32_t j = 0; j <= n; ++j) {
        const float x = -20 + 40.0F * static_cast<float>(i) / static_cast<float>(n),
                    y = -20 + 40.0F * static_cast<float>(j) / static_cast<float>(n) + 0.37F * slope;
        set.mesh.vertices.push_back({x, y, slope * x + 0.05F * y});
      }
    for (std::uint32_t i = 0; i < n; ++i)
      for (std::uint32_t j = 0; j < n; ++j) {
        const std::uint32_t a = first + i * (n + 1) + j, b = a + n + 1;
        set.mesh.triangles.push_back({a, b, a + 1});
        set.mesh.triangles.push_back({b, b + 1, a + 1});
      }
  }
  set.contact = path([](float i) { return Position{3 * std::sin(i * 0.013F), 15 * std::sin(i * 0.0031F), -0.4F}; });
  return set;
}

void run_soup(const Set& set, const Scale& clock) {
  const auto soup = std::make_shared<const fast::soups::Soup>(set.mesh, std::vector{set.sides});
  std::vector<double> times;
  Times best = kNone;
  std::size_t in_contact = 0, moves = 0;
  for (int pass = 0; pass < kPasses; ++pass) {
    fast::soups::Session session(soup, static_cast<float>(kMeshStiffness), false);
    for (const Position& p : set.approach) session.tick(p);
    in_contact = moves = 0;
    best = least(best, measure(set.contact, clock, times, [&](const Position& p) {
                   const fast::soups::Tick tick = session.tick(p);
                   in_contact += tick.status == Status::contact ? 1 : 0;
                   moves += tick.moves;
                 }));
  }
  print("any set of triangles", best);
  const auto ticks = static_cast<double>(set.contact.size());
  std::printf("  %28s %.0f %% in contact, %.2f moves a tick\n", "", 100 * static_cast<double>(in_contact) / ticks,
              static_cast<double>(moves) / ticks);
}

void run_mesh(const MeshWorkload& workload, const Scale& clock) {
  const auto mesh = std::make_shared<const fast::Mesh>(value_of(fast::Mesh::build(unshaded_rendering(workload)), workload));
  std::vector<double> times;
  Times best = kNone;
  for (int pass = 0; pass < kPasses; ++pass) {
    fast::MeshSession session(mesh, static_cast<float>(kMeshStiffness), mesh::Shading::none);
    for (const Position& p : workload.approach) session.tick(p);
    best = least(best, measure(workload.contact, clock, times, [&](const Position& p) { keep(session.tick(p)); }));
  }
  std::printf("%s: %zu triangles\n", workload.name.c_str(), workload.mesh.triangles.size());
  print("a mesh", best);
  run_soup({"", workload.mesh, mesh::Sides::front, workload.approach, workload.contact}, clock);
}

// Builds what both renderers hold of a sphere.
void run_build(int f) {
  const MeshWorkload workload = sphere_workload(f, 0, 0);
  const auto triangles = static_cast<double>(workload.mesh.triangles.size());
  std::printf("sphere, f = %d: %.0f triangles\n", f, triangles);
  const auto report = [&](const char* name, const auto& build) {
    const std::clock_t start = std::clock();
    const auto built = build();
    std::printf("  %-28s built in %.3f s of a processor, %.1f bytes a triangle\n", name,
                static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC, static_cast<double>(built.bytes()) / triangles);
  };
  const MeshRendering rendering = unshaded_rendering(workload);
  report("a mesh", [&] { return value_of(fast::Mesh::build(rendering), workload); });
  report("any set of triangles", [&] { return fast::soups::Soup(workload.mesh, std::vector{mesh::Sides::front}); });
}

}  // namespace
}  // namespace forceshade::bench

int main(int argc, char** argv) {
  using namespace forceshade::bench;
  const Scale clock = scale();
  for (const int f : {7, 71}) run_mesh(sphere_workload(f, kTicks, 0), clock);
  run_mesh(bump_workload(224, kTicks, 0), clock);
  for (const Set& set : {boxes(), book(10), book(100), crossing_sheets(20)}) {
    std::printf("%s: %zu triangles\n", set.name, set.mesh.triangles.size());
    run_soup(set, clock);
  }
  for (const int f : {7, 71, 224}) run_build(f);
  if (argc > 1 && std::string_view(argv[1]) == "large") run_build(708);
}
