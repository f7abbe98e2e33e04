// SPDX-License-Identifier: BSD-3-Clause
#include "rendering/meshes/box_tree.h"

#include <algorithm>

namespace forceshade::mesh {
namespace {

// Every third bit of the result is one of the 21 bits of x.
std::uint64_t spread(std::uint64_t x) {
  x = (x | x << 32) & 0x1F00000000FFFFU;
  x = (x | x << 16) & 0x1F0000FF0000FFU;
  x = (x | x << 8) & 0x100F00F00F00F00FU;
  x = (x | x << 4) & 0x10C30C30C30C30C3U;
  return (x | x << 2) & 0x1249249249249249U;
}

struct Keyed {
  std::uint64_t key;
  std::uint32_t triangle;

  bool operator<(const Keyed& other) const { return key < other.key || (key == other.key && triangle < other.triangle); }
};

}  // namespace

bool BoxTree::meet(const Box& a, const Box& b) {
  bool result = true;
  for (std::size_t i = 0; i < 3; ++i) result &= a.low[i] <= b.high[i] && b.low[i] <= a.high[i];
  return result;
}

BoxTree::Box BoxTree::around(const Box& a, const Box& b) {
  Box box;
  for (std::size_t i = 0; i < 3; ++i) {
    box.low[i] = std::min(a.low[i], b.low[i]);
    box.high[i] = std::max(a.high[i], b.high[i]);
  }
  return box;
}

BoxTree::Node BoxTree::left(const Node& node) {
  return {node.first, node.first + (node.end - node.first) / 2, node.place + 1};
}

BoxTree::Node BoxTree::right(const Node& node) {
  const std::uint32_t size = (node.end - node.first) / 2;
  return {node.first + size, node.end, node.place + 2 * size};
}

BoxTree::BoxTree(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) return;
  const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
  const auto box_of = [&](std::uint32_t triangle) {
    const auto& [a, b, c] = mesh.triangles[triangle];
    const Box of_a{mesh.vertices[a], mesh.vertices[a]}, of_b{mesh.vertices[b], mesh.vertices[b]};
    return around(around(of_a, of_b), {mesh.vertices[c], mesh.vertices[c]});
  };
  Box all = box_of(0);
  for (std::uint32_t i = 1; i < count; ++i) all = around(all, box_of(i));
  {
    std::vector<Keyed> keyed(count);
    for (std::uint32_t i = 0; i < count; ++i) {
      const Box box = box_of(i);
      keyed[i] = {0, i};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double size = static_cast<double>(all.high[axis]) - static_cast<double>(all.low[axis]);
        const double middle = (static_cast<double>(box.low[axis]) + static_cast<double>(box.high[axis])) / 2;
        const double place = size > 0 ? (middle - static_cast<double>(all.low[axis])) / size : 0;
        keyed[i].key |= spread(static_cast<std::uint64_t>(place * 0x1FFFFF)) << axis;
      }
    }
    std::sort(keyed.begin(), keyed.end());
    order_.resize(count);
    boxes_.resize(count);
    for (std::uint32_t i = 0; i < count; ++i) {
      order_[i] = keyed[i].triangle;
      boxes_[i] = box_of(order_[i]);
    }
  }
  const std::uint32_t leaves = (count + kLeaf - 1) / kLeaf;
  nodes_.resize(2 * std::size_t{leaves} - 1);
  const Node root{0, leaves, 0};
  make(root);
  add_tasks(root, root, std::max(leaves / 64, 1U));
}

BoxTree::Box BoxTree::make(const Node& node) {
  if (is_leaf(node)) {
    const std::size_t first = std::size_t{node.first} * kLeaf, end = std::min(first + kLeaf, boxes_.size());
    Box box = boxes_[first];
    for (std::size_t i = first + 1; i < end; ++i) box = around(box, boxes_[i]);
    return nodes_[node.place] = box;
  }
  const Box first = make(left(node));
  return nodes_[node.place] = around(first, make(right(node)));
}

void BoxTree::add_tasks(const Node& a, const Node& b, std::uint32_t most_leaves) {
  if (a.place == b.place) {
    if (a.end - a.first <= most_leaves) return tasks_.push_back({a, b});
    add_tasks(left(a), left(a), most_leaves);
    add_tasks(right(a), right(a), most_leaves);
    return add_tasks(left(a), right(a), most_leaves);
  }
  if (!meet(nodes_[a.place], nodes_[b.place])) return;
  const std::uint32_t of_a = a.end - a.first, of_b = b.end - b.first;
  if (std::max(of_a, of_b) <= most_leaves) return tasks_.push_back({a, b});
  if (of_a >= of_b) {
    add_tasks(left(a), b, most_leaves);
    add_tasks(right(a), b, most_leaves);
  } else {
    add_tasks(a, left(b), most_leaves);
    add_tasks(a, right(b), most_leaves);
  }
}

void BoxTree::run(std::size_t task, const std::function<bool(std::uint32_t i, std::uint32_t j)>& pair) const {
  run(tasks_[task].a, tasks_[task].b, pair);
}

bool BoxTree::run(const Node& a, const Node& b, const std::function<bool(std::uint32_t, std::uint32_t)>& pair) const {
  const bool is_same = a.place == b.place;
  if (!is_same && !meet(nodes_[a.place], nodes_[b.place])) return true;
  if (is_leaf(a) && is_leaf(b)) {
    const std::size_t end_a = std::min<std::size_t>(std::size_t{a.end} * kLeaf, boxes_.size());
    const std::size_t end_b = std::min<std::size_t>(std::size_t{b.end} * kLeaf, boxes_.size());
    for (std::size_t i = std::size_t{a.first} * kLeaf; i < end_a; ++i)
      for (std::size_t j = is_same ? i + 1 : std::size_t{b.first} * kLeaf; j < end_b; ++j)
        if (meet(boxes_[i], boxes_[j]) && !pair(std::min(order_[i], order_[j]), std::max(order_[i], order_[j]))) return false;
    return true;
  }
  if (is_same) return run(left(a), left(a), pair) && run(right(a), right(a), pair) && run(left(a), right(a), pair);
  if (a.end - a.first >= b.end - b.first) return run(left(a), b, pair) && run(right(a), b, pair);
  return run(a, left(b), pair) && run(a, right(b), pair);
}

}  // namespace forceshade::mesh
