// SPDX-License-Identifier: BSD-3-Clause
#include "rendering/meshes/join.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "rendering/meshes/border_edges.h"
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

std::vector<std::uint32_t> ends_of(const std::vector<BorderEdge>& edges) {
  std::vector<std::uint32_t> ends;
  for (const BorderEdge& edge : edges) ends.insert(ends.end(), edge.ends.begin(), edge.ends.end());
  std::ranges::sort(ends);
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  return ends;
}

class Joining {
 public:
  Joining(const TriangleMesh& mesh, float length, const std::vector<std::uint32_t>& number)
      : mesh_(mesh), length_(length), most_(squared(length)), number_(number), moved_(mesh) {}

  Join run() {
    move();
    split();
    return std::move(join_);
  }

 private:
  struct Beside {
    Whole share;  // along the edge, times the square of its length
    std::uint32_t vertex;
    SquaredDistance distance;
  };

  const Vertex& point(std::uint32_t v) const { return mesh_.vertices[v]; }

  void move() {
    const std::vector<std::uint32_t> ends = ends_of(border_edges(mesh_));
    for (std::uint32_t v = 0; v < mesh_.vertices.size(); ++v) join_.onto.push_back(v);
    const Near near(mesh_, ends);
    for (const std::uint32_t v : ends) {
      std::optional<std::pair<SquaredDistance, std::uint32_t>> nearest;
      near.between(below(point(v)[0], length_), above(point(v)[0], length_), [&](std::uint32_t other) {
        if (other >= v || join_.onto[other] != other) return;
        const SquaredDistance distance = squared(side(point(v), point(other)));
        if (most_ < distance) return;
        if (!nearest || distance < nearest->first || (!(nearest->first < distance) && other < nearest->second))
          nearest = {distance, other};
      });
      if (nearest) join_.onto[v] = nearest->second;
    }
    for (std::uint32_t i = 0; i < moved_.triangles.size(); ++i) {
      Triangle& t = moved_.triangles[i];
      for (std::uint32_t& v : t) v = join_.onto[v];
      if (t != mesh_.triangles[i]) expect_part(t, i);
    }
  }

  // Splits edges of borders as they are after the moves, at all vertices that are beside them. A vertex beside several edges of
  // a triangle counts at the nearest, the first of several.
  void split() {
    const std::vector<BorderEdge> edges = border_edges(moved_);
    const Near near(mesh_, ends_of(edges));
    std::vector<std::vector<Beside>> beside;
    std::map<std::pair<std::uint32_t, std::uint32_t>, SquaredDistance> nearest;  // of a triangle and a vertex
    for (const auto& [ends, triangle] : edges) {
      beside.push_back(beside_edge(near, ends, moved_.triangles[triangle]));
      for (const auto& [share, vertex, distance] : beside.back()) {
        SquaredDistance& least = nearest.try_emplace({triangle, vertex}, distance).first->second;
        least = std::min(least, distance);
      }
    }
    std::map<std::uint32_t, std::vector<Triangle>> parts;
    for (std::size_t edge = 0; edge < edges.size(); ++edge) {
      const std::uint32_t triangle = edges[edge].triangle;
      auto [last, to] = edges[edge].ends;
      for (const auto& [share, vertex, distance] : beside[edge]) {
        const auto counts = nearest.find({triangle, vertex});
        if (counts == nearest.end() || counts->second < distance) continue;
        nearest.erase(counts);
        split(parts.try_emplace(triangle, 1, moved_.triangles[triangle]).first->second, last, to, vertex);
        last = vertex;
        join_.splits.push_back({triangle, vertex, distance});
      }
    }
    for (std::uint32_t i = 0; i < moved_.triangles.size(); ++i) {
      const auto found = parts.find(i);
      if (found == parts.end()) {
        join_.triangles.push_back(moved_.triangles[i]);
        join_.of.push_back(i);
        continue;
      }
      for (const Triangle& part : found->second) {
        expect_part(part, i);
        join_.triangles.push_back(part);
        join_.of.push_back(i);
      }
    }
  }

  // Splits the part that has the edge.
  static void split(std::vector<Triangle>& parts, std::uint32_t from, std::uint32_t to, std::uint32_t at) {
    for (std::size_t part = 0; part < parts.size(); ++part)
      for (std::size_t i = 0; i < 3; ++i) {
        if (parts[part][i] != from || parts[part][(i + 1) % 3] != to) continue;
        const std::uint32_t apex = parts[part][(i + 2) % 3];
        parts[part] = {from, at, apex};
        parts.push_back({at, to, apex});
        return;
      }
  }

  std::vector<Beside> beside_edge(const Near& near, const std::array<std::uint32_t, 2>& ends, const Triangle& own) const {
    const Vertex &a = point(ends[0]), &b = point(ends[1]);
    const WholeVector along = side(a, b);
    std::vector<Beside> beside;
    near.between(below(std::min(a[0], b[0]), length_), above(std::max(a[0], b[0]), length_), [&](std::uint32_t v) {
      if (std::ranges::count(own, v) > 0) return;
      const Whole share = dot(side(a, point(v)), along);
      if (share <= 0 || share >= dot(along, along)) return;
      const SquaredDistance distance = squared_distance(point(v), a, b);
      if (!(most_ < distance)) beside.push_back({share, v, distance});
    });
    std::ranges::sort(
        beside, [](const Beside& s, const Beside& t) { return s.share != t.share ? s.share < t.share : s.vertex < t.vertex; });
    return beside;
  }

  void expect_part(const Triangle& part, std::uint32_t of) const {
    const auto normal = [&](const Triangle& t) {
      return cross(side(point(t[0]), point(t[1])), side(point(t[0]), point(t[2])));
    };
    const WholeVector before = normal(mesh_.triangles[of]), after = normal(part);
    if (dot(before, after) > 0) return;
    const bool is_flat = std::ranges::all_of(after, [](const Whole& component) { return component == 0; });
    throw std::invalid_argument(
        "face " + std::to_string(number_[of]) + (is_flat ? " would lose its area" : " would turn by a right angle or more") +
        "; expected a length below the sides and heights of the faces at the borders, got " + shortest(length_) + " mm");
  }

  const TriangleMesh& mesh_;
  float length_;
  SquaredDistance most_;
  const std::vector<std::uint32_t>& number_;
  TriangleMesh moved_;
  Join join_;
};

}  // namespace

Join join_borders(const TriangleMesh& mesh, float length, const std::vector<std::uint32_t>& number) {
  return Joining(mesh, length, number).run();
}

}  // namespace forceshade::mesh
