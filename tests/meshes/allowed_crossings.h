// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Both sides of the god-object on meshes that may intersect themselves, and its states as exact points.

#include <array>
#include <boost/multiprecision/gmp.hpp>
#include <cmath>
#include <cstdint>

#include "forceshade/reference.h"
#include "properties/mesh_source.h"
#include "tests/meshes/rendering.h"

namespace forceshade::tests {

inline constexpr float kStiffness = 0.3F;  // N/mm

struct Look {
  mesh::Shading shading = mesh::Shading::none;
  mesh::CornerNormals normals;
  mesh::Texture texture;
};
inline Look look_of(const mesh::TriangleMesh& triangles, mesh::Shading shading, properties::MeshSource& source) {
  Look look{shading, {}, {}};
  if (mesh::has_corner_normals(shading)) look.normals = source.normals_of(triangles);
  if (shading == mesh::Shading::texture_scheme)
    look.texture = {source.textures_of(triangles),
                    {{{height::Grating{1, 0.5F, 0.75F, 0}}, {height::Cone{1, 2, 3, 4}}, {height::Plane{0.25F, 0.5F, 0}}}}};
  return look;
}

inline MeshRendering rendering_of(const mesh::TriangleMesh& triangles, mesh::Sides sides, mesh::SelfIntersections allowed,
                                  const Look& look) {
  return {checked(triangles, allowed), look.normals, sides, look.shading, kStiffness, look.texture};
}

inline MeshRendering crossing(const mesh::TriangleMesh& triangles, mesh::Sides sides = mesh::Sides::front) {
  return rendering_of(triangles, sides, mesh::SelfIntersections::allowed, {});
}

using Integer = boost::multiprecision::number<boost::multiprecision::gmp_int, boost::multiprecision::et_off>;
using Exact = std::array<Integer, 3>;

inline Exact exact(const std::array<float, 3>& v) {  // in units of 2^-77 mm
  Exact result;
  for (std::size_t i = 0; i < 3; ++i) result[i] = Integer(std::ldexp(static_cast<double>(v[i]), 77));
  return result;
}

inline Exact point_of(const mesh::TriangleMesh& mesh, const mesh::GodObject& state) {
  const auto mix = [&](std::array<std::uint32_t, 3> corners, std::int64_t k, std::int64_t l) {
    const Exact a = exact(mesh.vertices[corners[0]]), b = exact(mesh.vertices[corners[1]]),
                c = exact(mesh.vertices[corners[2]]);
    Exact point;
    for (std::size_t i = 0; i < 3; ++i) point[i] = a[i] + (k * (b[i] - a[i]) + l * (c[i] - a[i])) / (1 << 24);
    return point;
  };
  switch (state.place) {
    case mesh::Place::vertex: return exact(mesh.vertices[state.index[0]]);
    case mesh::Place::edge: return mix({state.index[0], state.index[1], state.index[0]}, state.parameter[0], 0);
    case mesh::Place::triangle: return mix(mesh.triangles[state.index[0]], state.parameter[0], state.parameter[1]);
    default: return exact(state.position);
  }
}

}  // namespace forceshade::tests
