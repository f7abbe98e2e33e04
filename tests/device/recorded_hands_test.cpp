// SPDX-License-Identifier: BSD-3-Clause
// Recorded strokes as what a simulated hand means to do, through the whole loop, under every law. The recordings are not part
// of the project: FORCESHADE_RECORDINGS names their folder. docs/safety.md has the summary of the table printed here.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "device/simulated/simulated.h"
#include "forceshade/device.h"
#include "tests/device/chatter.h"
#include "tests/device/servo_loop_fixture.h"

namespace forceshade {

// Google Test's name for a parameter.
void PrintTo(const LawName& law, std::ostream* out) {
  *out << law.name;
}

}  // namespace forceshade

namespace forceshade::device {
namespace {

constexpr double kSeconds = 12;
constexpr double kForgotten = 0.5;  // s: a force that is away for as long is lost

// The path as recorded, shifted by (x, 0, z) mm.
Operator hand_along(const Replay& recorded, double x, double z) {
  std::vector<Intention::Point> points;
  for (const Reading& reading : recorded.recording())
    points.push_back(
        {reading.time - recorded.recording().front().time, reading.position.cast<double>() + Eigen::Vector3d(x, 0, z)});
  return {Grip{}, Intention(std::move(points), Intention::Between::straight), Tremor(1, 0), true};
}

// Away while the law has one and the supervisor leaves it as it is.
double longest_without_force(const std::vector<Sample>& samples) {
  double longest = 0, away = 0;
  for (const Sample& sample : samples) {
    const double desired = tests::vector(sample.law_force).cast<double>().norm();
    const double force = tests::vector(sample.force).cast<double>().norm();
    away = sample.limited == 0 && desired > 0.1 && force < 0.01 * desired ? away + 0.001 : 0;
    longest = std::max(longest, away);
  }
  return longest;
}

class recorded_hands : public testing::TestWithParam<LawName> {};

TEST_P(recorded_hands, feel_no_buzz_and_lose_no_force) {
  const char* folder = std::getenv("FORCESHADE_RECORDINGS");
  if (!folder) GTEST_SKIP() << "FORCESHADE_RECORDINGS names no folder";
  const LawName& law = GetParam();
  std::printf(
      "  law            recording       x    z  chatter  most, N   lowest, mJ (bound)  altered  without force, s  oscillation  "
      "end\n");
  for (const std::string name : {"square_xz", "square_xy"}) {
    const Replay recorded = Replay::load(std::filesystem::path(folder) / (name + ".csv"));
    for (const double z : {0.0, -10.0, -30.0})
      for (const double x : {-40.0, -20.0, 0.0, 20.0, 40.0}) {
        Simulated device(premium_1_5(), hand_along(recorded, x, z));
        const Kept run(device, law_of(law.id, 0.5F), {.max_seconds = kSeconds, .paced = false});
        tests::Chatter chatter;
        std::size_t contacts = 0;
        for (const Sample& sample : run.samples) {
          chatter.next(tests::vector(sample.force), tests::vector(sample.law_force));
          contacts += sample.status == 1;
        }
        const double away = longest_without_force(run.samples);
        std::printf("  %-14s %-10s %6.0f %4.0f %8zu %8.3f %12.3f (%.3f) %7.2f%% %17.3f %12zu  %s\n",
                    std::string(law.name).c_str(), name.c_str(), x, z, chatter.ticks, static_cast<double>(chatter.worst),
                    run.account.lowest_balance, -run.passivity_settings.epsilon,
                    100 * static_cast<double>(run.account.altered) / static_cast<double>(std::max<std::size_t>(contacts, 1)),
                    away, run.limited_ticks[static_cast<std::size_t>(Rule::oscillation)],
                    std::string(run.trip ? name_of(run.trip->rule) : name_of(run.end_reason)).c_str());
        EXPECT_EQ(chatter.ticks, 0U);
        EXPECT_GE(run.account.lowest_balance, -run.passivity_settings.epsilon);
        EXPECT_LE(away, kForgotten);
        EXPECT_FALSE(run.trip) << name_of(run.trip->rule);
      }
  }
}

INSTANTIATE_TEST_SUITE_P(laws, recorded_hands, testing::ValuesIn(kLaws), [](const auto& info) {
  std::string name(info.param.name);
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

}  // namespace
}  // namespace forceshade::device
