// SPDX-License-Identifier: BSD-3-Clause
#include "fast/meshes/box_tree.h"

#include <algorithm>
#include <cmath>

#include "fast/meshes/mesh.h"

namespace forceshade::fast {

BoxTree::BoxTree(const Faces& faces) : faces_(static_cast<std::uint32_t>(faces.size())) {
  const auto over = [](std::uint32_t count, std::uint32_t by) { return (count + by - 1) / by; };
  std::uint32_t total = 0, boxes = over(faces_, kRun);
  std::array<std::uint32_t, kMostLevels> boxes_of{};
  while (faces_ > 0) {
    boxes_of[levels_] = boxes;
    first_[levels_++] = total;
    const std::uint32_t nodes = over(boxes, kWidth);
    total += nodes;
    if (nodes == 1) break;
    boxes = nodes;
  }
  Node empty;
  for (std::size_t i = 0; i < 3; ++i) {
    empty.low[i].fill(HUGE_VALF);
    empty.high[i].fill(-HUGE_VALF);
  }
  nodes_.assign(total, empty);
  const auto include = [&](std::uint32_t level, std::uint32_t box, std::size_t axis, float low, float high) {
    Node& node = nodes_[first_[level] + box / kWidth];
    node.low[axis][box % kWidth] = std::min(node.low[axis][box % kWidth], low);
    node.high[axis][box % kWidth] = std::max(node.high[axis][box % kWidth], high);
  };
  for (std::uint32_t f = 0; f < faces_; ++f)
    for (const auto& corner : faces[f].corner)
      for (std::size_t i = 0; i < 3; ++i) include(0, f / kRun, i, corner[i], corner[i]);
  for (std::uint32_t level = 1; level < levels_; ++level)
    for (std::uint32_t box = 0; box < boxes_of[level]; ++box) {
      const Node& node = nodes_[first_[level - 1] + box];
      for (std::size_t i = 0; i < 3; ++i)
        include(level, box, i, *std::ranges::min_element(node.low[i]), *std::ranges::max_element(node.high[i]));
    }
}

void BoxTree::begin(Search& search, const Vector3<double>& point, double square) const noexcept {
  search.at_ = {point.x, point.y, point.z};
  search.square_ = search.beyond_ = square;
  search.count_ = 0;
  if (levels_ > 0) search.stack_[search.count_++] = {levels_, 0, 0.0};
}

}  // namespace forceshade::fast
