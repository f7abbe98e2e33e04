// SPDX-License-Identifier: BSD-3-Clause
#include "device/retrace.h"

#include <gtest/gtest.h>

#include "device/simulated/simulated.h"
#include "forceshade/device.h"
#include "tests/device/servo_loop_fixture.h"

namespace forceshade::device {
namespace {

// The number of ticks that differ from the recording.
std::size_t differences(const SafetySettings& settings, const Kept& run) {
  Retrace retrace(settings);
  std::size_t found = 0;
  for (const Sample& sample : run.samples)
    if (sample.status != Sample::kEnd && !is_same(retrace.next(sample), sample)) ++found;
  return found;
}

struct Changed {
  std::size_t limited = 0, altered = 0, tripped = 0;
  explicit Changed(const Kept& run) {
    for (const Sample& sample : run.samples) {
      limited += sample.limited != 0 ? 1 : 0;
      altered += sample.altered;
      tripped += sample.tripped != 0 ? 1 : 0;
    }
  }
};

// Pushes outward along a shaded bump and comes back through the air: the loop that is given energy each time. Its first round
// begins before the gentle start is over, so that supervisor and controller both have work.
class Looping final : public Pushing {
  ReadResult at(std::size_t reading) noexcept override {
    if (reading == 2000) return EndOfData{};
    const bool is_outward = reading % 200 >= 100;
    const float share = static_cast<float>(reading % 100) / 100, sway = 0.03F * static_cast<float>(reading % 3);
    const float way = std::min(1.0F, 5 * share), from = is_outward ? 1 : -2, to = is_outward ? -2 : 1;
    return Reading{{14 * (is_outward ? share : 1 - share), sway, reading < 100 ? 1 : from + way * (to - from)},
                   1e-3 * static_cast<double>(reading)};
  }
};

TEST(retrace, gives_every_command_of_a_run_to_the_bit) {
  for (const auto kind : {Passivity::damping, Passivity::tank, Passivity::observer}) {
    Looping device;
    const ServoOptions options{.paced = false, .passivity = kind};
    const SafetySettings settings = safety_settings(device.capabilities(), options);
    const Kept run(device, law_of(LawId::bump_1p_shaded, 1), options);
    const Changed changed(run);
    ASSERT_EQ(run.end_reason, EndReason::end_of_data) << (run.trip ? name_of(run.trip->rule) : "");
    EXPECT_GT(changed.limited, 100U);
    if (kind != Passivity::observer) {
      EXPECT_GT(changed.altered, 100U);
    }
    EXPECT_EQ(differences(settings, run), 0U);
  }
}

// A device that reports what it sent, and gets warm.
TEST(retrace, gives_every_command_of_a_simulated_run_to_the_bit) {
  for (const auto kind : {Passivity::damping, Passivity::tank}) {
    const auto device = open_device("simulated");
    const ServoOptions options{.max_seconds = 5, .paced = false, .passivity = kind};
    const SafetySettings settings = safety_settings(device->capabilities(), options);
    const Kept run(*device, law_of(LawId::bump_1p_shaded, 1), options);
    EXPECT_GT(run.peak_force_N, 0.3);
    EXPECT_EQ(differences(settings, run), 0U);
    Kept other = run;
    other.samples[3000].sent_work += 0.01;
    EXPECT_GE(differences(settings, other), 1U);
  }
}

TEST(retrace, gives_a_run_that_trips_and_one_of_a_device_that_cannot_push) {
  Simulated loose(premium_1_5(), std::nullopt);
  const ServoOptions options{.max_seconds = 5, .paced = false};
  const Kept run(loose, law_of(LawId::wall, 0.5F), options);
  EXPECT_EQ(differences(safety_settings(loose.capabilities(), options), run), 0U);

  class Leaping final : public Pushing {
    ReadResult at(std::size_t reading) noexcept override {
      Reading here = place(reading);
      if (reading == 300) here.position.x() = 90;
      return here;
    }
  } leaping;
  const Kept tripped(leaping, wall(), options);
  ASSERT_EQ(Changed(tripped).tripped, 1U);
  EXPECT_EQ(differences(safety_settings(leaping.capabilities(), options), tripped), 0U);

  Endless still;
  const Kept observed(still, wall(), {.max_seconds = 1, .paced = false});
  EXPECT_GT(observed.peak_force_N, 0);
  EXPECT_EQ(differences(safety_settings(still.capabilities(), {}), observed), 0U);
}

// The dead-man button is let go and pressed again while the wall is felt.
TEST(retrace, gives_every_command_of_a_run_with_a_dead_man_button) {
  class Holding final : public Pushing {
    ReadResult at(std::size_t reading) noexcept override {
      if (reading == 2000) return EndOfData{};
      Reading here{{0, 0, 1 - 1e-3F * static_cast<float>(reading)}, 1e-3 * static_cast<double>(reading)};
      here.buttons = reading >= 1500 && reading < 1600 ? 1 : 2;
      return here;
    }
  } device;
  const ServoOptions options{.paced = false, .dead_man_button = 1};
  const SafetySettings settings = safety_settings(device.capabilities(), options);
  const Kept run(device, wall(), options);
  ASSERT_EQ(run.end_reason, EndReason::end_of_data);
  EXPECT_GT(run.peak_force_N, 0.1) << "with the button pressed";
  EXPECT_EQ(run.samples[1550].force[2], 0);
  EXPECT_EQ(differences(settings, run), 0U);
}

// Late ticks too: how late each was is part of the recording.
TEST(retrace, gives_a_run_in_real_time_to_the_bit) {
  const auto device = open_device("simulated");
  const ServoOptions options{.max_seconds = 0.3, .watchdog_timeout = 10};
  const Kept run(*device, law_of(LawId::bump_cylinder, 0.5F), options);
  EXPECT_EQ(differences(safety_settings(device->capabilities(), options), run), 0U);
}

TEST(retrace, notices_another_force_setting_or_state) {
  Looping device;
  const ServoOptions options{.paced = false};
  const SafetySettings settings = safety_settings(device.capabilities(), options);
  const Kept run(device, law_of(LawId::bump_1p_shaded, 1), options);
  ASSERT_EQ(differences(settings, run), 0U);

  const auto changed = [&](auto change) {
    SafetySettings other = settings;
    change(other);
    return differences(other, run);
  };
  EXPECT_GT(changed([](SafetySettings& s) { s.limits.ramp_up *= 2; }), 0U);
  EXPECT_GT(changed([](SafetySettings& s) { s.limits.felt_free *= 2; }), 0U);
  EXPECT_GT(changed([](SafetySettings& s) { s.passivity_settings.epsilon *= 0.5; }), 0U);
  EXPECT_GT(changed([](SafetySettings& s) { s.passivity = Passivity::tank; }), 0U);
  EXPECT_GT(changed([](SafetySettings& s) { s.supervised = false; }), 0U);

  const auto recorded = [&](auto change) {
    Kept other = run;
    for (Sample& sample : other.samples)
      if (sample.tick == 1350) change(sample);
    return differences(settings, other);
  };
  EXPECT_EQ(recorded([](Sample& s) { s.force[2] = std::nextafter(s.force[2], 9.0F); }), 1U);
  EXPECT_EQ(recorded([](Sample& s) { s.energy = std::nextafter(s.energy, 9.0); }), 1U);
  EXPECT_EQ(recorded([](Sample& s) { s.limited ^= 1; }), 1U);
  EXPECT_EQ(recorded([](Sample& s) { s.altered ^= 1; }), 1U);
  EXPECT_GE(recorded([](Sample& s) { s.device_state = Sample::kCalibrated; }), 1U);
  EXPECT_GE(recorded([](Sample& s) { s.position[0] += 5; }), 1U);
}

}  // namespace
}  // namespace forceshade::device
