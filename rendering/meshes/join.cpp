// SPDX-License-Identifier: BSD-3-Clause
#include "rendering/meshes/join.h"

#include <algorithm>
#include <optional>
#include <stdexcept>

#include "rendering/meshes/border_edges.h"
#include "rendering/meshes/distances.h"
#include "text/number_text.h"

namespace forceshade::mesh {
namespace {

// Points that can be found by where they are.
class Near {
 public:
  Near(const TriangleMesh& mesh, std::vector<std::uint32_t> vertices) : mesh_(mesh), sorted_(std::move(vertices)) {
    std::ranges::sort(sorted_, {}, [&](std::uint32_t v) { return std::pair(mesh_.vertices[v][0], v); });
  }
  // Calls vertex(v) for all whose first coordinate is from `low` to `high`, and maybe more.
  template <class Vertex>
  void between(float low, float high, const Vertex& vertex) const {
    const auto x = [&](std::uint32_t v) { return mesh_.vertices[v][0]; };
    const auto is_below = [&](std::uint32_t v, float least) { return x(v) < least; };
    for (auto at = std::lower_bound(sorted_.begin(), sorted_.end(), low, is_below); at != sorted_.end() && x(*at) <= high; ++at)
      vertex(*at);
  }

 private:
  const TriangleMesh& mesh_;
  std::vector<std::uint32_t> sorted_;
};

float below(float x, float length) {
  return std::nextafter(x - length, -HUGE_VALF);
}
float above(float x, float length) {
  return std::nextafter(x + length, HUGE_VALF);
}

void expect_faces_to_stay(const TriangleMesh& mesh, const std::vector<std::uint32_t>& onto, float length,
                          const std::vector<std::uint32_t>& number) {
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& [a, b, c] = mesh.triangles[i];
    if (onto[a] == a && onto[b] == b && onto[c] == c) continue;
    const auto point = [&](std::uint32_t v) -> const Vertex& { return mesh.vertices[v]; };
    const auto normal = [&](std::uint32_t u, std::uint32_t v, std::uint32_t w) {
      return cross(side(point(u), point(v)), side(point(u), point(w)));
    };
    const WholeVector before = normal(a, b, c), after = normal(onto[a], onto[b], onto[c]);
    if (dot(before, after) > 0) continue;
    const bool is_flat = std::ranges::all_of(after, [](const Whole& component) { return component == 0; });
    throw std::invalid_argument(
        "face " + std::to_string(number[i]) + (is_flat ? " would lose its area" : " would turn by a right angle or more") +
        "; expected a length below the sides of the faces at the borders, got " + shortest(length) + " mm");
  }
}

}  // namespace

Join join_borders(const TriangleMesh& mesh, float length, const std::vector<std::uint32_t>& number) {
  const std::vector<BorderEdge> edges = border_edges(mesh);
  std::vector<std::uint32_t> ends;
  for (const BorderEdge& edge : edges) ends.insert(ends.end(), edge.ends.begin(), edge.ends.end());
  std::ranges::sort(ends);
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  Join join;
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) join.onto.push_back(v);
  const Near near(mesh, ends);
  const SquaredDistance most = squared(length);
  for (const std::uint32_t v : ends) {
    std::optional<std::pair<SquaredDistance, std::uint32_t>> nearest;
    near.between(below(mesh.vertices[v][0], length), above(mesh.vertices[v][0], length), [&](std::uint32_t other) {
      if (other >= v || join.onto[other] != other) return;
      const SquaredDistance distance = squared(side(mesh.vertices[v], mesh.vertices[other]));
      if (most < distance) return;
      if (!nearest || distance < nearest->first || (!(nearest->first < distance) && other < nearest->second))
        nearest = {distance, other};
    });
    if (nearest) join.onto[v] = nearest->second;
  }
  expect_faces_to_stay(mesh, join.onto, length, number);
  for (const auto& [between, triangle] : edges) {
    const std::uint32_t from = join.onto[between[0]], to = join.onto[between[1]];
    const Vertex &a = mesh.vertices[from], &b = mesh.vertices[to];
    near.between(below(std::min(a[0], b[0]), length), above(std::max(a[0], b[0]), length), [&](std::uint32_t v) {
      if (join.onto[v] != v || v == from || v == to) return;
      const SquaredDistance distance = squared_distance(mesh.vertices[v], a, b);
      if (distance.over > 0 && !(most < distance)) join.beside.push_back(v);
    });
  }
  std::ranges::sort(join.beside);
  join.beside.erase(std::unique(join.beside.begin(), join.beside.end()), join.beside.end());
  return join;
}

}  // namespace forceshade::mesh
