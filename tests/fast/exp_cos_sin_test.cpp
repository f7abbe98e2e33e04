// SPDX-License-Identifier: BSD-3-Clause
// exp, cos and sin of the real-time side: what they leave out, on numbers that round nothing, and all of their bounds.

#include "fast/numbers/exp_cos_sin.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/support/multiprecision.h"

namespace forceshade::fast {

using tests::Multiprecision;

// A Ball whose midpoint is not rounded, to 1600 bits: its bound holds what a series leaves out, and nothing else.
template <int kBits, int kTerms>
struct Unrounded {
  Multiprecision value = 0, error = 0;

  static Unrounded exactly(double value) { return {value, 0}; }
  Unrounded operator-() const { return {-value, error}; }
  friend Unrounded operator+(const Unrounded& a, const Unrounded& b) { return {a.value + b.value, a.error + b.error}; }
  friend Unrounded operator-(const Unrounded& a, const Unrounded& b) { return a + -b; }
  friend Unrounded operator*(const Unrounded& a, const Unrounded& b) {
    return {a.value * b.value, abs(a.value) * b.error + abs(b.value) * a.error + a.error * b.error};
  }
  // The divisors of a series are whole numbers.
  friend Unrounded operator/(const Unrounded& a, const Unrounded& b) { return {a.value / b.value, a.error / abs(b.value)}; }
  friend Unrounded widened(const Unrounded& a, int k) { return {a.value, ldexp(abs(a.value), k)}; }
};

template <int kBitsOfArgument, int kTermsOfSeries>
struct SeriesSize<Unrounded<kBitsOfArgument, kTermsOfSeries>> {
  static constexpr int kBits = kBitsOfArgument, kTerms = kTermsOfSeries;
};

namespace {

using tests::bound_of;
using tests::value_of;

template <int kBits, int kTerms>
Multiprecision value_of(const Unrounded<kBits, kTerms>& ball) {
  return ball.value;
}
template <int kBits, int kTerms>
Multiprecision bound_of(const Unrounded<kBits, kTerms>& ball) {
  return ball.error;
}

template <class N>
void expect_within(const char* what, const N& ball, const Multiprecision& truth) {
  EXPECT_LE(Multiprecision(abs(truth - value_of(ball))), bound_of(ball)) << what << ": " << truth.str(30);
}

// Σ wⁱ first!/(first + i·step)!, until nothing more can be seen.
Multiprecision series(const Multiprecision& w, int first, int step) {
  Multiprecision sum = 1, term = 1;
  for (int i = 1; i < 300; ++i) {
    term *= w;
    for (int m = 0; m < step; ++m) term /= first + i * step - m;
    sum += term;
  }
  return sum;
}

template <class N>
class Series : public ::testing::Test {};
// The types of the three stages, and types with so few terms that the part left out is as large as its bound.
using Numbers = ::testing::Types<DoubleWithError, DoubleDouble, BigFloatBall<2>, BigFloatBall<4>, Unrounded<6, 10>,
                                 Unrounded<9, 12>, Unrounded<3, 1>, Unrounded<3, 2>, Unrounded<4, 3>, Unrounded<2, 5>>;
TYPED_TEST_SUITE(Series, Numbers);

TYPED_TEST(Series, leave_out_what_their_bound_holds) {
  constexpr int kBits = SeriesSize<TypeParam>::kBits;
  for (const int step : {1, 2})
    for (const double share : {1.0, 1 - 0x1p-53, 0.75, 0.5, 0x1p-20, 0.0})
      for (const int first : {0, 1}) {
        const double w = -share * std::ldexp(1.0, -kBits * step);
        expect_within("series", factorial_series(TypeParam::exactly(w), first, step), series(w, first, step));
      }
}

TYPED_TEST(Series, of_any_argument_enclose_exp_cos_and_sin) {
  std::mt19937_64 random(37);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int i = 0; i < 150; ++i) {
    const double size = std::ldexp(1 + (i % 3 == 0 ? 1 - 0x1p-52 : i % 3 == 1 ? 0 : uniform(random)), i % 16 - 9);
    for (const double argument : {size, size * uniform(random), size * std::ldexp(1.0, -40), 0.0}) {
      const TypeParam exact = TypeParam::exactly(argument);
      if constexpr (requires { sign(exact); }) expect_within("exp", exp_of_minus(exact, size), exp(Multiprecision(-argument)));
      const CosineAndSine<TypeParam> of = cosine_and_sine(exact, size);
      expect_within("cosine", of.cosine, cos(Multiprecision(argument)));
      expect_within("sine", of.sine, sin(Multiprecision(argument)));
      expect_within("sine of a negative angle", cosine_and_sine(-exact, size).sine, sin(Multiprecision(-argument)));
    }
  }
}

// An argument halved too seldom would be too large for the terms of the series.
TEST(series, halve_an_argument_until_a_few_terms_do) {
  for (double size = 0x1p-20; size < 0x1p40; size *= 1.3) {
    using One = Unrounded<3, 1>;
    EXPECT_LE(std::ldexp(size, -halvings<One>(size)), 0x1p-3) << size;
    EXPECT_LE(std::ldexp(std::nextafter(2 * size, 0), -halvings<One>(size)), 0x1p-2) << size;
  }
  for (const double power : {0x1p-3, 0.25, 1.0, 2.0, 1024.0})
    for (const double size : {power, std::nextafter(2 * power, 0)}) {
      const double q = std::ldexp(size, -halvings<Unrounded<3, 1>>(size));
      expect_within("exp", factorial_series(-Unrounded<3, 1>::exactly(q), 0, 1), exp(Multiprecision(-q)));
    }
}

// An enclosure still holds the number beyond binary64's range.
template <class N>
void encloses_a_far_tail() {
  for (double q = 250; q < 330; q += 0.0625) {
    const N ball = exp_of_minus(N::exactly(q), q);
    expect_within("tail", ball, exp(Multiprecision(-q)));
    EXPECT_EQ(bound_of(ball) < exp(Multiprecision(-q)), q < 300) << q;
  }
  expect_within("farthest tail", exp_of_minus(N::exactly(4e14), 4e14), Multiprecision(0));
}
TEST(series, enclose_tails_that_binary64_does_not_hold) {
  encloses_a_far_tail<DoubleWithError>();
  encloses_a_far_tail<DoubleDouble>();
}

template <class N>
void is_within(int exponent) {
  const Multiprecision reach = ldexp(Multiprecision(1), -exponent);
  for (const Multiprecision& member : {reach, Multiprecision(-reach), Multiprecision(0)})
    expect_within("remainder", within<N>(exponent), member);
}
TEST(series, remainders_reach_as_far_as_they_say) {
  for (const int exponent : {0, 1, 27, 60, 108, 511, 512}) {
    is_within<DoubleWithError>(exponent);
    is_within<DoubleDouble>(exponent);
  }
  for (const int exponent : {0, 192, 512, 513, 1000}) is_within<BigFloatBall<2>>(exponent);
  for (const int exponent : {1024, 1025, 2112}) {
    EXPECT_GE(within<BigFloatBall<32>>(exponent).error_exponent(), -exponent);
    EXPECT_LE(within<BigFloatBall<32>>(exponent).error_exponent(), -exponent + 4);
  }
}

}  // namespace
}  // namespace forceshade::fast
