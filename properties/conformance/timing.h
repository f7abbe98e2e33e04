// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The time that a renderer takes for an answer.

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "properties/conformance/scene_renderer.h"

namespace forceshade::conformance {

// Seconds from a request of one position to its force, the way through the door included.
struct Timing {
  std::uint64_t answers = 0;
  double p50 = 0, p999 = 0, worst = 0;  // percentiles by nearest rank: so many were not slower
};

// "23.4 µs", "8.58 ms".
std::string words_of_time(double seconds);

// All zero without answers.
Timing timing_of(std::vector<double> seconds);

// Requests the forces along the path, which is begun again until there are 4000 answers, or 10 s are over. The path is not
// empty. Throws files::ProcessFailed.
Timing time_answers(SceneRenderer& renderer, std::span<const Eigen::Vector3f> path);

}  // namespace forceshade::conformance
