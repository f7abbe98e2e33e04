// SPDX-License-Identifier: BSD-3-Clause
#include "reference/energy.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "reference/estimates.h"
#include "tests/support/drawn.h"

namespace forceshade::reference {
namespace {

using Path = std::vector<PathPoint>;

constexpr Parameters kBump{15.24F, 25.4F, 0.5F};
constexpr std::array kActive{LawId::bump_2p, LawId::bump_3p, LawId::bump_1p_shaded, LawId::bump_2p_shaded,
                             LawId::bump_3p_shaded};
constexpr std::array kShaded{LawId::bump_1p_shaded, LawId::bump_2p_shaded, LawId::bump_3p_shaded};

Law build(LawId id, const Parameters& p = kBump) {
  return std::get<Law>(Law::build(id, p));
}

double low(const Interval& value) {
  return value.low.convert_to<double>();
}

// Narrow, and within some units in the last place of a binary64 formula.
void expect_near(const Interval& enclosed, double expected, const std::string& what) {
  const double width = Multiprecision(enclosed.high - enclosed.low).convert_to<double>();
  EXPECT_GE(width, 0) << what;
  EXPECT_LE(width, 1e-20 * expected + 1e-60) << what;
  EXPECT_NEAR(low(enclosed), expected, 1e-13 * expected + 1e-60) << what;
}

// The numbers of a bump in binary64.
struct Numbers {
  double R, w, K, d, alpha, theta;

  explicit Numbers(const Parameters& p)
      : R(static_cast<double>(p.radius)),
        w(static_cast<double>(p.width)),
        K(static_cast<double>(p.stiffness)),
        d(std::sqrt((R - w / 2) * (R + w / 2))),
        alpha(std::asin(w / (2 * R))),
        theta(2 * alpha / 3) {}
};

double cube_of_positive(double v) {
  return v > 0 ? v * v * v : 0;
}

TEST(energy, bounds_equal_the_closed_forms) {
  for (const Parameters& p :
       {kBump, {35.56F, 25.4F, 2}, {1.25F, 1.5F, 1}, {10, 20, 1}, {0.1F, 0.2F, 1000}, {9000, 5000, 0.001F}})
    for (const float of_radius : {0.0005F, 0.1F, 0.5F, 0.9F, 1.0F, 1.1F}) {
      const auto [R, w, K, d, alpha, theta] = Numbers(p);
      const float depth = of_radius * p.radius;
      const auto D = static_cast<double>(depth);
      const LoopBound two = loop_bound(build(LawId::bump_2p, p), depth), three = loop_bound(build(LawId::bump_3p, p), depth),
                      one = loop_bound(build(LawId::bump_1p_shaded, p), depth);
      const double side = K * D * D * std::pow(std::sin(alpha / 4), 2), steep = K * D * D * std::pow(std::sin(theta / 2), 2);
      expect_near(two.counter_clockwise, side, "bump-2p A+");
      expect_near(two.clockwise, 0, "bump-2p A-");
      expect_near(two.anywhere, side, "bump-2p");
      expect_near(three.counter_clockwise, steep, "bump-3p A+");
      expect_near(three.clockwise, steep, "bump-3p A-");
      expect_near(three.anywhere, 2 * steep, "bump-3p");
      const double below = K / (6 * R) * (cube_of_positive(D - d) - cube_of_positive(D - R)), out = K * D * w * w / (8 * R);
      expect_near(one.counter_clockwise, out + below, "bump-1p-shaded A+");
      expect_near(one.anywhere, out + 2 * below, "bump-1p-shaded");
    }
}

TEST(energy, one_half_less_the_other_is_the_closed_form_in_which_D_squared_cancels) {
  for (const Parameters& p : {kBump, {35.56F, 25.4F, 2}, {10, 20, 1}})
    for (const float depth : {0.1F, 2.0F, 9.0F, 40.0F}) {
      const auto [R, w, K, d, alpha, theta] = Numbers(p);
      const double top = R * std::sin(theta / 2), two = std::tan(alpha / 2) / 2 * (w * d / 2 + R * R * alpha),
                   three = std::tan(theta) / 2 * (w * d / 2 + R * R * theta - top * R * std::cos(theta / 2));
      for (const auto& [id, slopes] :
           {std::pair{LawId::bump_1p_shaded, 0.0}, {LawId::bump_2p_shaded, two}, {LawId::bump_3p_shaded, three}}) {
        const LoopBound bound = loop_bound(build(id, p), depth);
        const double expected = K * static_cast<double>(depth) / R * (w * w / 8 - slopes);
        EXPECT_NEAR(low(bound.counter_clockwise) - low(bound.clockwise), expected, 1e-13 * low(bound.anywhere)) << name_of(id);
      }
    }
}

// By mpmath's quadrature of the clamped columns, in another program.
TEST(energy, bounds_equal_independent_quadrature) {
  struct Case {
    LawId id;
    Parameters p;
    float depth;
    double plus, minus;
  };
  const auto one = LawId::bump_1p_shaded, two = LawId::bump_2p_shaded, three = LawId::bump_3p_shaded;
  for (const Case& c :
       std::initializer_list<Case>{{one, {15.24F, 25.4F, 0.5F}, 2, 5.291666587193807, 0.0},
                                   {two, {15.24F, 25.4F, 0.5F}, 2, 1.5234202333072666, 2.1441086143942292},
                                   {three, {15.24F, 25.4F, 0.5F}, 2, 1.6223652113280602, 1.1012338094894324},
                                   {one, {15.24F, 25.4F, 0.5F}, 9, 23.813543372066958, 0.0010437296948270814},
                                   {two, {15.24F, 25.4F, 0.5F}, 9, 10.708960584034516, 13.502058298925848},
                                   {three, {15.24F, 25.4F, 0.5F}, 9, 12.072377011209702, 9.7272857029358768},
                                   {one, {15.24F, 25.4F, 0.5F}, 20, 60.80865160157607, 7.8919857296380003},
                                   {two, {15.24F, 25.4F, 0.5F}, 20, 46.375489412227326, 52.582373223096953},
                                   {three, {15.24F, 25.4F, 0.5F}, 20, 48.194102606625932, 42.982788588239654},
                                   {one, {10, 20, 1}, 2, 10.133333333333333, 0.13333333333333333},
                                   {two, {10, 20, 1}, 2, 2.96794687408221, 8.6759101420311762},
                                   {three, {10, 20, 1}, 2, 4.4912519530852846, 5.1292455954274631},
                                   {one, {10, 20, 1}, 30, 466.66666666666667, 316.66666666666667},
                                   {two, {10, 20, 1}, 30, 450.97223872386207, 536.59168774309656},
                                   {three, {10, 20, 1}, 30, 456.10055026487759, 465.67045490001027},
                                   {one, {35.56F, 25.4F, 0.3F}, 5, 3.4017856159076404, 0.0},
                                   {two, {35.56F, 25.4F, 0.3F}, 5, 0.92842640248745049, 0.96814257643371014},
                                   {three, {35.56F, 25.4F, 0.3F}, 5, 0.87293306569625524, 0.49553152495874573},
                                   {one, {100, 1, 1}, 0.01F, 1.2499999720603228e-5, 0.0},
                                   {two, {100, 1, 1}, 0.01F, 3.1251627022148504e-6, 3.1251887443366723e-6},
                                   {three, {100, 1, 1}, 0.01F, 2.7780015012918443e-6, 1.3891126435175354e-6},
                                   {one, {15.24F, 25.4F, 0.5F}, 12, 32.000001632959506, 0.25000210979666385},
                                   {two, {15.24F, 25.4F, 0.5F}, 12, 17.752820509351591, 21.476950795873367},
                                   {three, {15.24F, 25.4F, 0.5F}, 12, 19.463499011176895, 16.336710600145128}}) {
    const LoopBound bound = loop_bound(build(c.id, c.p), c.depth);
    expect_near(bound.counter_clockwise, c.plus, std::string(name_of(c.id)));
    expect_near(bound.clockwise, c.minus, std::string(name_of(c.id)));
  }
}

TEST(energy, a_law_has_a_potential_exactly_where_its_bound_is_zero) {
  for (const LawName& name : kLaws)
    for (const Parameters& p : {kBump, {10, 20, 1}, {10000, 0.001F, 0.001F}, {10000, 20000, 1}}) {
      const Law law = build(name.id, p);
      const LoopBound bound = loop_bound(law, 2);
      EXPECT_EQ(potential(law).has_value(), bound.anywhere.high == 0) << name.name;
      EXPECT_EQ(bound.anywhere.low > 0, bound.anywhere.high > 0) << name.name;
    }
  // On w/2 = 10^4 mm the domain ends, and with it the only line of bump-2p.
  EXPECT_TRUE(potential(build(LawId::bump_2p, {10000, 20000, 1})));
  EXPECT_EQ(line_terms(build(LawId::bump_3p, {10000, 20000, 1})).size(), 1U);
}

TEST(energy, lines_rise_by_the_cosines_between_their_sides) {
  const auto [R, w, K, d, alpha, theta] = Numbers(kBump);
  const auto expect = [](LawId id, std::initializer_list<std::pair<double, double>> lines) {
    const std::vector<LineTerm> found = line_terms(build(id));
    ASSERT_EQ(found.size(), lines.size()) << name_of(id);
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_NEAR(low(found[i].x), lines.begin()[i].first, 1e-13) << name_of(id);
      EXPECT_NEAR(low(found[i].rise), lines.begin()[i].second, 1e-15) << name_of(id);
    }
  };
  for (const LawId id : {LawId::wall, LawId::cylinder, LawId::bump_cylinder, LawId::bump_1p}) expect(id, {});
  expect(LawId::bump_2p, {{w / 2, 1 - std::cos(alpha / 2)}});
  expect(LawId::bump_3p, {{R * std::sin(alpha / 3), std::cos(theta) - 1}, {w / 2, 1 - std::cos(theta)}});
  for (const LawId id : kShaded) expect(id, {{w / 2, 1 - d / R}});
}

TEST(energy, density_is_the_work_around_a_small_square_over_its_area) {
  std::mt19937 random(3);
  constexpr float kSide = 0x1p-8F;
  double largest = 0;
  for (const LawName& name : kLaws) {
    const Law law = build(name.id);
    const auto [R, w, K, d, alpha, theta] = Numbers(kBump);
    for (int i = 0; i < 60; ++i) {
      // In no square a line: x in steps of two sides, a margin off them; all below the surface.
      const float x = std::floor(std::uniform_real_distribution<float>(-800, 800)(random)) / 64 + 0x1p-7F;
      const float z = std::floor(std::uniform_real_distribution<float>(-800, -1)(random)) / 64;
      const double r = std::sqrt(R * R - static_cast<double>(x) * static_cast<double>(x));
      const float half = kSide / 2;
      const Path square{
          {x - half, z - half}, {x + half, z - half}, {x + half, z + half}, {x - half, z + half}, {x - half, z - half}};
      const double around = low(work(law, square)) / static_cast<double>(kSide * kSide);
      const double density = low(circulation_density(law, {x, z}));
      // κ is linear in z; the mean over the square differs by side²/24 times its second derivative in x at most,
      // 3K/R·(g R²/r³ - δ R²x/r⁵).
      const double bend = 3 * K / R *
                          (std::tan(theta) * R * R / std::pow(r - 0.1, 3) +
                           20 * R * R * std::fabs(static_cast<double>(x)) / std::pow(r - 0.1, 5));
      EXPECT_NEAR(around, density, bend * static_cast<double>(kSide * kSide) / 24) << name.name << ' ' << x << ' ' << z;
      largest = std::max(largest, std::fabs(density));
    }
    EXPECT_EQ(low(circulation_density(law, {3, 7})), 0) << "above every surface";
  }
  EXPECT_GT(largest, 0.3);
}

TEST(energy, no_simple_loop_generates_more_than_the_bound) {
  std::mt19937 random(4);
  const auto uniform = [&](double from, double to) { return std::uniform_real_distribution<double>(from, to)(random); };
  double best = 0;
  for (const LawId id : kActive)
    for (const Parameters& p : {kBump, {10, 20, 1}}) {
      const Law law = build(id, p);
      const auto w = static_cast<double>(p.width);
      const std::size_t loops = tests::drawn(100);
      for (std::size_t i = 0; i < loops; ++i) {
        // Below z = 0 by at most D - h nothing is deeper than D: corners in order around a middle.
        const double deep = uniform(0.1, 8), depth = deep + static_cast<double>(law.geometry().h.mid());
        const double middle = uniform(-0.6, 0.6) * w, reach = uniform(0.05, 0.6) * w;
        Path loop;
        for (int corner = 0; corner < 12; ++corner) {
          const double angle = (corner + uniform(0, 0.9)) * M_PI / 6, size = uniform(0.5, 1);
          loop.push_back(
              {static_cast<float>(middle + reach * size * std::cos(angle)), static_cast<float>(deep * size * std::sin(angle))});
        }
        loop.push_back(loop.front());
        Interval generated = work(law, loop);
        if (generated.high < 0) generated = {-generated.high, -generated.low};  // the other way round
        const LoopBound bound = loop_bound(law, static_cast<float>(depth) * (1 + 0x1p-22F));
        EXPECT_LE(generated.high, bound.anywhere.low) << name_of(id);
        best = std::max(best, low(generated) / low(bound.anywhere));
      }
    }
  EXPECT_GT(best, 0.3) << "loops that come nowhere near it test nothing";
}

TEST(energy, depths_outside_the_domain_are_refused) {
  const auto words = [](LawId id, float depth) {
    const auto error = depth_error(build(id), depth);
    return error ? error->message() : "fine";
  };
  EXPECT_EQ(words(LawId::bump_2p, 2), "fine");
  EXPECT_EQ(words(LawId::bump_2p, 1e4F), "fine");
  EXPECT_EQ(words(LawId::wall, 0.001F), "fine");
  EXPECT_EQ(words(LawId::wall, 0), "depth is 0 mm; expected 0.001 to 10000 mm");
  EXPECT_EQ(words(LawId::bump_2p, 0.001F), "depth is 0.001 mm; expected 0.001524 to 10000 mm");
  EXPECT_EQ(words(LawId::bump_2p, 10001), "depth is 10001 mm; expected 0.001524 to 10000 mm");
  EXPECT_EQ(words(LawId::bump_2p, std::nanf("")), "depth is nan mm; expected 0.001524 to 10000 mm");
}

}  // namespace
}  // namespace forceshade::reference
