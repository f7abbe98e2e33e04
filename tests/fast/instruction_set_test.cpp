// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

#include "forceshade/fast.h"

namespace forceshade::fast {
namespace {

TEST(instruction_set, has_a_name_by_which_it_is_found) {
  EXPECT_EQ(instruction_set_named("scalar"), InstructionSet::scalar);
  EXPECT_EQ(instruction_set_named("avx2"), InstructionSet::avx2);
  EXPECT_EQ(instruction_set_named("avx512"), InstructionSet::avx512);
  EXPECT_EQ(instruction_set_named("sse"), std::nullopt);
  for (const InstructionSet set : kInstructionSets) EXPECT_EQ(instruction_set_named(name_of(set)), set);
}

TEST(instruction_set, is_available_where_the_operating_system_says_so) {
  EXPECT_TRUE(is_available(InstructionSet::scalar));
  std::ifstream file("/proc/cpuinfo");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  if (text.find("flags") == std::string::npos) GTEST_SKIP() << "not x86 Linux";
  const auto listed = [&](const char* flag) { return text.find(std::string(" ") + flag + " ") != std::string::npos; };
  EXPECT_EQ(is_available(InstructionSet::avx2), listed("avx2") && listed("fma"));
  EXPECT_EQ(is_available(InstructionSet::avx512),
            listed("avx512f") && listed("avx512dq") && listed("avx512vl") && listed("avx512bw"));
}

TEST(instruction_set, is_the_widest_available_unless_named) {
  InstructionSet widest = InstructionSet::scalar;
  for (const InstructionSet set : kInstructionSets)
    if (is_available(set)) widest = set;
  EXPECT_EQ(best_instruction_set(), widest);
}

}  // namespace
}  // namespace forceshade::fast
