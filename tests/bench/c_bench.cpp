// SPDX-License-Identifier: BSD-3-Clause
// The cost that the C interface adds to a call and to a batch: each beside the C++ call that it makes, on the same positions,
// and beside a plain copy. And the gain of threads: such batches, a copy by as many threads, and a tick of each of a million
// paths over a mesh. There a name ends with the number of threads.

#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "fast/meshes/large_pages.h"
#include "forceshade.h"
#include "forceshade/damped.h"
#include "forceshade/fast.h"
#include "tests/bench/mesh_workloads.h"

namespace forceshade::bench {
namespace {

constexpr Parameters kBump{15.24F, 25.4F, 0.5F};
constexpr std::size_t kInCache = 4096, kOutOfCache = 10'000'000, kPaths = 1'000'000, kSteps = 4;

// In large pages, as NumPy's arrays are; what is written has been written before.
template <class T>
using Array = std::vector<T, fast::LargePages<T>>;

Array<Eigen::Vector3f> stroke(std::size_t count) {
  Array<Eigen::Vector3f> positions;
  for (std::size_t i = 0; i < count; ++i) {
    const auto ms = static_cast<float>(i % kInCache);
    positions.emplace_back(12 * std::sin(0.0015F * ms), 0, -1 - 0.5F * std::sin(0.01F * ms));
  }
  return positions;
}

fast::Law law_of(LawId id) {
  return std::get<fast::Law>(fast::Law::build(id, kBump));
}

forceshade_subject subject_of(LawId id) {
  const forceshade_law parameters{sizeof parameters, kBump.radius, kBump.width, kBump.stiffness};
  forceshade_subject made{};
  forceshade_law_new(name_of(id).data(), &parameters, &made);
  return made;
}

// Copies the answer to the caller's places, as the C interface does.
void take(const fast::Evaluation& answer, float* force, Status& status) {
  const volatile float* const components = answer.force.data();
  for (std::size_t axis = 0; axis < 3; ++axis) force[axis] = components[axis];
  status = answer.status;
}

// call(position, force, status) on one position of a stroke after the other.
template <class Status, class Call>
void time_calls(benchmark::State& state, const Call& call) {
  const auto at = stroke(kInCache);
  std::size_t i = 0;
  float force[3];
  Status status{};
  for (auto _ : state) {
    call(at[i++ % kInCache], force, status);
    benchmark::DoNotOptimize(force);
    benchmark::DoNotOptimize(status);
  }
}

void one_in_cpp(benchmark::State& state, LawId id) {
  const fast::Law law = law_of(id);
  time_calls<Status>(state, [&](const auto& at, float* force, auto& status) { take(law.evaluate(at), force, status); });
}

void one_in_c(benchmark::State& state, LawId id) {
  const forceshade_subject subject = subject_of(id);
  time_calls<forceshade_status>(
      state, [&](const auto& at, float* force, auto& status) { forceshade_force(subject, at.data(), force, &status); });
}

void step_in_cpp(benchmark::State& state, LawId id) {
  const auto session = fast::session_of(law_of(id));
  time_calls<Status>(state, [&](const auto& at, float* force, auto& status) { take(session->step(at), force, status); });
}

void step_in_c(benchmark::State& state, LawId id) {
  forceshade_session session{};
  forceshade_session_open(subject_of(id), &session);
  time_calls<forceshade_status>(
      state, [&](const auto& at, float* force, auto& status) { forceshade_session_step(session, at.data(), force, &status); });
  forceshade_session_close(session);
}

constexpr damping::Parameters kOil{.rate = 1000, .damping = 0.002F};

void damped_in_cpp(benchmark::State& state, LawId id) {
  const auto session = fast::damped(fast::session_of(law_of(id)), std::get<fast::Damping>(fast::Damping::build(kOil)));
  time_calls<Status>(state, [&](const auto& at, float* force, auto& status) { take(session->step(at), force, status); });
}

void damped_in_c(benchmark::State& state, LawId id) {
  const forceshade_damping oil{sizeof oil, kOil.rate, kOil.share, kOil.damping, kOil.most, kOil.drag, kOil.full_at};
  forceshade_damping_state its{};
  its.size = sizeof its;
  forceshade_session session{};
  forceshade_session_open(subject_of(id), &session);
  time_calls<forceshade_status>(state, [&](const auto& at, float* force, auto& status) {
    forceshade_session_step(session, at.data(), force, &status);
    forceshade_damping_step(&oil, &its, 1, at.data(), force, &status);
  });
  forceshade_session_close(session);
}

void per_position(benchmark::State& state, std::size_t count) {
  state.SetItemsProcessed(static_cast<std::int64_t>(count) * state.iterations());
}

// Coordinates apart, as the C++ batch takes them.
void batch_in_cpp(benchmark::State& state, LawId id, std::size_t count) {
  const fast::Law law = law_of(id);
  Array<float> x, z, fx(count), fz(count);
  for (const Eigen::Vector3f& position : stroke(count)) {
    x.push_back(position.x());
    z.push_back(position.z());
  }
  for (auto _ : state) benchmark::DoNotOptimize(law.force(x, z, fx, fz));
  per_position(state, count);
}

// The three coordinates of a position beside each other, as the C interface and NumPy's arrays of (n, 3) have them too.
void batch_of_rows_in_cpp(benchmark::State& state, LawId id, std::size_t count) {
  const fast::Law law = law_of(id);
  const auto at = stroke(count);
  Array<Eigen::Vector3f> forces(count, Eigen::Vector3f::Zero());
  for (auto _ : state) benchmark::DoNotOptimize(law.force(at, forces));
  per_position(state, count);
}

using Points = Array<Eigen::Vector3f>;

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

void batch_in_c(benchmark::State& state, LawId id) {
  const forceshade_subject subject = subject_of(id);
  const Points at = stroke(kOutOfCache);
  Points forces(at.size(), Eigen::Vector3f::Zero());
  const forceshade_batch batch = batch_of(at, forces, static_cast<std::size_t>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(forceshade_forces(subject, &batch, nullptr));
  per_position(state, at.size());
}

void copy(benchmark::State& state) {
  const Points at = stroke(kOutOfCache);
  Points to(at.size(), Eigen::Vector3f::Zero());
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
      at[step].emplace_back(paths.is_in_contact && step > 0 ? workload.contact[k].data() : workload.free[k].data());
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
  const auto by_threads = [](const std::string& name, const auto& work) {
    benchmark::RegisterBenchmark(name.c_str(), work)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);
  };
  by_threads("copy", copy);
  for (const LawId id : {LawId::wall, LawId::bump_2p, LawId::bump_3p_shaded, LawId::cylinder}) {
    const std::string name(name_of(id));
    benchmark::RegisterBenchmark((name + "/one/cpp").c_str(), one_in_cpp, id);
    benchmark::RegisterBenchmark((name + "/one/c").c_str(), one_in_c, id);
    benchmark::RegisterBenchmark((name + "/step/cpp").c_str(), step_in_cpp, id);
    benchmark::RegisterBenchmark((name + "/step/c").c_str(), step_in_c, id);
    benchmark::RegisterBenchmark((name + "/damped/cpp").c_str(), damped_in_cpp, id);
    benchmark::RegisterBenchmark((name + "/damped/c").c_str(), damped_in_c, id);
    benchmark::RegisterBenchmark((name + "/batch/cpp").c_str(), batch_in_cpp, id, kOutOfCache);
    benchmark::RegisterBenchmark((name + "/batch/cpp_rows").c_str(), batch_of_rows_in_cpp, id, kOutOfCache);
    by_threads(name + "/batch/c", [id](benchmark::State& state) { batch_in_c(state, id); });
  }
  for (const int f : {7, 71})
    for (const Paths paths : {Paths{"contact", "none", true}, {"contact_shaded", "vertex", true}, {"free", "none", false}})
      by_threads("advance/" + std::to_string(20 * f * f) + "/" + paths.name,
                 [=](benchmark::State& state) { advance(state, f, paths); });
  return true;
}();

}  // namespace
}  // namespace forceshade::bench

BENCHMARK_MAIN();
