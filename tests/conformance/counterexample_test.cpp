// SPDX-License-Identifier: BSD-3-Clause
#include "properties/conformance/counterexample.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>

namespace forceshade::conformance {
namespace {

TEST(counterexample, is_lines_of_c_that_lose_nothing) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInfinite = std::numeric_limits<float>::infinity();
  const std::array<Eigen::Vector3f, 2> path{Eigen::Vector3f(3, -0.0F, 0x1p-149F), {kNan, kInfinite, -kInfinite}};
  const Identity identity{"mesh", "a\nb.off", {{"stiffness_N_per_mm", 0.5F}}};
  Judged judged;
  judged.exact.force = {0, 0, 0.1F};
  judged.its.force = {0, 0, -0.1F};
  const std::array<std::uint32_t, 2> periods{1, 20};
  EXPECT_EQ(test_to_paste(identity, path, periods, judged),
            "// a\\nb.off: stiffness 0.5 N/mm\n"
            "const float path_mm[][3] = {{0x1.8p+1f, -0x0p+0f, 0x1p-149f},\n"
            "                             {NAN, INFINITY, -INFINITY}};  // from no contact\n"
            "const unsigned periods[] = {1, 20};\n"
            "const float force_N[3] = {0x0p+0f, 0x0p+0f, 0x1.99999ap-4f};  // at its end, not {0x0p+0f, 0x0p+0f, "
            "-0x1.99999ap-4f}\n");
}

}  // namespace
}  // namespace forceshade::conformance
