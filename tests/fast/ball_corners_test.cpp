// SPDX-License-Identifier: BSD-3-Clause
// One operation at a time, its operands' errors of every size down to below the rounding error: the result encloses what the
// ends of the operands' enclosures give. Here a bound cannot live on the slack of the bounds before it.

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <type_traits>

#include "fast/meshes/bounded_vector3.h"
#include "tests/support/multiprecision.h"

namespace forceshade::fast {
namespace {

using tests::bound_of;
using tests::Multiprecision;
using tests::value_of;
using Wide2 = BigFloatBall<2>;

template <class N>
N midpoint_of(const N& ball) {
  if constexpr (std::is_same_v<N, DoubleWithError>)
    return DoubleWithError::exactly(ball.value);
  else
    return midpoint(ball);
}

class Operands {
 public:
  // 1 to 2, either sign: any bits, a power of two and the numbers next to it, few bits, mostly ones.
  double significand() {
    const double any = std::uniform_real_distribution<double>(1, 2)(random_);
    double size = any;
    switch (pick(6)) {
      case 0: size = 1; break;
      case 1: size = 1 + std::ldexp(1.0, -52 + static_cast<int>(pick(3))); break;
      case 2: size = 2 - std::ldexp(1.0, -52 + static_cast<int>(pick(3))); break;
      case 3: size = 1 + std::ldexp(static_cast<double>(pick(16)), -4); break;
      case 4: size = 1 + std::ldexp(1.0, -static_cast<int>(pick(53))); break;
      default: break;
    }
    return pick(2) == 0 ? size : -size;
  }

  // Numbers of about the size 1, so that sums cancel, are ties, or lose one number beside the other.
  template <class N>
  N next() {
    // 0, give or take.
    if (pick(16) == 0) {
      const N size = widened(N::exactly(1), -static_cast<int>(pick(100)));
      return size - midpoint_of(size);
    }
    const int exponent = pick(3) == 0 ? -static_cast<int>(pick(150)) : static_cast<int>(pick(4)) - 2;
    if constexpr (std::is_same_v<N, DoubleWithError>) {
      DoubleWithError ball = DoubleWithError::exactly(std::ldexp(significand(), exponent));
      ball.error = error_of(ball.value, 60);
      return ball;
    } else if constexpr (std::is_same_v<N, DoubleDouble>) {
      const double hi = std::ldexp(significand(), exponent);
      // At most half a unit in the last place of hi.
      const double lo =
          pick(4) == 0 ? 0 : std::ldexp(significand(), std::ilogb(hi) - 54 - (pick(2) == 0 ? 0 : static_cast<int>(pick(54))));
      const TwoTerms sum = fast_two_sum(hi, lo);
      return {sum.hi, sum.lo, error_of(hi, 112)};
    } else {
      // Three pieces, the last of which the limbs cut off.
      Wide2 ball = Wide2::exactly(std::ldexp(significand(), exponent));
      const bool is_long = pick(4) != 0;
      for (int piece = 1; is_long && piece < 3; ++piece)
        ball = midpoint(ball + Wide2::exactly(std::ldexp(significand(), exponent - 53 * piece - static_cast<int>(pick(3)))));
      if (ball == Wide2()) return ball;
      return pick(3) == 0 ? ball : widened(ball, 4 - static_cast<int>(pick(2) == 0 ? pick(138) : pick(8)));
    }
  }

  std::uint64_t pick(std::uint64_t count) { return random_() % count; }

 private:
  // Nothing, a power of two or any bits, from 2^-bits of the value to the value itself and the numbers next to that.
  double error_of(double value, std::uint64_t bits) {
    switch (pick(6)) {
      case 0: return 0;
      case 1: return std::fabs(value) * (1 + std::ldexp(static_cast<double>(pick(33)) - 16, -53));
      case 2: return std::ldexp(std::fabs(value), -static_cast<int>(pick(bits)));
      default: return std::ldexp(std::fabs(significand()), std::ilogb(value) - static_cast<int>(pick(bits)));
    }
  }

  std::mt19937_64 random_{29};
};

template <class N>
std::array<Multiprecision, 3> ends_and_middle(const N& ball) {
  const Multiprecision middle = value_of(ball), reach = bound_of(ball);
  return {middle - reach, middle, middle + reach};
}

template <class N>
class Encloses {
 public:
  // The share of the bound that is used, at the worst.
  double worst() const { return worst_; }
  void operator()(const char* operation, const N& ball, const Multiprecision& truth) {
    const Multiprecision error = abs(truth - value_of(ball)), bound = bound_of(ball);
    ASSERT_LE(error, bound) << operation << ": " << truth.str(45) << " is outside of " << value_of(ball).str(45) << " +- "
                            << bound.str(20);
    if (bound > 0) worst_ = std::max(worst_, static_cast<double>(Multiprecision(error / bound)));
  }

 private:
  double worst_ = 0;
};

template <class N>
class BallCorners : public ::testing::Test {};
using Balls = ::testing::Types<DoubleWithError, DoubleDouble, Wide2>;
TYPED_TEST_SUITE(BallCorners, Balls);

TYPED_TEST(BallCorners, sums_products_quotients_and_roots_enclose_those_of_all_members) {
  using N = TypeParam;
  Operands operands;
  Encloses<N> sums, products, quotients, roots;
  int without_quotient = 0;
  for (int i = 0; i < 8000; ++i) {
    const N a = operands.next<N>(), b = operands.next<N>();
    const auto in_a = ends_and_middle(a), in_b = ends_and_middle(b);
    const N sum = a + b, difference = a - b, product = a * b, quotient = a / b, root = square_root(a);
    const bool has_quotient = abs(in_b[1]) > bound_of(b);
    without_quotient += !has_quotient;
    ASSERT_TRUE(has_quotient || bound_of(quotient) > 0x1p1000) << "a divisor that may be 0";
    for (const Multiprecision& x : in_a) {
      if (x >= 0) roots("root", root, sqrt(x));
      for (const Multiprecision& y : in_b) {
        sums("sum", sum, x + y);
        sums("difference", difference, x - y);
        products("product", product, x * y);
        if (has_quotient) quotients("quotient", quotient, x / y);
      }
    }
    if (this->HasFatalFailure()) return;
  }
  std::printf("  worst error/bound: sums %.3f, products %.3f, quotients %.3f, roots %.3f; %d divisors that may be 0\n",
              sums.worst(), products.worst(), quotients.worst(), roots.worst(), without_quotient);
  for (const Encloses<N>& one : {sums, products, quotients, roots}) EXPECT_GT(one.worst(), 0.2) << "the bound is idle";
  EXPECT_GT(without_quotient, 100);
}

// cross() and dot() of meshes, which bound several operations at once.
TEST(ball_corners, sums_of_products_enclose_those_of_all_members) {
  using N = DoubleWithError;
  Operands operands;
  Encloses<N> differences, dots;
  int looser = 0, sums = 0;
  for (int i = 0; i < 3000; ++i) {
    // Half of them without errors, where the bound is that of the roundings alone.
    const bool is_exact = operands.pick(2) == 0;
    const auto next = [&] { return is_exact ? midpoint_of(operands.next<N>()) : operands.next<N>(); };
    const Vector3<N> a{next(), next(), next()};
    Vector3<N> b{next(), next(), next()};
    if (operands.pick(2) == 0) b.y = a.x, b.x = a.y;  // so that the difference cancels
    const N difference = cross(a, b).z, product = dot(a, b);
    const N one_by_one = a.x * b.x + a.y * b.y + a.z * b.z;
    looser += product.error > 2 * one_by_one.error;
    ++sums;
    const auto x = ends_and_middle(a.x), y = ends_and_middle(a.y), z = ends_and_middle(a.z);
    const auto u = ends_and_middle(b.x), v = ends_and_middle(b.y), w = ends_and_middle(b.z);
    for (unsigned ends = 0; ends < 64; ++ends) {
      const auto end = [&](const auto& of, unsigned bit) { return of[(ends >> bit & 1U) * 2]; };
      const Multiprecision xu = end(x, 0) * end(u, 3), yv = end(y, 1) * end(v, 4), zw = end(z, 2) * end(w, 5);
      dots("dot product", product, xu + yv + zw);
      differences("difference of products", difference, end(x, 0) * end(v, 4) - end(y, 1) * end(u, 3));
    }
    if (HasFatalFailure()) return;
  }
  std::printf("  worst error/bound: differences %.3f, dot products %.3f; %d of %d bounds over twice that of the operations\n",
              differences.worst(), dots.worst(), looser, sums);
  EXPECT_GT(differences.worst(), 0.9);
  EXPECT_GT(dots.worst(), 0.9);
  EXPECT_LT(looser, sums / 10);
}

TYPED_TEST(BallCorners, signs_are_those_of_all_members) {
  using N = TypeParam;
  Operands operands;
  std::array<int, 4> signs{};
  for (int i = 0; i < 20000; ++i) {
    const N a = operands.next<N>();
    const auto in_a = ends_and_middle(a);
    const Sign decided = proved_sign(a);
    ++signs[static_cast<std::size_t>(decided)];
    for (const Multiprecision& x : in_a) {
      const Sign sign_of_x = x > 0 ? Sign::positive : x < 0 ? Sign::negative : Sign::zero;
      ASSERT_TRUE(decided == Sign::unknown || decided == sign_of_x) << x.str(45);
    }
    ASSERT_TRUE(decided != Sign::unknown || abs(in_a[1]) <= 4.5 * bound_of(a)) << "decides where there is no doubt";
  }
  EXPECT_EQ(proved_sign(N::exactly(0)), Sign::zero);
  for (const Sign reached : {Sign::negative, Sign::positive, Sign::unknown})
    EXPECT_GT(signs[static_cast<std::size_t>(reached)], 1000);
}

TYPED_TEST(BallCorners, what_is_widened_or_shortened_encloses_what_it_was) {
  using N = TypeParam;
  Operands operands;
  Encloses<N> enclosed;
  for (int i = 0; i < 2000; ++i) {
    const N a = operands.next<N>();
    const Multiprecision middle = value_of(a);
    for (const int k : {-100, -3, 0, 1}) {
      // The first number of a double-double counts as its value.
      const Multiprecision reach = ldexp(abs(middle), k) * (1 - 0x1p-52);
      for (const Multiprecision& x : {Multiprecision(middle - reach), Multiprecision(middle + reach)})
        enclosed("widened", widened(a, k), x);
    }
    if constexpr (std::is_same_v<N, Wide2>) {
      // Two limbs become one, the error as before, smaller or larger than what is cut off.
      for (const Multiprecision& x : ends_and_middle(a)) {
        ASSERT_LE(abs(x - value_of(BigFloatBall<1>(a))), bound_of(BigFloatBall<1>(a)));
        enclosed("in more bits", Wide2(BigFloatBall<3>(a)), x);
      }
      enclosed("scaled", a.scaled(-7), ldexp(ends_and_middle(a)[2], -7));
    }
    if (this->HasFatalFailure()) return;
  }
}

// The numbers next to a tie, their errors next to the distance from it: an answer is one that all members round to.
template <class N>
class RoundingCorners : public ::testing::Test {};
using BallsThatRound = ::testing::Types<DoubleWithError, DoubleDouble>;
TYPED_TEST_SUITE(RoundingCorners, BallsThatRound);

TYPED_TEST(RoundingCorners, an_answer_is_that_of_all_members) {
  using N = TypeParam;
  Operands operands;
  std::mt19937_64 random(31);
  const auto pick = [&](int count) { return static_cast<int>(random() % static_cast<std::uint64_t>(count)); };
  int decided = 0, open = 0;
  for (int i = 0; i < 40000; ++i) {
    const auto candidate = static_cast<float>(std::ldexp(operands.significand(), pick(3) == 0 ? -149 : pick(9) - 4));
    const auto tie_beside = [](float number, float towards) {
      return 0.5 * (static_cast<double>(number) + static_cast<double>(std::nextafter(number, towards)));
    };
    const double tie = tie_beside(candidate, HUGE_VALF), unit = std::ldexp(std::fabs(tie), -52);
    const double off = std::ldexp(pick(9) - 4, -pick(3)) * unit;
    N ball = N::exactly(tie + off);
    if constexpr (std::is_same_v<N, DoubleDouble>)
      ball.lo = pick(2) == 0 ? 0 : std::ldexp(pick(3) - 1, std::ilogb(unit) - pick(40));
    const double distance = std::fabs((tie + off) - tie);
    if (pick(4) != 0)
      ball.error = distance * (1 + std::ldexp(pick(5) - 2, -53 + pick(53))) + (pick(2) == 0 ? 0 : std::ldexp(unit, -pick(60)));
    const std::optional<float> answer = round_to_binary32(ball);
    ++(answer ? decided : open);
    if (!answer) continue;
    const bool is_even = (__builtin_bit_cast(unsigned, *answer) & 1U) == 0;
    const Multiprecision up = tie_beside(*answer, HUGE_VALF), down = tie_beside(*answer, -HUGE_VALF);
    for (const Multiprecision& x : ends_and_middle(ball)) {
      ASSERT_TRUE(is_even ? x <= up : x < up) << x.str(45) << " is not rounded to " << *answer;
      ASSERT_TRUE(is_even ? x >= down : x > down) << x.str(45) << " is not rounded to " << *answer;
    }
  }
  EXPECT_GT(decided, 4000);
  EXPECT_GT(open, 4000);
}

}  // namespace
}  // namespace forceshade::fast
