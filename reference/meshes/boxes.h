// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Finds the features that a straight way may meet: boxes of binary64 numbers around exact points, and a tree of them. Only
// what is proved to be apart is left out; exact numbers decide the rest.

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "reference/meshes/integers.h"

namespace forceshade::reference::meshes {

// In the units of Vector; it contains the points that it was made of.
struct Box {
  std::array<double, 3> low, high;

  explicit Box(const Vector& point);
  Box join(const Box& other) const;
  bool is_apart(const Box& other) const;
};

// The region in which features are searched for: those that may have a point of a box, or of a straight way.
class Reach {
 public:
  explicit Reach(const Box& box) : box_(box) {}
  // The way from g to p, both of coordinates below 2^100 in size.
  Reach(const Vector& g, const Vector& p);

  // True only where no point of it is in the other box.
  bool is_apart(const Box& other) const;

 private:
  struct Line {
    Box through;
    std::array<double, 3> along;  // each within 2^-52 of its size
  };
  static bool is_apart(const Line& line, const Box& other);

  Box box_;
  std::optional<Line> line_;
};

class BoxTree {
 public:
  explicit BoxTree(std::vector<Box> boxes);

  // The numbers of the boxes that are not apart from it, in order.
  std::vector<std::size_t> met_by(const Reach& reach) const;

 private:
  // A node is followed by its first half. It holds the boxes order_[first] to order_[end - 1].
  struct Node {
    Box box;
    std::size_t first, end;
    std::size_t second_half;  // the number of that node; 0: a leaf
  };

  std::size_t add(std::size_t first, std::size_t end);

  std::vector<Box> boxes_;
  std::vector<std::size_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace forceshade::reference::meshes
