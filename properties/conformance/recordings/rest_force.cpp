// SPDX-License-Identifier: BSD-3-Clause
#include "properties/conformance/recordings/rest_force.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace forceshade::conformance {

RestForce rest_force_of(const std::vector<Measured>& samples) {
  constexpr std::size_t kLooked = 400;
  const std::size_t step = (samples.size() + kLooked - 1) / kLooked;
  std::vector<Eigen::Vector3d> forces;
  for (std::size_t i = 0; i < samples.size(); i += step) forces.push_back(samples[i].force);

  double closest = std::numeric_limits<double>::infinity();
  RestForce rest;
  for (const Eigen::Vector3d& each : forces) {
    std::vector<double> distances;
    for (const Eigen::Vector3d& other : forces) distances.push_back((other - each).norm());
    const auto tenth = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 10);
    std::ranges::nth_element(distances, tenth);
    if (!(*tenth < closest)) continue;
    closest = *tenth;
    rest = {each, closest};
  }
  // The mean of those within four standard deviations, which are then known better. Without noise a tenth of the forces are one
  // number, and a mean of it may be rounded to none of them.
  for (int round = 0; round < 10 && rest.noise > 0; ++round) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double squares = 0, count = 0;
    for (const Eigen::Vector3d& each : forces) {
      if ((each - rest.force).norm() > 4 * rest.noise) continue;
      sum += each;
      squares += (each - rest.force).squaredNorm();
      ++count;
    }
    rest = {sum / count, std::min(2 * rest.noise, std::sqrt(squares / count / 3))};
  }
  return rest;
}

double doubt_of(const Eigen::Vector3d& offset, const std::vector<RestForce>& rests, double largest) {
  double doubt = 1e-3 * largest;
  for (const RestForce& rest : rests) doubt = std::min(doubt, (offset - rest.force).norm());
  return std::max(doubt, 1e-6 * largest);
}

}  // namespace forceshade::conformance
