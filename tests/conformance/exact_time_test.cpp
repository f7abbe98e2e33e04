// SPDX-License-Identifier: BSD-3-Clause
// Differences of times that binary64 cannot hold.
#include "properties/conformance/recordings/exact_time.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <sstream>

#include "properties/conformance/recordings/recording.h"

namespace forceshade::conformance {
namespace {

struct Difference {
  const char *from, *to;
  int power;
  double seconds;
};

TEST(exact_time, rounds_a_difference_once) {
  constexpr std::array kDifferences{
      Difference{"1690000000123456789", "1690000000124456789", -9, 0.001},
      Difference{"1690000000.123456789", "1690000000.124456789", 0, 0.001},
      Difference{"1690000000123456789", "1690000000123456790", -9, 1e-9},
      Difference{"1690000000123456.789", "1690000000123457.789", -6, 1e-6},
      Difference{"+1.5e3", "1.501E+3", -3, 0.001},
      Difference{"-2", "0.5", 0, 2.5},
      Difference{"2", "-.5", -3, -0.0025},
      Difference{"0x1p-1", "0x1.8p0", 0, 1},
      Difference{"1e-5000", "7", 0, 7},
      Difference{"0", "1e308", 0, 1e308},
      Difference{"-1e308", "1e308", 0, std::numeric_limits<double>::infinity()},
  };
  for (const Difference& each : kDifferences) {
    const ExactTime from(each.from, std::strtod(each.from, nullptr)), to(each.to, std::strtod(each.to, nullptr));
    EXPECT_EQ(to.seconds_since(from, each.power), each.seconds) << each.from << " to " << each.to;
  }
}

TEST(exact_time, is_what_a_recording_counts_from_its_first_sample) {
  std::istringstream file(
      "t_ns,x_mm,y_mm,z_mm,fx_N,fy_N,fz_N\n1690000000123456789,0,0,0,0,0,0\n1690000000124456789,0,0,0,0,0,0\n"
      "1690000000125456788,0,0,0,0,0,0\n");
  const Measurements measured =
      read_measurements(file, "made.csv", columns_of("t=t_ns,x=x_mm,y=y_mm,z=z_mm,fx=fx_N,fy=fy_N,fz=fz_N"));
  EXPECT_EQ(measured.samples[0].time, 0);
  EXPECT_EQ(measured.samples[2].time, 0.001999999);
  EXPECT_EQ(measured.samples[1].interval, 0.001);
  EXPECT_EQ(measured.samples[2].interval, 0.000999999);
}

}  // namespace
}  // namespace forceshade::conformance
