// SPDX-License-Identifier: BSD-3-Clause
// The points that places of a god-object stand for.

#include <Eigen/Geometry>
#include <algorithm>
#include <boost/multiprecision/eigen.hpp>
#include <boost/multiprecision/gmp.hpp>
#include <cmath>

#include "properties/mesh_properties.h"

namespace forceshade::properties {
namespace {

constexpr double kGridStep = 0x1p-24;

// Exact, because binary64 loses the point in which planes meet at a small angle.
using ExactNumber = boost::multiprecision::number<boost::multiprecision::gmp_rational, boost::multiprecision::et_off>;
using RationalVector = Eigen::Matrix<ExactNumber, 3, 1>;

// As the definition reads a coordinate.
RationalVector exact_vector(const std::array<float, 3>& millimetres) {
  RationalVector v;
  for (std::size_t i = 0; i < 3; ++i)
    v[static_cast<Eigen::Index>(i)] = std::fabs(millimetres[i]) < 0x1p-30F ? 0 : ExactNumber(millimetres[i]);
  return v;
}

// (b - a) x (c - a)
RationalVector normal_of(const mesh::TriangleMesh& mesh, std::uint32_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  const RationalVector at = exact_vector(mesh.vertices[a]);
  return (exact_vector(mesh.vertices[b]) - at).cross(exact_vector(mesh.vertices[c]) - at);
}

struct RationalLine {
  RationalVector on, along;
};
struct RationalPlane {
  RationalVector on, normal;
};

RationalVector foot(const RationalLine& line, const RationalVector& p) {
  return line.on + (p - line.on).dot(line.along) / line.along.squaredNorm() * line.along;
}

RationalVector meeting(const RationalLine& line, const RationalPlane& plane) {
  return line.on + (plane.on - line.on).dot(plane.normal) / line.along.dot(plane.normal) * line.along;
}

RationalLine meeting(const RationalPlane& a, const RationalPlane& b) {
  const RationalVector along = a.normal.cross(b.normal);
  return {meeting(RationalLine{a.on, a.normal.cross(along)}, b), along};
}

// A place on a mesh that is not regular, as docs/soups.md lists them.
RationalVector point_of_meeting(const mesh::TriangleMesh& mesh, const mesh::GodObject& state) {
  const auto vertex = [&](std::uint32_t v) { return exact_vector(mesh.vertices[v]); };
  const auto edge = [&](const std::array<std::uint32_t, 2>& ends) {
    return RationalLine{vertex(ends[0]), vertex(ends[1]) - vertex(ends[0])};
  };
  const auto plane = [&](std::uint32_t i) { return RationalPlane{vertex(mesh.triangles[i][0]), normal_of(mesh, i)}; };
  const RationalVector p = exact_vector(state.position);
  switch (state.meeting) {
    case mesh::Meeting::none: break;
    case mesh::Meeting::line: {  // the point of the plane parallel to the side beyond the corner, whose weight is the parameter
      const RationalPlane f = plane(state.index[0]);
      const mesh::Triangle& corners = mesh.triangles[state.index[0]];
      const auto corner = [&](std::uint32_t i) { return vertex(corners[(state.further[0] + i) % 3]); };
      const ExactNumber weight = ExactNumber(kGridStep) * state.parameter[0];
      return meeting(meeting(f, plane(state.index[1])),
                     {corner(1) + weight * (corner(0) - corner(1)), (corner(2) - corner(1)).cross(f.normal)});
    }
    case mesh::Meeting::edges: {
      const RationalLine one = edge(state.index), other = edge(state.further);
      return meeting(one, RationalPlane{other.on, other.along.cross(one.along.cross(other.along))});
    }
    case mesh::Meeting::edge_and_triangle: return meeting(edge(state.index), plane(state.further[0]));
    case mesh::Meeting::triangles:
      return meeting(meeting(plane(state.index[0]), plane(state.index[1])), plane(state.further[0]));
    case mesh::Meeting::foot_on_triangle: {
      const RationalPlane f = plane(state.index[0]);
      return meeting(RationalLine{p, f.normal}, f);
    }
    case mesh::Meeting::foot_on_edge: return foot(edge(state.index), p);
    case mesh::Meeting::foot_on_line: return foot(meeting(plane(state.index[0]), plane(state.index[1])), p);
  }
  return p;
}

}  // namespace

Eigen::Vector3d point_of(const mesh::TriangleMesh& mesh, const mesh::GodObject& state) {
  if (state.meeting != mesh::Meeting::none) {
    const RationalVector point = point_of_meeting(mesh, state);
    return {point[0].convert_to<double>(), point[1].convert_to<double>(), point[2].convert_to<double>()};
  }
  const auto vertex = [&](std::uint32_t v) { return vector_of(mesh.vertices[v]); };
  const auto share = [&](std::size_t i) { return kGridStep * state.parameter[i]; };
  switch (state.place) {
    case mesh::Place::vertex: return vertex(state.index[0]);
    case mesh::Place::edge: {
      const Eigen::Vector3d a = vertex(state.index[0]), b = vertex(state.index[1]);
      return a + share(0) * (b - a);
    }
    case mesh::Place::triangle: {
      const mesh::Triangle& corners = mesh.triangles[state.index[0]];
      const Eigen::Vector3d a = vertex(corners[0]), b = vertex(corners[1]), c = vertex(corners[2]);
      return a + share(0) * (b - a) + share(1) * (c - a);
    }
    default: return vector_of(state.position);
  }
}

bool has_area(const mesh::TriangleMesh& mesh, std::uint32_t triangle) {
  return normal_of(mesh, triangle) != RationalVector::Zero();
}

double grid_reach(const mesh::TriangleMesh& mesh, const mesh::GodObject& state) {
  const auto between = [&](std::uint32_t v, std::uint32_t w) {
    return (vector_of(mesh.vertices[v]) - vector_of(mesh.vertices[w])).norm();
  };
  double longest = 0;
  if (state.place == mesh::Place::edge) longest = between(state.index[0], state.index[1]);
  if (state.place == mesh::Place::triangle) {
    const mesh::Triangle& t = mesh.triangles[state.index[0]];
    longest = std::max({between(t[0], t[1]), between(t[1], t[2]), between(t[2], t[0])});
  }
  return 2 * kGridStep * longest;
}

}  // namespace forceshade::properties
