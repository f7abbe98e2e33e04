// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The runs of triangles that a segment or a ball may meet: boxes over triangles that lie together in memory, eight to a box.
//
// The answer may hold triangles that are not met, and leaves out none that is: a box holds its triangles exactly, for its sides
// are coordinates of their corners, and every test is widened by more than its roundings.

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "fast/meshes/large_pages.h"
#include "fast/meshes/vector3.h"

namespace forceshade::fast {

struct Face;

class BoxTree {
 public:
  static constexpr std::uint32_t kRun = 4, kWidth = 8;  // triangles of a leaf, children of a node

  BoxTree() = default;
  explicit BoxTree(const std::vector<Face, LargePages<Face>>& faces);

  // Calls visit(f) for every triangle f of a leaf whose box the segment may meet. The ends: within 2^-50, relative to 2^14 mm.
  template <class Visit>
  void along(const Vector3<double>& from, const Vector3<double>& to, const Visit& visit) const noexcept {
    const double whole = HUGE_VAL;
    along(from, to, whole, visit);
  }
  // The same for the part of the segment up to `share` of it, which visit() may lower: so nothing is looked at that is surely
  // beyond what is found. What comes first along the segment is visited first, about. share: 2^-24 more than is looked for.
  template <class Visit>
  void along(const Vector3<double>& from, const Vector3<double>& to, const double& share, const Visit& visit) const noexcept;

  // A search for a lower bound of the squared distance from a point to the nearest triangle, in pieces. The bound is at most
  // half too low: what lies beyond half of the square of the distance that is known is looked at no closer, so that far fewer
  // boxes are opened.
  class Search {
   public:
    bool is_done() const noexcept { return count_ == 0; }
    const std::array<double, 3>& point() const noexcept { return at_; }
    // mm², once it is done: the bound, or the `square` that it began with where that is less.
    double square() const noexcept { return square_ < beyond_ ? square_ : beyond_; }

   private:
    friend class BoxTree;
    static constexpr std::size_t kStack = 11 * 8;

    // A box that is still to be opened, and a lower bound of the squared distance to what it holds.
    struct Entry {
      std::uint32_t level, box;  // level 0: a leaf's triangles
      double lower;
    };

    bool passes_over(double lower) noexcept {
      if (lower < 0.5 * square_) return false;
      if (lower < beyond_) beyond_ = lower;
      return true;
    }

    std::array<double, 3> at_{};
    double square_ = 0, beyond_ = 0;  // the least so far; nothing that was passed over is nearer
    std::size_t count_ = 0;
    std::array<Entry, kStack> stack_{};
  };

  void begin(Search& search, const Vector3<double>& point, double square) const noexcept;
  // Opens at most `boxes` boxes, the nearest first; bound(f): a lower bound of the squared distance to triangle f.
  template <class Bound>
  void advance(Search& search, int boxes, const Bound& bound) const noexcept;

  std::size_t bytes() const noexcept { return nodes_.capacity() * sizeof(Node); }

 private:
  // The boxes of up to eight children; those that are missing are empty.
  struct alignas(32) Node {
    std::array<std::array<float, kWidth>, 3> low, high;
  };
  static constexpr std::size_t kMostLevels = 10;
  struct Entry {
    std::uint32_t level, node;
  };
  static constexpr std::size_t kStack = kMostLevels * kWidth;
  static_assert(Search::kStack >= kStack + kWidth);

  // Four numbers in one register, and four masks, of 0 or all bits.
  using Floats = float __attribute__((vector_size(16)));
  using Masks = std::int32_t __attribute__((vector_size(16)));
  static Floats four(const float* first) noexcept {
    Floats all;
    __builtin_memcpy(&all, first, sizeof all);
    return all;
  }
  std::vector<Node, LargePages<Node>> nodes_;       // level by level, from the leaves on
  std::array<std::uint32_t, kMostLevels> first_{};  // node of each level
  std::uint32_t levels_ = 0, faces_ = 0;
};

template <class Visit>
void BoxTree::along(const Vector3<double>& from, const Vector3<double>& to, const double& share,
                    const Visit& visit) const noexcept {
  if (levels_ == 0) return;
  constexpr double kMargin = 0x1p-34;  // mm; the roundings below stay under 2^-38
  const std::array<double, 3> a{from.x, from.y, from.z}, b{to.x, to.y, to.z};
  // The segment's box. Rounded to binary32, it still meets each box that it met, for their sides are binary32 numbers, and
  // rounding changes the order of no two numbers.
  std::array<float, 3> low, high;
  std::array<double, 3> middle, half;
  for (std::size_t i = 0; i < 3; ++i) {
    low[i] = static_cast<float>((a[i] < b[i] ? a[i] : b[i]) - kMargin);
    high[i] = static_cast<float>((a[i] < b[i] ? b[i] : a[i]) + kMargin);
    middle[i] = 0.5 * (a[i] + b[i]);
    half[i] = __builtin_fabs(0.5 * (b[i] - a[i]));
  }
  const double length = half[0] + half[1] + half[2];
  const bool is_long = length > 0.01;
  const std::array<double, 3> direction{b[0] - a[0], b[1] - a[1], b[2] - a[2]};
  const std::size_t longest = half[0] >= half[1] && half[0] >= half[2] ? 0 : half[1] >= half[2] ? 1 : 2;
  const bool is_upwards = direction[longest] >= 0;
  // Along an axis on which the segment is longer than 0.0025 mm, the share at which it comes to a box is good to 2^-25.
  const auto is_beyond = [&](const Node& node, std::uint32_t c) {
    for (std::size_t i = 0; i < 3; ++i) {
      const double start = static_cast<double>(direction[i] > 0 ? node.low[i][c] : node.high[i][c]) - a[i];
      if (half[i] > 0.125 * length && start / direction[i] > share) return is_long;
    }
    return false;
  };
  std::array<Entry, kStack> stack;
  std::size_t count = 0;
  stack[count++] = {levels_ - 1, 0};
  while (count > 0) {
    const Entry entry = stack[--count];
    if (share < 1 && entry.level + 1 < levels_ &&
        is_beyond(nodes_[first_[entry.level + 1] + entry.node / kWidth], entry.node % kWidth))
      continue;
    const Node& node = nodes_[first_[entry.level] + entry.node];
    std::uint32_t meets = 0;  // a bit for each child whose box the segment's box meets
    for (std::size_t first = 0; first < kWidth; first += 4) {
      Masks bits = {1, 2, 4, 8};
      for (std::size_t i = 0; i < 3; ++i)
        bits &= (four(&node.low[i][first]) <= high[i]) & (four(&node.high[i][first]) >= low[i]);
      meets |= static_cast<std::uint32_t>(bits[0] | bits[1] | bits[2] | bits[3]) << first;
    }
    // A child with a higher number lies higher along the axes, about. What is put on the stack last is visited first.
    const bool is_highest_next = (entry.level > 0) == is_upwards;
    while (meets != 0) {
      const auto c = static_cast<std::uint32_t>(is_highest_next ? std::bit_width(meets) - 1 : std::countr_zero(meets));
      meets ^= 1U << c;
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
      } else if (!(share < 1) || !is_beyond(node, c)) {
        const std::uint32_t end = kRun * (child + 1) < faces_ ? kRun * (child + 1) : faces_;
        for (std::uint32_t f = kRun * child; f < end; ++f) visit(f);
      }
    }
  }
}

template <class Bound>
void BoxTree::advance(Search& search, int boxes, const Bound& bound) const noexcept {
  for (; boxes > 0 && search.count_ > 0; --boxes) {
    const Search::Entry entry = search.stack_[--search.count_];
    if (search.passes_over(entry.lower)) continue;
    if (entry.level == 0) {
      const std::uint32_t end = kRun * (entry.box + 1) < faces_ ? kRun * (entry.box + 1) : faces_;
      for (std::uint32_t f = kRun * entry.box; f < end; ++f) {
        const double one = bound(f);
        if (one < search.square_) search.square_ = one;
      }
      continue;
    }
    const Node& node = nodes_[first_[entry.level - 1] + entry.box];
    std::array<double, kWidth> away{};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t c = 0; c < kWidth; ++c) {
        const double below = static_cast<double>(node.low[i][c]) - search.at_[i],
                     above = search.at_[i] - static_cast<double>(node.high[i][c]);
        const double off = below > above ? below : above;
        away[c] += off > 0 ? off * off : 0;
      }
    // The nearest child last, so that it is next: an insertion into the part of the stack above `base`.
    const std::size_t base = search.count_;
    for (std::uint32_t c = 0; c < kWidth; ++c) {
      const double lower = away[c] * (1 - 0x1p-40);
      if (search.passes_over(lower)) continue;
      std::size_t i = search.count_++;
      for (; i > base && search.stack_[i - 1].lower < lower; --i) search.stack_[i] = search.stack_[i - 1];
      search.stack_[i] = {entry.level - 1, kWidth * entry.box + c, lower};
    }
  }
}

}  // namespace forceshade::fast
