// SPDX-License-Identifier: BSD-3-Clause
#include "reference/soups/soup.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <map>
#include <optional>

#include "reference/position.h"

namespace forceshade::reference::soups {
namespace {

using Names = std::vector<std::uint32_t>;

// The lowest index of a used vertex with the same coordinates, by index.
Names names_of(const mesh::TriangleMesh& mesh) {
  std::vector<bool> is_used(mesh.vertices.size());
  for (const mesh::Triangle& triangle : mesh.triangles)
    for (const std::uint32_t v : triangle) is_used[v] = true;
  std::map<std::array<float, 3>, std::uint32_t> first;
  Names names(mesh.vertices.size());
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
    if (!is_used[v]) continue;
    names[v] = first.emplace(quantised(mesh.vertices[v]), v).first->second;
  }
  return names;
}

Vector normal_of(const std::array<Vector, 3>& corner) {
  return cross(corner[1] - corner[0], corner[2] - corner[0]);
}

// Around a number. The nearest binary64 towards 0 is less than one step away.
std::array<double, 2> ends_of(const Rational& value) {
  const double towards_zero = value.convert_to<double>();
  return {std::nextafter(towards_zero, -HUGE_VAL), std::nextafter(towards_zero, HUGE_VAL)};
}

Box box_of(std::initializer_list<const Vector*> points) {
  Box box{{HUGE_VAL, HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}};
  for (const Vector* point : points) {
    std::size_t axis = 0;
    for (const Rational* coordinate : {&point->x, &point->y, &point->z}) {
      const auto [low, high] = ends_of(*coordinate);
      box.low[axis] = std::min(box.low[axis], low);
      box.high[axis] = std::max(box.high[axis], high);
      ++axis;
    }
  }
  return box;
}

bool are_apart(const Box& a, const Box& b) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (a.low[axis] > b.high[axis] || b.low[axis] > a.high[axis]) return true;
  return false;
}

}  // namespace

std::array<float, 3> quantised(const std::array<float, 3>& millimetres) {
  return {reference::quantised(millimetres[0]), reference::quantised(millimetres[1]), reference::quantised(millimetres[2])};
}

Vector exact_point(const std::array<float, 3>& millimetres) {
  const auto [x, y, z] = quantised(millimetres);
  return {Rational(x), Rational(y), Rational(z)};
}

bool Triangle::holds(const Vector& x) const {
  return has_in_plane(x) && inside(0, x) >= 0 && inside(1, x) >= 0 && inside(2, x) >= 0;
}

bool Triangle::holds_strictly(const Vector& x) const {
  return has_in_plane(x) && inside(0, x) > 0 && inside(1, x) > 0 && inside(2, x) > 0;
}

std::array<Rational, 2> Triangle::weights(const Vector& x) const {
  const Rational area = squared(normal);
  return {inside(2, x) / area, inside(0, x) / area};
}

Soup::Soup(const mesh::TriangleMesh& mesh, const std::vector<mesh::Sides>& sides,
           const std::vector<mesh::Material>& materials) {
  const Names names = names_of(mesh);
  for (const mesh::Vertex& vertex : mesh.vertices) vertices_.push_back(exact_point(vertex));
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& [a, b, c] = mesh.triangles[i];
    const std::array<Vector, 3> corner{vertices_[a], vertices_[b], vertices_[c]};
    const Vector normal = normal_of(corner);
    if (is_zero(normal)) continue;
    const mesh::Sides blocks = sides.size() == 1 ? sides.front() : sides[i];
    const mesh::Material material = materials.empty() ? mesh::Material{} : materials[i];
    triangles_.push_back({i,
                          {names[a], names[b], names[c]},
                          corner,
                          normal,
                          blocks == mesh::Sides::both,
                          material.static_friction,
                          material.dynamic_friction});
    boxes_.push_back(box_of({&corner[0], &corner[1], &corner[2]}));
  }
}

const Triangle& Soup::numbered(std::size_t number) const {
  return *std::ranges::lower_bound(triangles_, number, {}, &Triangle::number);
}

std::vector<const Triangle*> Soup::holding(const Vector& x) const {
  const Box around = box_of({&x});
  std::vector<const Triangle*> all;
  for (std::size_t i = 0; i < triangles_.size(); ++i)
    if (!are_apart(around, boxes_[i]) && triangles_[i].holds(x)) all.push_back(&triangles_[i]);
  return all;
}

// A way and a box are apart only if one of these shows it: an axis, or what is seen along it.
std::size_t Soup::looks(const Vector& a, const Vector& b) const {
  const Vector along = b - a;
  const auto list = [](const Vector& v) { return std::array<const Rational*, 3>{&v.x, &v.y, &v.z}; };
  const auto from = list(a), to = list(b), by = list(along);
  const Box around = box_of({&a, &b});
  const auto meets = [&](std::size_t i) {
    if (are_apart(around, boxes_[i])) return false;
    std::array<std::array<Rational, 2>, 3> ends;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto at = [&](std::size_t corner) { return *list(triangles_[i].corner[corner])[axis]; };
      const auto [low, high] = std::minmax({at(0), at(1), at(2)});
      if ((*from[axis] < low && *to[axis] < low) || (*from[axis] > high && *to[axis] > high)) return false;
      ends[axis] = {low, high};
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t j = (axis + 1) % 3, k = (axis + 2) % 3;
      std::array<int, 2> corners{};  // on either side of the line
      for (const Rational& at_j : ends[j])
        for (const Rational& at_k : ends[k]) {
          const Rational off = *by[j] * (at_k - *from[k]) - *by[k] * (at_j - *from[j]);
          if (!off.is_zero()) ++corners[off < 0 ? 0 : 1];
        }
      if (corners[0] == 4 || corners[1] == 4) return false;
    }
    return true;
  };
  std::size_t count = 0;
  for (std::size_t i = 0; i < triangles_.size(); ++i) count += meets(i) ? 1 : 0;
  return count;
}

std::vector<Rational> Soup::changes(const Vector& from, const Vector& along, const Rational& most) const {
  std::vector<Rational> all;
  const auto add = [&](const Rational& t) {
    if (t > 0 && t <= most) all.push_back(t);
  };
  const Vector end = from + most * along;
  const Box around = box_of({&from, &end});
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    if (are_apart(around, boxes_[i])) continue;
    const Triangle& triangle = triangles_[i];
    const Rational slope = dot(triangle.normal, along), height = dot(triangle.normal, triangle.corner[0] - from);
    if (!slope.is_zero()) {
      const Rational t = height / slope;
      if (t > 0 && t <= most && triangle.holds(from + t * along)) all.push_back(t);
      continue;
    }
    if (!height.is_zero()) continue;
    // The line lies in the triangle's plane, and in the triangle from one number to another.
    std::optional<Rational> first, last;
    bool is_outside = false;
    for (std::size_t side = 0; side < 3; ++side) {
      const Rational inside = triangle.inside(side, from), grows = dot(cross(triangle.side(side), along), triangle.normal);
      if (grows.is_zero()) {
        is_outside |= inside < 0;
        continue;
      }
      const Rational t = -inside / grows;
      if (grows > 0)
        first = first ? std::max(*first, t) : t;
      else
        last = last ? std::min(*last, t) : t;
    }
    if (is_outside || *first > *last) continue;
    add(*first);
    add(*last);
  }
  std::ranges::sort(all);
  all.erase(std::ranges::unique(all).begin(), all.end());
  return all;
}

}  // namespace forceshade::reference::soups
