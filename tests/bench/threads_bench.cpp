// SPDX-License-Identifier: BSD-3-Clause
// The gain of threads: batches of laws out of cache beside a copy by as many threads, and a tick of each of a million paths
// over a mesh. forceshade_threads_bench; a name ends with the number of threads.

#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <cstring>
#include <string>
#include <thread>
#include <vector>

#include "fast/meshes/large_pages.h"
#include "forceshade.h"
#include "tests/bench/mesh_workloads.h"

namespace forceshade::bench {
namespace {

constexpr std::size_t kPositions = 10'000'000, kPaths = 1'000'000, kSteps = 4;

template <class T>
using Array = std::vector<T, fast::LargePages<T>>;
using Points = Array<std::array<float, 3>>;

Points stroke() {
  Points positions;
  for (std::size_t i = 0; i < kPositions; ++i) {
    const auto ms = static_cast<float>(i % 4096);
    positions.push_back({12 * std::sin(0.0015F * ms), 0, -1 - 0.5F * std::sin(0.01F * ms)});
  }
  return positions;
}

forceshade_batch batch_of(const Points& at, Points& forces, std::size_t threads) {
  forceshade_batch batch{};
  batch.size = sizeof batch;
  batch.count = at.size();
  batch.positions = at.front().data();
  batch.forces = forces.front().data();
  batch.position_stride = batch.force_stride = 12;
  batch.position_component = batch.force_component = 4;
  batch.threads = threads;
  return batch;
}

void per_position(benchmark::State& state, std::size_t count) {
  state.SetItemsProcessed(static_cast<std::int64_t>(count) * state.iterations());
}

void copy(benchmark::State& state) {
  const Points at = stroke();
  Points to(at.size());
  const auto threads = static_cast<std::size_t>(state.range(0));
  for (auto _ : state) {
    std::vector<std::thread> others;
    const auto part = [&](std::size_t i) {
      const std::size_t begin = at.size() * i / threads, end = at.size() * (i + 1) / threads;
      std::memcpy(to[begin].data(), at[begin].data(), 12 * (end - begin));
    };
    for (std::size_t i = 1; i < threads; ++i) others.emplace_back(part, i);
    part(0);
    for (std::thread& other : others) other.join();
    benchmark::ClobberMemory();
  }
  per_position(state, at.size());
}

void forces(benchmark::State& state, const char* law) {
  const forceshade_law parameters{sizeof parameters, 15.24F, 25.4F, 0.5F};
  forceshade_subject subject{};
  forceshade_law_new(law, &parameters, &subject);
  const Points at = stroke();
  Points to(at.size());
  const forceshade_batch batch = batch_of(at, to, static_cast<std::size_t>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(forceshade_forces(subject, &batch, nullptr));
  per_position(state, at.size());
}

forceshade_subject mesh_of(const MeshWorkload& workload, const char* shading) {
  forceshade_mesh mesh{};
  mesh.size = sizeof mesh;
  mesh.vertices = workload.mesh.vertices.front().data();
  mesh.vertex_count = workload.mesh.vertices.size();
  mesh.triangles = workload.mesh.triangles.front().data();
  mesh.triangle_count = workload.mesh.triangles.size();
  mesh.shading = shading;
  mesh.crease = 180;
  mesh.stiffness = static_cast<float>(kMeshStiffness);
  forceshade_subject made{};
  if (forceshade_mesh_new(&mesh, &made) != FORCESHADE_OK) std::printf("%s\n", forceshade_message());
  return made;
}

struct Paths {
  const char *name, *shading;
  bool is_in_contact;
};

// Each path begins somewhere else on the workload's, so that neighbours in the batch are far apart on the mesh.
void advance(benchmark::State& state, int f, const Paths& paths) {
  const MeshWorkload workload = sphere_workload(f, 200'000, 200'000);
  const forceshade_subject subject = mesh_of(workload, paths.shading);
  std::array<Points, kSteps + 1> at;
  for (std::size_t step = 0; step <= kSteps; ++step)
    for (std::size_t i = 0; i < kPaths; ++i) {
      const std::size_t k = (i * 7919 + step) % workload.contact.size();
      at[step].push_back(paths.is_in_contact && step > 0 ? workload.contact[k] : workload.free[k]);
    }
  Points to(kPaths);
  Array<forceshade_state> states(kPaths);
  states[0].size = sizeof states[0];
  const auto threads = static_cast<std::size_t>(state.range(0));
  const auto step = [&](const Points& positions) {
    const forceshade_batch batch = batch_of(positions, to, threads);
    benchmark::DoNotOptimize(forceshade_advance(subject, states.data(), &batch, nullptr));
  };
  step(at[0]);
  step(at[1]);
  std::size_t next = 2;  // to and fro
  bool is_forth = true;
  for (auto _ : state) {
    step(at[next]);
    if (next == 1 || next == kSteps) is_forth = next == 1;
    next = is_forth ? next + 1 : next - 1;
  }
  per_position(state, kPaths);
}

const bool registered = [] {
  const auto add = [](const std::string& name, const auto& work) {
    benchmark::RegisterBenchmark(name.c_str(), work)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);
  };
  add("copy", copy);
  for (const char* law : {"wall", "bump-2p", "bump-3p-shaded", "cylinder"})
    add(std::string("forces/") + law, [law](benchmark::State& state) { forces(state, law); });
  for (const int f : {7, 71})
    for (const Paths paths : {Paths{"contact", "none", true}, {"contact_shaded", "vertex", true}, {"free", "none", false}})
      add("advance/" + std::to_string(20 * f * f) + "/" + paths.name,
          [=](benchmark::State& state) { advance(state, f, paths); });
  return true;
}();

}  // namespace
}  // namespace forceshade::bench

BENCHMARK_MAIN();
