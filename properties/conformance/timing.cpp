// SPDX-License-Identifier: BSD-3-Clause
#include "properties/conformance/timing.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <utility>

#include "rendering/number_text.h"

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
  std::ranges::sort(seconds);
  const auto not_slower = [&](double share) {
    return seconds[static_cast<std::size_t>(std::ceil(share * static_cast<double>(seconds.size()))) - 1];
  };
  return {seconds.size(), not_slower(0.5), not_slower(0.999), seconds.back()};
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
