// SPDX-License-Identifier: BSD-3-Clause
#include "properties/mesh_path.h"

#include <cmath>
#include <limits>

#include "properties/binary32.h"
#include "properties/mesh_points.h"

namespace forceshade::properties {
namespace {

float in_domain(double value) {
  return static_cast<float>(kept_in_domain(value));
}

}  // namespace

MeshPath::MeshPath(const mesh::TriangleMesh& mesh, std::uint64_t seed) : Draws(seed), mesh_(mesh), size_(size_of(mesh)) {}

Point MeshPath::corner(std::size_t triangle, std::size_t i) const {
  return wide(mesh_.vertices[mesh_.triangles[triangle][i]]);
}

Point MeshPath::normal(std::size_t triangle) const {
  const Point a = corner(triangle, 0);
  return scaled_to(cross(difference(corner(triangle, 1), a), difference(corner(triangle, 2), a)), 1);
}

Point MeshPath::vertex() {
  return corner(any_triangle(), bits() % 3);
}

// A corner, a point of a side, or any point; at binary fractions as often as not, so that it may be exact.
Point MeshPath::surface_point(std::size_t triangle) {
  const auto fraction = [&](double most) {
    return bits() % 2 == 0 ? uniform(0, most) : most * static_cast<double>(bits() % 9) / 8;
  };
  const double beta = bits() % 4 == 0 ? 0 : fraction(1), gamma = bits() % 4 == 0 ? 0 : fraction(1 - beta);
  const Point a = corner(triangle, 0), b = corner(triangle, 1), c = corner(triangle, 2);
  Point point{};
  for (std::size_t axis = 0; axis < 3; ++axis) point[axis] = a[axis] + beta * (b[axis] - a[axis]) + gamma * (c[axis] - a[axis]);
  return point;
}

void MeshPath::begin_stretch() {
  kind_ = static_cast<PathKind>(bits() % kPathKinds.size());
  left_ = 1 + static_cast<int>(bits() % 40);
  reach_ = std::pow(10, uniform(-9, 3));
  if (bits() % 2 == 0) reach_ = size_ * std::pow(10, uniform(-6, 0));
  const std::size_t triangle = any_triangle();
  const Point towards = normal(triangle), on_surface = surface_point(triangle);
  const double depth = size_ * std::pow(10, uniform(-6, 0)) * (bits() % 4 == 0 ? 1 : -1);
  switch (kind_) {
    case PathKind::walk: break;  // from where it is
    case PathKind::stroke: {
      const Point other = surface_point(any_triangle());
      for (std::size_t axis = 0; axis < 3; ++axis) {
        at_[axis] = on_surface[axis] + depth * towards[axis];
        step_[axis] = (other[axis] + depth * towards[axis] - at_[axis]) / left_;
      }
      break;
    }
    case PathKind::press:
      for (std::size_t axis = 0; axis < 3; ++axis) {
        at_[axis] = on_surface[axis] - depth * towards[axis];
        step_[axis] = 2 * depth * towards[axis] / left_;
      }
      break;
    case PathKind::graze:  // to and fro, down to less than a grid step of the surface apart
      reach_ = size_ * std::pow(10, uniform(-10, -6));
      at_ = on_surface;
      step_ = towards;
      break;
    case PathKind::axis_parallel: {
      const std::size_t axis = bits() % 3;
      at_ = bits() % 2 == 0 ? vertex() : on_surface;
      step_ = {};
      step_[axis] = (bits() % 2 == 0 ? 1 : -1) * (bits() % 2 == 0 ? size_ : reach_);
      for (double& length : step_) length = std::ldexp(std::round(std::ldexp(length, 8)), -8);
      at_[axis] -= left_ / 2 * step_[axis];
      break;
    }
    case PathKind::on_surface:
    case PathKind::beside_vertex:
    case PathKind::jump:
    case PathKind::few_bits: break;
    case PathKind::domain_end:
    case PathKind::invalid: left_ = 1 + left_ / 16;
  }
}

Point MeshPath::advanced() {
  switch (kind_) {
    case PathKind::walk:
      return {at_[0] + uniform(-reach_, reach_), at_[1] + uniform(-reach_, reach_), at_[2] + uniform(-reach_, reach_)};
    case PathKind::graze: return at_;
    case PathKind::on_surface: return surface_point(any_triangle());
    case PathKind::beside_vertex: {
      Point point = vertex();
      for (double& x : point) x = static_cast<double>(neighbour(static_cast<float>(x), small_step()));
      return point;
    }
    case PathKind::jump: {
      Point point = vertex();
      for (double& x : point) x += uniform(-size_, size_);
      return point;
    }
    case PathKind::few_bits: {
      Point point = vertex();
      for (double& x : point) x = std::round(x) + static_cast<double>(few_bits(size_));
      return point;
    }
    case PathKind::domain_end: {
      Point point = vertex();
      point[bits() % 3] = static_cast<double>(domain_end());
      return point;
    }
    default: return {at_[0] + step_[0], at_[1] + step_[1], at_[2] + step_[2]};
  }
}

std::array<float, 3> MeshPath::next() {
  if (left_ == 0) begin_stretch();
  --left_;
  if (bits() % 8 != 0) at_ = advanced();
  if (kind_ == PathKind::graze) {
    const double off = uniform(-reach_, reach_);
    return {in_domain(at_[0] + off * step_[0]), in_domain(at_[1] + off * step_[1]), in_domain(at_[2] + off * step_[2])};
  }
  std::array<float, 3> position{in_domain(at_[0]), in_domain(at_[1]), in_domain(at_[2])};
  if (kind_ == PathKind::invalid) {
    constexpr std::array<float, 4> kInvalid{std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                                            -std::numeric_limits<float>::infinity(), 10000.001F};
    position[bits() % 3] = kInvalid[bits() % kInvalid.size()];
  }
  return position;
}

}  // namespace forceshade::properties
