// SPDX-License-Identifier: BSD-3-Clause
#include "reference/meshes/points.h"

#include <algorithm>
#include <vector>

namespace forceshade::reference::meshes {
namespace {

using mesh::Place;

Fraction in_grid_units(const Fraction& parameter) {
  return {parameter.over * kGrid, parameter.under};
}

std::uint32_t grid_number(const Integer& value) {
  return value.convert_to<std::uint32_t>();
}

std::uint32_t floor_number(const Fraction& value) {
  return grid_number(floor(value));
}

std::uint32_t ceiling_number(const Fraction& value) {
  return grid_number(-floor({-value.over, value.under}));
}

Fraction sum(const Fraction& a, const Fraction& b) {
  if (a.under == b.under) return {a.over + b.over, a.under};
  return {a.over * b.under + b.over * a.under, a.under * b.under};
}

// Ties to even, within 1 and 2^24 - 1.
std::uint32_t nearest_inside(const Fraction& value) {
  std::uint32_t number = floor_number(value);
  const auto past_half = Fraction{2 * value.over, value.under} <=> Fraction{2 * Integer(number) + 1, 1};
  if (past_half > 0 || (past_half == 0 && number % 2 == 1)) ++number;
  return std::clamp(number, 1U, kGrid - 1);
}

using Corner = std::array<std::uint32_t, 2>;  // k, l

// The corners of the part of the triangle's grid that the point with these parameters is in, in the order in which ties are
// decided: the point itself, the ends of a segment, or the corners of a triangle.
std::vector<Corner> grid_around(const Fraction& k, const Fraction& l) {
  const auto [whole_k, k_is_whole] = floor_of(k);
  const auto [whole_l, l_is_whole] = floor_of(l);
  const std::uint32_t K = grid_number(whole_k), L = grid_number(whole_l);
  if (k_is_whole && l_is_whole) return {{K, L}};
  if (k_is_whole) return {{K, L}, {K, L + 1}};
  if (l_is_whole) return {{K, L}, {K + 1, L}};
  const auto [whole_both, both_is_whole] = floor_of(sum(k, l));
  const std::uint32_t diagonal = grid_number(whole_both);
  if (both_is_whole) return {{K, diagonal - K}, {K + 1, diagonal - K - 1}};
  if (diagonal == K + L) return {{K, L}, {K, L + 1}, {K + 1, L}};
  return {{K, L + 1}, {K + 1, L}, {K + 1, L + 1}};
}

// The first of those that are nearest to p.
GridPoint nearest(const Surface& surface, const std::vector<GridPoint>& points, const Vector& p) {
  if (points.size() == 1) return points.front();
  std::vector<Integer> distances;
  for (const GridPoint& point : points) {
    const Vector off = surface.position(point) - p;
    distances.push_back(dot(off, off));
  }
  return points[static_cast<std::size_t>(std::ranges::min_element(distances) - distances.begin())];
}

}  // namespace

SurfacePoint exactly(const GridPoint& point) {
  return {point.feature, {Fraction{point.parameter[0], kGrid}, Fraction{point.parameter[1], kGrid}}};
}

SurfacePoint foot(const Surface& surface, const Feature& feature, const Vector& p) {
  if (feature.place == Place::vertex) return {feature, {}};
  if (feature.place == Place::edge) {
    const Edge& edge = surface.edges()[feature.index];
    return {feature, {Fraction{dot(p - surface.vertices()[edge.vertices[0]], edge.along), edge.length_squared}, {}}};
  }
  const Triangle& triangle = surface.triangles()[feature.index];
  const Vector w = p - surface.vertices()[triangle.vertices[0]];
  // The weight of a corner is w's height over the opposite side, in parts of the corner's own, which is |n|² here, too.
  return {feature,
          {Fraction{dot(triangle.inward[2], w), triangle.normal_squared},
           Fraction{dot(triangle.inward[0], w), triangle.normal_squared}}};
}

bool is_inside(const SurfacePoint& point) {
  const auto& [first, second] = point.parameter;
  if (point.feature.place == Place::vertex) return true;
  if (point.feature.place == Place::edge) return first.over > 0 && first.over < first.under;
  return first.over > 0 && second.over > 0 && sum(first, second) < Fraction{1, 1};
}

SurfacePoint part_of_way(const SurfacePoint& from, const SurfacePoint& to, const Integer& share) {
  SurfacePoint point = to;
  for (std::size_t i = 0; i < 2; ++i) {
    Fraction& parameter = point.parameter[i];  // over the same denominator as that of `from`
    parameter = {(kGrid - share) * from.parameter[i].over + share * parameter.over, kGrid * parameter.under};
  }
  return point;
}

SurfacePoint on_side(const Surface& surface, std::size_t triangle, std::size_t side, const Fraction& t) {
  const mesh::Triangle& corners = surface.triangles()[triangle].vertices;
  const std::uint32_t from = corners[side], to = corners[(side + 1) % 3];
  if (t.over.is_zero()) return {{Place::vertex, from}, {}};
  if (t.over == t.under) return {{Place::vertex, to}, {}};
  return {{Place::edge, surface.triangles()[triangle].edges[side]}, {from < to ? t : Fraction{t.under - t.over, t.under}, {}}};
}

GridPoint rounded_towards(const Surface& surface, const SurfacePoint& point, const Vector& p) {
  const auto [place, index] = point.feature;
  if (place == Place::vertex) return {point.feature, {}};
  const Fraction first = in_grid_units(point.parameter[0]), second = in_grid_units(point.parameter[1]);
  std::vector<GridPoint> around;
  if (place == Place::edge) {
    around.push_back(surface.on_edge(index, floor_number(first)));
    around.push_back(surface.on_edge(index, ceiling_number(first)));
  } else {
    for (const auto& [k, l] : grid_around(first, second)) around.push_back(surface.in_triangle(index, k, l));
  }
  return nearest(surface, around, p);
}

GridPoint rounded_inside(const SurfacePoint& point) {
  const auto [place, index] = point.feature;
  if (place == Place::vertex) return {point.feature, {}};
  std::uint32_t k = nearest_inside(in_grid_units(point.parameter[0]));
  if (place == Place::edge) return {point.feature, {k, 0}};
  std::uint32_t l = nearest_inside(in_grid_units(point.parameter[1]));
  const std::uint32_t excess = k + l > kGrid - 1 ? k + l - (kGrid - 1) : 0;
  (k >= l ? k : l) -= excess;
  return {point.feature, {k, l}};
}

}  // namespace forceshade::reference::meshes
