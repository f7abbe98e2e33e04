// SPDX-License-Identifier: BSD-3-Clause
#include "reference/meshes/boxes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace forceshade::reference::meshes {
namespace {

constexpr std::size_t kLeaf = 4;  // boxes at most

// A conversion drops digits: the neighbours enclose the number.
double below(const Integer& value) {
  return std::nextafter(value.convert_to<double>(), -std::numeric_limits<double>::infinity());
}
double above(const Integer& value) {
  return std::nextafter(value.convert_to<double>(), std::numeric_limits<double>::infinity());
}

struct Range {
  double low, high;
};

// The product of a number with all numbers of a range.
Range times(double factor, const Range& range) {
  return factor < 0 ? Range{factor * range.high, factor * range.low} : Range{factor * range.low, factor * range.high};
}

}  // namespace

Box::Box(const Vector& point)
    : low{below(point[0]), below(point[1]), below(point[2])}, high{above(point[0]), above(point[1]), above(point[2])} {}

Box Box::join(const Box& other) const {
  Box both = *this;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    both.low[axis] = std::min(low[axis], other.low[axis]);
    both.high[axis] = std::max(high[axis], other.high[axis]);
  }
  return both;
}

bool Box::is_apart(const Box& other) const {
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (high[axis] < other.low[axis] || other.high[axis] < low[axis]) return true;
  return false;
}

Reach::Reach(const Vector& g, const Vector& p) : box_(Box(g).join(Box(p))) {
  const Vector u = p - g;
  line_ = Line{Box(g), {u[0].convert_to<double>(), u[1].convert_to<double>(), u[2].convert_to<double>()}};
}

bool Reach::is_apart(const Box& other) const {
  return box_.is_apart(other) || (line_ && is_apart(*line_, other));
}

// Seen along each axis: a point x of the box is on the line through g along u only if u_i (x_j - g_j) = u_j (x_i - g_i). Where
// the difference of both sides has one sign for all x and g of the boxes, none is.
//
// An end of a range of x - g is rounded once, u_i is within 2^-52 of its size, and their product is rounded once: so the
// product is within 2^-50.9 of its size, and the difference of two products, rounded once, within 2^-50 of the sum of their
// sizes. The 1 is more than what any product loses that is subnormal. Sizes are below 2^100 · 2^101, so that nothing overflows.
bool Reach::is_apart(const Line& line, const Box& other) {
  std::array<Range, 3> off;
  for (std::size_t axis = 0; axis < 3; ++axis)
    off[axis] = {other.low[axis] - line.through.high[axis], other.high[axis] - line.through.low[axis]};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const Range one = times(line.along[i], off[j]), two = times(line.along[j], off[i]);
    const auto is_positive = [](double a, double b) { return a - b > 0x1p-50 * (std::fabs(a) + std::fabs(b)) + 1; };
    if (is_positive(one.low, two.high) || is_positive(two.low, one.high)) return true;
  }
  return false;
}

BoxTree::BoxTree(std::vector<Box> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  if (!order_.empty()) add(0, order_.size());
}

// Halves along the axis on which the node is longest, by the middles of the boxes.
std::size_t BoxTree::add(std::size_t first, std::size_t end) {
  Box all = boxes_[order_[first]];
  for (std::size_t i = first; i < end; ++i) all = all.join(boxes_[order_[i]]);
  const std::size_t number = nodes_.size();
  nodes_.push_back({all, first, end, 0});
  if (end - first <= kLeaf) return number;
  const auto length = [&](std::size_t axis) { return all.high[axis] - all.low[axis]; };
  const std::size_t axis = length(0) >= length(1) && length(0) >= length(2) ? 0 : length(1) >= length(2) ? 1 : 2;
  const auto at = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
  const std::size_t middle = first + (end - first) / 2;
  std::nth_element(at(first), at(middle), at(end), [&](std::size_t a, std::size_t b) {
    return boxes_[a].low[axis] + boxes_[a].high[axis] < boxes_[b].low[axis] + boxes_[b].high[axis];
  });
  add(first, middle);
  const std::size_t second_half = add(middle, end);
  nodes_[number].second_half = second_half;
  return number;
}

std::vector<std::size_t> BoxTree::met_by(const Reach& reach) const {
  std::vector<std::size_t> found, left;
  if (!nodes_.empty()) left.push_back(0);
  while (!left.empty()) {
    const std::size_t number = left.back();
    left.pop_back();
    const Node& node = nodes_[number];
    if (reach.is_apart(node.box)) continue;
    if (node.second_half != 0) {
      left.push_back(node.second_half);
      left.push_back(number + 1);
      continue;
    }
    for (std::size_t i = node.first; i < node.end; ++i)
      if (!reach.is_apart(boxes_[order_[i]])) found.push_back(order_[i]);
  }
  std::ranges::sort(found);
  return found;
}

}  // namespace forceshade::reference::meshes
