// SPDX-License-Identifier: BSD-3-Clause
// A law that was shifted and turned in a device's workspace.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>
#include <set>
#include <string>

#include "device/placement_text.h"
#include "forceshade/device.h"
#include "forceshade/error.h"
#include "forceshade/servo_loop.h"
#include "run/words.h"
#include "tests/device/servo_loop_fixture.h"
#include "tests/support/words.h"

namespace forceshade::device {
namespace {

using Eigen::Vector3f;
using run::axes_words;
using run::origin_words;
using tests::vector;

std::vector<Placement> all_turns(const Vector3f& origin = {0, 0, 0}) {
  std::vector<Placement> all;
  std::set<std::string> seen;
  for (int x = 0; x < 4; ++x)
    for (int y = 0; y < 4; ++y)
      for (int z = 0; z < 4; ++z) {
        const Placement placement = Placement(origin).turned(0, x).turned(1, y).turned(2, z);
        if (seen.insert(axes_words(placement)).second) all.push_back(placement);
      }
  return all;
}

TEST(placement, turns_by_the_right_hand) {
  // About z, the subject's x axis goes to the device's y axis.
  EXPECT_EQ(Placement().turned(2, 1).turned_to_device({1, 2, 3}), Vector3f(-2, 1, 3));
  EXPECT_EQ(Placement().turned(0, 1).turned_to_device({1, 2, 3}), Vector3f(1, -3, 2));
  EXPECT_EQ(Placement().turned(1, 1).turned_to_device({1, 2, 3}), Vector3f(3, 2, -1));
  EXPECT_EQ(Placement().turned(1, -1), Placement().turned(1, 3));
  // One after the other, about the device's axes: x goes to y by the first and then to z by the second.
  EXPECT_EQ(Placement().turned(2, 1).turned(0, 1).turned_to_device({1, 0, 0}), Vector3f(0, 0, 1));
}

TEST(placement, has_the_24_turns_of_a_cube_and_none_of_them_mirrors_or_rounds) {
  const std::vector<Placement> all = all_turns();
  EXPECT_EQ(all.size(), 24U);
  std::mt19937 random(9);
  std::uniform_real_distribution<float> uniform(-200, 200);
  for (const Placement& placement : all) {
    Eigen::Matrix3f turn;
    for (int i = 0; i < 3; ++i) turn.col(i) = placement.turned_to_device(Vector3f::Unit(i));
    EXPECT_EQ(turn.col(0).cross(turn.col(1)), turn.col(2)) << axes_words(placement);
    for (int k = 0; k < 100; ++k) {
      const Vector3f v(uniform(random), uniform(random), uniform(random));
      EXPECT_EQ(placement.turned_to_subject(placement.turned_to_device(v)), v);
      EXPECT_EQ(placement.turned_to_device(v), turn * v);
    }
    for (const float zero : placement.turned_to_device(Vector3f::Zero())) EXPECT_FALSE(std::signbit(zero));
    for (const float zero : placement.turned_to_subject(Vector3f::Zero())) EXPECT_FALSE(std::signbit(zero));
  }
}

TEST(placement, shifts_by_one_correctly_rounded_difference_and_not_at_all_by_default) {
  const Vector3f origin(0.1F, -250.3F, 1e-3F);
  std::mt19937 random(9);
  std::uniform_real_distribution<float> uniform(-200, 200);
  for (int k = 0; k < 10000; ++k) {
    const Vector3f there(uniform(random), uniform(random), uniform(random));
    const Vector3f got = Placement(origin).to_subject(there);
    for (int i = 0; i < 3; ++i)
      EXPECT_EQ(got[i], static_cast<float>(static_cast<double>(there[i]) - static_cast<double>(origin[i])));
    EXPECT_EQ(Placement().to_subject(there), there);
  }
  EXPECT_TRUE(std::signbit(Placement().to_subject({-0.0F, 0, 0}).x())) << "not one bit of it";
}

TEST(placement, is_read_from_lengths_with_units_and_quarter_turns) {
  EXPECT_EQ(parse_placement(""), Placement());
  EXPECT_EQ(parse_placement("1in,-2.5,100mil").origin(), Vector3f(25.4F, -2.5F, 2.54F));
  EXPECT_EQ(parse_placement("z90"), Placement().turned(2, 1));
  EXPECT_EQ(parse_placement("x-90deg,z180"), Placement().turned(0, 3).turned(2, 2));
  EXPECT_EQ(parse_placement("y0"), Placement());
  EXPECT_EQ(axes_words(parse_placement("z90")), "+y,-x,+z");
  EXPECT_EQ(origin_words(parse_placement("0.1,-3,1in")), "0.1,-3,25.4");
  EXPECT_EQ(parse_placement("1,2,3,z90,x90"), Placement({1, 2, 3}).turned(2, 1).turned(0, 1));
  const auto words_of = [](const char* text) { return tests::thrown_by<Error>([&] { parse_placement(text); }); };
  for (const char* text : {"1,2", "1,2,3,4", ",", "45", "1,z90", "w90", "90z"})
    EXPECT_EQ(words_of(text),
              std::string("--place: expected three lengths X,Y,Z such as 10mm,0,-1in, turns such as z90, or both, got \"") +
                  text + '"');
  EXPECT_NE(words_of("1,2,3furlong").find("--place: expected a length"), std::string::npos);
  EXPECT_EQ(words_of("0,10000,0"), "");
  EXPECT_EQ(words_of("0,-10.001m,0"), "--place: expected at most 10000 mm each way, got \"-10.001m\"");
  for (const char* turn : {"z45", "z90.5", "z", "z90rad", "z90,", "z99999999999", "x90 y90", "z90,1,2,3"})
    EXPECT_TRUE(words_of(turn).starts_with("--place: expected an axis and a multiple of 90 degrees")) << turn;
}

// The device is given the correctly rounded force at the position that the recording holds, turned and not rounded again.
TEST(servo_loop, gives_the_force_at_the_position_that_it_records_wherever_the_law_is_placed) {
  const auto law = law_of(LawId::bump_3p_shaded, 0.3F);
  std::mt19937 random(21);
  std::uniform_real_distribution<float> uniform(-20, 20);
  for (const Placement& placement : all_turns({3.1F, -2.7F, 0.9F})) {
    struct Anywhere final : Still {
      explicit Anywhere(std::vector<Vector3f> where) : positions(std::move(where)) {}
      ReadResult at(std::size_t reading) noexcept override {
        if (reading == positions.size()) return EndOfData{};
        return Reading{positions[reading], 0.001 * static_cast<double>(reading)};
      }
      std::vector<Vector3f> positions;
    };
    std::vector<Vector3f> positions;
    for (int k = 0; k < 200; ++k) positions.emplace_back(uniform(random), uniform(random), uniform(random));
    Anywhere device(positions);
    ServoOptions options = unpaced();
    options.placement = placement;
    const Kept run(device, law, options);
    ASSERT_EQ(run.ticks, positions.size());
    int touching = 0;
    for (std::size_t k = 0; k < positions.size(); ++k) {
      const Vector3f there = vector(run.samples[k].position);
      EXPECT_EQ(there, placement.to_subject(positions[k]));
      EXPECT_EQ(vector(run.samples[k].law_force), law.force(there));
      EXPECT_EQ(run.samples[k].force, run.samples[k].law_force);
      EXPECT_EQ(device.commands[k], placement.turned_to_device(law.force(there)));
      touching += !law.force(there).isZero(0);
    }
    EXPECT_GT(touching, 5);
    expect_ends_at_zero_force(run);
  }
}

// 0.3 mm deep in a wall that faces the device's x axis, 30 mm beyond the device's origin, and 6 mm outside the device's
// workspace, whose margin is 10 mm wide.
TEST(servo_loop, keeps_to_the_workspace_of_the_device_wherever_the_law_is_placed) {
  struct Beside final : Pushing {
    Capabilities capabilities() const noexcept override {
      Capabilities known = Pushing::capabilities();
      known.workspace_low = {-24, -100, -100};
      known.workspace_high = {100, 100, 100};
      return known;
    }
    ReadResult at(std::size_t reading) noexcept override {
      Reading there = place(reading);
      there.position = {-30 + there.position.z(), there.position.y(), 0};
      return there;
    }
  } device;
  ServoOptions options{.max_seconds = 0.8, .paced = false};
  options.placement = Placement({-30, 0, 0}).turned(1, 1);  // z to x
  const Kept run(device, wall(), options);
  EXPECT_EQ(run.end_reason, EndReason::time_up);
  const Sample& sample = run.samples[700];
  EXPECT_NEAR(sample.position[2], -0.3F, 1e-5F) << "in the law's frame";
  EXPECT_EQ(sample.law_force, (std::array<float, 3>{0, 0, 0.5F * -sample.position[2]}));
  // A position of x = -30.3 mm is 6.3 mm outside.
  EXPECT_NEAR(sample.force[2] / sample.law_force[2], 0.37F, 1e-3F);
  EXPECT_EQ(device.commands[700], Vector3f(sample.force[2], 0, 0));
  EXPECT_EQ(sample.limited, 1U << static_cast<int>(Rule::workspace));
  // The energy given to the hand is the work of these forces on the device's positions.
  double work = 0;
  for (std::size_t k = 0; k + 1 < run.ticks; ++k)
    for (std::size_t i = 0; i < 3; ++i)
      work += static_cast<double>(run.samples[k].force[i]) *
              (static_cast<double>(run.samples[k + 1].position[i]) - static_cast<double>(run.samples[k].position[i]));
  EXPECT_NEAR(run.account.net(), work, 1e-6);
}

}  // namespace
}  // namespace forceshade::device
