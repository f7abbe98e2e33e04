// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Grounds that are a line in the plane of x and z, drawn along y: floors, slopes, ridges and steps.

#include <Eigen/Core>
#include <vector>

#include "properties/conformance/simulators/simulation.h"

namespace forceshade::conformance::simulators {

// Points (x, z) from the left to the right, the outside above them; a last part may go back below, as in a plate.
using Profile = std::vector<Eigen::Vector2d>;

enum class Diagonals { rising, falling, alternating };

struct Tessellation {
  unsigned along = 16, across = 16;  // cells on each part of the profile, and across it
  Diagonals diagonals = Diagonals::rising;
  double moved = 0;  // by how much of a cell inner vertices are moved in x and y, at random; only on a flat floor
};

// From y = -1.2 to 1.2 m.
GroundMesh mesh_of(const Profile& profile, const Tessellation& tessellation);

// The way from the nearest point of the profile to a centre that lies above it.
struct Nearest {
  double distance = 0;  // negative below the profile
  Eigen::Vector3d normal{0, 0, 1};
};
Nearest nearest(const Profile& profile, const Eigen::Vector3d& centre);

}  // namespace forceshade::conformance::simulators
