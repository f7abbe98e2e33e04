// SPDX-License-Identifier: BSD-3-Clause
// The time of a tick of a law with damping behind it, beside that without, and with damping that is off.

#include <benchmark/benchmark.h>

#include <cmath>
#include <utility>
#include <vector>

#include "forceshade/damped.h"

namespace forceshade::bench {
namespace {

constexpr std::size_t kPositions = 4096;  // a power of two: a remainder by any other takes a nanosecond

// A finger at 1 kHz that strokes the thesis's bump, up to 60 mm/s, always in contact.
std::vector<Eigen::Vector3f> stroke() {
  std::vector<Eigen::Vector3f> positions;
  for (std::size_t i = 0; i < kPositions; ++i) {
    const auto ms = static_cast<float>(i);
    positions.emplace_back(10 * std::sin(0.006F * ms), 30 * std::sin(0.0011F * ms), -1 - 0.5F * std::sin(0.01F * ms));
  }
  return positions;
}

void tick(benchmark::State& state, const damping::Parameters& parameters) {
  const auto law = std::get<fast::Law>(fast::Law::build(LawId::bump_2p_shaded, {15.24F, 25.4F, 0.5F}));
  const auto session = fast::damped(fast::session_of(law), std::get<fast::Damping>(fast::Damping::build(parameters)));
  const auto positions = stroke();
  std::size_t i = 0;
  for (auto _ : state) {
    const fast::Evaluation answer = session->step(positions[i++ % kPositions]);
    benchmark::DoNotOptimize(std::as_const(answer));
  }
}

BENCHMARK_CAPTURE(tick, off, damping::Parameters{.rate = 1000});
BENCHMARK_CAPTURE(tick, damping, damping::Parameters{.rate = 1000, .damping = 0.002F});
BENCHMARK_CAPTURE(tick, damping_half, damping::Parameters{.rate = 1000, .share = 0.5F, .damping = 0.002F});
BENCHMARK_CAPTURE(tick, damping_filtered, damping::Parameters{.rate = 1000, .share = 0.1F, .damping = 0.002F});
BENCHMARK_CAPTURE(tick, damping_and_drag, damping::Parameters{.rate = 1000, .share = 0.1F, .damping = 0.002F, .drag = 0.001F});

}  // namespace
}  // namespace forceshade::bench

BENCHMARK_MAIN();
