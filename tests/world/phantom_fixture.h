// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A Phantom over the driver of the simulated world, for tests that are its program: what a test waits for takes no time.

#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "device/phantom/phantom.h"
#include "tests/support/words.h"
#include "tests/world/hd.h"
#include "tests/world/world.h"

namespace forceshade::world {

using namespace std::chrono_literals;
using namespace device;
using tests::expect_words;

inline void tell(const Orders& orders) {
  Hd::current().tell(orders);
}
inline const Hd::Seen& seen() {
  return Hd::current().seen();
}
inline Eigen::Vector3d last_force() {
  return seen().frames.empty() ? Eigen::Vector3d(0, 0, 0) : seen().frames.back().force;
}

// For tests whose own order is old before what they wait for comes.
inline constexpr PhantomOptions kPatient{.watchdog_timeout = 20s, .start = 20s, .rate_tolerance = 1};

inline Attends& nobody() {
  static Attends it;
  return it;
}
inline Phantom opened(const PhantomOptions& options = {}, Attendant& attendant = nobody(), const std::string& name = "") {
  return {name, options, attendant, &Hd::functions};
}

// At most a minute of the world.
template <class Condition>
void wait_until(Condition condition) {
  for (int k = 0; k < 60'000; ++k, system::sleep_for(1ms))
    if (condition()) return;
  ADD_FAILURE() << "it never comes";
}

inline std::string fault_of(Device& device) {
  std::string words;
  wait_until([&] {
    const ReadResult read = device.read();
    if (const Fault* fault = std::get_if<Fault>(&read)) words = fault->words;
    return !words.empty();
  });
  return words;
}

// Every test leaves the device without a misuse, disabled, closed and without force, and no thread.
class phantom : public testing::Test {
 protected:
  static void in_world(const std::function<void()>& body) {
    World world;
    const Plan plan;
    Arm arm(plan);
    arm.on_sent = [](const Arm::Sent&) {};
    arm.on_misuse = [](const char* words) { ADD_FAILURE() << words; };
    const Hd hd(arm);
    EXPECT_EQ(world.run(body, 200 * system::kSecond), World::End::over);
    EXPECT_FALSE(seen().initialised || seen().scheduler || seen().output);
    EXPECT_FALSE(seen().is_left) << "without hdDisableDevice";
    EXPECT_TRUE(last_force().isZero(0));
    for (int thread = 0; thread < world.threads(); ++thread) EXPECT_TRUE(world.is_over(thread)) << world.name(thread);
  }
};

}  // namespace forceshade::world

// A test of the fixture whose body runs in a world.
#define IN_WORLD(name)           \
  struct name##_body {           \
    static void run();           \
  };                             \
  TEST_F(phantom, name) {        \
    in_world(&name##_body::run); \
  }                              \
  void name##_body::run()
