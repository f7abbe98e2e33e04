// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <limits>
#include <tuple>

#include "forceshade/meshes.h"
#include "rendering/meshes/border_edges.h"
#include "rendering/meshes/distances.h"
#include "rendering/meshes/pairs.h"
#include "rendering/meshes/weld.h"

namespace forceshade::mesh {
namespace {

struct Box {
  std::array<float, 3> low, high;
};

// Larger by the length, and by what rounding it may lose.
Box around(const std::array<Vertex, 2>& edge, float length) {
  Box box{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto [low, high] = std::minmax(edge[0][axis], edge[1][axis]);
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    box.low[axis] = std::nextafter(low - length, -kInfinity);
    box.high[axis] = std::nextafter(high + length, kInfinity);
  }
  return box;
}

bool are_apart(const Box& a, const Box& b) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (a.low[axis] > b.high[axis] || b.low[axis] > a.high[axis]) return true;
  return false;
}

// That of two edges, or of their other ends where they have an end in common.
SquaredDistance gap(const TriangleMesh& mesh, const BorderEdge& s, const BorderEdge& t) {
  const auto point = [&](std::uint32_t v) { return mesh.vertices[v]; };
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t k = 0; k < 2; ++k)
      if (s.ends[i] == t.ends[k]) return squared(side(point(s.ends[1 - i]), point(t.ends[1 - k])));
  return squared_distance({point(s.ends[0]), point(s.ends[1])}, {point(t.ends[0]), point(t.ends[1])});
}

}  // namespace

SquaredDistance squared_distance(const std::array<Vertex, 2>& s, const std::array<Vertex, 2>& t) {
  SquaredDistance least = squared_distance(s[0], t[0], t[1]);
  for (const SquaredDistance& other :
       {squared_distance(s[1], t[0], t[1]), squared_distance(t[0], s[0], s[1]), squared_distance(t[1], s[0], s[1])})
    least = std::min(least, other);
  // Between their insides, where the lines' nearest points lie in both.
  const WholeVector d = side(s[0], s[1]), e = side(t[0], t[1]), n = cross(d, e), w = side(s[0], t[0]);
  const Whole square = dot(n, n), along_s = dot(cross(w, e), n), along_t = dot(cross(w, d), n), height = dot(w, n);
  const bool is_inside = square > 0 && along_s > 0 && along_s < square && along_t > 0 && along_t < square;
  return is_inside ? std::min(least, SquaredDistance{height * height, square}) : least;
}

Borders borders_of(TriangleMesh mesh, float nearer_than) {
  quantise(mesh);
  const Welded kept = welded(mesh);
  const std::vector<BorderEdge> edges = border_edges(kept.mesh);
  Borders borders;
  borders.edges = edges.size();
  std::vector<Box> boxes;
  for (const auto& [ends, triangle] : edges) {
    const std::array<Vertex, 2> points{mesh.vertices[ends[0]], mesh.vertices[ends[1]]};
    borders.length += root(squared(side(points[0], points[1])));
    boxes.push_back(around(points, nearer_than));
  }
  if (nearer_than == 0) return borders;
  const SquaredDistance most = squared(nearer_than);
  std::vector<std::size_t> order(edges.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::sort(order, {}, [&](std::size_t i) { return std::pair(boxes[i].low[0], i); });
  for (std::size_t place = 0; place < order.size(); ++place)
    for (std::size_t next = place + 1; next < order.size() && boxes[order[next]].low[0] <= boxes[order[place]].high[0];
         ++next) {
      const auto [i, j] = std::minmax(order[place], order[next]);
      if (are_apart(boxes[i], boxes[j])) continue;
      const SquaredDistance distance = gap(kept.mesh, edges[i], edges[j]);
      if (distance.over == 0 || !(distance < most)) continue;
      const auto [one, other] = std::minmax({kept.number[edges[i].triangle], kept.number[edges[j].triangle]});
      borders.cracks.push_back({{one, other}, mesh.vertices[edges[i].ends[0]], root(distance)});
    }
  std::ranges::sort(borders.cracks, {},
                    [](const Crack& crack) { return std::tuple(crack.triangles, crack.distance, crack.near); });
  const auto is_same_pair = [](const Crack& a, const Crack& b) { return a.triangles == b.triangles; };
  borders.cracks.erase(std::unique(borders.cracks.begin(), borders.cracks.end(), is_same_pair), borders.cracks.end());
  return borders;
}

}  // namespace forceshade::mesh
