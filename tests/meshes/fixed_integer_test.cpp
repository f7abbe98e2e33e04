// SPDX-License-Identifier: BSD-3-Clause
// The exact integers of the fast path against integers of any size.

#include "fast/numbers/fixed_integer.h"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <cstdio>
#include <random>
#include <utility>

namespace forceshade::fast {
namespace {

using Integer = boost::multiprecision::cpp_int;

// An integer in both forms, built from the same pieces.
template <int kBits>
struct Pair {
  FixedInteger<kBits> fixed;
  Integer wide;
};

// Any bits, a power of two and its neighbours, 0, few bits, of either sign.
class Pairs {
 public:
  template <int kBits>
  Pair<kBits> next() {
    Pair<kBits> result;
    const auto bits = static_cast<int>(random_() % kBits);  // at most kBits - 1, so that one more unit fits
    switch (random_() % 4) {
      case 0: break;
      case 1: add(result, 1, bits); break;
      case 2:
        add(result, 1, bits);
        add(result, random_() % 2 == 0 ? 1 : -1, 0);
        break;
      default:
        for (int i = bits - 1; i >= 0; i -= 1 + static_cast<int>(random_() % 7)) add(result, 1, i);
        break;
    }
    if (random_() % 2 == 0) result = {-result.fixed, -result.wide};
    return result;
  }

 private:
  template <int kBits>
  static void add(Pair<kBits>& to, int significand, int shift) {
    to.wide += Integer(significand) << shift;
    typename FixedInteger<kBits>::Words words;
    Integer rest = to.wide < 0 ? (Integer(1) << (64 * words.size())) + to.wide : to.wide;
    for (std::uint64_t& word : words) {
      word = static_cast<std::uint64_t>(rest & ~std::uint64_t{0});
      rest >>= 64;
    }
    to.fixed = FixedInteger<kBits>(words);
  }

  std::mt19937_64 random_{1};
};

template <int kBits>
Integer wide(const FixedInteger<kBits>& value) {
  Integer result = 0;
  const auto& words = value.words();
  for (std::size_t i = words.size(); i-- > 0;) result = (result << 64) + words[i];
  if ((words.back() >> 63) != 0) result -= Integer(1) << (64 * words.size());
  return result;
}

struct Reached {
  int negative = 0, zero = 0, positive = 0, equal = 0;
};

template <int kA, int kB>
void compare_operations(Pairs& pairs, Reached& reached) {
  for (int i = 0; i < 2000; ++i) {
    const Pair<kA> a = pairs.next<kA>();
    Pair<kB> b = pairs.next<kB>();
    if constexpr (kA == kB)
      if (i % 16 == 0) b = a;
    ASSERT_EQ(wide(a.fixed), a.wide);
    ASSERT_EQ(wide(a.fixed + b.fixed), a.wide + b.wide);
    ASSERT_EQ(wide(a.fixed - b.fixed), a.wide - b.wide);
    ASSERT_EQ(wide(a.fixed * b.fixed), a.wide * b.wide);
    ASSERT_EQ(wide(-a.fixed), -a.wide);
    ASSERT_EQ(wide(a.fixed.template shifted<24>()), a.wide << 24);
    ASSERT_EQ(a.fixed.sign(), a.wide.sign());
    ASSERT_EQ(a.fixed.compare(b.fixed), a.wide.compare(b.wide) < 0 ? -1 : a.wide.compare(b.wide) > 0);
    ASSERT_EQ(a.fixed.bit_length(), a.wide == 0 ? 0 : static_cast<int>(msb(Integer(abs(a.wide)))) + 1);
    // By any shift, and by one that makes the two about equally long.
    const int shift = i % 2 == 0 ? i % 301 - 150 : b.fixed.bit_length() - a.fixed.bit_length() + i % 3 - 1;
    const Integer left = abs(a.wide) << (shift > 0 ? shift : 0), right = abs(b.wide) << (shift < 0 ? -shift : 0);
    ASSERT_EQ(compare_sizes(a.fixed, shift, b.fixed), left < right ? -1 : left > right ? 1 : 0);
    const auto product = a.fixed * b.fixed;
    const double exact = static_cast<double>(a.wide * b.wide);
    ASSERT_LE(std::abs(product.approximately() - exact), 0x1p-51 * std::abs(exact));
    (a.wide.sign() < 0 ? reached.negative : a.wide.sign() == 0 ? reached.zero : reached.positive) += 1;
    reached.equal += a.wide == b.wide;
  }
}

TEST(fixed_integer, has_the_results_of_integers_of_any_size) {
  Pairs pairs;
  Reached reached;
  compare_operations<24, 24>(pairs, reached);
  compare_operations<63, 64>(pairs, reached);
  compare_operations<64, 64>(pairs, reached);
  compare_operations<67, 25>(pairs, reached);
  compare_operations<68, 137>(pairs, reached);
  compare_operations<127, 128>(pairs, reached);
  compare_operations<192, 191>(pairs, reached);
  compare_operations<277, 277>(pairs, reached);
  compare_operations<25, 320>(pairs, reached);
  std::printf("first operand negative %d, zero %d, positive %d; equal %d\n", reached.negative, reached.zero, reached.positive,
              reached.equal);
  EXPECT_GT(reached.negative, 100);
  EXPECT_GT(reached.zero, 100);
  EXPECT_GT(reached.positive, 100);
  EXPECT_GT(reached.equal, 100);
}

TEST(fixed_integer, holds_every_coordinate_in_units_of_its_last_bit) {
  std::mt19937 random(2);
  int small = 0, large = 0;
  for (int i = 0; i < 100000; ++i) {
    auto value = __builtin_bit_cast(float, static_cast<std::uint32_t>(random()));
    const float exponent = std::ldexp(1.0F, static_cast<int>(random() % 45) - 31);
    if (i % 2 == 0) value = exponent * (1 + static_cast<float>(random() % 8) * 0x1p-23F);
    if (!(std::fabs(value) >= 0x1p-30F && std::fabs(value) <= 1e4F)) continue;
    small += std::fabs(value) < 0x1p-28F;
    large += std::fabs(value) > 4096;
    // A binary64 times 2^53 is whole here, for binary32 has 24 bits; so is what cpp_int takes from it.
    ASSERT_EQ(wide(in_units(value)), Integer(std::ldexp(static_cast<double>(value), 53))) << value;
  }
  std::printf("small %d, large %d\n", small, large);
  EXPECT_GT(small, 100);
  EXPECT_GT(large, 100);
  for (const float zero : {0.0F, -0.0F}) EXPECT_TRUE(in_units(zero).is_zero());
  EXPECT_EQ(wide(in_units(1e4F)), Integer(10000) << 53);
  EXPECT_EQ(wide(in_units(-0x1p-30F)), -(Integer(1) << 23));
}

// The types of results bound them: the sizes that fast/meshes/bits.md states.
TEST(fixed_integer, widens_by_what_an_operation_can_need) {
  using A = FixedInteger<68>;
  using B = FixedInteger<137>;
  EXPECT_EQ((decltype(A{} * A{} - A{} * A{})::kMostBits), 137);
  EXPECT_EQ((decltype(A{} * B{} + A{} * B{} + A{} * B{})::kMostBits), 207);
  EXPECT_EQ(FixedInteger<63>::kWords, 1U);
  EXPECT_EQ(FixedInteger<64>::kWords, 2U);
}

}  // namespace
}  // namespace forceshade::fast
