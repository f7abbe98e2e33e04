// SPDX-License-Identifier: BSD-3-Clause
// The exact god-object's search leaves out boxes beside a way, but none that the way meets.

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "reference/meshes/boxes.h"

namespace forceshade::reference::meshes {
namespace {

// Up to 2^91 in size, of so many digits; with more than 53 it is no binary64.
Integer number(std::mt19937_64& random, unsigned digits) {
  Integer value = static_cast<std::int64_t>(random() >> 1);
  value = (value << 28) + static_cast<std::int64_t>(random() >> 36);
  value = value >> (91 - digits) << (91 - digits);
  return random() % 2 == 0 ? value : Integer(-value);
}

Vector vector(std::mt19937_64& random, unsigned digits) {
  return {number(random, digits), number(random, digits), number(random, digits)};
}

// Parts of [0, 1], where a way is within two numbers on an axis.
struct Stretch {
  Fraction from{0, 1}, to{1, 1};
  bool is_empty = false;

  void cut(const Integer& g, const Integer& u, const Integer& low, const Integer& high) {
    if (u.is_zero()) {
      is_empty |= g < low || high < g;
      return;
    }
    Fraction in = fraction(low - g, u), out = fraction(high - g, u);
    if (u < 0) std::swap(in, out);
    if (from < in) from = in;
    if (out < to) to = out;
    is_empty |= to < from;
  }
};

bool meets(const Vector& g, const Vector& p, const Vector& low, const Vector& high) {
  Stretch stretch;
  for (std::size_t axis = 0; axis < 3; ++axis) stretch.cut(g[axis], p[axis] - g[axis], low[axis], high[axis]);
  return !stretch.is_empty;
}

// Both corners of a box of binary32 numbers, which may be flat.
std::array<Vector, 2> corners(std::mt19937_64& random) {
  std::array<Vector, 2> ends{vector(random, 24), vector(random, 24)};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (random() % 4 == 0) ends[1][axis] = ends[0][axis];
    if (ends[1][axis] < ends[0][axis]) std::swap(ends[0][axis], ends[1][axis]);
  }
  return ends;
}

TEST(mesh_boxes, no_box_that_a_way_meets_is_left_out) {
  std::mt19937_64 random(1);
  int met = 0, touched = 0, beside_the_line = 0, not_decided = 0;
  for (int i = 0; i < 200000; ++i) {
    const auto [low, high] = corners(random);
    const Box box = Box(low).join(Box(high));
    Vector g = vector(random, 91), p = vector(random, 91);
    const bool is_aimed = i % 2 == 0;
    if (is_aimed) {  // through a corner exactly, or one unit beside it
      const Vector u = vector(random, 40);
      Vector corner;
      for (std::size_t axis = 0; axis < 3; ++axis) corner[axis] = random() % 2 == 0 ? low[axis] : high[axis];
      g = corner - Integer(1 + random() % 9) * u;
      p = corner + Integer(1 + random() % 9) * u;
      if (i % 4 == 0) g[random() % 3] += static_cast<int>(random() % 3) - 1;
    }
    const bool is_met = meets(g, p, low, high), is_apart = Reach(g, p).is_apart(box);
    ASSERT_FALSE(is_met && is_apart) << i;
    met += is_met;
    touched += is_met && is_aimed;
    beside_the_line += is_apart && !Reach(Box(g).join(Box(p))).is_apart(box);
    not_decided += !is_met && !is_apart;
  }
  std::printf("  %d met, %d of them at a corner; %d left out for the line alone; %d left to the exact numbers\n", met, touched,
              beside_the_line, not_decided);
  EXPECT_GT(touched, 0);
  EXPECT_GT(beside_the_line, 0);
  EXPECT_GT(not_decided, 0);
}

TEST(mesh_boxes, a_tree_finds_each_box_that_is_not_apart_in_order) {
  std::mt19937_64 random(2);
  std::size_t found = 0, left_out = 0;
  for (int i = 0; i < 2000; ++i) {
    std::vector<Box> boxes;
    for (std::size_t count = random() % 100; boxes.size() < count;) {
      const Vector at = vector(random, 24);
      boxes.push_back(Box(at).join(Box(at + Vector{Integer(1) << 90, Integer(1) << (random() % 91), Integer(1) << 90})));
    }
    const Reach reach = i % 2 == 0 ? Reach(vector(random, 91), vector(random, 91)) : Reach(Box(vector(random, 24)));
    std::vector<std::size_t> expected;
    for (std::size_t k = 0; k < boxes.size(); ++k)
      if (!reach.is_apart(boxes[k])) expected.push_back(k);
    ASSERT_EQ(BoxTree(boxes).met_by(reach), expected) << i;
    found += expected.size();
    left_out += boxes.size() - expected.size();
  }
  std::printf("  %zu found, %zu left out\n", found, left_out);
  EXPECT_GT(found, 0U);
  EXPECT_GT(left_out, 0U);
}

}  // namespace
}  // namespace forceshade::reference::meshes
