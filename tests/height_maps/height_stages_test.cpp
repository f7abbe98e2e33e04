// SPDX-License-Identifier: BSD-3-Clause
// The stages of the real-time height maps: a spline's first one and its bounds, and the answers that are left to later ones.

#include <gtest/gtest.h>

#include <random>

#include "fast/heights/spline_force.h"
#include "forceshade/fast.h"
#include "forceshade/reference.h"
#include "properties/binary32.h"
#include "tests/height_maps/grids_of.h"

namespace forceshade {
namespace {

using Eigen::Vector3f;
using height::Edge;
using height::Interpolant;
using properties::neighbour;
using properties::same_bits;
using properties::show;
using tests::fast_law;
using tests::grid;
using tests::uniform;

using Random = std::mt19937_64;

// A spline that is flat in one direction, or all over a window, is answered in binary64: its bounds vanish with its steps.
TEST(height_map_field, answers_flat_places_of_a_spline_at_once) {
  const auto ridge = [](std::uint32_t i) { return 0.3F * static_cast<float>(i % 5); };
  const auto along_y = [&](std::uint32_t i, std::uint32_t) { return ridge(i); };
  const auto along_x = [&](std::uint32_t, std::uint32_t j) { return ridge(j); };
  const auto plate = [](std::uint32_t i, std::uint32_t j) { return i < 4 && j < 4 ? 1.0F : 5.0F; };
  const fast::HeightMapField lines =
      fast_law({{{grid(64, 64, 0.5F, Edge::tile, Interpolant::cubic_spline, along_y)}}}, height::Mode::true_height);
  const fast::HeightMapField other_lines =
      fast_law({{{grid(64, 64, 0.5F, Edge::tile, Interpolant::cubic_spline, along_x)}}}, height::Mode::true_height);
  const fast::HeightMapField flat =
      fast_law({{{grid(64, 64, 0.5F, Edge::clamp, Interpolant::cubic_spline, plate)}}}, height::Mode::true_height);
  Random random(2);
  int in_binary64 = 0;
  for (int i = 0; i < 1000; ++i) {
    const Vector3f position(uniform(random, 0, 9), uniform(random, 0, 9), uniform(random, -1, 0));
    const fast::Evaluation on_lines = lines.evaluate(position), on_plate = flat.evaluate(position),
                           on_other_lines = other_lines.evaluate(position);
    EXPECT_EQ(on_lines.force.y(), 0);
    EXPECT_EQ(on_other_lines.force.x(), 0);
    EXPECT_EQ(on_plate.force.head<2>(), Eigen::Vector2f(0, 0));
    for (const fast::Evaluation& one : {on_lines, on_other_lines, on_plate}) in_binary64 += one.stage == fast::Stage::binary64;
  }
  EXPECT_GT(in_binary64, 2985);
}

// The bounds of fast/heights/spline.g hold, and are not idle.
TEST(height_map_field, spline_first_stage_stays_within_its_bound) {
  Random random(3);
  double worst = 0, worst_slope = 0;
  for (int map = 0; map < 12; ++map) {
    const float size = std::exp2(uniform(random, -10, 10)), base = map % 2 == 0 ? 0 : uniform(random, -100, 100);
    const auto value = [&](std::uint32_t, std::uint32_t) {
      return base + size * (map % 4 < 2 ? uniform(random, -1, 1) : static_cast<float>(random() % 2));
    };
    const fast::HeightGrid g(grid(9, 9, uniform(random, 0.01F, 3), Edge::clamp, Interpolant::cubic_spline, value));
    const fast::SplineErrors error(g, g.largest_step_along(), g.largest_step_across());
    const auto pitch = static_cast<float>(g.pitch());
    for (int i = 0; i < 300; ++i) {
      // Anywhere, or next to where cells meet.
      const auto coordinate = [&] {
        if (i % 2 == 0) return uniform(random, -2.99F * pitch, 2.99F * pitch);
        return neighbour(static_cast<float>(static_cast<int>(random() % 5) - 2) * pitch, static_cast<int>(random() % 5) - 2);
      };
      const fast::Place at(coordinate(), coordinate());
      const fast::NearCell<fast::Quad> cell(g, at.coordinates);
      ASSERT_TRUE(g.has_window_around(cell.column, cell.row));
      const fast::SplineValues<fast::Quad> quick(g, cell.past, g.values() + ((cell.row - 1) * 9 + cell.column - 1), 9);
      const auto exact = fast::spline_jet<fast::BigFloatBall<32>>(g, at);
      const auto share = [](double value, const fast::BigFloatBall<32>& truth, double bound) {
        return std::fabs(approximately(fast::BigFloatBall<32>::exactly(value) - truth)) / bound;
      };
      worst = std::max(worst, share(quick.rise, exact.U - fast::BigFloatBall<32>::exactly(quick.c), error.rise));
      worst_slope = std::max({worst_slope, share(quick.Ux, exact.Ux, error.Ux), share(quick.Uy, exact.Uy, error.Uy)});
    }
  }
  std::printf("  worst error of the first stage: height %.3f, slopes %.3f of their bounds\n", worst, worst_slope);
  EXPECT_LE(worst, 1);
  EXPECT_LE(worst_slope, 1);
  EXPECT_GE(std::min(worst, worst_slope), 1.0 / 128) << "loose: intervals add up what never comes together";
}

// Steps so small that forces are subnormal, which drops more bits than rounding_is_in_doubt looks at: the first input is a tie,
// rounded upwards by the first stage when it was sure of such numbers; the second it rounded in two ways, fused and not.
TEST(height_map_field, rounds_subnormal_forces) {
  struct Input {
    std::uint32_t column, row;  // of the one coefficient that is a unit in the last place higher
    float stiffness;
    Vector3f position;
  };
  for (const Input& input : {Input{0, 0, 0x1.0ep-5F, {-76, -64, 0x1p-30F}}, Input{3, 4, 0x1.44p-8F, {36, 0, 0x1p-30F}}}) {
    const HeightMap map{{{grid(8, 8, 32, Edge::tile, Interpolant::cubic_spline, [&](std::uint32_t i, std::uint32_t j) {
      return i == input.column && j == input.row ? 0x1.000002p-30F : 0x1p-30F;
    })}}};
    for (const auto& [mode, name] : height::kModes) {
      const fast::HeightMapField law = fast_law(map, mode, input.stiffness);
      const auto reference = std::get<reference::HeightMapField>(reference::HeightMapField::build(map, mode, input.stiffness));
      const auto expected = reference.round_to_binary32(input.position);
      const std::vector<Vector3f> positions(8, input.position);
      for (const fast::InstructionSet set : fast::kInstructionSets) {
        std::vector<Vector3f> forces(8);
        law.force(positions, forces, set);
        for (int axis = 0; axis < 3; ++axis)
          EXPECT_TRUE(same_bits(forces.front()[axis], expected.force[axis]))
              << name << ", " << fast::name_of(set) << ": " << show(forces.front());
      }
      EXPECT_EQ(law.evaluate(input.position).force, expected.force) << name;
    }
  }
}

// The first stage itself, which evaluate() hides: with and without vectors it answers nearly everything, and the same.
TEST(height_map_field, first_stage_answers_a_spline_with_and_without_vectors) {
  Random random(8);
  const auto rough = [&](std::uint32_t, std::uint32_t) { return uniform(random, -0.5F, 0.5F); };
  const fast::HeightGrid g(grid(37, 29, 0.3F, Edge::tile, Interpolant::cubic_spline, rough));
  for (const auto& [mode, name] : height::kModes) {
    const fast::SplineMap map(g, mode, 0.5);
    std::vector<fast::SplineForce> functions{&fast::spline_force<fast::Quad>};
#if defined(__x86_64__)
    if (fast::is_available(fast::InstructionSet::avx2)) functions.push_back(fast::kAvx2SplineFunctions.force);
#endif
    int answered = 0, asked = 0;
    for (int i = 0; i < 3000; ++i) {
      const Vector3f position(uniform(random, -5, 5), uniform(random, -3.8F, 3.8F), uniform(random, -1, 0.5F));
      std::vector<fast::Evaluation> answers;
      for (const fast::SplineForce function : functions) {
        Vector3f force;
        const fast::Sign contact = function(map, position.data(), force.data());
        ++asked;
        if (contact == fast::Sign::unknown) continue;
        ++answered;
        answers.push_back({force, contact == fast::Sign::positive ? Status::contact : Status::free, fast::Stage::binary64});
      }
      for (const fast::Evaluation& answer : answers) {
        ASSERT_EQ(answer.status, answers.front().status) << name << ' ' << show(position);
        ASSERT_EQ(answer.force, answers.front().force) << name << ' ' << show(position);
      }
    }
    EXPECT_GE(1000 * answered, 995 * asked) << name;
    for (const float odd : {5.6F, -5.5F, 6.0F, 1e5F, NAN, 0x1p-40F})
      for (const fast::SplineForce function : functions)
        for (int axis = 0; axis < 2; ++axis) {
          Vector3f position(0, 0, -1), force;
          position[axis] = odd;
          EXPECT_EQ(function(map, position.data(), force.data()), fast::Sign::unknown) << odd;
        }
    // A tie, K (1 - z) = 1/2 + 2^-25, is left to a later stage, and what stands where the force would go is left alone.
    const auto level = [](auto, auto) { return 1.0F; };
    const fast::SplineMap plane(fast::HeightGrid(grid(8, 8, 1, Edge::tile, Interpolant::cubic_spline, level)), mode, 0.5);
    if (mode == height::Mode::force_shaded) continue;
    for (const fast::SplineForce function : functions) {
      const Vector3f tie(0.25F, 0.25F, -0x1p-24F);
      Vector3f force(-7, -7, -7);
      EXPECT_EQ(function(plane, tie.data(), force.data()), fast::Sign::unknown) << name;
      EXPECT_EQ(force, Vector3f(-7, -7, -7)) << name;
    }
  }
}

}  // namespace
}  // namespace forceshade
