// SPDX-License-Identifier: BSD-3-Clause
#include "properties/conformance/doors/lines.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

namespace forceshade::conformance {
namespace {

Eigen::Vector3f with_bits(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  return {std::bit_cast<float>(x), std::bit_cast<float>(y), std::bit_cast<float>(z)};
}

TEST(lines, carry_the_bits_of_every_number) {
  const std::vector<Eigen::Vector3f> numbers{with_bits(0x80000000, 0x7fc12345, 0xff800001),
                                             with_bits(1, 0x40490fdb, 0xdeadbeef)};
  const std::string line = line_of(kAnswers, numbers);
  EXPECT_EQ(line, R"({"answers":["800000007fc12345ff800001","0000000140490fdbdeadbeef"]})");
  const auto found = numbers_in(line, kAnswers);
  ASSERT_TRUE(found && found->size() == numbers.size());
  for (std::size_t i = 0; i < numbers.size(); ++i)
    for (Eigen::Index axis = 0; axis < 3; ++axis)
      EXPECT_EQ(std::bit_cast<std::uint32_t>((*found)[i][axis]), std::bit_cast<std::uint32_t>(numbers[i][axis]));
}

TEST(lines, are_read_with_spaces_and_capital_digits) {
  const auto found = numbers_in(R"({"answers": [ "3F8000003f8000003f800000" , "400000004000000040000000" ] } )", kAnswers);
  ASSERT_TRUE(found && found->size() == 2);
  EXPECT_EQ((*found)[0], Eigen::Vector3f(1, 1, 1));
  EXPECT_EQ((*found)[1], Eigen::Vector3f(2, 2, 2));
}

TEST(lines, of_positions_may_have_periods) {
  const std::vector<Eigen::Vector3f> numbers(3, {1, 2, 3});
  const std::vector<std::uint32_t> periods{1, 0, 4294967295};
  const std::string line = line_of(kNewPath, numbers, periods);
  EXPECT_TRUE(line.ends_with(R"(],"periods":[1,0,4294967295]})")) << line;
  const auto found = [](const std::string& text) {
    std::vector<std::uint32_t> its;
    return numbers_in(text, kNewPath, &its) ? std::optional(its) : std::nullopt;
  };
  EXPECT_EQ(found(line), periods);
  EXPECT_EQ(found(line_of(kNewPath, numbers)), std::vector<std::uint32_t>());
  EXPECT_FALSE(numbers_in(line, kNewPath)) << "where none are expected";
  for (const char* wrong : {"[1,0,4294967296]", "[1,0,-1]", "[1,0,]", "[]", "[1,0", "1]"}) {
    std::string other = line;
    EXPECT_FALSE(found(other.replace(other.find("[1,0,"), std::string("[1,0,4294967295]").size(), wrong))) << other;
  }
}

TEST(lines, are_nothing_where_they_are_others) {
  const std::string right = line_of(kAnswers, std::vector<Eigen::Vector3f>(2, {1, 2, 3}));
  ASSERT_TRUE(numbers_in(right, kAnswers));
  EXPECT_FALSE(numbers_in(right, kPositions));
  EXPECT_FALSE(numbers_in(line_of(kAnswers, {}), kAnswers)) << "the general reader says what is wrong with an empty list";
  for (std::size_t length = 0; length < right.size(); ++length)
    EXPECT_FALSE(numbers_in(right.substr(0, length), kAnswers)) << length;
  // Any other character makes the line wrong; only a digit may take a digit's place.
  for (std::size_t at = 0; at < right.size(); ++at)
    for (const char c : {'\0', ' ', 'g', '"', ',', '\x80', '/', ':', '@', '`'}) {
      std::string other = right;
      if (std::exchange(other[at], c) == c) continue;
      EXPECT_FALSE(numbers_in(other, kAnswers)) << other;
    }
  EXPECT_FALSE(numbers_in(right + "}", kAnswers));
  EXPECT_FALSE(numbers_in(right + right, kAnswers));
}

}  // namespace
}  // namespace forceshade::conformance
