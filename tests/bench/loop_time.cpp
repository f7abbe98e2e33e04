// SPDX-License-Identifier: BSD-3-Clause
// The time of a tick of the servo loop alone, whatever else the machine does: the same strokes five times over, to the bit, and
// of each tick the least time. A stall of the machine seldom meets the same tick five times.
//
// forceshade_loop_time [SECONDS]: of strokes; default: 60.

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "forceshade/device.h"
#include "forceshade/fast.h"
#include "forceshade/servo_loop.h"
#include "tests/support/kept_samples.h"

namespace {

using namespace forceshade;

constexpr int kRuns = 5;

struct Least {
  std::vector<std::int64_t> computing, tick;  // ns
};

Least least_times(LawId id, double seconds) {
  const auto law = std::get<fast::Law>(fast::Law::build(id, {.radius = 15.24F, .width = 25.4F, .stiffness = 0.5F}));
  const std::atomic<bool> never = false;
  Least least;
  for (int run = 0; run < kRuns; ++run) {
    const auto simulated = device::open_device("simulated");
    tests::KeptSamples times(static_cast<std::size_t>(1000 * seconds) + 1);
    run_servo_loop(*simulated, law, {.max_seconds = seconds, .paced = false, .sinks = {&times}}, never);
    const std::size_t ticks = times.samples.size() - 1;
    least.computing.resize(ticks, INT64_MAX);
    least.tick.resize(ticks, INT64_MAX);
    for (std::size_t k = 0; k < ticks; ++k) {
      least.computing[k] = std::min(least.computing[k], times.samples[k].compute_ns);
      least.tick[k] = std::min(least.tick[k], times.samples[k + 1].wall_ns - times.samples[k].wall_ns);
    }
  }
  return least;
}

std::string percentiles(std::vector<std::int64_t> times) {
  std::sort(times.begin(), times.end());
  const auto at = [&](std::size_t per_myriad) {
    return static_cast<double>(times[(times.size() * per_myriad + 9999) / 10'000 - 1]) / 1e3;
  };
  char text[100];
  std::snprintf(text, sizeof text, "%.2f | %.2f | %.2f | %.2f", at(5000), at(9900), at(9999), at(10'000));
  return text;
}

}  // namespace

int main(int count, char** arguments) {
  const double seconds = count > 1 ? std::strtod(arguments[1], nullptr) : 60;
  if (!(seconds >= 1 && seconds <= 86400)) {
    std::fprintf(stderr, "forceshade_loop_time [SECONDS]: expected 1 to 86400 seconds, got %s\n", arguments[1]);
    return 2;
  }
  std::printf(
      "| µs | computing p50 | p99 | p99.99 | max | whole tick p50 | p99 | p99.99 | max "
      "|\n|---|---|---|---|---|---|---|---|---|\n");
  for (const LawName& law : kLaws) {
    const Least least = least_times(law.id, seconds);
    std::printf("| `%s` | %s | %s |\n", law.name.data(), percentiles(least.computing).c_str(), percentiles(least.tick).c_str());
    std::fflush(stdout);
  }
}
