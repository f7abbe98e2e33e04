// SPDX-License-Identifier: BSD-3-Clause
#include "properties/conformance/timing.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <utility>

#include "properties/conformance/quantile.h"
#include "text/number_text.h"

namespace forceshade::conformance {
namespace {

constexpr std::size_t kTimed = 4000;
constexpr std::chrono::seconds kLongestTiming{10};

}  // namespace

std::string words_of_time(double seconds) {
  const auto& [unit, in_a_second] = seconds < 1e-3 ? std::pair(" µs", 1e6)
                                    : seconds < 1  ? std::pair(" ms", 1e3)
                                                   : std::pair(" s", 1.0);
  return digits(in_a_second * seconds, 3) + unit;
}

Timing timing_of(std::vector<double> seconds) {
  if (seconds.empty()) return {};
  return {seconds.size(), quantile(seconds, 0.5), quantile(seconds, 0.999), std::ranges::max(seconds)};
}

Timing time_answers(SceneRenderer& renderer, std::span<const Eigen::Vector3f> path) {
  using Clock = std::chrono::steady_clock;
  std::vector<double> seconds;
  const Clock::time_point begin = Clock::now();
  for (std::size_t i = 0; i < kTimed; ++i) {
    const std::size_t at = i % path.size();
    const Clock::time_point asked = Clock::now();
    renderer.forces(path.subspan(at, 1), at == 0);
    const Clock::time_point answered = Clock::now();
    seconds.push_back(std::chrono::duration<double>(answered - asked).count());
    if (answered - begin > kLongestTiming) break;
  }
  return timing_of(std::move(seconds));
}

}  // namespace forceshade::conformance
