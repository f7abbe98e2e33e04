// SPDX-License-Identifier: BSD-3-Clause
// The god-object's time for a tick at a vertex of many triangles, where it looks at each of them: forceshade_vertex_bench.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include "forceshade/fast.h"
#include "forceshade/meshes.h"

namespace forceshade::bench {
namespace {

// n triangles around the origin; their other corners lie 50 mm off it, at heights up to 5 mm.
mesh::TriangleMesh fan(std::uint32_t n) {
  mesh::TriangleMesh mesh;
  mesh.vertices.push_back({0, 0, 0});
  for (std::uint32_t i = 0; i < n; ++i) {
    const double angle = 2 * 3.14159265358979 * i / n;
    mesh.vertices.push_back({static_cast<float>(50 * std::cos(angle)), static_cast<float>(50 * std::sin(angle)),
                             static_cast<float>(0.05 * (7919 * i % 100))});
    mesh.triangles.push_back({0, 1 + i, 1 + (i + 1) % n});
  }
  return mesh;
}

// us: the shortest of five times.
double time_of(fast::TickSession& session, const mesh::GodObject& state, const std::array<float, 3>& p) {
  double shortest = HUGE_VAL;
  for (int pass = 0; pass < 5; ++pass) {
    session.resume(state);
    const auto start = std::chrono::steady_clock::now();
    const mesh::Tick tick = session.tick(p);
    asm volatile("" : : "g"(&tick) : "memory");
    shortest = std::min(shortest, std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count());
  }
  return shortest;
}

void print(std::uint32_t n, const char* what, std::vector<double> times) {
  std::ranges::sort(times);
  std::printf("%6u triangles, %-32s p50 %8.2f  longest %8.2f us\n", n, what, times[times.size() / 2], times.back());
}

void run(std::uint32_t n) {
  constexpr int kTicks = 500;
  std::mt19937 random(1);
  std::uniform_real_distribution<float> uniform(-1, 1);
  std::vector<double> from_vertex, past, through;
  for (const mesh::Sides sides : {mesh::Sides::front, mesh::Sides::both}) {
    const MeshRendering rendering{std::get<mesh::CheckedMesh>(mesh::check(fan(n))), {}, sides, mesh::Shading::none, 0.5F};
    const auto session = std::get<fast::GodObject>(fast::GodObject::build(rendering)).open();
    mesh::GodObject vertex, free;
    vertex.place = mesh::Place::vertex;
    free.place = mesh::Place::free;
    for (int i = 0; i < kTicks; ++i) {
      const float down = i % 2 == 0 ? 1.0F : -1.0F, reach = i % 3 == 0 ? 3.0F : 0.3F;
      const std::array<float, 3> p{reach * uniform(random), reach * uniform(random), -down * (2 + uniform(random))};
      from_vertex.push_back(time_of(*session, vertex, p));
      free.position = {1e-4F * uniform(random), 1e-4F * uniform(random), 3 * down};
      past.push_back(time_of(*session, free, {1e-4F * uniform(random), 1e-4F * uniform(random), -2 * down}));
      free.position = {p[0], p[1], -p[2]};
      through.push_back(time_of(*session, free, i % 4 == 0 ? std::array{0.0F, 0.0F, 0.0F} : std::array{-p[0], -p[1], p[2]}));
    }
  }
  print(n, "from the vertex", from_vertex);
  print(n, "a flight beside the vertex", past);
  print(n, "a flight through the vertex", through);
}

}  // namespace
}  // namespace forceshade::bench

int main() {
  for (const std::uint32_t n : {8U, 32U, 100U, 300U, 1000U, 4000U, 16000U}) forceshade::bench::run(n);
}
