// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/naive_mesh.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace forceshade::bench {

using Eigen::Vector3f;

namespace {
constexpr float kEpsilon = 1e-4F;  // mm
constexpr std::uint32_t kLeaf = 4;
}  // namespace

NaiveGodObject::NaiveGodObject(const mesh::TriangleMesh& mesh, float stiffness, const mesh::CornerNormals& normals)
    : stiffness_(stiffness) {
  std::vector<Corner3> corners;
  for (const mesh::Triangle& t : mesh.triangles) {
    const auto at = [&](std::size_t i) { return Vector3f(mesh.vertices[t[i]].data()); };
    corners.push_back({at(0), at(1), at(2)});
  }
  std::vector<std::uint32_t> order(corners.size());
  std::iota(order.begin(), order.end(), 0U);
  nodes_.reserve(corners.size());
  nodes_.emplace_back();
  split(0, 0, static_cast<std::uint32_t>(order.size()), order, corners);
  for (const std::uint32_t t : order) triangles_.push_back(corners[t]);
  if (normals.empty()) return;
  for (const std::uint32_t t : order)
    normals_.push_back({Vector3f(normals[t][0].data()), Vector3f(normals[t][1].data()), Vector3f(normals[t][2].data())});
}

void NaiveGodObject::split(std::uint32_t node, std::uint32_t begin, std::uint32_t end, std::vector<std::uint32_t>& order,
                           const std::vector<Corner3>& corners) {
  Vector3f low = Vector3f::Constant(HUGE_VALF), high = -low;
  for (std::uint32_t i = begin; i < end; ++i) {
    const Corner3& t = corners[order[i]];
    low = low.cwiseMin(t.a).cwiseMin(t.b).cwiseMin(t.c);
    high = high.cwiseMax(t.a).cwiseMax(t.b).cwiseMax(t.c);
  }
  nodes_[node] = {low, high, begin, end - begin};
  if (end - begin <= kLeaf) return;
  int axis = 0;
  (high - low).maxCoeff(&axis);
  const std::uint32_t middle = (begin + end) / 2;
  std::nth_element(order.begin() + begin, order.begin() + middle, order.begin() + end, [&](std::uint32_t s, std::uint32_t t) {
    return (corners[s].a + corners[s].b + corners[s].c)[axis] < (corners[t].a + corners[t].b + corners[t].c)[axis];
  });
  const auto children = static_cast<std::uint32_t>(nodes_.size());
  nodes_[node].first = children;
  nodes_[node].count = 0;
  nodes_.emplace_back();
  nodes_.emplace_back();
  split(children, begin, middle, order, corners);
  split(children + 1, middle, end, order, corners);
}

NaiveGodObject::RayHit NaiveGodObject::cast(const Vector3f& from, const Vector3f& by) const {
  RayHit best{1, ~0U};
  const Vector3f inverse = by.cwiseInverse();
  std::uint32_t stack[64];
  int count = 0;
  stack[count++] = 0;
  while (count > 0) {
    const Node& node = nodes_[stack[--count]];
    const Vector3f near = (node.low - from).cwiseProduct(inverse), far = (node.high - from).cwiseProduct(inverse);
    const float enter = std::max(0.0F, near.cwiseMin(far).maxCoeff()), leave = std::min(best.t, near.cwiseMax(far).minCoeff());
    if (!(enter <= leave)) continue;
    if (node.count == 0) {
      stack[count++] = node.first;
      stack[count++] = node.first + 1;
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      const Corner3& t = triangles_[i];
      const Vector3f e1 = t.b - t.a, e2 = t.c - t.a, p = by.cross(e2);
      const float det = e1.dot(p);
      if (det < 1e-12F) continue;  // from behind, or along it
      const Vector3f w = from - t.a, q = w.cross(e1);
      const float u = w.dot(p) / det, v = by.dot(q) / det, s = e2.dot(q) / det;
      if (u >= 0 && v >= 0 && u + v <= 1 && s >= 0 && s < best.t) best = {s, i};
    }
  }
  return best;
}

Vector3f NaiveGodObject::interpolated_normal(std::uint32_t i) const {
  const Corner3 &t = triangles_[i], &normal = normals_[i];
  const Vector3f e1 = t.b - t.a, e2 = t.c - t.a, n = e1.cross(e2), w = place_ - t.a;
  const float second = w.cross(e2).dot(n) / n.squaredNorm(), third = e1.cross(w).dot(n) / n.squaredNorm();
  return ((1 - second - third) * normal.a + second * normal.b + third * normal.c).normalized();
}

Vector3f NaiveGodObject::step(const Vector3f& position) {
  if (!has_place_) {
    place_ = position;
    has_place_ = true;
    return Vector3f::Zero();
  }
  Vector3f planes[3];
  int count = 0;
  Vector3f goal = position;
  std::uint32_t touched = ~0U;
  for (int i = 0; i < 10; ++i) {
    const Vector3f by = goal - place_;
    if (by.squaredNorm() < 1e-12F) break;
    const RayHit hit = cast(place_, by);
    if (hit.triangle == ~0U) {
      place_ = goal;
      break;
    }
    touched = hit.triangle;
    const Corner3& t = triangles_[hit.triangle];
    const Vector3f n = (t.b - t.a).cross(t.c - t.a).normalized();
    place_ += hit.t * by + kEpsilon * n;
    if (count == 3) break;
    planes[count++] = n;
    // The point nearest to the position on all planes that have been met.
    const Vector3f to = position - place_;
    if (count == 1) {
      goal = place_ + to - to.dot(n) * n;
    } else if (count == 2) {
      const Vector3f line = planes[0].cross(planes[1]);
      const float length = line.squaredNorm();
      goal = length > 1e-6F ? Vector3f(place_ + to.dot(line) / length * line) : Vector3f(place_ + to - to.dot(n) * n);
    } else {
      break;
    }
  }
  if (touched == ~0U) return Vector3f::Zero();
  const Vector3f spring = place_ - position;
  return normals_.empty() ? Vector3f(stiffness_ * spring) : Vector3f(stiffness_ * spring.norm() * interpolated_normal(touched));
}

}  // namespace forceshade::bench
