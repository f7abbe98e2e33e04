// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The servo loop's report of a run, kept in memory; for benchmarks, too.

#include <Eigen/Core>
#include <vector>

#include "forceshade/servo_loop.h"

namespace forceshade::tests {

class KeptSamples final : public device::SampleSink {
 public:
  explicit KeptSamples(std::size_t room = 10'000) { samples.reserve(room); }
  void push(const device::Sample& sample) noexcept override { samples.push_back(sample); }

  std::vector<device::Sample> samples;
};

inline Eigen::Vector3f vector(const std::array<float, 3>& a) {
  return {a[0], a[1], a[2]};
}

}  // namespace forceshade::tests
