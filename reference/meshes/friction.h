// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Decides for friction (docs/friction.md): whether it holds the god-object, and how far it lets it slip.

#include "reference/meshes/surface.h"

namespace forceshade::reference::meshes {

// The materials of a surface.
class SurfaceMaterials {
 public:
  // stiffness: of a material that has none.
  SurfaceMaterials(const Surface& surface, const mesh::Materials& materials, float stiffness);

  // That of a triangle; of an edge or a vertex the largest of each number that its triangles have. It has a stiffness.
  mesh::Material of(const Feature& feature) const;

  bool is_rough(const Feature& feature) const { return of(feature).static_friction > 0; }
  bool are_rough_somewhere() const { return are_rough_somewhere_; }

 private:
  const Surface& surface_;
  std::vector<mesh::Material> of_triangle_;
  bool are_rough_somewhere_ = false;
};

// u = p - g at a point g of a triangle's plane or of an edge's line, on which q is the point nearest to p.
struct Load {
  Vector pull;      // (q - g) under
  Vector pressure;  // (p - q) under
  Integer under;
};
Load load_on(const Surface& surface, const Feature& along, const Vector& u);

// With the pull t = |q - g| and the pressure z = |p - q|: factor t <= mu z, where infinity times 0 is 0.
bool is_within(const Load& load, float mu, unsigned factor = 1);

// 2^24 λ, where λ is the share of the way to q that the god-object slips. The load is not within the dynamic coefficient.
Integer share(const Load& load, float dynamic_friction);

}  // namespace forceshade::reference::meshes
