// SPDX-License-Identifier: BSD-3-Clause
// Exact sums of roots, exponentials and waves against identities of algebra, and beside them.

#include "reference/numbers/exponential_sum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

namespace forceshade {
namespace {

using Sum = reference::ExponentialSum;

Sum ratio(int p, int q) {
  return Sum(p) / Sum(q);
}

// Expects that 0 is found to be 0, and moved by one part in 2^1000 to be positive or negative.
void expect_zero(const Sum& value, const char* what) {
  const Sum little = Sum(0x1p-1000) * sqrt(Sum(2));
  EXPECT_EQ(value.sign(), 0) << what;
  EXPECT_EQ((value + little).sign(), 1) << what;
  EXPECT_EQ((value - little).sign(), -1) << what;
}

TEST(exponential_sum, knows_the_identities_of_roots) {
  const Sum two = sqrt(Sum(2)), three = sqrt(Sum(3)), six = sqrt(Sum(6));
  expect_zero(two * sqrt(Sum(8)) - 4, "the product of roots may be whole");
  expect_zero(two * three - six, "the product of roots is a root");
  expect_zero((two + three) * (two + three) - 5 - Sum(2) * six, "the square of a sum");
  expect_zero(sqrt(ratio(2, 9)) - two / Sum(3), "the root of a quotient");
  expect_zero(Sum(1) / three - three / Sum(3), "a root in the denominator");
  expect_zero(sqrt(Sum(0.25)) - 0.5, "the root of a square");
  expect_zero(two * three * six - 6, "three roots");
}

TEST(exponential_sum, knows_the_identities_of_exponentials_and_waves) {
  std::mt19937 random(3);
  std::uniform_int_distribution<int> numerator(-1000, 1000), denominator(1, 9);
  const auto any = [&] { return ratio(numerator(random), denominator(random)); };
  for (int i = 0; i < 50; ++i) {
    const Sum a = any(), b = i % 5 == 0 ? a : i % 5 == 1 ? -a : any();
    expect_zero(sin(a) * sin(a) + cos(a) * cos(a) - 1, "Pythagoras");
    expect_zero(cos(a + b) - (cos(a) * cos(b) - sin(a) * sin(b)), "the cosine of a sum");
    expect_zero(sin(a + b) - (sin(a) * cos(b) + cos(a) * sin(b)), "the sine of a sum");
    expect_zero(sin(-a) + sin(a), "the sine is odd");
    const Sum p = a * a, q = b * b;
    expect_zero(exp(-p) * exp(-q) - exp(-(p + q)), "the product of exponentials");
    expect_zero(exp(-p) * cos(b) * (exp(-q) - sqrt(Sum(3))) - cos(b) * (exp(-(p + q)) - exp(-p) * sqrt(Sum(3))), "all of them");
  }
  expect_zero(exp(Sum(0)) - 1, "e^0");
  expect_zero(cos(Sum(0)) - 1, "cos 0");
  expect_zero(sin(Sum(0)), "sin 0");
}

TEST(exponential_sum, sees_what_no_enclosure_sees) {
  const Sum tiny = exp(-Sum(2e14));  // 2^(-2.9·10^14)
  EXPECT_EQ((ratio(1, 3) + tiny - ratio(1, 3)).sign(), 1);
  EXPECT_EQ((tiny - tiny * cos(ratio(1, 1000000)) - tiny * tiny).sign(), 1);
  EXPECT_EQ((tiny * tiny - tiny).sign(), -1);
  EXPECT_EQ((exp(-Sum(1)) - exp(-Sum(1) - Sum(0x1p-300))).sign(), 1) << "exponents that all but agree";
  EXPECT_EQ((cos(Sum(1e7)) - cos(Sum(1e7) + Sum(0x1p-300))).sign(), std::sin(1e7) > 0 ? 1 : -1);
}

TEST(exponential_sum, has_the_sign_of_terms_that_are_alike_but_differ) {
  const Sum one(1), two(2);
  EXPECT_EQ((sin(one) - cos(one)).sign(), 1) << "a sine is no cosine of the same angle";
  expect_zero(two * sin(one) - sin(one) * two, "a number times a sine, either way round");
  EXPECT_EQ((two * exp(-one) - Sum(6) * exp(-two)).sign(), -1) << "2/e is less than 6/e^2";
  EXPECT_EQ(cos(Sum(3)).sign(), -1) << "one wave, of a positive factor";
  EXPECT_EQ((exp(-one - Sum(0x1p-300)) - exp(-one)).sign(), -1) << "less than 256 bits show";
}

TEST(exponential_sum, agrees_with_binary64_where_that_can_tell) {
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> number(-3, 3);
  for (int i = 0; i < 300; ++i) {
    const double a = number(random), b = number(random), c = number(random), d = number(random);
    const double value = a * std::exp(-b * b) + c * std::cos(d) * std::sqrt(d * d + 1) - std::sin(a);
    if (std::fabs(value) < 1e-10) continue;
    const Sum exact = Sum(a) * exp(-(Sum(b) * b)) + Sum(c) * cos(Sum(d)) * sqrt(Sum(d) * d + 1) - sin(Sum(a));
    EXPECT_EQ(exact.sign(), value > 0 ? 1 : -1) << a << ' ' << b << ' ' << c << ' ' << d;
  }
}

TEST(exponential_sum, refuses_what_leads_out_of_its_numbers) {
  const Sum root = sqrt(Sum(2));
  EXPECT_THROW(sqrt(root), std::logic_error);
  EXPECT_THROW(sqrt(Sum(-1)), std::logic_error);
  EXPECT_THROW(exp(root), std::logic_error);
  EXPECT_THROW(exp(Sum(1)), std::logic_error);
  EXPECT_THROW(cos(root), std::logic_error);
  EXPECT_THROW(Sum(1) / (Sum(1) + root), std::logic_error);
  EXPECT_THROW(Sum(1) / Sum(0), std::logic_error);
  EXPECT_THROW(Sum(1) / cos(Sum(1)), std::logic_error);
}

}  // namespace
}  // namespace forceshade
