// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/properties/calls.h"

#include <cmath>
#include <limits>
#include <vector>

namespace forceshade::properties {

Calls calls_of(const fast::Law& law) {
  return {[law](const Eigen::Vector3f& position) { return law.evaluate(position); },
          // This batch call knows no y: a position refused for its y alone is sent as one refused for its x.
          [law](std::span<const Eigen::Vector3f> positions, std::span<Eigen::Vector3f> forces, fast::InstructionSet set) {
            std::vector<float> x, z, fx(positions.size()), fz(positions.size());
            for (const Eigen::Vector3f& position : positions) {
              x.push_back(std::fabs(position.y()) <= 1e4F ? position.x() : std::numeric_limits<float>::quiet_NaN());
              z.push_back(position.z());
            }
            const fast::BatchResult result = law.force(x, z, fx, fz, set);
            for (std::size_t i = 0; i < positions.size(); ++i) forces[i] = {fx[i], 0, fz[i]};
            return result;
          }};
}

Calls calls_of(const fast::HeightMapField& law) {
  return {[law](const Eigen::Vector3f& position) { return law.evaluate(position); },
          [law](std::span<const Eigen::Vector3f> positions, std::span<Eigen::Vector3f> forces, fast::InstructionSet set) {
            return law.force(positions, forces, set);
          },
          true};
}

MakeCalls calls_of_the_fast_path() {
  return {
      [](LawId law, const Parameters& parameters) { return calls_of(std::get<fast::Law>(fast::Law::build(law, parameters))); },
      [](const HeightMap& map, height::Rendering rendering, float stiffness) {
        return calls_of(std::get<fast::HeightMapField>(fast::HeightMapField::build(map, rendering, stiffness)));
      }};
}

}  // namespace forceshade::properties
