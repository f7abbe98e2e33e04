// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/properties/height_loops.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace forceshade::properties {
namespace {

// By the force at the middle of steps no longer than 1 µm.
double walked(const fast::HeightLaw& law, const std::vector<Eigen::Vector3f>& path) {
  double paid = 0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Eigen::Vector3d from = path[i - 1].cast<double>(), way = path[i].cast<double>() - from;
    const int steps = static_cast<int>(std::ceil(way.norm() * 1000));
    for (int k = 0; k < steps; ++k)
      paid += law.force((from + (k + 0.5) / steps * way).cast<float>()).cast<double>().dot(way) / steps;
  }
  return paid;
}

}  // namespace

reference::Slice certified_slice(const HeightMap& map) {
  float reach = 12.7F;
  for (const auto* parts : {&map.parts, &map.surface})
    for (const height::Part& part : *parts)
      if (const auto* grid = std::get_if<std::shared_ptr<const height::Grid>>(&part.shape))
        reach = std::min(reach, 250 * (*grid)->pitch);
  return {reference::Slice::Along::x, 0, -reach, reach};
}

std::vector<LoopEnergy> loop_energies(const reference::HeightLaw& law, const fast::HeightLaw& fast,
                                      const std::atomic<bool>& stop) {
  const reference::Slice slice = certified_slice(law.map());
  std::vector<LoopEnergy> energies;
  try {
    for (const float depth : {0.5F, 2.0F}) {
      if (stop || slice_error(law, slice, depth)) continue;
      const std::array<double, 2> bound = binary64(loop_bound(law, slice, depth).most());
      if (!std::isfinite(bound[0]) || !std::isfinite(bound[1])) continue;
      const std::vector<Eigen::Vector3f> loop = witness(law, slice, depth);
      energies.push_back({static_cast<double>(depth), bound, binary64(work(law, loop))[0], walked(fast, loop)});
    }
    return energies;
  } catch (const std::domain_error&) {
    return {};
  }
}

}  // namespace forceshade::properties
