// SPDX-License-Identifier: BSD-3-Clause
#include "properties/height_loops.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace forceshade::properties {
namespace {

// By the force at the middle of steps no longer than 1 µm.
double walked(const ForceAt& renderer, const std::vector<Eigen::Vector3f>& path, const Monitor& monitor) {
  double generated = 0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    monitor.at(static_cast<double>(i) / static_cast<double>(path.size()));
    const Eigen::Vector3d from = path[i - 1].cast<double>(), way = path[i].cast<double>() - from;
    const int steps = static_cast<int>(std::ceil(way.norm() * 1000));
    for (int k = 0; k < steps; ++k)
      generated += renderer((from + (k + 0.5) / steps * way).cast<float>()).force.cast<double>().dot(way) / steps;
  }
  return generated;
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

std::vector<LoopEnergy> loop_energies(const RenderedHeightMap& rendered, const Monitor& monitor) {
  const reference::HeightMapField& law = rendered.law;
  const reference::Slice slice = certified_slice(law.map());
  std::vector<LoopEnergy> energies;
  for (const auto& [depth, half] : {std::pair{0.5F, monitor.part(0, 0.5)}, {2.0F, monitor.part(0.5, 1)}}) {
    if (slice_error(law, slice, depth)) continue;
    const auto bound = loop_bound(law, slice, depth, half.part(0, 0.4));
    const auto loop = witness(law, slice, depth, half.part(0.4, 0.6));
    const auto generated = work(law, loop, half.part(0.6, 0.8));
    energies.push_back({static_cast<double>(depth), binary64(bound.most()), binary64(generated)[0],
                        walked(rendered.force_at, loop, half.part(0.8, 1))});
  }
  return energies;
}

}  // namespace forceshade::properties
