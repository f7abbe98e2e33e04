// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "forceshade/servo_loop.h"

namespace forceshade::device {

LastSamples::LastSamples(double seconds, double rate) : ring_(static_cast<std::size_t>(std::lround(seconds * rate)) + 1) {}

void LastSamples::push(const Sample& sample) noexcept {
  if (sample.status == Sample::kEnd) return;
  ring_[pushed_++ % ring_.size()] = sample;
}

std::vector<Sample> LastSamples::samples() const {
  const std::size_t kept = std::min(pushed_, ring_.size());
  std::vector<Sample> all;
  for (std::size_t i = pushed_ - kept; i < pushed_; ++i) all.push_back(ring_[i % ring_.size()]);
  return all;
}

}  // namespace forceshade::device
