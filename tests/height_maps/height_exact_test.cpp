// SPDX-License-Identifier: BSD-3-Clause
// Forces of height maps that only the exact numbers of their last stage can round.

#include <gtest/gtest.h>

#include <random>

#include "fast/heights/all.h"
#include "fast/heights/exact.h"
#include "forceshade/fast.h"
#include "forceshade/reference.h"
#include "properties/binary32.h"

namespace forceshade {
namespace {

using Eigen::Vector3f;
using fast::Sign;
using height::Mode;

struct Input {
  const char* what;
  HeightMap map;
  Mode mode;
  float stiffness;
  Vector3f position;
};

std::vector<Input> inputs() {
  const height::Gaussian hill{0, 0, 1, 1}, far_hill{80, 0, 1, 1}, narrow{0, 0, 1, 0.2F};
  const height::Plane half{0, 0, 0.5F}, slope{0.75F, 0, 0};
  const HeightMap tail{{{hill}, {half}}}, hole{{{hill, true}, {half}}};
  const HeightMap pair{{{height::Gaussian{-3, 0, 1, 1}}, {height::Gaussian{3, 0, 1, 1}, true}}};
  const HeightMap cones{{{height::Cone{0, 0, 6, 8}}, {height::Cone{0, 0, 6, 8}, true}, {height::Cone{0, 0, 7.5F, 10}}}};
  constexpr auto kTrue = Mode::true_height, kShaded = Mode::force_shaded, kConservative = Mode::conservative;
  return {
      {"contact, 64 sigma off", {{{narrow}, {half}}}, kTrue, 0.5F, {12.8F, 0, 0.5F}},
      {"no contact over a dent, 64 sigma off", {{{narrow, true}, {half}}}, kTrue, 0.5F, {12.8F, 0, 0.5F}},
      {"a tail that is not seen at 1900 bits", {{{hill}, {half}}}, kTrue, 1, {55, 0, -0x1.749722p-2F}},
      {"a tie, and a hill's tail", tail, kTrue, 1, {80, 0, -0x1.000002p-1F}},
      {"a tie, and a dent's tail", hole, kTrue, 1, {80, 0, -0x1.000002p-1F}},
      {"a tie, and the tail's slope", tail, kShaded, 1.5F, {80, 0, -0x1.000002p+0F}},
      {"a negative tie along x, and a tail", {{{far_hill}, {slope}}}, kTrue, 1.25F, {0, 0, -0x1.000002p+0F}},
      {"a tie along x, and a tail", {{{far_hill}, {slope, true}}}, kTrue, 1.25F, {0, 0, -0x1.000002p+0F}},
      {"a tie along x, and a tail aside",
       {{{height::Gaussian{0, 90, 1, 1}}, {slope}}},
       kConservative,
       2,
       {0, 0, -0x1.000002p+0F}},
      {"two tails that cancel in height", pair, kTrue, 1.5F, {0, 80, -0x1.000002p+0F}},
      {"two tails that cancel in height, near by", pair, kConservative, 1.5F, {0, 2, -0x1.000002p+0F}},
      {"two tails that cancel in height, on the surface", pair, kTrue, 1.5F, {0, 2, 0}},
      {"roots that are whole", {{{height::Cone{0, 0, 6, 8}}}}, kTrue, 1.875F, {3, 4, 1.25F - 0x1p-23F}},
      {"a root that squares away", {{{height::Cone{0, 0, 6, 8}}}}, kShaded, 1.875F, {1, 1, -0x1.000002p+0F}},
      {"two roots at a right angle",
       {{{height::Cone{-2, 0, 16, 8}}, {height::Cone{2, 0, 16, 8}}}},
       kShaded,
       4.5F,
       {0, 2, -0x1.000002p+0F}},
      {"cones that cancel", cones, kShaded, 1.875F, {1, 2, -0x1.000002p+0F}},
      {"a cap's root that is whole", {{{height::SphereCap{0, 0, 5, 9}}}}, kShaded, 1.875F, {3, 0, -0x1.000002p+0F}},
      {"a grating on a crest, and a tail",
       {{{height::Grating{1, 1000, -1000, 0}}, {height::Gaussian{0x1.1496c8p+13F, 0x1.388p+13F, 1, 0x1.88p+4F}, true}}},
       kTrue,
       1.5F,
       {0x1.388p+13F, 0x1.388p+13F, -0x1p-23F}},
      {"a force of half a unit of the smallest number",
       {{{height::Cone{0, 0, 0x1.fa4c8ep+12F, 0x1.fa4c56p-10F}},
         {height::Cone{0, 0, 0x1.fa4c8ep+12F, 0x1.fa4c6cp-10F}, true},
         {height::Plane{0x1.63f6eap+1F, 0, 0}},
         {height::Plane{0x1.daa5f2p-15F, 0, 0}},
         {height::Gaussian{0, 0, 0x1.39c4p-135F, 1}},
         {height::Gaussian{0, 0, 0x1p-96F, 1}},
         {height::Gaussian{0, 0, 0x1p-96F, 1}, true}}},
       kConservative,
       0x1.c28d76p-2F,
       {0, 0, 0}},
  };
}

TEST(height_exact, rounds_what_no_enclosure_can) {
  for (const Input& input : inputs()) {
    const auto fast = std::get<fast::HeightMapField>(fast::HeightMapField::build(input.map, input.mode, input.stiffness));
    const auto reference =
        std::get<reference::HeightMapField>(reference::HeightMapField::build(input.map, input.mode, input.stiffness));
    for (const int step : {0, -1, 1, -2, 2}) {
      Vector3f position = input.position;
      position.z() = properties::neighbour(position.z(), step);
      const fast::Evaluation answer = fast.evaluate(position);
      const reference::Rounded exact = reference.round_to_binary32(position);
      EXPECT_EQ(answer.status, exact.status) << input.what << ", step " << step;
      for (int axis = 0; axis < 3; ++axis)
        EXPECT_TRUE(properties::same_bits(answer.force[axis], exact.force[axis]))
            << input.what << ", step " << step << ": " << properties::show(answer.force) << ", not "
            << properties::show(exact.force);
      if (step == 0) {
        EXPECT_NE(answer.stage, fast::Stage::binary64) << input.what;
      }
    }
  }
}

// Answers known by hand: a tie goes to even but for a tail, which decides by its sign.
TEST(height_exact, moves_a_tie_off_by_any_tail) {
  const auto z_force = [](std::vector<height::Part> parts, Mode mode, float stiffness, const Vector3f& position) {
    return std::get<fast::HeightMapField>(fast::HeightMapField::build({std::move(parts)}, mode, stiffness)).force(position).z();
  };
  const height::Plane half{0, 0, 0.5F};
  const float below = -0x1.000002p-1F;  // the force of the plane is 1 + 2^-24
  for (const float x : {40.0F, 80.0F, 1e3F, 1e4F}) {
    const height::Gaussian hill{0, 0, 1, 1};
    EXPECT_EQ(z_force({{half}}, Mode::true_height, 1, {x, 0, below}), 1);
    EXPECT_EQ(z_force({{half}, {hill}}, Mode::true_height, 1, {x, 0, below}), 0x1.000002p+0F);
    EXPECT_EQ(z_force({{half}, {hill, true}}, Mode::true_height, 1, {x, 0, below}), 1);
    EXPECT_EQ(z_force({{half}}, Mode::force_shaded, 1.5F, {x, 0, -0x1.000002p+0F}), 0x1.800004p+0F);
    EXPECT_EQ(z_force({{half}, {hill}}, Mode::force_shaded, 1.5F, {x, 0, -0x1.000002p+0F}), 0x1.800002p+0F);
  }
}

// Level places of grids whose pitches have no common measure, where each part's height is a quotient of long numbers.
TEST(height_exact, has_room_for_every_map_that_is_built) {
  HeightMap map;
  const auto add_grid = [&](float pitch) {
    map.parts.push_back({std::make_shared<const height::Grid>(
        height::Grid{2, 2, pitch, height::Edge::tile, height::Interpolant::cubic_spline, {0.25F, 0.25F, 0.25F, 0.25F}})});
  };
  const auto build = [&] { return fast::HeightMapField::build(map, Mode::true_height, 1.5F); };
  while (map.parts.size() < 6) {
    add_grid(0.3F + static_cast<float>(map.parts.size()) * 0x1p-20F);
    const auto law = build();
    ASSERT_TRUE(std::holds_alternative<fast::HeightMapField>(law)) << map.parts.size();
    const float top = 0.25F * static_cast<float>(map.parts.size());
    const auto evaluate = [&](float z) { return std::get<fast::HeightMapField>(law).evaluate({1.1F, 0x1.234566p-13F, z}); };
    EXPECT_EQ(evaluate(top).status, Status::free) << map.parts.size();
    const fast::Evaluation tie = evaluate(top - 2 - 0x1p-22F);
    EXPECT_EQ(tie.stage, map.parts.size() == 1 ? fast::Stage::binary64 : fast::Stage::wide);
    EXPECT_EQ(tie.force, Vector3f(0, 0, 0x1.800004p+1F)) << map.parts.size();
  }
  while (map.parts.size() < 16) add_grid(0.7F);
  const auto refused = build();
  ASSERT_TRUE(std::holds_alternative<ParameterError>(refused));
  EXPECT_NE(std::get<ParameterError>(refused).message().find("exact numbers"), std::string::npos);
}

// Fourteen cones that cancel bring their radii and the square of their distance, none of which divides another, into one sum;
// the cone that is left has a slope of 5/8, the polygons one of 11/8.
TEST(height_exact, has_room_for_what_meets_in_one_root) {
  constexpr double kUnit = 2796203 * 0x1p-53, kPlace = 1950 * 1024 + 1;
  const auto x = static_cast<float>(3 * kUnit), y = static_cast<float>(4 * kUnit);
  HeightMap map{{{height::Cone{x, y, 5 * 1254401 * 0x1p-10F, 8 * 1254401 * 0x1p-10F}}}};
  for (const bool negated : {false, true})
    for (int i = 0; i < 7; ++i) {
      const auto radius = static_cast<float>((9800 * 1024 + 2 * i + 1) / 1024.0);
      map.parts.push_back({height::Cone{x, y, static_cast<float>(1000 + i), radius}, negated});
    }
  map.parts.push_back({height::Polygons{{{5000, 0}, {8072, 4224}}}});
  const auto law = std::get<fast::HeightMapField>(fast::HeightMapField::build(map, Mode::force_shaded, 2.25F));
  const Vector3f position(static_cast<float>(3 * kPlace / 1024), static_cast<float>(4 * kPlace / 1024), -0x1.000002p+0F);
  const fast::Evaluation answer = law.evaluate(position);
  EXPECT_EQ(answer.status, Status::contact);
  EXPECT_EQ(answer.force, Vector3f(-0x1.800004p+0F, 0x1.800004p-1F, 0x1.800004p+0F));
}

// The central difference of a cosine: (2 sin ε/2)^2n with ε = 2^-149, in terms of a size of 1.
TEST(height_exact, sees_waves_that_all_but_cancel) {
  const auto binomial = [](int n, int k) {
    double value = 1;
    for (int i = 1; i <= k; ++i) value = value * (n - k + i) / i;
    return value;
  };
  for (const int n : {6, 7, 8, 13}) {
    HeightMap map{{{height::Plane{0, 0, static_cast<float>(binomial(2 * n, n) * 0x1p-11)}}}};
    for (int k = 1; k <= n; ++k) {
      const double height = (k % 2 == 0 ? 2 : -2) * binomial(2 * n, n + k) * 0x1p-11;
      map.parts.push_back({height::Grating{static_cast<float>(height), 0, 0, static_cast<float>(k) * 0x1p-149F}});
    }
    const auto law = std::get<fast::HeightMapField>(fast::HeightMapField::build(map, Mode::true_height, 1));
    EXPECT_EQ(law.evaluate({0, 0, 0}).status, Status::contact) << n;
    EXPECT_EQ(law.evaluate({0, 0, 0}).force, Vector3f(0, 0, 0)) << n;
    const auto reference = std::get<reference::HeightMapField>(reference::HeightMapField::build(map, Mode::true_height, 1));
    EXPECT_EQ(reference.round_to_binary32({0, 0, 0}).status, Status::contact) << n;
  }
}

// Random parts at one place, as jets in 4096 bits and exactly.
class PartsAtAPlace {
 public:
  PartsAtAPlace(const fast::Place& at, double z, Mode mode, double stiffness)
      : place_(at, z, mode, stiffness), at_(at), z_(z), mode_(mode), stiffness_(stiffness) {}

  template <class Shape>
  void add(const Shape& shape, bool negated) {
    const bool is_shaded = mode_ == Mode::force_shaded;
    place_.add(shape, {!is_shaded, true, negated ? -1.0 : 1.0});
    const fast::Jet<N> one = fast::jet<N>(shape, at_);
    jet_ = jet_ + (negated ? -one : one);
  }
  Sign exact_gap() const { return place_.sign_of_gap(); }
  Sign enclosed_gap() const { return proved_sign(gap()); }
  Sign exact_excess(std::size_t axis, double tie) const { return place_.sign_of_excess(axis, tie); }
  Sign enclosed_excess(std::size_t axis, double tie) const { return proved_sign(component(axis) - N::exactly(tie)); }
  double approximate_component(std::size_t axis) const { return approximately(component(axis)); }

 private:
  using N = fast::BigFloatBall<64>;

  N gap() const { return (mode_ == Mode::force_shaded ? N::exactly(0) : jet_.U) - N::exactly(z_); }
  N component(std::size_t axis) const {
    N magnitude = N::exactly(stiffness_) * gap();
    if (mode_ != Mode::conservative)
      magnitude = magnitude / square_root(N::exactly(1) + (jet_.Ux * jet_.Ux + jet_.Uy * jet_.Uy));
    return axis == 2 ? magnitude : -(magnitude * (axis == 0 ? jet_.Ux : jet_.Uy));
  }

  fast::ExactPlace place_;
  fast::Place at_;
  double z_;
  Mode mode_;
  double stiffness_;
  fast::Jet<N> jet_ = fast::flat<N>();
};

struct Agreement {
  int compared = 0, unknown = 0;

  // An enclosure that decides must not be contradicted.
  void expect(Sign exact, Sign enclosed, const char* what) {
    if (enclosed == Sign::unknown) return;
    ++compared;
    unknown += exact == Sign::unknown;
    if (exact != Sign::unknown) {
      EXPECT_EQ(exact, enclosed) << what;
    }
  }
};

// Takes components whose polynomial is of degree 2: near a Gaussian nothing else is expanded far enough.
void compare(const PartsAtAPlace& parts, std::size_t first_axis, std::mt19937& random, Agreement& agreement) {
  agreement.expect(parts.exact_gap(), parts.enclosed_gap(), "gap");
  if (parts.enclosed_gap() != Sign::positive) return;
  for (std::size_t axis = first_axis; axis < 3; ++axis) {
    const double value = parts.approximate_component(axis);
    if (std::fabs(value) < 1e-200) continue;
    const double tie = value * (1 + std::ldexp(static_cast<double>(random() % 5) - 2, -static_cast<int>(random() % 53)));
    if (tie * value > 0) agreement.expect(parts.exact_excess(axis, tie), parts.enclosed_excess(axis, tie), "component");
  }
}

TEST(height_exact, agrees_with_enclosures_that_can_tell) {
  std::mt19937 random(6);
  const auto few_bits = [&] { return static_cast<float>(static_cast<int>(random() % 33) - 16) / 4; };
  const auto reach = [&] { return static_cast<float>(random() % 15 + 1) / 2; };
  Agreement agreement;
  for (int i = 0; i < 600; ++i) {
    const auto mode = height::kModes[random() % 3].mode;
    PartsAtAPlace parts(fast::Place(few_bits(), few_bits()), static_cast<double>(few_bits()) - 4, mode, 0.75);
    int roots = 0;
    bool has_hill = false;
    for (auto part = random() % 3 + 1; part > 0; --part) {
      const bool negated = random() % 3 == 0;
      switch (random() % 5) {
        case 0: parts.add(height::Plane{few_bits() / 4, few_bits() / 4, few_bits()}, negated); break;
        case 1:
          parts.add(height::Gaussian{few_bits(), few_bits(), few_bits(), reach() / 4}, negated);
          has_hill = true;
          break;
        case 2: parts.add(height::Polygons{{{-3, 0}, {-1, few_bits()}, {2, 1}, {4, few_bits()}}}, negated); break;
        case 3: {
          if (++roots > 3) break;
          parts.add(height::Cone{few_bits(), few_bits(), few_bits(), 2 * reach()}, negated);
          break;
        }
        default: {
          if ((roots += 2) > 3) break;
          const float radius = reach() + 0.5F;
          if (random() % 2 == 0)
            parts.add(height::CylinderCap{few_bits(), radius, 1.5F * radius}, negated);
          else
            parts.add(height::SphereCap{few_bits(), few_bits(), radius, 1.5F * radius}, negated);
        }
      }
    }
    compare(parts, has_hill && mode != Mode::conservative ? 2 : 0, random, agreement);
  }
  std::printf("  %d compared, %d unknown\n", agreement.compared, agreement.unknown);
  EXPECT_GT(agreement.compared, 1000);
  EXPECT_EQ(agreement.unknown, 0);
}

// A tie of the plane, and Gaussians whose tails 4096 bits see to the second order.
TEST(height_exact, agrees_with_enclosures_beside_ties) {
  std::mt19937 random(7);
  Agreement agreement;
  for (int i = 0; i < 400; ++i) {
    const auto mode = height::kModes[random() % 3].mode;
    const bool is_sloped = random() % 2 == 0;
    const double gap = 1 + static_cast<double>(random() % 64) / 64, stiffness = 1.25;
    const float x = static_cast<float>(random() % 9) - 4;
    PartsAtAPlace parts(fast::Place(x, 0),
                        (mode == Mode::force_shaded || !is_sloped ? 0.0 : 0.75 * static_cast<double>(x)) - gap, mode,
                        stiffness);
    if (is_sloped) parts.add(height::Plane{0.75F, 0, 0}, false);
    for (auto hill = random() % 4; hill > 0; --hill) {
      const auto distance = static_cast<float>(random() % 4 + 8);
      const auto y = static_cast<float>(random() % 3);
      const height::Gaussian one{x + (random() % 2 == 0 ? distance : -distance), random() % 2 == 0 ? y : -y,
                                 static_cast<float>(random() % 3) - 1, random() % 3 == 0 ? 0.25F : 0.5F};
      parts.add(one, random() % 2 == 0);
    }
    const bool is_long = mode == Mode::conservative || !is_sloped;  // the normal's length is left out, or is 1
    agreement.expect(parts.exact_excess(2, stiffness * gap / (is_long ? 1 : 1.25)),
                     parts.enclosed_excess(2, stiffness * gap / (is_long ? 1 : 1.25)), "F_z");
    if (is_sloped)
      agreement.expect(parts.exact_excess(0, -stiffness * gap * 0.75 / (is_long ? 1 : 1.25)),
                       parts.enclosed_excess(0, -stiffness * gap * 0.75 / (is_long ? 1 : 1.25)), "F_x");
  }
  std::printf("  %d compared, %d unknown\n", agreement.compared, agreement.unknown);
  EXPECT_GT(agreement.compared, 300);
  EXPECT_EQ(agreement.unknown, 0);
}

// Waves that are left are not its affair.
TEST(height_exact, leaves_waves_to_enclosures) {
  fast::ExactPlace place(fast::Place(1, 2), 0, Mode::true_height, 1);
  place.add(height::Grating{1, 1, 0, 0}, {true, true, 1});
  EXPECT_EQ(place.sign_of_gap(), Sign::unknown);
  EXPECT_EQ(place.sign_of_excess(2, 1), Sign::unknown);
  place.add(height::Grating{1, -3, 1, 0}, {true, true, -1});  // cos(-1), slopes 3 and -1 times sin(-1)
  EXPECT_EQ(place.sign_of_gap(), Sign::zero) << "as high, by an angle of the same size";
  EXPECT_EQ(place.sign_of_excess(2, 1), Sign::unknown) << "the slopes are left";
}

}  // namespace
}  // namespace forceshade
