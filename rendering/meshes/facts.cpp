// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>

#include "forceshade/meshes.h"
#include "rendering/half_edges.h"
#include "rendering/largest_fan.h"
#include "rendering/vectors.h"

namespace forceshade::mesh {
namespace {

using Vector = std::array<double, 3>;

Vector wide_difference(const Vertex& a, const Vertex& b) {
  Vector result;
  for (std::size_t i = 0; i < 3; ++i) result[i] = static_cast<double>(a[i]) - static_cast<double>(b[i]);
  return result;
}

std::uint64_t count_parts(const std::vector<std::uint32_t>& opposite) {
  std::uint64_t parts = 0;
  std::vector<bool> is_met(opposite.size() / 3, false);
  std::vector<std::uint32_t> next;
  for (std::uint32_t first = 0; first < is_met.size(); ++first) {
    if (is_met[first]) continue;
    ++parts;
    is_met[first] = true;
    next.assign(1, first);
    while (!next.empty()) {
      const std::uint32_t i = next.back();
      next.pop_back();
      for (std::uint32_t h = 3 * i; h < 3 * i + 3; ++h) {
        if (opposite[h] == kNoEdge || is_met[opposite[h] / 3]) continue;
        is_met[opposite[h] / 3] = true;
        next.push_back(opposite[h] / 3);
      }
    }
  }
  return parts;
}

}  // namespace

Facts facts_of(const CheckedMesh& checked) {
  const TriangleMesh& mesh = checked.mesh();
  const std::vector<std::uint32_t> opposite = opposite_half_edges(mesh);
  Facts facts;
  facts.vertices = mesh.vertices.size();
  facts.triangles = mesh.triangles.size();
  facts.parts = count_parts(opposite);
  facts.low = facts.high = mesh.vertices[mesh.triangles[0][0]];
  facts.shortest_edge = std::numeric_limits<double>::infinity();
  std::vector<bool> is_used(mesh.vertices.size(), false);
  for (std::uint32_t h = 0; h < opposite.size(); ++h) {
    const Vertex &a = mesh.vertices[start_of(mesh, h)], &b = mesh.vertices[end_of(mesh, h)];
    is_used[start_of(mesh, h)] = true;
    for (std::size_t i = 0; i < 3; ++i) {
      facts.low[i] = std::min(facts.low[i], a[i]);
      facts.high[i] = std::max(facts.high[i], a[i]);
    }
    if (opposite[h] != kNoEdge && opposite[h] < h) continue;
    ++facts.edges;
    facts.rim_edges += opposite[h] == kNoEdge ? 1 : 0;
    const Vector edge = wide_difference(a, b);
    const double length = std::sqrt(dot(edge, edge));
    facts.shortest_edge = std::min(facts.shortest_edge, length);
    facts.longest_edge = std::max(facts.longest_edge, length);
  }
  facts.unused_vertices = static_cast<std::uint64_t>(std::count(is_used.begin(), is_used.end(), false));
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vector u = wide_difference(mesh.vertices[b], mesh.vertices[a]),
                 v = wide_difference(mesh.vertices[c], mesh.vertices[a]);
    const Vector n = cross(u, v);
    facts.area += std::sqrt(dot(n, n)) / 2;
    facts.volume += dot(n, wide_difference(mesh.vertices[a], facts.low)) / 6;
  }
  if (!facts.is_closed()) facts.volume = 0;
  return facts;
}

LargestFan largest_fan(const TriangleMesh& mesh) {
  const auto [vertex, triangles] = vertex_of_most(mesh);
  return {vertex, triangles};
}

}  // namespace forceshade::mesh
