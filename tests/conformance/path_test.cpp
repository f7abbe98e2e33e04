// SPDX-License-Identifier: BSD-3-Clause
// Positions between samples.

#include "properties/conformance/recordings/path.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>

#include "properties/conformance/recordings/recording.h"

namespace forceshade::conformance {
namespace {

Eigen::Vector3d hand(double time) {
  const double turns = 2 * std::numbers::pi * time;
  return {12 * std::sin(3 * turns), 1.5 * std::cos(15 * turns), 7 + 40 * time};
}

// 1 s at 250 Hz, where every third interval is half as long.
std::vector<Measured> recorded() {
  std::vector<Measured> samples;
  double time = 0;
  for (std::size_t i = 0; i < 250; ++i) {
    samples.push_back({time, hand(time), Eigen::Vector3d::Zero(), i + 2, 0});
    time += i % 3 == 0 ? 0.002 : 0.004;
  }
  return samples;
}

TEST(path, meets_the_positions_between_samples) {
  const std::vector<Measured> samples = recorded();
  const RecordedPath path(samples);
  double worst = 0;
  for (std::size_t i = 20; i + 20 < samples.size(); ++i)
    for (const double lag : {-0.013, -0.0007, 0.0, 0.0011, 0.004, 0.0217})
      worst = std::max(worst, (path.position(samples[i], lag) - hand(samples[i].time - lag)).norm());
  std::printf("off by %.3g mm at most\n", worst);
  EXPECT_LT(worst, 5e-4);
  for (const Measured& each : samples) EXPECT_EQ(path.position(each, 0), each.position);
}

TEST(path, reaches_from_its_first_sample_to_its_last) {
  const std::vector<Measured> samples = recorded();
  const RecordedPath path(samples);
  EXPECT_TRUE(path.reaches(samples.front(), 0));
  EXPECT_FALSE(path.reaches(samples.front(), 1e-9));
  EXPECT_FALSE(path.reaches(samples.back(), -1e-9));
  EXPECT_TRUE(path.reaches(samples.back(), 0.1));
}

// A time that goes back, and one that is repeated, are not on the path; the sample itself is where it is.
TEST(path, leaves_out_times_that_do_not_increase) {
  std::vector<Measured> samples = recorded();
  const RecordedPath whole(samples);
  Measured back = samples[100], again = samples[120];
  back.time -= 0.05;
  back.position.setConstant(1000);
  again.position.setConstant(-1000);
  samples.insert(samples.begin() + 121, again);
  samples.insert(samples.begin() + 101, back);
  const RecordedPath path(samples);
  EXPECT_EQ(path.position(back, 0), back.position);
  for (std::size_t i = 50; i < 200; ++i) {
    if (samples[i].position.norm() >= 500) continue;
    EXPECT_EQ(path.position(samples[i], 0.0015), whole.position(samples[i], 0.0015)) << i;
  }
}

// Differences of times that binary64 cannot hold.

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

// As `force` and `conform judge` read them: each is rounded once, in any unit.
TEST(measurements, are_at_the_nearest_binary32_positions_to_the_numbers_times_their_unit) {
  const auto last_of = [](const std::string& units, const std::string& number) {
    std::istringstream in("t,x,y,z,fx,fy,fz\n0,0,0,0,0,0,0\n1,0,0," + number + ",0,0," + number + '\n');
    const Columns columns = columns_of("t=t,x=x,y=y,z=z,fx=fx,fy=fy,fz=fz,s," + units);
    const Measured last = read_measurements(in, "a.csv", columns).samples.at(1);
    return std::pair(static_cast<float>(last.position.z()), static_cast<float>(last.force.z()));
  };
  // On either side of the middle of two binary32 numbers, nearer to it than binary64 tells; the middle goes to the even one.
  const float low = 0x1.000002p+0F, high = 0x1.000004p+0F;
  EXPECT_EQ(last_of("mm,N", "1.0000001788139343261718749999"), std::pair(low, low));
  EXPECT_EQ(last_of("mm,N", "+1.000000178813934326171875"), std::pair(high, high));
  EXPECT_EQ(last_of("mm,N", "1.000000298023223876953125"), std::pair(high, high));
  EXPECT_EQ(last_of("mm,N", "1.00000029802322387695312501"), std::pair(0x1.000006p+0F, 0x1.000006p+0F));
  EXPECT_EQ(last_of("m,N", "1.0000001788139343261718749999e-3").first, low);
  EXPECT_EQ(last_of("mm,mN", "1.0000001788139343261718749999e3").second, low);
  EXPECT_EQ(last_of("mm,N", "0x1.000004p+0"), std::pair(high, high));
  EXPECT_EQ(last_of("in,N", "0.1").first, 2.54F);
  EXPECT_EQ(last_of("mm,N", "1e-400"), std::pair(0.0F, 0.0F));
}

}  // namespace

}  // namespace forceshade::conformance
