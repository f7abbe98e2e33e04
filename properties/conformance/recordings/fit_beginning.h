// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The placements from which a fit may begin.

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "forceshade/properties.h"
#include "properties/conformance/recordings/path.h"
#include "properties/conformance/recordings/recording.h"

namespace forceshade::conformance {

using Samples = std::vector<Measured>;

// At most so many of them, evenly.
Samples thinned(const Samples& samples, std::size_t most);

// mm/s; 1 of a hand that never moves.
double usual_speed_of(const Measurements& measured);

// A point on the surface of the scene, and the direction of the force there.
struct Spot {
  Eigen::Vector3d point, direction;
};

std::vector<Spot> spots_of(const properties::Subject& subject, float stiffness, std::uint64_t seed);

// A placement, with the factor by which the renderer's forces explain the measured ones best there.
struct Beginning {
  Placement placement;
  double factor = 0, share = 1;  // of the squared force that is left
};

Beginning tried(const Renderer& renderer, const RecordedPath& path, const Samples& samples, const Placement& placement);

}  // namespace forceshade::conformance
