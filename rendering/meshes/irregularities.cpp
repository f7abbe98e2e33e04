// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <numeric>
#include <span>

#include "forceshade/meshes.h"
#include "rendering/half_edges.h"
#include "rendering/meshes/box_tree.h"
#include "rendering/meshes/insides.h"
#include "rendering/meshes/pairs.h"
#include "rendering/meshes/weld.h"

namespace forceshade::mesh {
namespace {

// Sets that are joined.
class Joined {
 public:
  explicit Joined(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0U); }
  std::uint32_t root(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::uint32_t i, std::uint32_t j) { parent_[root(i)] = root(j); }

 private:
  std::vector<std::uint32_t> parent_;
};

class Search {
 public:
  Search(const TriangleMesh& mesh, Irregularities& found) : mesh_(welded(mesh)), found_(found) {
    count_equal(mesh);
    for (std::uint32_t i = 0, kept = 0; i < mesh.triangles.size(); ++i)
      if (kept < mesh_.number.size() && mesh_.number[kept] == i)
        ++kept;
      else
        add(Irregularity::no_area, {i}, mesh.vertices[mesh.triangles[i][0]]);
  }

  void look_at_vertices_and_edges() {
    Joined corners(3 * triangles().size());
    for_each_edge(mesh_.mesh, [&](std::span<const std::uint32_t> half_edges) { look_at_edge(half_edges, corners); });
    std::vector<std::uint32_t> first(mesh_.mesh.vertices.size(), kNoEdge);
    for (std::uint32_t h = 0; h < 3 * triangles().size(); ++h) {
      std::uint32_t& corner = first[start_of(mesh_.mesh, h)];
      if (corner == kNoEdge) {
        corner = h;
      } else if (corner != kCounted && corners.root(corner) != corners.root(h)) {
        add(Irregularity::several_fans, {corner / 3, h / 3}, point(start_of(mesh_.mesh, h)), Numbers::kept);
        corner = kCounted;
      }
    }
  }

  void look_at_pairs(const Monitor& monitor) {
    const BoxTree tree(mesh_.mesh);
    std::uint64_t left = most_pairs(triangles().size());
    std::vector<std::array<std::uint32_t, 2>> of_kind[3];
    for (std::size_t task = 0; task < tree.tasks() && left > 0; ++task) {
      monitor.at(static_cast<double>(task) / static_cast<double>(tree.tasks()));
      tree.run(task, [&](std::uint32_t i, std::uint32_t j) {
        if (const auto kind = kind_of(i, j)) of_kind[static_cast<std::size_t>(*kind)].push_back({i, j});
        return --left > 0;
      });
    }
    found_.is_complete = left > 0;
    for (std::size_t kind = 0; kind < 3; ++kind) {
      std::ranges::sort(of_kind[kind]);
      for (const auto& [i, j] : of_kind[kind])
        add(static_cast<Irregularity>(static_cast<std::size_t>(Irregularity::touching) + kind), {i, j}, middle_of_boxes(i, j),
            Numbers::kept);
    }
  }

 private:
  static constexpr std::uint32_t kCounted = kNoEdge - 1;
  enum class Numbers { of_file, kept };  // of triangles: in the file, or among those with an area
  enum class Meet { touching, crossing, coinciding };

  const std::vector<Triangle>& triangles() const { return mesh_.mesh.triangles; }
  const Vertex& point(std::uint32_t v) const { return mesh_.mesh.vertices[v]; }
  TrianglePoints points(const Triangle& t) const { return {point(t[0]), point(t[1]), point(t[2])}; }

  void add(Irregularity kind, std::vector<std::uint32_t> numbers, const Vertex& near, Numbers which = Numbers::of_file) {
    Irregularities::Kind& all = found_.kinds[static_cast<std::size_t>(kind)];
    if (++all.count > Irregularities::kListed) return;
    constexpr std::size_t kNamed = 8;
    std::ranges::sort(numbers);
    if (numbers.size() > kNamed) numbers.resize(kNamed);
    if (which == Numbers::kept)
      for (std::uint32_t& number : numbers) number = mesh_.number[number];
    all.places.push_back({std::move(numbers), near});
  }

  // The used vertices that are not the lowest one with their coordinates.
  void count_equal(const TriangleMesh& mesh) {
    std::vector<bool> is_counted(mesh.vertices.size(), false);
    for (std::size_t i = 0; i < mesh_.number.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t v = mesh.triangles[mesh_.number[i]][k];
        if (v == triangles()[i][k] || is_counted[v]) continue;
        is_counted[v] = true;
        ++found_.equal_vertices;
      }
  }

  // Joins the corners of its triangles at each of its ends.
  void look_at_edge(std::span<const std::uint32_t> half_edges, Joined& corners) {
    const std::uint32_t a = start_of(mesh_.mesh, half_edges[0]), b = end_of(mesh_.mesh, half_edges[0]);
    const auto third = [&](std::uint32_t h) { return start_of(mesh_.mesh, previous_in_triangle(h)); };
    Vertex middle{};
    for (std::size_t axis = 0; axis < 3; ++axis) middle[axis] = (point(a)[axis] + point(b)[axis]) / 2;
    // A triangle with the vertices of one before it is found at the edge of its two lower ones.
    for (std::size_t i = 1; i < half_edges.size(); ++i) {
      const std::uint32_t apex = third(half_edges[i]);
      if (apex < std::max(a, b)) continue;
      const auto before = std::ranges::find(half_edges.first(i), apex, third);
      if (before != half_edges.begin() + static_cast<std::ptrdiff_t>(i))
        add(Irregularity::same_vertices, {*before / 3, half_edges[i] / 3}, point(apex), Numbers::kept);
    }
    std::vector<std::uint32_t> numbers;
    for (const std::uint32_t h : half_edges) numbers.push_back(h / 3);
    if (half_edges.size() > 2) {
      add(Irregularity::many_at_edge, numbers, middle, Numbers::kept);
    } else if (half_edges.size() == 2 && start_of(mesh_.mesh, half_edges[1]) == a) {
      add(Irregularity::same_direction, numbers, middle, Numbers::kept);
    }
    const auto corner_at = [&](std::uint32_t h, std::uint32_t v) {
      return start_of(mesh_.mesh, h) == v ? h : next_in_triangle(h);
    };
    for (const std::uint32_t h : half_edges)
      for (const std::uint32_t v : {a, b}) corners.join(corner_at(half_edges[0], v), corner_at(h, v));
  }

  std::optional<Meet> kind_of(std::uint32_t i, std::uint32_t j) const {
    Triangle s = triangles()[i], t = triangles()[j];
    const std::size_t shared = shared_first(s, t);
    if (shared == 3) return {};
    const TrianglePoints of_s = points(s), of_t = points(t);
    const bool meets = shared == 0   ? meet(of_s, of_t)
                       : shared == 1 ? meet_beside_corner(of_s, of_t)
                                     : meet_beside_edge(of_s, of_t);
    if (!meets) return {};
    if (!insides_meet(of_s, of_t)) return Meet::touching;
    return are_in_one_plane(of_s, of_t) ? Meet::coinciding : Meet::crossing;
  }

  Vertex middle_of_boxes(std::uint32_t i, std::uint32_t j) const {
    Vertex middle{};
    const TrianglePoints s = points(triangles()[i]), t = points(triangles()[j]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto [s_low, s_high] = std::minmax({s[0][axis], s[1][axis], s[2][axis]});
      const auto [t_low, t_high] = std::minmax({t[0][axis], t[1][axis], t[2][axis]});
      middle[axis] = (std::max(s_low, t_low) + std::min(s_high, t_high)) / 2;
    }
    return middle;
  }

  Welded mesh_;
  Irregularities& found_;
};

}  // namespace

Irregularities irregularities_of(TriangleMesh mesh, const Monitor& monitor) {
  quantise(mesh);
  Irregularities found;
  Search search(mesh, found);
  search.look_at_vertices_and_edges();
  search.look_at_pairs(monitor);
  return found;
}

}  // namespace forceshade::mesh
