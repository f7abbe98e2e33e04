// SPDX-License-Identifier: BSD-3-Clause
// A session of an experiment in a simulated world: the person, the servo loop, the frames of the arm and the recorder are
// fibers, and the rules of every session of an arm hold at every step. Log and ticks are files, read again after a death.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "forceshade/recording.h"
#include "study/apparatus/motion.h"
#include "study/apparatus/session_run.h"
#include "study/experiments/stimulus_list.h"
#include "study/tests/experiments/patient.h"
#include "study/tests/experiments/protocol_folder.h"
#include "tests/recorder/faulty_disk.h"
#include "tests/world/arms.h"
#include "tests/world/judge.h"
#include "tests/world/searches.h"

namespace forceshade::apparatus {
namespace {

namespace fs = std::filesystem;
using experiments::Event;
using tests::FaultyDisk;
using tests::TemporaryDirectory;
using world::Found;
using world::Ns;
using world::Plan;
using world::World;

constexpr Ns kMillisecond = 1'000'000;
constexpr Ns kMostMissing = 100 * kMillisecond;  // docs/recording.md
constexpr Ns kFrame = system::kSecond / 60;

// Answers every screen, a key each few frames.
class Person final : public Front {
 public:
  explicit Person(std::uint64_t seed) : state_(seed) {}

  bool show(const experiments::Screen& screen, const std::optional<device::Sample>&, const experiments::Scene&) override {
    screen_ = screen;
    system::sleep_for(std::chrono::nanoseconds(kFrame));
    return true;
  }
  std::vector<experiments::Press> presses() override {
    if (--frames_ > 0) return {};
    state_ = state_ * 6364136223846793005U + 1442695040888963407U;
    frames_ = 1 + static_cast<int>(state_ >> 62U);
    return {experiments::next_press(screen_, presses_of_trial_)};
  }
  bool waits_at_the_end() const override { return false; }

 private:
  std::uint64_t state_;
  experiments::Screen screen_;
  int frames_ = 40, presses_of_trial_ = 0;  // the arm is ready by then
};

// The samples that the loop has handed to its sinks, and their times.
struct Pushed final : device::SampleSink {
  struct Tick {
    Ns time;
    device::Sample sample;
  };
  std::vector<Tick> ticks;
  void push(const device::Sample& sample) noexcept override { ticks.push_back({world::current()->now(), sample}); }
};

const tests::ProtocolFolder& protocols() {
  static const tests::ProtocolFolder folder;
  return folder;
}

struct Deaths {
  Ns from = 0, to = 0;  // since the begin: tries one at each step between
};

class SessionInTheWorld {
 public:
  world::Outcome run(const Plan& plan, const Deaths& deaths = {}) {
    static const std::atomic<bool> never = false;
    static Bumps bumps(experiments::read_protocol(protocols().file("matching.toml")), read_until(never));
    World world(plan.schedule);
    world::Arm arm(plan);
    world::Judge judge(world, arm);
    const Ns begin = world.now();
    world.at_step = [&](long) {
      if (plan.at_step) plan.at_step(arm);
      judge.look();
      if (const Ns time = world.now() - begin; deaths.from < time && time < deaths.to) die();
    };
    world::Outcome outcome;
    Outcome end;
    outcome.end = world.run(
        [&] {
          try {
            auto recorded = experiments::RecordedSession::start(session(), protocols().file("matching.toml"), "P-1", 5, {},
                                                                experiments::Sync::never);
            world::Watched device(world::framed_arm().open(arm), judge);
            Person person(plan.schedule.seed);
            const LoopPlan its{
                .device = "the arm", .folder = {}, .certificates = {}, .servo = {.rate_hz = 1000, .sinks = {&judge, &pushed_}}};
            end = run_session(
                recorded, bumps, device, person, its, [&](const std::string&) { ++failures; }, never);
          } catch (const std::exception& error) {
            end.result.ticks = pushed_.ticks.size() - 1;  // the loop did not live to tell
            fault = error.what();
            if (world.now() - full_since > 100 * kMillisecond) violate("the disk refused ticks, and the session went on");
          }
        },
        60 * system::kSecond);
    outcome.result = end.result;
    judge.conclude(outcome);
    outcome.violations = judge.violations();
    if (fault.empty() != !FaultyDisk::full || (fault.empty() && failures > 0)) violate("it ended with: " + fault);
    if (fault.empty() && !end.is_over) violate("the session is not over");
    is_dead_ = !fault.empty();
    read_files(session());
    for (std::size_t tick = 0; tick < pushed_.ticks.size() && fault.empty(); ++tick)
      if (!is_there_[tick]) violate("the record lacks tick " + std::to_string(tick));
    outcome.violations.insert(outcome.violations.end(), violations_.begin(), violations_.end());
    outcome.decisions = world.decisions();
    outcome.lasted = world.now() - begin;
    outcome.steps = world.steps();
    outcome.digest = static_cast<std::uint64_t>(outcome.lasted) * 31 + static_cast<std::uint64_t>(outcome.steps);
    for (const world::Arm::Sent& sent : arm.sent()) outcome.peak = std::max(outcome.peak, sent.force.norm());
    return outcome;
  }

  long tried = 0, states = 0;  // deaths; different files that they left
  int failures = 0;            // that were told beside the one that was thrown
  std::string fault;           // that one
  static inline Ns full_since = 0;
  double most_missing = 0;  // ms
  const std::vector<Event>& events() const { return events_; }

 private:
  std::string session() const { return folder_.file("session"); }

  void violate(const std::string& words) {
    if (violations_.size() < 10) violations_.push_back({7, words});
  }

  // As another process finds the folder once this one is dead.
  void die() {
    if (is_dead_) return;
    is_dead_ = true;
    ++tried;
    const auto size_of = [&](const char* file) {
      std::error_code none;
      const auto size = fs::file_size(fs::path(session()) / file, none);
      return none ? 0 : static_cast<long>(size);
    };
    const long now = FaultyDisk::writes + size_of("trials.jsonl") + size_of("ticks/run-1/stimuli.jsonl");
    if (now != seen_) {
      seen_ = now;
      ++states;
      const TemporaryDirectory copies;
      fs::copy(session(), copies.file("session"), fs::copy_options::recursive);
      read_files(copies.file("session"));
      if (std::ranges::find(events_, experiments::EventKind::session_ended, &Event::kind) == events_.end())
        experiments::RecordedSession::resume(copies.file("session"));
    }
    for (std::size_t tick = 0; tick < pushed_.ticks.size(); ++tick) {
      if (tick < is_there_.size() && is_there_[tick]) continue;
      const Ns missing = world::current()->now() - pushed_.ticks[tick].time;
      most_missing = std::max(most_missing, static_cast<double>(missing) * 1e-6);
      if (missing > kMostMissing)
        violate("tick " + std::to_string(tick) + " is missing for " + std::to_string(missing) + " ns");
    }
    is_dead_ = false;
  }

  // The log goes on where it was, every tick that is there is one that was pushed, and what it says was shown is in the list.
  void read_files(const fs::path& folder) {
    std::vector<Event> events = experiments::read_session(folder).events;
    if (events.size() < events_.size() || !std::equal(events_.begin(), events_.end(), events.begin()))
      violate("the log has changed");
    events_ = std::move(events);
    is_there_.assign(pushed_.ticks.size(), false);
    if (!fs::exists(folder / "ticks/run-1/stimuli.jsonl")) return;
    const std::size_t stimuli = experiments::read_stimuli(folder / "ticks/run-1/stimuli.jsonl").size();
    std::size_t next = 0;
    for (const fs::path& part : parts_of(folder / "ticks/run-1")) try {
        recorder::Recording recording(part);
        const std::size_t first = next;
        std::uint64_t own = 0;
        recording.for_each_chunk([&](std::span<const device::Sample> chunk) {
          for (const device::Sample& got : chunk) {
            while (own == 0 && next < pushed_.ticks.size() && pushed_.ticks[next].sample.wall_ns < got.wall_ns) ++next;
            if (next == pushed_.ticks.size()) return violate("a tick that was not pushed");
            device::Sample expected = pushed_.ticks[next].sample;
            expected.tick = own++;
            if (std::memcmp(&got, &expected, sizeof got) != 0) violate("tick " + std::to_string(next) + " is another one");
            if ((got.shown & 0xFFFF'FFFFU) > stimuli) violate("a stimulus was shown that is not in the list");
            is_there_[next++] = true;
          }
        });
        if (!is_dead_ && first != next && !recording.ended()) violate("a part has no end");
      } catch (const Error& error) {
        violate(error.what());
      }
  }

  const TemporaryDirectory folder_;
  const FaultyDisk disk_;
  Pushed pushed_;
  std::vector<bool> is_there_;
  std::vector<Event> events_;
  std::vector<world::Violation> violations_;
  long seen_ = -1;
  bool is_dead_ = false;
};

void expect_kept(const char* what, const Found& found) {
  std::printf("%s: %ld sessions, %.0f s in the world, %ld broke a rule, digest %016lx\n", what, found.tried, found.seconds,
              found.broken, found.digest);
  EXPECT_GT(found.tried, 0);
  EXPECT_EQ(found.broken, 0) << found.first;
}

const world::Session session_in_the_world = [](const Plan& plan) { return SessionInTheWorld().run(plan); };
constexpr Ns kTrial = 660 * kMillisecond;  // a trial begins soon after this time since the begin

TEST(session_world, a_session_in_order_records_what_it_ordered) {
  SessionInTheWorld session;
  const world::Outcome outcome = session.run({});
  for (const world::Violation& violation : outcome.violations) ADD_FAILURE() << violation.rule << ": " << violation.words;
  std::printf("%.3f s in the world, %ld steps, %.3f N, %zu events\n", static_cast<double>(outcome.lasted) * 1e-9, outcome.steps,
              outcome.peak, session.events().size());
  EXPECT_GT(outcome.peak, 0.2);
  EXPECT_EQ(session.events().back().kind, experiments::EventKind::run_ended);
}

TEST(session_world, random_holds_and_a_person_who_presses_at_any_time_break_no_rule) {
  Plan plan;
  plan.schedule = {.holds = 0.005, .changes = 0.02};
  expect_kept("random", random_sessions(15, plan, session_in_the_world));
}

TEST(session_world, a_death_at_any_step_leaves_a_session_that_goes_on_and_every_tick_but_those_of_the_last_100_ms) {
  SessionInTheWorld session;
  const world::Outcome outcome = session.run({}, {kTrial - 20 * kMillisecond, kTrial + 180 * kMillisecond});
  for (const world::Violation& violation : outcome.violations) ADD_FAILURE() << violation.rule << ": " << violation.words;
  std::printf("%ld deaths left %ld different states of the files; the oldest tick that was missing was of %.3f ms before\n",
              session.tried, session.states, session.most_missing);
  EXPECT_GT(session.states, 100);
}

TEST(session_world, no_hold_where_a_trial_begins_breaks_a_rule) {
  expect_kept("trial", placed_anew(world::holds(4), {kTrial, 10, 9}, {}, session_in_the_world));
}

// The ticks that the disk has taken are read again, and the force is zero before anybody is told.
TEST(session_world, a_disk_that_is_full_from_any_step_on_ends_the_session_in_order) {
  const std::vector<world::Fault> full{{"the disk is full", [](World& world, world::Arm&) {
                                          FaultyDisk::full = true;
                                          SessionInTheWorld::full_since = world.now();
                                        }}};
  expect_kept("full", placed_anew(full, {kTrial, 20, 800}, {}, session_in_the_world));
}

}  // namespace
}  // namespace forceshade::apparatus
