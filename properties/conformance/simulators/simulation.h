// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The scene of a simulation: a sphere above a ground that does not move. Lengths in m, masses in kg, z up.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <variant>
#include <vector>

namespace forceshade::conformance::simulators {

struct GroundMesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;  // counter-clockwise seen from outside

  bool operator==(const GroundMesh&) const = default;
};

struct GroundBox {
  Eigen::Vector3d half{0, 0, 0}, centre{0, 0, 0};

  bool operator==(const GroundBox&) const = default;
};

struct Simulation {
  std::string name;
  double units_per_metre = 1;  // of the numbers that a simulator is given, and answers
  double rate = 240;           // steps in a second
  Eigen::Vector3d gravity{0, 0, -9.81};
  std::variant<GroundMesh, GroundBox> ground = GroundBox{};
  double radius = 0.1, mass = 1;
  Eigen::Vector3d position{0, 0, 0}, velocity{0, 0, 0};  // of the sphere's centre

  double step() const { return 1 / rate; }
  bool operator==(const Simulation&) const = default;
};

// As in docs/conformance-protocol.md. A coordinate that is no number is null.
nlohmann::ordered_json json_of(const Simulation& scene);
nlohmann::ordered_json json_of(const Eigen::Vector3d& v);

// A turn or mirror whose entries are 0, 1 and -1. A mirrored mesh is wound the other way, so that its outside stays there.
Simulation transformed(Simulation scene, const Eigen::Matrix3d& by);

// Other numbers of triangles and vertices, and each triangle begins at another of its corners.
Simulation renumbered(Simulation scene);

// Each triangle twice; or every second one in two, from the middle of a side that its neighbour keeps whole.
Simulation doubled(Simulation scene);
Simulation split(Simulation scene);

// Grounds that are a line in the plane of x and z, drawn along y: floors, slopes, ridges and steps.

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
