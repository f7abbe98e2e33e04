// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Finds the triangles of a mesh whose boxes meet: a superset of those that have a point in common.

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "forceshade/mesh.h"

namespace forceshade::mesh {

// A binary tree of boxes around triangles, in the order of a space-filling curve. Takes 40 bytes a triangle or so, and 16 more
// while it is built.
class BoxTree {
 public:
  explicit BoxTree(const TriangleMesh& mesh);

  // Work that can be done in any order, by several threads.
  std::size_t tasks() const { return tasks_.size(); }

  // Calls pair(i, j) for pairs of different triangles whose boxes have a point in common, i < j, until it returns false. All
  // tasks together have each pair once.
  void run(std::size_t task, const std::function<bool(std::uint32_t i, std::uint32_t j)>& pair) const;

 private:
  struct Box {
    std::array<float, 3> low, high;
  };
  // Leaves from first to end, behind the last. Its left child is the next node; the tree below a node with m leaves has 2 m
  // - 1.
  struct Node {
    std::uint32_t first, end, place;
  };
  struct Task {
    Node a, b;
  };

  static constexpr std::uint32_t kLeaf = 4;  // triangles

  static bool meet(const Box& a, const Box& b);
  static Box around(const Box& a, const Box& b);
  static bool is_leaf(const Node& node) { return node.end - node.first == 1; }
  static Node left(const Node& node);
  static Node right(const Node& node);

  Box make(const Node& node);
  void add_tasks(const Node& a, const Node& b, std::uint32_t most_leaves);
  bool run(const Node& a, const Node& b, const std::function<bool(std::uint32_t, std::uint32_t)>& pair) const;

  std::vector<std::uint32_t> order_;  // of the triangles
  std::vector<Box> boxes_;            // of the triangles in this order
  std::vector<Box> nodes_;
  std::vector<Task> tasks_;
};

}  // namespace forceshade::mesh
