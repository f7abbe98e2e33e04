// SPDX-License-Identifier: BSD-3-Clause
// The supervisor under its default rules has nothing to say of ordinary use.

#include <cstdio>
#include <string>

#include "device/null.h"
#include "device/simulated/simulated.h"
#include "forceshade/device.h"
#include "forceshade/fast.h"
#include "tests/device/supervised_hand.h"

namespace forceshade::device {
namespace {

// Runs a device under the default rules and counts the ticks that a rule other than `expected` limited.
std::size_t limited_ticks(Device& device, LawId id, int ticks, std::optional<Rule> expected = std::nullopt) {
  const auto law = std::get<fast::Law>(fast::Law::build(id, {.radius = 15.24F, .width = 25.4F, .stiffness = 0.5F}));
  Supervisor supervisor(supervisor_limits(device.capabilities(), kRate), kRate);
  device.start(kRate);
  std::size_t limited = 0, limited_as_expected = 0;
  int still = 0, longest_still = 0;
  Eigen::Vector3f before{0, 0, 0};
  for (int tick = 0; tick < ticks; ++tick) {
    const Reading reading = std::get<Reading>(device.read());
    const fast::Evaluation desired = law.evaluate(reading.position);
    const Verdict verdict = supervisor.supervise(reading, device.state(), desired.force, desired.status, 0);
    if (verdict.trip) ADD_FAILURE() << name_of(*verdict.trip) << " at tick " << tick << ", " << name_of(id);
    if (verdict.trip) break;
    if (!verdict.limited.none()) ++(expected && verdict.limited.has(*expected) ? limited_as_expected : limited);
    device.command(verdict.force);
    still = reading.position == before && !verdict.force.isZero(0) ? still + 1 : 0;
    longest_still = std::max(longest_still, still);
    before = reading.position;
  }
  std::printf("  %s: under force without a changed bit for %d ticks\n", std::string(name_of(id)).c_str(), longest_still);
  if (expected) {
    std::printf("  %s: %s in %zu of %d ticks\n", std::string(name_of(id)).c_str(), std::string(name_of(*expected)).c_str(),
                limited_as_expected, ticks);
    EXPECT_GT(limited_as_expected, 0U);
  }
  return limited;
}

// On the ridge of bump-2p the force jumps by two newtons at the depth of these strokes: it is turned within a few ticks.
TEST(supervisor, leaves_ordinary_strokes_alone) {
  for (const LawName& law : kLaws) {
    const auto expected = law.id == LawId::bump_2p ? std::optional(Rule::slew) : std::nullopt;
    EXPECT_EQ(limited_ticks(*open_device("simulated"), law.id, 10'000, expected), 0U) << law.name;
  }
  EXPECT_EQ(limited_ticks(*open_device("simulated:omni"), LawId::bump_1p_shaded, 60'000), 0U);
}

TEST(supervisor, leaves_a_hand_at_rest_alone) {
  for (const auto& make : kModels)
    for (const double tremor : {0.0, 0.03, 0.1}) {
      const Intention rest({{0, {3, 0, 5}}, {1, {3, 0, 5}}, {2, {3, 0, -3}}}, Intention::Between::minimum_jerk);
      Simulated device(make(), Operator{Grip{}, rest, Tremor(1, tremor), false});
      EXPECT_EQ(limited_ticks(device, LawId::wall, 20'000), 0U) << make().name;
    }
}

TEST(supervisor, leaves_a_null_device_alone) {
  for (const LawName& law : kLaws) {
    Null device;
    limited_ticks(device, law.id, 5'000);
  }
}

}  // namespace
}  // namespace forceshade::device
