// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Fails each test of a program that includes this in which the real-time side cut an integer of a tick on a set of triangles.

#include <gtest/gtest.h>

#include "fast/soups/whole.h"

namespace forceshade::tests {

inline void expect_uncut() {
  EXPECT_EQ(fast::soups::Whole::cuts, 0U) << "an integer was longer than soup_bits_test allows";
}

class Uncut final : public testing::EmptyTestEventListener {
  void OnTestEnd(const testing::TestInfo& /*test*/) override { expect_uncut(); }
};
inline const bool kIsWatched = (testing::UnitTest::GetInstance()->listeners().Append(new Uncut), true);

}  // namespace forceshade::tests
