// SPDX-License-Identifier: BSD-3-Clause
// The simulated world itself: time, threads, holds, deaths; that a session is replayed from its list, that a list is shrunk to
// what it takes, and that the rules are looked at.

#include "tests/world/world.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cerrno>
#include <cfenv>
#include <functional>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "system/system.h"
#include "tests/world/arms.h"

namespace forceshade::world {
namespace {

constexpr Ns kMillisecond = 1'000'000;

TEST(world, goes_on_to_the_next_time_for_which_a_thread_waits) {
  World world;
  std::vector<std::string> order;
  Ns lasted = 0;
  const auto sleeper = [&](const char* name, Ns time) {
    return system::Thread(name, [&order, name, time] {
      system::sleep_until(system::now() + time);
      order.emplace_back(name);
    });
  };
  const World::End end = world.run(
      [&] {
        const Ns begin = system::now();
        system::Thread slow = sleeper("slow", system::kSecond), fast = sleeper("fast", kMillisecond);
        EXPECT_EQ(world.thread("fast"), 2);
        EXPECT_EQ(world.thread("nobody"), -1);
        slow.join();
        fast.join();
        lasted = system::now() - begin;
      },
      2 * system::kSecond);
  EXPECT_EQ(end, World::End::over);
  EXPECT_EQ(order, (std::vector<std::string>{"fast", "slow"}));
  EXPECT_GE(lasted, system::kSecond);
  EXPECT_LT(lasted, system::kSecond + kMillisecond);
}

TEST(world, ends_where_everyone_waits_for_ever_or_its_time_is_up) {
  const system::Number nothing = 0;
  World world;
  EXPECT_EQ(world.run([&] { system::wait_for_change(nothing, 0, system::kForever); }, system::kSecond), World::End::never);
  EXPECT_EQ(world.run(
                [] {
                  for (;;) system::step();
                },
                kMillisecond),
            World::End::never);
}

// Each fiber has its own of what each thread of the system has of its own.
TEST(world, fibers_keep_their_exceptions_their_errno_and_their_rounding) {
  World world;
  const auto body = [](int error, int rounding) {
    std::fesetround(rounding);
    errno = error;
    try {
      throw std::runtime_error(std::to_string(error));
    } catch (const std::exception& caught) {
      for (int i = 0; i < 5; ++i) system::sleep_until(system::now() + kMillisecond);
      EXPECT_EQ(caught.what(), std::to_string(error));
      EXPECT_NE(std::current_exception(), nullptr);
    }
    EXPECT_EQ(errno, error);
    EXPECT_EQ(std::fegetround(), rounding);
    std::fesetround(FE_TONEAREST);
  };
  world.run(
      [&] {
        system::Thread other("other", [&] { body(7, FE_UPWARD); });
        body(9, FE_DOWNWARD);
        other.join();
      },
      system::kSecond);
  EXPECT_EQ(std::fegetround(), FE_TONEAREST);
}

// The steps of the other thread when the first has slept for 10 ms, after this.
long steps_of_other(const std::function<void(World&)>& happens) {
  World world;
  long steps = 0;
  world.run(
      [&] {
        system::Thread("other", [&] {
          for (;; ++steps) system::sleep_until(system::now() + kMillisecond);
        }).leave();
        system::sleep_until(system::now() + kMillisecond / 2);
        happens(world);
        system::sleep_until(system::now() + 10 * kMillisecond);
      },
      system::kSecond);
  return steps;
}

TEST(world, holds_and_kills) {
  EXPECT_EQ(steps_of_other([](World&) {}), 10);
  EXPECT_EQ(steps_of_other([](World& world) { world.kill(1); }), 0);
  EXPECT_EQ(steps_of_other([](World& world) { world.hold(1, 5 * kMillisecond); }), 5);
  EXPECT_EQ(steps_of_other([](World& world) { world.hold(1, system::kSecond); }), 0);
}

TEST(world, stands_still_with_its_clock_or_without) {
  World world;
  const Ns begin = world.now();
  world.stand_still(kMillisecond);
  EXPECT_EQ(world.now(), begin + kMillisecond);
  world.stand_still(kMillisecond, false);
  EXPECT_EQ(world.now(), begin + kMillisecond);
  EXPECT_EQ(world.outside_now(), begin + 2 * kMillisecond);
}

Plan random_plan(std::uint64_t seed) {
  Plan plan;
  plan.seconds = 0.1;
  plan.schedule.seed = seed;
  plan.schedule.holds = 0.02;
  plan.schedule.changes = 0.05;
  return plan;
}

TEST(world, a_session_is_the_same_in_every_run_and_replayed_from_its_list) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    Plan plan = random_plan(seed);
    const Outcome first = session(plan, framed_arm().open), again = session(plan, framed_arm().open);
    EXPECT_EQ(first.digest, again.digest);
    EXPECT_GT(first.decisions.size(), 100U);
    plan.schedule.list = first.decisions;
    const Outcome replayed = session(plan, framed_arm().open);
    EXPECT_EQ(replayed.digest, first.digest);
    plan = random_plan(seed + 100);
    EXPECT_NE(session(plan, framed_arm().open).digest, first.digest);
  }
}

// A device whose readings a test alters, and which may break a rule where a certain thread was held: of each session's
// decisions two are needed for that.
struct Altered final : device::Device {
  Altered(std::unique_ptr<device::Device> its, std::function<void(device::Reading&)> alters)
      : device(std::move(its)), alter(std::move(alters)) {}
  device::Capabilities capabilities() const noexcept override { return device->capabilities(); }
  std::optional<device::Fault> start(double rate) noexcept override { return device->start(rate); }
  std::int64_t wait_for_frame(std::int64_t deadline) noexcept override { return device->wait_for_frame(deadline); }
  device::ReadResult read() noexcept override {
    device::ReadResult result = device->read();
    if (auto* reading = std::get_if<device::Reading>(&result); reading && alter) alter(*reading);
    return result;
  }
  void allow(const device::Allowance& allowance) noexcept override {
    device->allow(alter ? device::Allowance{.work = 1e6, .longest_step = 1} : allowance);
  }
  device::State state() const noexcept override { return device->state(); }
  std::optional<device::Fault> command(const Eigen::Vector3f& force) noexcept override {
    const Ns before = std::exchange(last, system::now());
    if (!alter && before != 0 && last - before > 1'500'000) ++late;
    return device->command(late > 1 ? Eigen::Vector3f(0, 0, 1) : force);  // no rule allows it
  }
  std::unique_ptr<device::Device> device;
  std::function<void(device::Reading&)> alter;
  Ns last = 0;
  int late = 0;
};

Open altered(const std::function<void(device::Reading&)>& alter = nullptr) {
  return [=](Arm& arm) { return std::make_unique<Altered>(framed_arm().open(arm), alter); };
}

TEST(world, what_breaks_a_rule_is_found_and_shrunk_to_the_decisions_that_it_takes) {
  const Open open = altered();
  const Plan plan = random_plan(0);
  EXPECT_TRUE(session(plan, open).violations.empty());
  const Found found = random_sessions(20, plan, open);
  ASSERT_GT(found.broken, 0);
  EXPECT_EQ(std::ranges::count(found.first, '\n'), 2) << found.first;
  EXPECT_NE(found.first.find("rule 1: a force that no order covers was sent"), std::string::npos) << found.first;
}

// The rules that a session breaks whose device or arm does one thing wrong, in contact.
std::set<int> broken_with(const std::function<void(device::Reading&)>& alter,
                          const std::function<void(Arm&)>& at_step = nullptr) {
  Plan plan;
  plan.seconds = 5;
  const Ns begin = system::kSecond + parts()[1].from;
  if (at_step)
    plan.at_step = [&](Arm& arm) {
      if (current()->now() > begin) at_step(arm);
    };
  std::set<int> rules;
  for (const Violation& violation : session(plan, altered(alter)).violations) rules.insert(violation.rule);
  return rules;
}

// Rules 1, 4 and 8: the next test.
TEST(world, each_rule_is_looked_at) {
  const auto nothing = [](device::Reading&) {};
  EXPECT_EQ(broken_with(nothing), std::set<int>{});
  // Once the hand withdraws, the force of 60 frames before.
  bool is_sent = false;
  const auto send_old = [&](Arm& arm) {
    const auto& sent = arm.sent();
    const Eigen::Vector3d old = sent[sent.size() - 60].force, last = sent.back().force;
    if (is_sent || last.isZero(0) || old.norm() < 2 * last.norm()) return;
    is_sent = true;
    arm.push(old);
  };
  EXPECT_TRUE(broken_with(nothing, send_old).contains(2));
  EXPECT_EQ(broken_with(nothing,
                        [](Arm&) {
                          for (const char* name : {"first", "frames"}) current()->kill(current()->thread(name));
                        }),
            std::set<int>{3});
  EXPECT_TRUE(broken_with([n = 0](device::Reading& reading) mutable { reading.time -= ++n == 500 ? 1 : 0; }).contains(5));
  // The loop is told of a deeper place while the hand withdraws.
  EXPECT_TRUE(broken_with([last = 0.0F, deeper = 0.0F](device::Reading& reading) mutable {
                const float z = std::exchange(last, reading.position.z());
                deeper = std::clamp(deeper + (reading.position.z() > z ? 0.05F : -0.05F), 0.0F, 6.0F);
                reading.position.z() -= deeper;
                reading.sent->work = 0;
              }).contains(6));
  EXPECT_TRUE(broken_with([](device::Reading& reading) { reading.sent->acting.x() += 1; }).contains(7));
  bool is_halved = false;
  const auto send_half = [&](Arm& arm) {
    const Eigen::Vector3d last = arm.sent().back().force;
    if (!std::exchange(is_halved, is_halved || last.norm() > 0.2) && is_halved) arm.push(last / 2);
  };
  EXPECT_TRUE(broken_with(nothing, send_half).contains(9));
}

TEST(world, a_fault_that_is_placed_happens_at_every_step) {
  const Part& contact = parts()[1];
  const ArmKind arm = framed_arm();
  const auto found = [&](const Fault& fault) { return placed({fault}, {contact.from, 10}, plan_for(contact, arm), arm.open); };
  const Found none = found({"nothing", [](World&, Arm&) {}});
  EXPECT_EQ(none.tried, 10);
  EXPECT_EQ(none.go_on, 10);
  EXPECT_EQ(none.broken, 0);
  const Found dies = found({"the process dies", [](World& world, Arm& its) {
                              for (int thread = 0; thread < world.threads(); ++thread) world.kill(thread);
                              its.lose_client();
                            }});
  EXPECT_EQ(dies.go_on, 0);
  EXPECT_GT(dies.longest, 45);
  const Found wrong = found({"other words are expected", [](World&, Arm&) {}, {"tripped"}});
  EXPECT_EQ(wrong.broken, 10);
  EXPECT_NE(wrong.first.find("rule 8"), std::string::npos) << wrong.first;
  const Found pushed = found({"a force without an order", [](World&, Arm& its) { its.push({0, 0, 2}); }});
  EXPECT_EQ(pushed.broken, 10);
  EXPECT_NE(pushed.first.find("rule 1"), std::string::npos) << pushed.first;
  const Found twice = found({"it is closed by somebody else", [](World&, Arm& its) {
                               its.push({0, 0, 0});
                               its.on_misuse("closed");
                             }});
  EXPECT_NE(twice.first.find("rule 4"), std::string::npos) << twice.first;
}

}  // namespace
}  // namespace forceshade::world
