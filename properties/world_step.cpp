// SPDX-License-Identifier: BSD-3-Clause
#include "properties/world_step.h"

#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>

#include "properties/binary32.h"
#include "rendering/vectors.h"
#include "text/formatted.h"

namespace forceshade::properties {
namespace {

using Number = boost::multiprecision::cpp_bin_float_50;
using Vector = std::array<Number, 3>;
using mesh::cross, mesh::difference, mesh::dot;

Vector vector_of(const Eigen::Vector3f& a) {
  return {Number(a.x()), Number(a.y()), Number(a.z())};
}

// v + 2 u x (u x v + w v) / |q|², of the quaternion q = (w, u) or, backwards, (w, -u).
Vector rotated(const scene::Pose& pose, const Vector& v, bool is_backwards) {
  const auto& [w, x, y, z] = pose.rotation;
  const Number sign = is_backwards ? -1 : 1, real = w;
  const Vector u{sign * x, sign * y, sign * z};
  const Vector once = cross(u, v);
  const Vector twice = cross(u, {once[0] + real * v[0], once[1] + real * v[1], once[2] + real * v[2]});
  const Number factor = 2 / (real * real + dot(u, u));
  return {v[0] + factor * twice[0], v[1] + factor * twice[1], v[2] + factor * twice[2]};
}

Vector translation_of(const scene::Pose& pose) {
  return vector_of(Eigen::Vector3f(pose.translation.data()));
}

// The position of the world as an object of this pose sees it.
Vector seen(const scene::Pose& pose, const Vector& position) {
  return rotated(pose, difference(position, translation_of(pose)), true);
}

double wide(const Number& a) {
  return static_cast<double>(a);
}

}  // namespace

Eigen::Vector3f in_world(const scene::Pose& pose, const Eigen::Vector3f& point) {
  if (!point.allFinite()) return point;
  const Vector turned = rotated(pose, vector_of(point), false), moved = translation_of(pose);
  Eigen::Vector3f world;
  for (std::size_t axis = 0; axis < 3; ++axis)
    world[static_cast<Eigen::Index>(axis)] = static_cast<float>(turned[axis] + moved[axis]);
  return world;
}

WorkOfTick::WorkOfTick(const Eigen::Vector3f& from, const Eigen::Vector3f& to) : from_(from), to_(to) {}

void WorkOfTick::add(const ContactOfTick& contact) {
  const Vector to = vector_of(to_), force = vector_of(contact.force);
  const Number of_object = dot(force, difference(vector_of(contact.seen_next), vector_of(contact.seen)));
  const Number of_motion = dot(force, difference(seen(contact.next, to), seen(contact.now, to)));
  expected_ += wide(of_object - of_motion);
  // A coordinate is seen within half a unit of its last place, or is below the quantum of 2^-30 mm; so are those in the world.
  constexpr double kQuantum = 0x1p-30;
  for (const Eigen::Vector3f* place : {&contact.seen, &contact.seen_next})
    for (Eigen::Index axis = 0; axis < 3; ++axis)
      allowed_ += std::fabs(static_cast<double>(contact.force[axis])) * (half_spacing((*place)[axis]) + kQuantum);
  const double size = contact.force.cast<double>().lpNorm<1>();
  allowed_ += size * (8 * kQuantum + 1e-15 * (from_ - to_).cast<double>().lpNorm<1>());
}

Violation WorkOfTick::difference_from(const Eigen::Vector3f& force) const {
  const Vector step = difference(vector_of(to_), vector_of(from_));
  const double got = wide(dot(vector_of(force), step));
  double allowed = allowed_ + 1e-12 * (std::fabs(got) + std::fabs(expected_));
  for (std::size_t axis = 0; axis < 3; ++axis)
    allowed += half_spacing(force[static_cast<Eigen::Index>(axis)]) * std::fabs(wide(step[axis]));
  if (std::fabs(got - expected_) <= allowed) return std::nullopt;
  return formatted("the force does %.9g mJ on the hand; the objects and their motions do %.9g, within %.3g", got, expected_,
                   allowed);
}

}  // namespace forceshade::properties
