// SPDX-License-Identifier: BSD-3-Clause
// The thesis's edge scheme on a mesh: its direction by its formula, and its jump (docs/god-object.md).

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "forceshade/reference.h"
#include "tests/meshes/rendering.h"

namespace forceshade {
namespace {

using mesh::Place;
using reference::GodObject;
using Position = std::array<float, 3>;

const mesh::TriangleMesh kOctahedron{{{4, 0, 0}, {-4, 0, 0}, {0, 4, 0}, {0, -4, 0}, {0, 0, 4}, {0, 0, -4}},
                                     {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};

// The unit direction of the force where the god-object rests at this point of a triangle of the octahedron, 1 mm above p.
std::array<double, 3> direction_at(std::size_t triangle, double beta, double gamma) {
  static const GodObject shaded = tests::built(
      GodObject::build({tests::checked(kOctahedron), {}, mesh::Sides::front, mesh::Shading::edge_scheme, 0.5F, {}}));
  const auto& [a, b, c] = kOctahedron.triangles[triangle];
  Position out{}, in{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto at = [&](std::uint32_t v) { return static_cast<double>(kOctahedron.vertices[v][axis]); };
    const double r = at(a) + beta * (at(b) - at(a)) + gamma * (at(c) - at(a)),
                 n = std::copysign(std::sqrt(1.0 / 3), at(a) + at(b) + at(c));
    out[axis] = static_cast<float>(r + n);
    in[axis] = static_cast<float>(r - n);
  }
  reference::GodObjectSession session(shaded);
  session.step(out);
  const mesh::Tick tick = session.step(in);
  EXPECT_EQ(tick.after.place, Place::triangle);
  EXPECT_EQ(tick.after.index[0], triangle);
  std::array<double, 3> force{};
  std::ranges::transform(tick.force, force.begin(), [](float x) { return static_cast<double>(x); });
  const double size = std::hypot(force[0], force[1], force[2]);
  EXPECT_NEAR(size, 0.5, 1e-6);
  for (double& component : force) component /= size;
  return force;
}

// Triangle 0 has the normal (1, 1, 1)/√3; its neighbours across sides 0, 1 and 2 have z, x and y turned over.
TEST(edge_scheme, the_direction_is_that_of_the_printed_formula) {
  for (const auto& [beta, gamma] :
       {std::pair(1.0 / 3, 1.0 / 3), std::pair(0.2, 0.5), std::pair(0.1, 0.15), std::pair(0.7, 0.2)}) {
    const std::array<double, 3> distances{gamma, 1 - beta - gamma, beta};  // from sides 0, 1, 2: all are of one length
    std::array<double, 3> N{};
    for (std::size_t i = 0; i < 3; ++i)
      for (const std::size_t j : {(i + 1) % 3, (i + 2) % 3})
        for (std::size_t axis = 0; axis < 3; ++axis) N[axis] += distances[i] * (axis == (j + 2) % 3 ? 0 : 2);
    const double size = std::hypot(N[0], N[1], N[2]);
    const auto direction = direction_at(0, beta, gamma);
    for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_NEAR(direction[axis], N[axis] / size, 1e-6) << beta << ' ' << gamma;
  }
}

// From triangle 0 to its neighbour across side 0, near one end of the side.
TEST(edge_scheme, the_direction_jumps_across_an_edge) {
  double largest = 0;
  for (int i = 1; i < 64; ++i) {
    const double t = i / 64.0, near = 1e-5;
    const auto here = direction_at(0, t, near);       // side 0 runs from vertex 0 to 2
    const auto there = direction_at(4, 1 - t, near);  // side 0 of triangle 4 runs from 2 to 0
    largest = std::max(largest, std::hypot(here[0] - there[0], here[1] - there[1], here[2] - there[2]));
  }
  std::printf("  the largest jump across an edge of a regular octahedron: %.3f\n", largest);
  EXPECT_NEAR(largest, 0.85, 0.005);
}

}  // namespace
}  // namespace forceshade
