// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/properties/stroke.h"

#include <cmath>
#include <stdexcept>

#include "forceshade/reference/height_energy.h"

namespace forceshade::properties {
namespace {

constexpr double kStep = 5e-4;  // mm

// mJ, the force of each step taken at its middle.
double walked(const Renderer& renderer, const std::vector<Eigen::Vector3f>& loop) {
  double paid = 0;
  for (std::size_t i = 1; i < loop.size(); ++i) {
    const Eigen::Vector3d from = loop[i - 1].cast<double>(), way = loop[i].cast<double>() - from;
    const int steps = std::max(1, static_cast<int>(std::ceil(way.norm() / kStep)));
    for (int step = 0; step < steps; ++step)
      paid += renderer((from + (step + 0.5) / steps * way).cast<float>()).force.cast<double>().dot(way) / steps;
  }
  return paid;
}

}  // namespace

std::vector<LoopEnergy> stroke_energies(const HeightSubject& subject) {
  const reference::Slice slice;
  std::vector<LoopEnergy> energies;
  try {
    for (const float depth : {0.5F, 1.0F, 2.0F}) {
      const std::vector<Eigen::Vector3f> loop = reference::witness(subject.law, slice, depth);
      LoopEnergy energy{.depth_mm = static_cast<double>(depth),
                        .bound_mJ = reference::binary64(reference::loop_bound(subject.law, slice, depth).most())};
      if (!loop.empty()) {
        energy.witness_mJ = reference::binary64(reference::work(subject.law, loop))[0];
        energy.measured_mJ = walked(subject.renderer, loop);
      }
      energies.push_back(energy);
    }
  } catch (const std::domain_error&) {
    return {};
  }
  return energies;
}

}  // namespace forceshade::properties
