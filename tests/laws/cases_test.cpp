// SPDX-License-Identifier: BSD-3-Clause
// A case file that is empty or malformed is refused by file and line, so it cannot pass for a test.

#include "tests/laws/cases.h"

#include <gtest/gtest.h>

#include <sstream>

#include "files/csv.h"
#include "tests/support/words.h"

namespace forceshade::tests {
namespace {

const std::string kHeader = "R,w,K,x,z,Fx,Fz,from tie,why\n";

std::string refusal_of(const std::string& text) {
  std::istringstream in(text);
  return tests::thrown_by<Error>([&] { read_hard_cases(in, "tests/some.cases"); });
}

TEST(cases, are_read_with_their_place) {
  std::istringstream in(kHeader + "2,1,0x1p-1,0x0p+0,-0x1.8p+1,0,0x1.8p+0,z 2^-50.0,why not\n");
  const std::vector<HardCase> cases = read_hard_cases(in, "tests/some.cases");
  ASSERT_EQ(cases.size(), 1U);
  EXPECT_EQ(cases[0].parameters, (Parameters{2, 1, 0.5F}));
  EXPECT_EQ(cases[0].position, Eigen::Vector3f(0, 0, -3));
  EXPECT_EQ(cases[0].force, Eigen::Vector3f(0, 0, 1.5F));
  EXPECT_EQ(cases[0].place, "tests/some.cases:2");
}

TEST(cases, must_not_be_none) {
  EXPECT_NE(refusal_of(""), "");
  EXPECT_EQ(refusal_of(kHeader), "tests/some.cases:1: expected cases below the header");
}

TEST(cases, are_refused_by_file_and_line) {
  EXPECT_EQ(refusal_of(kHeader + "1,1,1,0,-1,0,1,z 0,a tie\n1,1,1,0,deep,0,1,z 0,a tie\n"),
            "tests/some.cases:3: column 5 (z): expected a number, got \"deep\"");
  EXPECT_EQ(refusal_of(kHeader + "1,1,1,0,-1,0,1,z 0,\n"), "tests/some.cases:2: column 9 (why): expected words, got \"\"");
}

TEST(cases, are_as_far_from_a_tie_as_they_are) {
  const float z = -8388609.0F * 0x1p-22F;  // 2^23 + 1 units
  const auto distance = [&](float K) {
    return distance_from_tie(std::get<reference::Law>(reference::Law::build(LawId::wall, {0, 0, K})), {0, 0, z});
  };
  EXPECT_EQ(distance(1.5F), "z 0") << "25 bits, the last one set";
  EXPECT_EQ(distance(1), "z 2^-24.0") << "a binary32 number: half a unit";
  EXPECT_EQ(distance(0x1.fffffep-1F), "z 2^-47.0") << "(2^24 - 1)(2^23 + 1) = 2^47 + 2^23 - 1, one below a tie";
}

}  // namespace
}  // namespace forceshade::tests
