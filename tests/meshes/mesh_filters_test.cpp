// SPDX-License-Identifier: BSD-3-Clause
// Decisions of binary64 on slips and forces are right for every number that is within the errors it was given, up to
// their ends: each decision is taken again for numbers that lie there.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <random>

#include "fast/meshes/force.h"
#include "fast/meshes/quick_slips.h"
#include "fast/meshes/rest_numbers.h"
#include "tests/meshes/rendering.h"

namespace forceshade::fast {
namespace {

class Draw {
 public:
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  double sign() { return random_() % 2 == 0 ? 1 : -1; }
  double power(int low, int high) {
    return std::ldexp(1.0, low + static_cast<int>(random_() % static_cast<unsigned>(high - low + 1)));
  }
  std::array<float, 3> point(double size) {
    const auto one = [&] { return static_cast<float>(size * uniform(-1, 1)); };
    return {one(), one(), one()};
  }

 private:
  std::mt19937_64 random_{1};
};

// ---- Slips.

using Quick = QuickSlips<FilteredStages>;

struct Slipped {
  Quick::Outcome outcome;
  double k, l;
  bool is_slipping;
  int moves;
  Vector3<double> way;
  double error;
};

struct Slip {
  FaceNumbers face;
  DoubleWithError across;
  Weights weights;
  Coefficients of;
  double k, l;
  bool is_slipping;

  Slipped run() const {
    Slipped result{Quick::Outcome::unsure, 0, 0, is_slipping, 0, {}, 0};
    const FilteredStages stages;
    Quick quick(face, across, weights, of, stages);
    result.outcome = quick.run(k, l, result.is_slipping, result.moves, 3);
    result.k = quick.k();
    result.l = quick.l();
    result.way = quick.way_to_hand();
    result.error = quick.error_of_way();
    return result;
  }
  double first() const { return 0x1p24 * weights.corner[1].value / weights.all.value; }
  double second() const { return 0x1p24 * weights.corner[2].value / weights.all.value; }
  double pull_at(double at_k, double at_l) const { return pull_squared(first() - at_k, second() - at_l, gram()); }
  Gram<double> gram() const { return {dot(face.e1, face.e1), dot(face.e1, face.e2), dot(face.e2, face.e2)}; }
  // The distance from the end of the first slip to the triangle's border, in steps of the grid.
  double inside_at_end() const {
    const double pressure = 0x1p24 * std::fabs(across.value) / std::sqrt(weights.all.value),
                 share = static_cast<double>(of.dynamic_friction) * pressure / std::sqrt(pull_at(k, l)),
                 kept = 0x1p-24 * std::floor(0x1p24 * share), x1 = first() - kept * (first() - k),
                 x2 = second() - kept * (second() - l);
    return std::fmin(std::fmin(x1, x2), 0x1p24 - x1 - x2);
  }
  // Numbers at the ends of the errors, which are then exact.
  Slip at_an_end(Draw& draw) const {
    Slip other = *this;
    for (DoubleWithError* number : {&other.across, &other.weights.all, &other.weights.corner[1], &other.weights.corner[2]})
      *number = {number->value + 0.999 * draw.sign() * number->error, 0};
    return other;
  }
};

// The errors are so large that they decide, in one of three ways: friction holds by some of the errors or not; it lets go by
// far, and the slip ends somewhere in a cell of the grid; or two points of the grid are nearly as far from the hand.
enum class Near { hold, cell, border, tie };

Slip slip_of(Draw& draw, const Face& f) {
  const auto near = static_cast<Near>(static_cast<int>(draw.uniform(0, 4)));
  Slip slip{FaceNumbers(f), {}, {}, {}, 0, 0, draw.sign() > 0};
  const double n2 = dot(slip.face.n, slip.face.n), error = draw.power(-56, -12);
  slip.k = std::floor(1 + draw.power(0, 23) * draw.uniform(0, 1));
  slip.l = std::floor(1 + draw.power(0, 23) * draw.uniform(0, 1));
  const auto dynamic_friction = static_cast<float>(draw.power(-10, 9) * draw.uniform(1, 2));
  slip.of = {dynamic_friction * (draw.sign() > 0 ? 1 : 2), dynamic_friction};
  const Gram<double> gram = slip.gram();
  const double size = near == Near::hold ? draw.power(4, 24) : near != Near::tie ? draw.power(18, 24) : draw.power(-2, 20);
  double c1 = size * draw.uniform(-1, 1), c2 = size * draw.uniform(-1, 1), off = draw.power(-36, -24), held = 1;
  switch (near) {
    case Near::hold:
      held += error * draw.power(-2, 8) * draw.uniform(-1, 1);
      off = error * std::fmin(1, draw.power(-24, 0) * size);
      break;
    case Near::cell: held = draw.uniform(0.05, 0.9); break;
    case Near::border:
      held = draw.uniform(0.05, 0.9);
      slip.k = std::floor(draw.power(18, 22) * draw.uniform(1, 2));
      c1 = -(slip.k + 0x1p24 * off * draw.power(-2, 4) * draw.uniform(-1, 1)) /
           (1 - held * static_cast<double>(slip.is_slipping ? 1 : slip.of.dynamic_friction / slip.of.static_friction));
      break;
    case Near::tie: {
      // The middle between a point of the grid and its neighbour d, at a right angle to d from there, and some of the errors
      // on.
      held = std::fmin(0.9, draw.uniform(0.2, 2) / size);
      off = 0x1p-50 * (1 + size) * draw.power(-8, 0);
      const double d1 = std::floor(draw.uniform(-1, 2)), d2 = d1 == 0 ? 1 : std::floor(draw.uniform(-1, 2)),
                   of_first = d1 * gram.first + d2 * gram.mixed, of_second = d1 * gram.mixed + d2 * gram.second,
                   aside = draw.uniform(-0.7, 0.7) / std::fmax(std::fabs(of_first), std::fabs(of_second)),
                   along = 0.5 + 0x1p24 * off * draw.power(-2, 4) * draw.uniform(-1, 1);
      c1 = std::trunc(c1) + along * d1 - aside * of_second;
      c2 = std::trunc(c2) + along * d2 + aside * of_first;
    }
  }
  const double friction = static_cast<double>(slip.is_slipping ? dynamic_friction : slip.of.static_friction),
               across = held * std::sqrt(pull_squared(c1, c2, gram) * n2) / friction * 0x1p-24,
               of_across = near == Near::hold ? error : draw.power(-40, -26);
  slip.across = {draw.sign() * across, (draw.sign() > 0 ? 1 : 0x1p-30) * of_across * across};
  off *= (draw.sign() > 0 ? 1 : 0x1p-30) * n2;
  slip.weights.all = {n2, near != Near::tie && draw.sign() > 0 ? off : 0};
  slip.weights.corner[1] = {n2 * 0x1p-24 * (slip.k + c1), off};
  slip.weights.corner[2] = {n2 * 0x1p-24 * (slip.l + c2), off};
  return slip;
}

TEST(mesh_filters, slips_are_sure_of_what_holds_up_to_the_ends_of_the_errors) {
  Draw draw;
  std::array<int, 3> counts{};
  int slips = 0, compared = 0;
  for (int i = 0; i < 150000; ++i) {
    Face f{};
    for (auto& corner : f.corner) corner = draw.point(4);
    const Slip slip = slip_of(draw, f);
    const Slipped found = slip.run();
    ++counts[static_cast<std::size_t>(found.outcome)];
    slips += found.moves;
    if (found.outcome == Quick::Outcome::unsure) continue;
    if (found.moves > 0) {
      ASSERT_GT(std::fmin(std::fmin(found.k, found.l), 0x1p24 - found.k - found.l), 0) << i;
    }
    for (int end = 0; end < 6; ++end) {
      const Slip other = slip.at_an_end(draw);
      const Slipped there = other.run();
      if (found.outcome == Quick::Outcome::leaves && found.moves == 0) {
        ASSERT_LT(other.inside_at_end(), 0) << i;
      }
      if (found.moves == 1) {
        ASSERT_LT(other.pull_at(found.k, found.l), other.pull_at(slip.k, slip.l)) << i;
      }
      if (there.outcome == Quick::Outcome::unsure) continue;
      ++compared;
      ASSERT_EQ(found.outcome, there.outcome) << i;
      ASSERT_EQ(found.moves, there.moves) << i;
      ASSERT_EQ(found.k, there.k) << i;
      ASSERT_EQ(found.l, there.l) << i;
      if (found.outcome != Quick::Outcome::rests) continue;
      ASSERT_EQ(found.is_slipping, there.is_slipping) << i;
      for (const auto& [one, other] :
           {std::pair(found.way.x, there.way.x), {found.way.y, there.way.y}, {found.way.z, there.way.z}})
        ASSERT_LE(std::fabs(one - other), found.error + there.error) << i;
    }
  }
  std::printf("  %d unsure, %d leave, %d rest, %d slips, %d compared\n", counts[0], counts[1], counts[2], slips, compared);
  for (const int count : counts) EXPECT_GT(count, 300);
  EXPECT_GT(slips, 1000);
}

// ---- Forces.

TEST(mesh_filters, the_force_at_a_slip_is_that_of_every_way_within_its_error) {
  Draw draw;
  MeshRendering rendering = tests::unshaded({{{0, 0, 0}, {4, 1, 0}, {1, 3, 2}}, {{0, 1, 2}}}, mesh::Sides::both);
  const Mesh mesh = tests::fast_mesh(rendering);
  for (int i = 0; i < 20000; ++i) {
    Arrival arrival;
    arrival.grid_point =
        grid_point_in_triangle(mesh, 0, 1 + static_cast<std::uint32_t>(draw.uniform(1, 0x1p23)), 5, mesh::Side::front);
    arrival.rest = RestKind::at_grid_point;
    arrival.pull = {Slide::Along::triangle, 0, false};
    const std::array<float, 3> p = draw.point(4);
    const Offset exact = offset_from(point_of(mesh, arrival.grid_point), p.data(), 0);
    arrival.to_hand = exact;
    arrival.error_to_hand = exact.size * draw.power(-45, -24);
    for (double* component : {&arrival.to_hand.U.x, &arrival.to_hand.U.y, &arrival.to_hand.U.z})
      *component += draw.uniform(-1, 1) * arrival.error_to_hand;
    const HandAndGoal ends(p);
    ASSERT_EQ(mesh_force(mesh, arrival, ends, 0.7F, mesh::Shading::none),
              mesh_force(mesh, arrival, ends, 0.7F, mesh::Shading::none, false))
        << i;
  }
}

// A number of more bits than binary64 has is off by one in its last place.
TEST(mesh_filters, numbers_from_integers_are_good_to_their_error) {
  for (const std::int64_t beside : {-1, 0, 1}) {
    const std::int64_t whole = (std::int64_t{1} << 60) + beside;
    const DoubleWithError about = meshes::near(FixedInteger<63>(whole), 0x1p-53);
    EXPECT_GE(about.error * 0x1p53, std::fabs(static_cast<double>(static_cast<std::int64_t>(about.value * 0x1p53) - whole)));
    EXPECT_LE(about.error, 0x1p-50 * std::fabs(about.value));
  }
}

}  // namespace
}  // namespace forceshade::fast
