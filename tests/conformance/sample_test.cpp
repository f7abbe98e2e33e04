// SPDX-License-Identifier: BSD-3-Clause
#include "properties/conformance/sample.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace forceshade::conformance {
namespace {

using Numbers = Sample<std::uint64_t>;

TEST(sample, keeps_all_where_they_are_few) {
  Numbers sample;
  for (std::uint64_t i = 0; i < 5; ++i) sample.add(i, 10 * i);
  std::vector<std::uint64_t> values = sample.values();
  std::ranges::sort(values);
  EXPECT_EQ(values, (std::vector<std::uint64_t>{0, 10, 20, 30, 40}));
}

TEST(sample, is_the_same_in_whatever_order_they_come) {
  constexpr std::uint64_t kCount = 3 * Numbers::kMost;
  Numbers forwards, backwards;
  for (std::uint64_t i = 0; i < kCount; ++i) forwards.add(i, i);
  for (std::uint64_t i = kCount; i-- > 0;) backwards.add(i, i);
  EXPECT_EQ(forwards.values(), backwards.values());
  EXPECT_EQ(forwards.values().size(), Numbers::kMost);
  EXPECT_EQ(forwards.seen(), kCount);
}

// Each sixteenth of the numbers has its share, to five standard deviations of a random one.
TEST(sample, prefers_neither_the_first_nor_the_last) {
  constexpr std::uint64_t kParts = 16, kOfPart = 5000;
  Numbers sample;
  for (std::uint64_t i = 0; i < kParts * kOfPart; ++i) sample.add(i, i);
  std::vector<double> kept(kParts);
  for (const std::uint64_t i : sample.values()) ++kept[i / kOfPart];
  const double expected = static_cast<double>(Numbers::kMost) / kParts;
  for (const double one : kept) EXPECT_NEAR(one, expected, 5 * std::sqrt(expected));
}

}  // namespace
}  // namespace forceshade::conformance
