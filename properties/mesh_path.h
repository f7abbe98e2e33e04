// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Random paths across a mesh, where a god-object is hard pressed.

#include <array>
#include <cstdint>
#include <string_view>

#include "forceshade/mesh.h"
#include "properties/positions.h"

namespace forceshade::properties {

// The way in which the positions of a stretch of a path are drawn.
enum class PathKind {
  walk,
  stroke,
  press,
  graze,
  axis_parallel,
  on_surface,
  beside_vertex,
  jump,
  few_bits,
  domain_end,
  invalid
};
inline constexpr std::array<std::string_view, 11> kPathKinds{"walk",          "stroke",     "press",         "graze",
                                                             "axis parallel", "on surface", "beside vertex", "jump",
                                                             "few bits",      "domain end", "invalid"};

// An endless, repeatable path: stretches of one kind each, steps from 10^-9 to 10^3 mm, a position now and then repeated.
class MeshPath : private Draws {
 public:
  MeshPath(const mesh::TriangleMesh& mesh, std::uint64_t seed);

  std::array<float, 3> next();
  PathKind kind() const { return kind_; }  // of the position that next() gave last

 private:
  using Point = std::array<double, 3>;

  void begin_stretch();
  Point vertex();
  Point surface_point(std::size_t triangle);
  std::size_t any_triangle() { return bits() % mesh_.triangles.size(); }
  Point normal(std::size_t triangle) const;
  Point corner(std::size_t triangle, std::size_t i) const;
  Point advanced();

  mesh::TriangleMesh mesh_;
  double size_;  // mm: of the mesh
  PathKind kind_ = PathKind::jump;
  int left_ = 0;      // positions of the stretch
  Point at_{};        // mm
  Point step_{};      // mm a tick; grazing, the direction off the surface
  double reach_ = 0;  // mm: the size of a random step
};

}  // namespace forceshade::properties
