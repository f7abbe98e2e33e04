// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The suite that every fault of a list passes: it has the reaction that the list says.

#include <gtest/gtest.h>

#include <cctype>
#include <cstdio>
#include <ostream>
#include <string>
#include <vector>

#include "files/csv.h"
#include "tests/device/faults/fault.h"

namespace forceshade::faults {

// Google Test's name for a parameter.
inline void PrintTo(const Fault& fault, std::ostream* out) {
  *out << fault.what;
}

inline std::string all_of(const std::vector<std::string>& complaints) {
  std::string all;
  for (const std::string& complaint : complaints) all += complaint + "\n";
  return all;
}

// Those of these lists that are judged by the order of events, or the others.
inline std::vector<Fault> faults_of(const std::vector<std::vector<Fault>>& lists, bool is_timed = false) {
  std::vector<Fault> all;
  for (const std::vector<Fault>& list : lists)
    for (const Fault& fault : list)
      if (fault.is_timed == is_timed) all.push_back(fault);
  return all;
}

class fault : public testing::TestWithParam<Fault> {};

TEST_P(fault, has_its_reaction) {
  const Outcome outcome = tried(GetParam());
  EXPECT_EQ(all_of(complaints(GetParam(), outcome)), "");
  std::printf("  %s; %.3g N before; zero after %s; %g lost\n", outcome.reaction.substr(0, 300).c_str(), outcome.before,
              outcome.to_zero ? files::shortest(*outcome.to_zero).c_str() : "never", outcome.lost);
}

inline std::string test_name(const testing::TestParamInfo<Fault>& info) {
  std::string name = name_of(info.param.kind) + "_" + info.param.what;
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return name;
}

}  // namespace forceshade::faults
