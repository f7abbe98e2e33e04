// SPDX-License-Identifier: BSD-3-Clause
#include "properties/mesh_properties.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "properties/binary32.h"
#include "rendering/mesh_rendering.h"

namespace forceshade::properties {
namespace {

constexpr double kGridStep = 0x1p-24;
constexpr double kSum = 0x1p-36;  // mm: more than binary64 loses where coordinates within 10^4 mm are added

// As the definition reads a position.
Eigen::Vector3d read(const MeshPosition& position) {
  Eigen::Vector3d p = vector_of(position);
  for (double& coordinate : p)
    if (std::fabs(coordinate) < 0x1p-30) coordinate = 0;
  return p;
}

Eigen::Vector3d force_of(const mesh::Tick& tick) {
  return vector_of(tick.force);
}

// The rounding of a force whose components are rounded.
double rounding_of(const mesh::Tick& tick) {
  double sum = 0;
  for (const float component : tick.force) sum += static_cast<double>(half_spacing(component));
  return sum;
}

// Includes that of an unfinished tick, but not where a free god-object stays free: then there is no force.
bool is_on_surface(const mesh::Tick& tick) {
  return tick.status == Status::contact || (tick.status == Status::unfinished && tick.after.place != mesh::Place::free);
}

// N/mm: K where the god-object is.
double stiffness_at(const MeshRendering& rendering, const mesh::GodObject& state) {
  const auto of = [&](std::size_t triangle) {
    return material_of(rendering.materials, triangle).stiffness.value_or(rendering.stiffness);
  };
  if (!has_own_stiffness(rendering.materials) || state.place == mesh::Place::nowhere || state.place == mesh::Place::free)
    return static_cast<double>(rendering.stiffness);
  if (state.place == mesh::Place::triangle) return static_cast<double>(of(state.index[0]));
  // The largest of the triangles at the vertex or edge.
  float largest = 0;
  const auto& triangles = rendering.mesh().triangles;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const auto has = [&](std::uint32_t v) { return std::ranges::find(triangles[i], v) != triangles[i].end(); };
    if (has(state.index[0]) && (state.place == mesh::Place::vertex || has(state.index[1]))) largest = std::max(largest, of(i));
  }
  return static_cast<double>(largest);
}

// True if a part of the force may be friction's, at a right angle to what is turned to the shading direction, so that the force
// is not as long as the spring's.
bool is_drag_beside_shading(const MeshRendering& rendering) {
  return rendering.contact == mesh::Contact::friction && rendering.shading != mesh::Shading::none &&
         has_friction(rendering.materials);
}

// The turn of a shaded force, as a chord, at the end of this tick; 0 where it is not shaded. D: from the position to
// the god-object, mm, known to `slack`. A rest that was refused, or is not inside a triangle, has D along no normal in
// particular.
double most_turn(const MeshRendering& rendering, const mesh::Tick& tick, const Eigen::Vector3d& D, double slack) {
  if (rendering.shading == mesh::Shading::none) return 0;
  const bool is_inside = tick.status == Status::contact && tick.after.place == mesh::Place::triangle;
  if (!is_inside || rendering.shading != mesh::Shading::vertex_scheme) return std::numbers::sqrt2;
  const mesh::Triangle& corners = rendering.mesh().triangles[tick.after.index[0]];
  const auto corner = [&](std::size_t i) { return vector_of(rendering.mesh().vertices[corners[i]]); };
  const Eigen::Vector3d n = (corner(1) - corner(0)).cross(corner(2) - corner(0));
  if (n.cross(D).norm() > slack * n.norm()) return std::numbers::sqrt2;
  return largest_turn(rendering, tick.after.index[0]);
}

// The factor by which the distance to the new position may be longer than if the god-object had not moved. A
// sub-goal is off the position by the sine of a turn, times that distance, and no farther from where the god-object arrives
// than from where it was. A sine is at most the chord.
double most_growth(const MeshRendering& rendering, const mesh::GodObject& before) {
  if (rendering.contact != mesh::Contact::sub_goal || before.place != mesh::Place::triangle) return 1;
  return 1 + 2 * largest_turn(rendering, before.index[0]);
}

// The error of a goal because its coordinates are binary32 numbers. distance: the most that it is off the position q.
double rounding_of_goal(const Eigen::Vector3d& q, double distance) {
  const double largest = q.cwiseAbs().maxCoeff() + distance;
  return std::numbers::sqrt3 * (half_spacing(static_cast<float>(largest)) + 0x1p-30);
}

std::string at(const MeshPosition& p) {
  return "at (" + show(p[0]) + ", " + show(p[1]) + ", " + show(p[2]) + ") mm ";
}

std::string words(double value) {
  return show(static_cast<float>(value));
}

struct Line {
  Eigen::Vector3d on, along;
};
struct Plane {
  Eigen::Vector3d on, normal;
};

Eigen::Vector3d foot(const Line& line, const Eigen::Vector3d& p) {
  return line.on + (p - line.on).dot(line.along) / line.along.squaredNorm() * line.along;
}

Eigen::Vector3d meeting(const Line& line, const Plane& plane) {
  return line.on + (plane.on - line.on).dot(plane.normal) / line.along.dot(plane.normal) * line.along;
}

Line meeting(const Plane& a, const Plane& b) {
  const Eigen::Vector3d along = a.normal.cross(b.normal);
  return {meeting(Line{a.on, a.normal.cross(along)}, b), along};
}

// A place on a mesh that is not regular, as docs/soups.md lists them.
Eigen::Vector3d point_of_meeting(const mesh::TriangleMesh& mesh, const mesh::GodObject& state) {
  const auto vertex = [&](std::uint32_t v) { return vector_of(mesh.vertices[v]); };
  const auto edge = [&](const std::array<std::uint32_t, 2>& ends) {
    return Line{vertex(ends[0]), vertex(ends[1]) - vertex(ends[0])};
  };
  const auto plane = [&](std::uint32_t i) {
    const auto& [a, b, c] = mesh.triangles[i];
    return Plane{vertex(a), (vertex(b) - vertex(a)).cross(vertex(c) - vertex(a))};
  };
  const Eigen::Vector3d p = vector_of(state.position);
  switch (state.meeting) {
    case mesh::Meeting::none: break;
    case mesh::Meeting::line: {  // the point of the plane parallel to the side beyond the corner, whose weight is the parameter
      const Plane f = plane(state.index[0]);
      const mesh::Triangle& corners = mesh.triangles[state.index[0]];
      const auto corner = [&](std::uint32_t i) { return vertex(corners[(state.further[0] + i) % 3]); };
      const double weight = kGridStep * state.parameter[0];
      return meeting(meeting(f, plane(state.index[1])),
                     {corner(1) + weight * (corner(0) - corner(1)), (corner(2) - corner(1)).cross(f.normal)});
    }
    case mesh::Meeting::edges: {
      const Line one = edge(state.index), other = edge(state.further);
      return meeting(one, Plane{other.on, other.along.cross(one.along.cross(other.along))});
    }
    case mesh::Meeting::edge_and_triangle: return meeting(edge(state.index), plane(state.further[0]));
    case mesh::Meeting::triangles:
      return meeting(meeting(plane(state.index[0]), plane(state.index[1])), plane(state.further[0]));
    case mesh::Meeting::foot_on_triangle: {
      const Plane f = plane(state.index[0]);
      return meeting(Line{p, f.normal}, f);
    }
    case mesh::Meeting::foot_on_edge: return foot(edge(state.index), p);
    case mesh::Meeting::foot_on_line: return foot(meeting(plane(state.index[0]), plane(state.index[1])), p);
  }
  return p;
}

}  // namespace

Eigen::Vector3d point_of(const mesh::TriangleMesh& mesh, const mesh::GodObject& state) {
  if (state.meeting != mesh::Meeting::none) return point_of_meeting(mesh, state);
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

Violation force_is_as_long_as_the_spring(const MeshRendering& rendering, const Ticked& ticked) {
  const mesh::Tick& tick = ticked.tick;
  const double size = force_of(tick).norm(), K = stiffness_at(rendering, tick.after);
  if (!is_on_surface(tick)) {
    if (size == 0) return std::nullopt;
    return at(ticked.position) + "the god-object is not on the surface, and the force is " + words(size) + " N";
  }
  const double length = (point_of(rendering.mesh(), tick.after) - read(ticked.position)).norm();
  const double allowed = K * (grid_reach(rendering.mesh(), tick.after) + kSum) + rounding_of(tick);
  // The two parts of a spring that is S long are S cos and S sin of an angle, so that together they are no longer than S√2.
  if (is_drag_beside_shading(rendering) ? size <= std::numbers::sqrt2 * (K * length + allowed)
                                        : std::fabs(size - K * length) <= allowed)
    return std::nullopt;
  return at(ticked.position) + "the force is " + words(size) + " N; the spring is " + words(length) + " mm long, so " +
         words(K * length) + " N were expected";
}

Violation force_follows_the_spring(const MeshRendering& rendering, const Ticked& one, const Ticked& other) {
  const mesh::GodObject &a = one.tick.after, &b = other.tick.after;
  if (!is_on_surface(one.tick) || !is_on_surface(other.tick)) return std::nullopt;
  if (a.place != b.place || a.index != b.index || a.side != b.side) return std::nullopt;
  // Friction's part is drawn from the normal of the triangle in which the hand pulls, and at an edge that may change.
  if (is_drag_beside_shading(rendering)) return std::nullopt;
  const double moved = (read(other.position) - read(one.position)).norm() +
                       (point_of(rendering.mesh(), b) - point_of(rendering.mesh(), a)).norm() +
                       2 * grid_reach(rendering.mesh(), a) + 2 * kSum;
  const double allowed = stiffness_at(rendering, a) * moved + rounding_of(one.tick) + rounding_of(other.tick);
  const Eigen::Vector3d F = force_of(one.tick), G = force_of(other.tick);
  const double change = rendering.shading == mesh::Shading::none ? (G - F).norm() : std::fabs(G.norm() - F.norm());
  if (change <= allowed) return std::nullopt;
  return at(one.position) + "and " + at(other.position) + "forces differ by " + words(change) + " N; at most " +
         words(allowed) + " N were expected";
}

UnitNormal unit_normal(const mesh::TriangleMesh& mesh, std::uint32_t triangle) {
  const mesh::Triangle& corners = mesh.triangles[triangle];
  const auto corner = [&](std::size_t i) { return vector_of(mesh.vertices[corners[i]]); };
  const Eigen::Vector3d e = corner(1) - corner(0), f = corner(2) - corner(0), n = e.cross(f);
  return {n.normalized(), 16 * 0x1p-53 * e.norm() * f.norm() / n.norm() + 16 * 0x1p-53};
}

double largest_turn(const MeshRendering& rendering, std::uint32_t triangle) {
  const UnitNormal n = unit_normal(rendering.mesh(), triangle);
  double turn = 0;
  for (const mesh::Normal& normal : rendering.normals[triangle]) {
    const Eigen::Vector3d N = vector_of(normal);
    if (N.isZero(0)) continue;  // it adds nothing to the others; a chord beyond the root of 2 is that of an angle above 90°
    turn = std::max(turn, (N.normalized() - n.direction).norm() + n.error);
  }
  return std::min(turn, std::numbers::sqrt2);
}

Violation spring_gives_no_energy(const MeshRendering& rendering, std::span<const Ticked> path) {
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Ticked &before = path[i - 1], &now = path[i];
    const Eigen::Vector3d p = read(before.position), q = read(now.position), step = q - p;
    const Eigen::Vector3d r = point_of(rendering.mesh(), before.tick.after), s = point_of(rendering.mesh(), now.tick.after);
    const double growth = most_growth(rendering, before.tick.after);
    const double slack = grid_reach(rendering.mesh(), before.tick.after) + grid_reach(rendering.mesh(), now.tick.after) +
                         4 * kSum + (growth > 1 ? 2 * rounding_of_goal(q, growth * (r - q).norm()) : 0);
    if ((s - q).norm() > growth * (r - q).norm() + slack)
      return at(now.position) + "the god-object went from " + words((r - q).norm()) + " mm off the position to " +
             words((s - q).norm()) + " mm off it";
    const Eigen::Vector3d F = force_of(before.tick), G = force_of(now.tick);
    const double K = stiffness_at(rendering, before.tick.after), L = stiffness_at(rendering, now.tick.after);
    // The lengths of the springs, mm: of forces, but where friction has a part in them.
    const bool has_drag = is_drag_beside_shading(rendering);
    const double D = has_drag && is_on_surface(before.tick) ? (r - p).norm() : F.norm() / K,
                 E = has_drag && is_on_surface(now.tick) ? (s - q).norm() : G.norm() / L;
    const double given = F.dot(step);
    const double turned = is_on_surface(before.tick) ? most_turn(rendering, before.tick, r - p, slack) : 0;
    const double stored = 0.5 * K * (D * D - E * E / (growth * growth) + step.squaredNorm()) + turned * K * D * step.norm();
    // The springs' ends are off by the slack, and the forces by their roundings.
    const double larger = std::max(K, L),
                 off = (turned > 0 ? 3 : 1) * larger * slack + rounding_of(before.tick) + rounding_of(now.tick) * larger / L;
    const double allowed = off * (step.norm() + D + E + off / K);
    if (given > stored + allowed)
      return at(now.position) + "a tick gave " + words(given) + " mJ; at most " + words(stored) + " mJ were expected";
  }
  return std::nullopt;
}

}  // namespace forceshade::properties
