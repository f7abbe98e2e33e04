// SPDX-License-Identifier: BSD-3-Clause
#include "run/recorder/settings.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "tests/support/words.h"

namespace forceshade::recorder {
namespace {

std::vector<double*> numbers_of(device::SafetySettings& settings) {
  auto& limits = settings.limits;
  auto& passivity = settings.passivity_settings;
  return {&limits.peak_force,        &limits.continuous_force, &limits.slew,
          &limits.workspace_margin,  &limits.resolution,       &limits.speed,
          &limits.speed_under_force, &limits.frozen,           &limits.frozen_speed,
          &limits.frozen_force,      &limits.energy,           &limits.ramp_down,
          &limits.watchdog_timeout,  &limits.felt_free,        &limits.ramp_up,
          &passivity.friction,       &passivity.epsilon,       &passivity.period,
          &passivity.longest_step};
}

// Every number another one, so that none can be in another's place.
device::SafetySettings odd_settings() {
  device::SafetySettings settings{.rate_hz = 998.5, .supervised = true};
  float single = 0.1F;
  double next = 0.1;
  auto& limits = settings.limits;
  for (double* number : numbers_of(settings)) *number = next += 1.0 / 3;
  for (Eigen::Index i = 0; i < 3; ++i) {
    limits.workspace_low[i] = -(single += 1.0F / 3);
    limits.workspace_high[i] = single += 1.0F / 3;
  }
  limits.peak_force = std::numeric_limits<double>::infinity();
  limits.held_ticks = 7;
  limits.acts_on_lateness = false;
  limits.dead_man_button = 1;
  settings.passivity = device::Passivity::tank;
  settings.passivity_settings.latency = true;
  return settings;
}

TEST(settings, of_a_run_are_read_as_they_were_written) {
  const Metadata written = metadata_of(odd_settings());
  const auto read = safety_settings_in(written, "run.fsr");
  ASSERT_TRUE(read);
  EXPECT_EQ(metadata_of(*read), written);
  EXPECT_EQ(read->limits.dead_man_button, 1);
  EXPECT_EQ(read->limits.held_ticks, 7);
  EXPECT_EQ(read->rate_hz, 998.5);
  EXPECT_TRUE(read->supervised);
  EXPECT_TRUE(read->passivity_settings.latency);
  EXPECT_FALSE(read->limits.acts_on_lateness);
  device::SafetySettings expected = odd_settings(), got = *read;
  for (std::size_t i = 0; i < numbers_of(expected).size(); ++i)
    EXPECT_EQ(*numbers_of(got)[i], *numbers_of(expected)[i]) << "number " << i;
  EXPECT_EQ(read->limits.workspace_high, odd_settings().limits.workspace_high);
  EXPECT_TRUE(std::isinf(read->limits.peak_force));
  EXPECT_EQ(read->passivity, device::Passivity::tank);
  EXPECT_FALSE(safety_settings_in({{"law", "wall"}}, "run.fsr"));
}

constexpr const char* kLaterKey = "supervisor_acts_on_lateness";

TEST(settings, of_recordings_that_lack_the_later_key_act_on_lateness) {
  Metadata earlier = metadata_of(odd_settings());
  ASSERT_EQ(earlier.erase(kLaterKey), 1U);
  EXPECT_TRUE(safety_settings_in(earlier, "run.fsr")->limits.acts_on_lateness);
}

TEST(settings, that_are_missing_or_odd_are_refused_by_their_key) {
  const Metadata good = metadata_of(odd_settings());
  const auto words = [&](const std::string& key, const char* value) -> std::string {
    Metadata bad = good;
    if (value == nullptr)
      bad.erase(key);
    else
      bad[key] = value;
    return tests::thrown_by<Error>([&] { safety_settings_in(bad, "run.fsr"); });
  };
  int missing = 0;
  for (const auto& [key, value] : good) {
    if (key == "supervised" || key == kLaterKey) continue;
    EXPECT_EQ(words(key, nullptr), "run.fsr: " + key + " is not recorded");
    EXPECT_NE(words(key, ""), "") << key;
    ++missing;
  }
  EXPECT_GE(missing, 25);
  EXPECT_EQ(words("supervisor_slew_N_per_s", "1x"), "run.fsr: supervisor_slew_N_per_s is 1x; expected a number");
  EXPECT_EQ(words("supervisor_slew_N_per_s", "nan"), "run.fsr: supervisor_slew_N_per_s is nan; expected a number");
  EXPECT_EQ(words("supervised", "maybe"), "run.fsr: supervised is maybe; expected yes or no");
  EXPECT_EQ(words(kLaterKey, "maybe"), "run.fsr: " + std::string(kLaterKey) + " is maybe; expected yes or no");
  EXPECT_EQ(words("passivity", "magic"), "run.fsr: passivity is magic; expected observer, tank or damping");
  EXPECT_EQ(words("rate_hz", "0"), "run.fsr: rate_hz is 0; expected 100 to 10000");
  EXPECT_EQ(words("dead_man_button", "-1"), "run.fsr: dead_man_button is -1; expected none, or a button from 0 to 15");
  EXPECT_EQ(words("dead_man_button", "0"), "");
  EXPECT_EQ(words("dead_man_button", "15"), "");
  EXPECT_EQ(words("dead_man_button", "16"), "run.fsr: dead_man_button is 16; expected none, or a button from 0 to 15");
}

}  // namespace
}  // namespace forceshade::recorder
