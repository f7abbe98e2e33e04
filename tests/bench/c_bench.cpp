// SPDX-License-Identifier: BSD-3-Clause
// The cost that the C interface adds to a call and to a batch: each beside the C++ call that it makes, on the same positions,
// and beside a plain copy.

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstring>
#include <span>
#include <vector>

#include "fast/meshes/large_pages.h"
#include "forceshade.h"
#include "forceshade/fast.h"

namespace forceshade::bench {
namespace {

constexpr Parameters kBump{15.24F, 25.4F, 0.5F};
constexpr std::size_t kInCache = 4096, kOutOfCache = 10'000'000;

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

void batch_in_c(benchmark::State& state, LawId id, std::size_t count) {
  const forceshade_subject subject = subject_of(id);
  const auto at = stroke(count);
  Array<Eigen::Vector3f> forces(count, Eigen::Vector3f::Zero());
  forceshade_batch batch{};
  batch.size = sizeof batch;
  batch.count = count;
  batch.positions = at.front().data();
  batch.forces = forces.front().data();
  batch.position_stride = batch.force_stride = 12;
  batch.position_component = batch.force_component = 4;
  for (auto _ : state) benchmark::DoNotOptimize(forceshade_forces(subject, &batch, nullptr));
  per_position(state, count);
}

void copy(benchmark::State& state, std::size_t count) {
  const auto at = stroke(count);
  Array<Eigen::Vector3f> to(count, Eigen::Vector3f::Zero());
  for (auto _ : state) {
    std::memcpy(to.front().data(), at.front().data(), 12 * count);
    benchmark::ClobberMemory();
  }
  per_position(state, count);
}

const bool registered = [] {
  for (const LawId id : {LawId::wall, LawId::bump_2p, LawId::bump_3p_shaded}) {
    const std::string name(name_of(id));
    benchmark::RegisterBenchmark((name + "/one/cpp").c_str(), one_in_cpp, id);
    benchmark::RegisterBenchmark((name + "/one/c").c_str(), one_in_c, id);
    benchmark::RegisterBenchmark((name + "/step/cpp").c_str(), step_in_cpp, id);
    benchmark::RegisterBenchmark((name + "/step/c").c_str(), step_in_c, id);
    benchmark::RegisterBenchmark((name + "/batch/cpp").c_str(), batch_in_cpp, id, kOutOfCache);
    benchmark::RegisterBenchmark((name + "/batch/cpp_rows").c_str(), batch_of_rows_in_cpp, id, kOutOfCache);
    benchmark::RegisterBenchmark((name + "/batch/c").c_str(), batch_in_c, id, kOutOfCache);
  }
  benchmark::RegisterBenchmark("copy", copy, kOutOfCache);
  return true;
}();

}  // namespace
}  // namespace forceshade::bench

BENCHMARK_MAIN();
