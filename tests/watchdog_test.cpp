// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/device/watchdog.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>

namespace forceshade::device {
namespace {

using namespace std::chrono_literals;

std::int64_t now() {
  return std::chrono::steady_clock::now().time_since_epoch() / 1ns;
}

TEST(watchdog, barks_after_its_patience_and_not_before) {
  Watchdog dog(20, 100);
  EXPECT_FALSE(dog.barked(120));
  EXPECT_TRUE(dog.feed(120));
  EXPECT_FALSE(dog.barked(140));
  EXPECT_TRUE(dog.barked(141));
}

TEST(watchdog, that_barked_takes_no_food) {
  Watchdog dog(20, 0);
  EXPECT_TRUE(dog.barked(21));
  EXPECT_FALSE(dog.feed(22));
  EXPECT_TRUE(dog.barked(22));
}

TEST(watchdog, that_was_fed_after_the_clock_was_read_does_not_bark) {
  Watchdog dog(20, 0);
  EXPECT_TRUE(dog.feed(100));
  EXPECT_FALSE(dog.barked(90));
}

// A servo loop that commands a newton until told otherwise, and a watcher who commands zero.
TEST(watchdog, zeroes_the_force_of_a_stalled_loop_for_good) {
  constexpr std::int64_t kPatience = 200'000'000;  // ns: more than a busy machine takes from a thread that sleeps 1 ms
  Watchdog dog(kPatience, now());
  std::atomic<float> commanded = 0;
  std::atomic<bool> stall = false, wake = false;
  bool told = false;
  std::thread loop([&] {
    for (int tick = 0; tick < 100; ++tick) {
      ASSERT_TRUE(dog.feed(now())) << tick;
      commanded = 1;
      std::this_thread::sleep_for(1ms);
    }
    stall = true;
    while (!wake) std::this_thread::sleep_for(1ms);
    told = !dog.feed(now());
    if (!told) commanded = 1;
  });
  std::thread watcher([&] {
    while (!dog.barked(now())) {
      EXPECT_TRUE(!stall || commanded == 1);
      std::this_thread::sleep_for(1ms);
    }
    EXPECT_TRUE(stall) << "barked at a loop that ran";
    commanded = 0;
  });
  watcher.join();
  wake = true;
  loop.join();
  EXPECT_TRUE(told);
  EXPECT_EQ(commanded, 0);
}

// The last tick of a loop races with the watcher: either it was in time, or it is told.
TEST(watchdog, never_barks_at_a_loop_that_it_told_to_go_on) {
  int in_time = 0;
  for (int round = 0; round < 300; ++round) {
    Watchdog dog(1, 0);
    bool fed = false, barked = false;
    std::thread loop([&] { fed = dog.feed(2); });
    std::thread watcher([&] { barked = dog.barked(2); });
    loop.join();
    watcher.join();
    EXPECT_NE(fed, barked);
    in_time += fed ? 1 : 0;
  }
  std::printf("  in time in %d of 300 rounds\n", in_time);
}

}  // namespace
}  // namespace forceshade::device
