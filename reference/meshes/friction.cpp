// SPDX-License-Identifier: BSD-3-Clause
#include "reference/meshes/friction.h"

#include <algorithm>
#include <cmath>

#include "reference/larger_limits.h"
#include "reference/meshes/rounding.h"
#include "rendering/mesh_rendering.h"

namespace forceshade::reference::meshes {

SurfaceMaterials::SurfaceMaterials(const Surface& surface, const mesh::Materials& materials, float stiffness)
    : surface_(surface) {
  for (std::size_t i = 0; i < surface.triangles().size(); ++i) {
    mesh::Material its = material_of(materials, i);
    its.stiffness = its.stiffness.value_or(stiffness);
    are_rough_somewhere_ |= its.static_friction > 0;
    of_triangle_.push_back(its);
  }
}

mesh::Material SurfaceMaterials::of(const Feature& feature) const {
  mesh::Material largest{.damping = {0, 0}};
  for (const std::size_t i : surface_.triangles_at(feature)) {
    const mesh::Material& its = of_triangle_[i];
    largest.stiffness = std::max(largest.stiffness, its.stiffness);
    largest.static_friction = std::max(largest.static_friction, its.static_friction);
    largest.dynamic_friction = std::max(largest.dynamic_friction, its.dynamic_friction);
    enlarge(largest.damping, its.damping);
  }
  return largest;
}

Load load_on(const Surface& surface, const Feature& along, const Vector& u) {
  Load load;
  if (along.place == mesh::Place::edge) {
    const Edge& edge = surface.edges()[along.index];
    load.under = edge.length_squared;
    load.pull = dot(edge.along, u) * edge.along;
    load.pressure = load.under * u - load.pull;
  } else {
    const Triangle& triangle = surface.triangles()[along.index];
    load.under = triangle.normal_squared;
    load.pressure = dot(triangle.normal, u) * triangle.normal;
    load.pull = load.under * u - load.pressure;
  }
  return load;
}

bool is_within(const Load& load, float mu, unsigned factor) {
  const Integer t_squared = factor * factor * dot(load.pull, load.pull), z_squared = dot(load.pressure, load.pressure);
  if (z_squared.is_zero()) return t_squared.is_zero();
  if (std::isinf(mu)) return true;
  const Integer mu_over = integer_of(mu, kFloatScale);
  return t_squared << (2 * kFloatScale) <= mu_over * mu_over * z_squared;
}

// The least j with (2^24 - j)² t² <= 2^48 mu² z²: 2^24 - j is the root of the right side over t², rounded down.
Integer share(const Load& load, float dynamic_friction) {
  const Integer z_squared = dot(load.pressure, load.pressure);
  if (z_squared.is_zero()) return kGrid;
  const Integer mu_over = Integer(kGrid) * integer_of(dynamic_friction, kFloatScale);
  return kGrid - sqrt(Integer(mu_over * mu_over * z_squared / (dot(load.pull, load.pull) << (2 * kFloatScale))));
}

}  // namespace forceshade::reference::meshes
