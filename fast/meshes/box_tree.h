// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Which runs of triangles a segment or a ball may meet: boxes over triangles that lie together in memory, eight to a box.
//
// The answer may hold triangles that are not met, and leaves out none that is: a box holds its triangles exactly, for its sides
// are coordinates of their corners, and every test is widened by more than its roundings.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "forceshade/fast/meshes/vector3.h"

namespace forceshade::fast {

struct Face;

class BoxTree {
 public:
  static constexpr std::uint32_t kRun = 4, kWidth = 8;  // triangles of a leaf, children of a node

  BoxTree() = default;
  explicit BoxTree(const std::vector<Face>& faces);

  // Calls visit(f) for every triangle f of a leaf whose box the segment may meet. The ends: within 2^-50, relative to 2^14 mm.
  template <class Visit>
  void along(const Vector3<double>& from, const Vector3<double>& to, const Visit& visit) const noexcept;

  // A lower bound of the squared distance from the point to the nearest triangle, mm², or `square` where that is less;
  // bound(f): one of triangle f. What lies beyond about nine tenths of the distance is looked at no closer, so the bound is as
  // much too low at most, and far fewer boxes are opened.
  template <class Bound>
  double distance(const Vector3<double>& point, double square, const Bound& bound) const noexcept;

  std::size_t bytes() const noexcept { return nodes_.capacity() * sizeof(Node); }

 private:
  // Of up to eight children; those that are missing are empty boxes.
  struct alignas(32) Node {
    std::array<std::array<float, kWidth>, 3> low, high;
  };
  static constexpr std::size_t kMostLevels = 10;
  struct Entry {
    std::uint32_t level, node;
  };
  static constexpr std::size_t kStack = kMostLevels * kWidth;

  std::vector<Node> nodes_;                         // level by level, from the leaves on
  std::array<std::uint32_t, kMostLevels> first_{};  // node of each level
  std::uint32_t levels_ = 0, faces_ = 0;
};

template <class Visit>
void BoxTree::along(const Vector3<double>& from, const Vector3<double>& to, const Visit& visit) const noexcept {
  if (levels_ == 0) return;
  constexpr double kMargin = 0x1p-34;  // mm; the roundings below stay under 2^-38
  const std::array<double, 3> a{from.x, from.y, from.z}, b{to.x, to.y, to.z};
  std::array<double, 3> low, high, middle, half;
  for (std::size_t i = 0; i < 3; ++i) {
    low[i] = (a[i] < b[i] ? a[i] : b[i]) - kMargin;
    high[i] = (a[i] < b[i] ? b[i] : a[i]) + kMargin;
    middle[i] = 0.5 * (a[i] + b[i]);
    half[i] = __builtin_fabs(0.5 * (b[i] - a[i]));
  }
  const double length = half[0] + half[1] + half[2];
  const bool is_long = length > 0.01;
  const std::array<double, 3> direction{b[0] - a[0], b[1] - a[1], b[2] - a[2]};
  std::array<Entry, kStack> stack;
  std::size_t count = 0;
  stack[count++] = {levels_ - 1, 0};
  while (count > 0) {
    const Entry entry = stack[--count];
    const Node& node = nodes_[first_[entry.level] + entry.node];
    std::array<bool, kWidth> meets;
    for (std::size_t c = 0; c < kWidth; ++c) {
      bool inside = true;
      for (std::size_t i = 0; i < 3; ++i)
        inside = inside & (static_cast<double>(node.low[i][c]) <= high[i]) & (static_cast<double>(node.high[i][c]) >= low[i]);
      meets[c] = inside;
    }
    for (std::uint32_t c = kWidth; c-- > 0;) {
      if (!meets[c]) continue;
      if (is_long) {
        // The line passes a box by if the box lies on one side of a plane through the line and along an axis.
        bool passes = false;
        for (std::size_t i = 0; i < 3; ++i) {
          const std::size_t j = i == 2 ? 0 : i + 1, k = j == 2 ? 0 : j + 1;
          const auto centre = [&](std::size_t axis) {
            return 0.5 * (static_cast<double>(node.low[axis][c]) + static_cast<double>(node.high[axis][c])) - middle[axis];
          };
          const auto extent = [&](std::size_t axis) {
            return 0.5 * (static_cast<double>(node.high[axis][c]) - static_cast<double>(node.low[axis][c])) + kMargin;
          };
          const double off = __builtin_fabs(direction[j] * centre(k) - direction[k] * centre(j));
          const double reach = __builtin_fabs(direction[j]) * extent(k) + __builtin_fabs(direction[k]) * extent(j);
          passes = passes | (off > reach * (1 + 0x1p-30) + length * kMargin);
        }
        if (passes) continue;
      }
      const std::uint32_t child = kWidth * entry.node + c;
      if (entry.level > 0) {
        stack[count++] = {entry.level - 1, child};
      } else {
        const std::uint32_t end = kRun * (child + 1) < faces_ ? kRun * (child + 1) : faces_;
        for (std::uint32_t f = kRun * child; f < end; ++f) visit(f);
      }
    }
  }
}

template <class Bound>
double BoxTree::distance(const Vector3<double>& point, double square, const Bound& bound) const noexcept {
  if (levels_ == 0) return square;
  const std::array<double, 3> at{point.x, point.y, point.z};
  std::array<Entry, kStack> stack;
  std::array<double, kStack> lower_bound;
  double beyond = square;  // nothing that was passed over is nearer
  const auto passes_over = [&](double lower) {
    if (lower < 0.8 * square) return false;
    if (lower < beyond) beyond = lower;
    return true;
  };
  std::size_t count = 0;
  stack[count] = {levels_ - 1, 0};
  lower_bound[count++] = 0;
  while (count > 0) {
    const Entry entry = stack[--count];
    if (passes_over(lower_bound[count])) continue;
    const Node& node = nodes_[first_[entry.level] + entry.node];
    std::array<double, kWidth> away{};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t c = 0; c < kWidth; ++c) {
        const double below = static_cast<double>(node.low[i][c]) - at[i], above = at[i] - static_cast<double>(node.high[i][c]);
        const double off = below > above ? below : above;
        away[c] += off > 0 ? off * off : 0;
      }
    // The nearest child last, so that it is next: an insertion into the part of the stack above `base`.
    const std::size_t base = count;
    for (std::uint32_t c = 0; c < kWidth; ++c) {
      const double lower = away[c] * (1 - 0x1p-40);
      if (passes_over(lower)) continue;
      const std::uint32_t child = kWidth * entry.node + c;
      if (entry.level == 0) {
        const std::uint32_t end = kRun * (child + 1) < faces_ ? kRun * (child + 1) : faces_;
        for (std::uint32_t f = kRun * child; f < end; ++f) {
          const double one = bound(f);
          if (one < square) square = one;
        }
        continue;
      }
      std::size_t i = count++;
      for (; i > base && lower_bound[i - 1] < lower; --i) {
        stack[i] = stack[i - 1];
        lower_bound[i] = lower_bound[i - 1];
      }
      stack[i] = {entry.level - 1, child};
      lower_bound[i] = lower;
    }
  }
  return square < beyond ? square : beyond;
}

}  // namespace forceshade::fast
