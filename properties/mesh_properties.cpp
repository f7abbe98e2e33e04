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
struct Stiffness {
  double least, most;  // different where the place does not say all that is there: on a mesh that is not regular
};

Stiffness stiffness_at(const MeshRendering& rendering, const mesh::GodObject& state) {
  const auto of = [&](std::size_t triangle) {
    return material_of(rendering.materials, triangle).stiffness.value_or(rendering.stiffness);
  };
  const auto just = [](float K) { return Stiffness{static_cast<double>(K), static_cast<double>(K)}; };
  if (!has_own_stiffness(rendering.materials) || state.place == mesh::Place::nowhere || state.place == mesh::Place::free)
    return just(rendering.stiffness);
  const auto& triangles = rendering.mesh().triangles;
  if (!rendering.checked.is_regular()) {
    Stiffness all = just(of(0));
    for (std::size_t i = 1; i < triangles.size(); ++i)
      all = {std::min(all.least, static_cast<double>(of(i))), std::max(all.most, static_cast<double>(of(i)))};
    return all;
  }
  if (state.place == mesh::Place::triangle) return just(of(state.index[0]));
  // The largest of the triangles at the vertex or edge.
  float largest = 0;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const auto has = [&](std::uint32_t v) { return std::ranges::find(triangles[i], v) != triangles[i].end(); };
    if (has(state.index[0]) && (state.place == mesh::Place::vertex || has(state.index[1]))) largest = std::max(largest, of(i));
  }
  return just(largest);
}

// True if a part of the force may be friction's, at a right angle to what is turned to the shading direction, so that the force
// is not as long as the spring's.
bool is_drag_beside_shading(const MeshRendering& rendering) {
  return rendering.contact == mesh::Contact::friction && rendering.shading != mesh::Shading::none &&
         has_friction(rendering.materials);
}

// The turn of a shaded force, as a chord, at the end of this tick; 0 where it is not shaded. D: from the position to
// the god-object, mm, known to `slack`. A rest that was refused, or is not inside a triangle, has D along no normal in
// particular. On a mesh that is not regular others can be where its place says that a triangle is.
double most_turn(const MeshRendering& rendering, const mesh::Tick& tick, const Eigen::Vector3d& D, double slack) {
  if (rendering.shading == mesh::Shading::none) return 0;
  const bool is_inside = tick.status == Status::contact && tick.after.place == mesh::Place::triangle;
  if (!is_inside || rendering.shading != mesh::Shading::vertex_scheme || !rendering.checked.is_regular())
    return std::numbers::sqrt2;
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

}  // namespace

Violation force_is_as_long_as_the_spring(const MeshRendering& rendering, const Ticked& ticked) {
  const mesh::Tick& tick = ticked.tick;
  const double size = force_of(tick).norm();
  const auto [K, most] = stiffness_at(rendering, tick.after);
  if (!is_on_surface(tick)) {
    if (size == 0) return std::nullopt;
    return at(ticked.position) + "the god-object is not on the surface, and the force is " + words(size) + " N";
  }
  const double length = (point_of(rendering.mesh(), tick.after) - read(ticked.position)).norm();
  const double allowed = most * (grid_reach(rendering.mesh(), tick.after) + kSum) + rounding_of(tick);
  // The two parts of a spring that is S long are S cos and S sin of an angle, so that together they are no longer than S√2.
  if (is_drag_beside_shading(rendering) ? size <= std::numbers::sqrt2 * (most * length + allowed)
                                        : size >= K * length - allowed && size <= most * length + allowed)
    return std::nullopt;
  return at(ticked.position) + "the force is " + words(size) + " N; the spring is " + words(length) + " mm long, so " +
         words(K * length) + " N were expected";
}

Violation force_follows_the_spring(const MeshRendering& rendering, const Ticked& one, const Ticked& other) {
  const mesh::GodObject &a = one.tick.after, &b = other.tick.after;
  if (!is_on_surface(one.tick) || !is_on_surface(other.tick)) return std::nullopt;
  if (a.place != b.place || a.index != b.index || a.side != b.side) return std::nullopt;
  const auto [K, most] = stiffness_at(rendering, a);
  // Friction's part is drawn from the normal of the triangle in which the hand pulls, and at an edge that may change.
  if (is_drag_beside_shading(rendering) || K != most) return std::nullopt;
  const double moved = (read(other.position) - read(one.position)).norm() +
                       (point_of(rendering.mesh(), b) - point_of(rendering.mesh(), a)).norm() +
                       2 * grid_reach(rendering.mesh(), a) + 2 * kSum;
  const double allowed = K * moved + rounding_of(one.tick) + rounding_of(other.tick);
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
  if (!(n.error < 1)) return has_area(rendering.mesh(), triangle) ? std::numbers::sqrt2 : 0;
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
    const Stiffness were = stiffness_at(rendering, before.tick.after), are = stiffness_at(rendering, now.tick.after);
    const double K = were.most, L = are.most;
    // The lengths of the springs, mm: of forces, but where friction has a part in them or their stiffness is not known.
    const bool by_points = is_drag_beside_shading(rendering) || were.least < K || are.least < L;
    const double D = by_points && is_on_surface(before.tick) ? (r - p).norm() : F.norm() / K,
                 E = by_points && is_on_surface(now.tick) ? (s - q).norm() : G.norm() / L;
    const double given = F.dot(step);
    const double turned = is_on_surface(before.tick) ? most_turn(rendering, before.tick, r - p, slack) : 0;
    const double stored_at_1 = 0.5 * (D * D - E * E / (growth * growth) + step.squaredNorm()) + turned * D * step.norm();
    const double stored = std::max(were.least * stored_at_1, K * stored_at_1);
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
