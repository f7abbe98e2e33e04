// SPDX-License-Identifier: BSD-3-Clause
// The supervisor under its default rules has nothing to say of ordinary use.

#include "device/simulated/simulated.h"
#include "forceshade/device.h"
#include "tests/device/servo_loop_fixture.h"

namespace forceshade::device {
namespace {

// Runs a device under the default rules, of which `expected` alone limits a force.
void expect_left_alone(Device& device, LawId id, double seconds, std::optional<Rule> expected = std::nullopt) {
  const Kept run(device, law_of(id, 0.5F), {.max_seconds = seconds, .paced = false, .passivity = Passivity::observer});
  EXPECT_EQ(run.end_reason, EndReason::time_up) << (run.trip ? name_of(run.trip->rule) : "") << ", " << name_of(id);
  for (std::size_t i = 0; i < kRules; ++i) {
    const Rule rule = static_cast<Rule>(i);
    EXPECT_EQ(run.limited_ticks[i] > 0, rule == expected) << name_of(rule) << ", " << name_of(id);
  }
}

// On the ridge of bump-2p the force jumps by two newtons at the depth of these strokes: it is turned within a few ticks.
TEST(supervisor, leaves_ordinary_strokes_alone) {
  for (const LawName& law : kLaws)
    expect_left_alone(*open_device("simulated"), law.id, 6,
                      law.id == LawId::bump_2p ? std::optional(Rule::slew) : std::nullopt);
  expect_left_alone(*open_device("simulated:omni"), LawId::bump_1p_shaded, 20);
}

TEST(supervisor, leaves_a_hand_at_rest_alone) {
  for (const auto& make : kModels)
    for (const double tremor : {0.0, 0.03, 0.1}) {
      SCOPED_TRACE(make().name);
      const Intention rest({{0, {3, 0, 5}}, {1, {3, 0, 5}}, {2, {3, 0, -3}}}, Intention::Between::minimum_jerk);
      Simulated device(make(), Operator{Grip{}, rest, Tremor(1, tremor), false});
      expect_left_alone(device, LawId::wall, 8);
    }
}

}  // namespace
}  // namespace forceshade::device
