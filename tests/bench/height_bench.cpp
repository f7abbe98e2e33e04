// SPDX-License-Identifier: BSD-3-Clause
// A stroke across a 1024 by 1024 B-spline texture: the proved evaluation beside a naive binary32 one of the same spline, which
// checks nothing, bounds nothing and is compiled as it likes to be (tests/bench/CMakeLists.txt).

#include <benchmark/benchmark.h>

#include <cmath>
#include <memory>
#include <random>
#include <utility>
#include <vector>

#include "forceshade/fast.h"
#include "tests/bench/naive_spline.h"

namespace forceshade::bench {
namespace {

constexpr std::uint32_t kSamples = 1024;
constexpr float kPitch = 0.1F, kStiffness = 0.5F;  // mm, N/mm
constexpr std::size_t kPositions = 4096;           // a power of two: a remainder by any other takes a nanosecond

std::shared_ptr<const height::Grid> texture() {
  static const auto grid = [] {
    height::Grid g{kSamples, kSamples, kPitch, height::Edge::clamp, height::Interpolant::cubic_spline, {}};
    std::mt19937 random(1);
    std::uniform_real_distribution<float> uniform(-0.3F, 0.3F);
    for (std::uint32_t i = 0; i < kSamples * kSamples; ++i) g.values.push_back(uniform(random));
    return std::make_shared<const height::Grid>(std::move(g));
  }();
  return grid;
}

// A finger at 1 kHz, up to 60 mm/s, always in contact.
std::vector<Eigen::Vector3f> stroke() {
  std::vector<Eigen::Vector3f> positions;
  for (std::size_t i = 0; i < kPositions; ++i) {
    const auto ms = static_cast<float>(i);
    positions.emplace_back(40 * std::sin(0.0015F * ms), 30 * std::sin(0.0011F * ms), -1 - 0.5F * std::sin(0.01F * ms));
  }
  return positions;
}

void proved(benchmark::State& state, height::Mode mode) {
  const auto law = std::get<fast::HeightMapField>(fast::HeightMapField::build({{{texture()}}}, mode, kStiffness));
  const auto positions = stroke();
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(law.evaluate(positions[i++ % kPositions]));
}

// The same where each position waits for the force before it, as a servo loop's do: all of what a call takes, most of which the
// processor overlaps with the next in a row of independent calls.
void proved_in_turn(benchmark::State& state) {
  const auto law =
      std::get<fast::HeightMapField>(fast::HeightMapField::build({{{texture()}}}, height::Mode::true_height, kStiffness));
  const auto positions = stroke();
  std::size_t i = 0;
  float last = 0;
  for (auto _ : state) {
    Eigen::Vector3f position = positions[i++ % kPositions];
    position.x() += 0 * last;
    last = law.evaluate(position).force.x();
    benchmark::DoNotOptimize(std::as_const(last));  // as it is: g++ 12 loses a value that the benchmark may change
  }
}

// The least that a force needs on this machine: its window's sixteen numbers; a square root and a division.
void sixteen_numbers(benchmark::State& state) {
  const auto grid = texture();
  const auto positions = stroke();
  std::size_t i = 0;
  for (auto _ : state) {
    const Eigen::Vector3f& p = positions[i++ % kPositions];
    const auto column = static_cast<std::size_t>(p.x() * 10 + 510.5F), row = static_cast<std::size_t>(p.y() * 10 + 510.5F);
    const float* from = &grid->values[row * kSamples + column];
    using Row = Eigen::Map<const Eigen::Array4f>;
    const Eigen::Array4f sum = (Row(from) + Row(from + kSamples)) + (Row(from + 2 * kSamples) + Row(from + 3 * kSamples));
    benchmark::DoNotOptimize(sum);
  }
}
void root_and_quotient(benchmark::State& state) {
  const volatile double squares = 1.25;
  for (auto _ : state) benchmark::DoNotOptimize(3 / std::sqrt(squares));
}

// Per position of a batch.
void batch(benchmark::State& state, fast::InstructionSet set) {
  if (!fast::is_available(set)) return state.SkipWithError("not on this machine");
  const auto law =
      std::get<fast::HeightMapField>(fast::HeightMapField::build({{{texture()}}}, height::Mode::true_height, kStiffness));
  const auto positions = stroke();
  std::vector<Eigen::Vector3f> forces(positions.size());
  while (state.KeepRunningBatch(static_cast<std::int64_t>(positions.size())))
    benchmark::DoNotOptimize(law.force(positions, forces, set));
}

void naive(benchmark::State& state) {
  const NaiveSpline spline{texture()->values.data(), kSamples, kPitch, kStiffness};
  const auto positions = stroke();
  std::size_t i = 0;
  for (auto _ : state) {
    const Eigen::Vector3f& p = positions[i++ % kPositions];
    benchmark::DoNotOptimize(naive_force(spline, p.x(), p.y(), p.z()));
  }
}

BENCHMARK_CAPTURE(proved, height_map, height::Mode::true_height);
BENCHMARK_CAPTURE(proved, height_map_shaded, height::Mode::force_shaded);
BENCHMARK_CAPTURE(proved, height_map_conservative, height::Mode::conservative);
BENCHMARK_CAPTURE(batch, scalar, fast::InstructionSet::scalar);
BENCHMARK_CAPTURE(batch, avx2, fast::InstructionSet::avx2);
BENCHMARK_CAPTURE(batch, avx512, fast::InstructionSet::avx512);
BENCHMARK(naive);
BENCHMARK(proved_in_turn);
BENCHMARK(sixteen_numbers);
BENCHMARK(root_and_quotient);

}  // namespace
}  // namespace forceshade::bench

BENCHMARK_MAIN();
