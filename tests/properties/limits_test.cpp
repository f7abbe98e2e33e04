// SPDX-License-Identifier: BSD-3-Clause
// The limits of each property, to a few units of rounding: cases that reach a limit exactly, and the same with a little more.

#include <gtest/gtest.h>

#include <cmath>

#include "properties/binary32.h"
#include "properties/mesh_properties.h"
#include "properties/work.h"
#include "tests/meshes/rendering.h"

namespace forceshade::properties {
namespace {

// A triangle in z = 0, K = 2 N/mm. Its grid is fine enough that slacks stay below 10^-5 mJ.
MeshRendering flat_triangle(mesh::Shading shading) {
  MeshRendering rendering{
      tests::checked({{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, {{0, 1, 2}}}), {}, mesh::Sides::front, shading, 2, {}};
  if (shading != mesh::Shading::none) rendering.normals = {{{0.6F, 0, 0.8F}, {0.6F, 0, 0.8F}, {0.6F, 0, 0.8F}}};
  return rendering;
}

// At rest above (x, 1, z), with this force.
Ticked resting(double x, double z, const Eigen::Vector3d& force) {
  Ticked ticked{{static_cast<float>(x), 1, static_cast<float>(z)}, {}};
  ticked.tick.status = Status::contact;
  ticked.tick.force = {static_cast<float>(force.x()), static_cast<float>(force.y()), static_cast<float>(force.z())};
  ticked.tick.after.place = mesh::Place::triangle;
  ticked.tick.after.parameter = {static_cast<std::uint32_t>(std::lround(x / 4 * 0x1p24)), 1U << 22};
  return ticked;
}

// A tick straight up gives K a (a - b), all that the spring had stored between the depths a and b, to the last bit.
TEST(limits, of_the_energy_of_an_unshaded_tick_are_reached_by_a_straight_stroke) {
  const MeshRendering rendering = flat_triangle(mesh::Shading::none);
  const auto stroke = [&](double from, double to, double softer) {
    const std::array<Ticked, 2> path{resting(1, -from, {0, 0, 2 * from}), resting(1, -to, {0, 0, 2 * to * softer})};
    return spring_gives_no_energy(rendering, path);
  };
  for (const auto& [from, to] : {std::pair{1.0, 0.75}, {2.0, 0.5}, {0.5, 0.75}, {1.0, 1.5}}) {
    EXPECT_EQ(stroke(from, to, 1), std::nullopt) << from << " to " << to;
    EXPECT_NE(stroke(from, to, 1.001), std::nullopt) << from << " to " << to << ", where more is stored than there is";
  }
}

// A shaded force gives most along the chord from the triangle's normal to its own.
TEST(limits, of_the_energy_of_a_shaded_tick_are_reached_along_the_chord) {
  const MeshRendering rendering = flat_triangle(mesh::Shading::vertex_scheme);
  const double angle = std::atan2(0.6, 0.8), chord = 2 * std::sin(angle / 2);
  const Eigen::Vector3d along = Eigen::Vector3d(0.6, 0, 0.8 - 1) / chord;
  constexpr double kDepth = 1, kStep = 0x1p-7;
  const auto stroke = [&](double turned) {
    const Eigen::Vector3d force = 2 * kDepth * Eigen::Vector3d(std::sin(turned), 0, std::cos(turned));
    const double depth = kDepth - kStep * along.z();
    const std::array<Ticked, 2> path{resting(1, -kDepth, force),
                                     resting(1 + kStep * along.x(), -depth, 2 * depth * Eigen::Vector3d(0.6, 0, 0.8))};
    return spring_gives_no_energy(rendering, path);
  };
  EXPECT_EQ(stroke(angle), std::nullopt);
  EXPECT_NE(stroke(1.02 * angle), std::nullopt) << "turned by a fiftieth more than the normals allow";
}

TEST(limits, of_a_force_that_is_none) {
  for (const Status status : {Status::free, Status::invalid})
    for (const float force : {0x1p-149F, 0.5F, 2.0F})
      for (const std::size_t axis : {0U, 1U, 2U}) {
        Ticked ticked{{1, 1, 1}, {}};
        ticked.tick.status = status;
        EXPECT_EQ(force_is_as_long_as_the_spring(flat_triangle(mesh::Shading::none), ticked), std::nullopt);
        ticked.tick.force[axis] = force;
        EXPECT_NE(force_is_as_long_as_the_spring(flat_triangle(mesh::Shading::none), ticked), std::nullopt) << force;
      }
}

// Every field of the work of one step, from each component alone.
TEST(limits, of_the_work_of_a_step_count_each_component) {
  for (const int axis : {0, 1, 2}) {
    Eigen::Vector3f force = Eigen::Vector3f::Zero();
    Eigen::Vector3d step = Eigen::Vector3d::Zero();
    Eigen::Matrix<long double, 3, 1> exact = Eigen::Matrix<long double, 3, 1>::Zero();
    force[axis] = 3;
    exact[axis] = 2.5L;
    step[axis] = -0.5;
    Work work;
    for (const int times : {1, 2}) {
      work.add(force, exact, step);
      EXPECT_EQ(work.rendered, -1.5 * times) << axis;
      EXPECT_EQ(work.exact, -1.25 * times) << axis;
      EXPECT_EQ(work.turnover, 1.5 * times) << axis;
      EXPECT_EQ(work.rounding, 0x1p-23 * 0.5 * times) << axis;
      EXPECT_EQ(work.placing, 0) << axis;
      EXPECT_EQ(work.summing(), 0x1p-36 * (work.turnover + work.rounding)) << axis;
    }
  }
}

}  // namespace
}  // namespace forceshade::properties
