// SPDX-License-Identifier: BSD-3-Clause
// A session on a simulated device, called from a program in a simulated world: what the front is shown, what is kept, and how
// it ends.

#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "device/simulated/simulated.h"
#include "forceshade/apparatus.h"
#include "forceshade/bad_input.h"
#include "forceshade/recording.h"
#include "study/apparatus/motion.h"
#include "study/experiments/session_folder.h"
#include "study/experiments/session_results.h"
#include "tests/experiments/patient.h"
#include "tests/experiments/protocol_folder.h"
#include "tests/world/world.h"

namespace forceshade::apparatus {
namespace {

namespace fs = std::filesystem;
using experiments::Press;
using experiments::Scene;
using experiments::Screen;
using experiments::ScreenKind;
using tests::ProtocolFolder;

// Answers every screen, a press at a time, once the screen's bumps are felt.
class Patient : public Front {
 public:
  bool show(const Screen& screen, const std::optional<device::Sample>& latest, const Scene& felt) override {
    system::sleep_for(std::chrono::milliseconds(16));
    screen_ = screen;
    is_ready_ = latest && (screen.trial == 0 || felt.left);
    if (screen.trial > 0 && felt.left) {
      shown.insert({screen.block, screen.trial, screen.trials});
      stimuli.insert(felt.left->stimulus);
      if (felt.right) stimuli.insert(felt.right->stimulus);
    }
    return is_open(screen);
  }
  std::vector<Press> presses() override {
    if (!is_ready_) return {};
    return {experiments::next_press(screen_, presses_of_trial_)};
  }
  bool waits_at_the_end() const override { return false; }

  std::function<bool(const Screen&)> is_open = [](const Screen&) { return true; };
  std::set<std::array<int, 3>> shown;  // block, trial, trials
  std::set<std::string> stimuli;

 private:
  Screen screen_;
  bool is_ready_ = false;
  int presses_of_trial_ = 0;
};

class SessionRun : public testing::Test {
 protected:
  SessionPlan plan(const std::string& protocol) const {
    return {.session = folder.file("session"),
            .protocol = folder.file(protocol),
            .participant = "P-1",
            .seed = 5,
            .device = kDevice};
  }
  // One tap, and then the hand stays in the air, where every exchange of bumps is possible (device/stage.h).
  Outcome run(const SessionPlan& its, Front& front) const {
    const device::Intention tap({{0, {20, 0, 10}}, {0.5, {20, 0, -1}}, {1, {20, 0, 10}}},
                                device::Intention::Between::minimum_jerk);
    device::Simulated device(device::premium_1_5(), device::Operator{device::Grip{}, tap, device::Tremor(1, 0.03), false});
    world::World world;
    Outcome outcome;
    std::exception_ptr thrown;
    const auto in_the_world = [&] {
      try {
        outcome = run_session(its, device, front, stop);
      } catch (...) {
        thrown = std::current_exception();
      }
    };
    EXPECT_EQ(world.run(in_the_world, 60 * system::kSecond), world::World::End::over);
    if (thrown) std::rethrow_exception(thrown);
    return outcome;
  }

  static constexpr const char* kDevice = "simulated:premium-1.5";
  ProtocolFolder folder;
  std::atomic<bool> stop = false;
};

TEST_F(SessionRun, goes_through_every_trial_and_keeps_answers_and_ticks) {
  Patient patient;
  const Outcome outcome = run(plan("matching.toml"), patient);
  EXPECT_TRUE(outcome.is_over);
  EXPECT_EQ(outcome.run, 1);
  EXPECT_GT(outcome.result.ticks, 0U);
  EXPECT_EQ(patient.shown, (std::set<std::array<int, 3>>{{1, 1, 3}, {1, 2, 3}, {1, 3, 3}}));
  EXPECT_EQ(patient.stimuli, (std::set<std::string>{"bump-1p-shaded", "bump-cylinder"}));

  const experiments::SavedSession saved = experiments::read_session(folder.file("session"));
  EXPECT_EQ(saved.participant, "P-1");
  EXPECT_EQ(saved.seed, 5U);
  EXPECT_EQ(experiments::results_of(saved).matching.size(), 3U);

  std::size_t ticks = 0;
  std::set<std::string> trials;
  for (const fs::path& part : parts_of(fs::path(folder.file("session")) / "ticks/run-1")) {
    recorder::Recording recording(part);
    EXPECT_EQ(recorder::problems_of(recording), std::vector<std::string>());
    EXPECT_EQ(recording.metadata().at("participant"), "P-1");
    EXPECT_EQ(recording.metadata().at("certified"), "no");
    EXPECT_EQ(recording.metadata().at("run"), "1");
    if (recording.metadata().contains("trial_of_block")) trials.insert(recording.metadata().at("trial_of_block"));
    recording.for_each_chunk([&](std::span<const device::Sample> chunk) {
      for (const device::Sample& sample : chunk) ticks += sample.status == device::Sample::kEnd ? 0 : 1;
    });
  }
  EXPECT_EQ(ticks, outcome.result.ticks);
  EXPECT_EQ(trials, (std::set<std::string>{"1", "2", "3"}));
}

TEST_F(SessionRun, ends_when_its_front_is_closed_and_goes_on_with_the_next_trial) {
  Patient patient;
  patient.is_open = [](const Screen& screen) { return screen.trial < 2; };
  const Outcome first = run(plan("classification.toml"), patient);
  EXPECT_FALSE(first.is_over);
  EXPECT_EQ(first.result.end_reason, device::EndReason::stopped);

  SessionPlan again = plan("classification.toml");
  again.protocol.clear();
  Patient next;
  const Outcome second = run(again, next);
  EXPECT_TRUE(second.is_over);
  EXPECT_EQ(second.run, 2);
  EXPECT_EQ(next.shown, (std::set<std::array<int, 3>>{{1, 2, 2}}));
  EXPECT_EQ(experiments::results_of(experiments::read_session(folder.file("session"))).classification.size(), 2U);
  EXPECT_THROW(run(again, next), std::runtime_error) << "a session that is over";
}

// Two trials of one bump: their parts differ in trial and repetition alone, and neither was tried again.
TEST_F(SessionRun, says_of_each_part_which_trial_it_is_of) {
  Patient patient;
  EXPECT_TRUE(run(plan("classification.toml"), patient).is_over);
  std::set<std::string> trials, repetitions, attempts;
  for (const fs::path& part : parts_of(fs::path(folder.file("session")) / "ticks/run-1")) {
    const recorder::Metadata metadata = recorder::Recording(part).metadata();
    if (!metadata.contains("trial")) continue;
    trials.insert(metadata.at("trial"));
    repetitions.insert(metadata.at("repetition"));
    attempts.insert(metadata.at("attempt"));
    EXPECT_EQ(metadata.at("stimulus"), "bump-1p");
    EXPECT_EQ(metadata.at("radius_mil"), "600");
    EXPECT_EQ(metadata.at("practice"), "no");
  }
  EXPECT_EQ(trials, (std::set<std::string>{"1", "2"}));
  EXPECT_EQ(repetitions, (std::set<std::string>{"1", "2"}));
  EXPECT_EQ(attempts, std::set<std::string>{"1"});
}

TEST_F(SessionRun, ends_when_it_is_told_to_from_outside) {
  Patient patient;
  patient.is_open = [&](const Screen& screen) {
    if (screen.trial > 0) stop = true;
    return true;
  };
  EXPECT_FALSE(run(plan("matching.toml"), patient).is_over);
  EXPECT_LE(patient.shown.size(), 1U);
}

TEST_F(SessionRun, is_refused_before_it_leaves_a_folder) {
  Patient patient;
  const auto refusal = [&](const SessionPlan& refused) -> std::string {
    try {
      run(refused, patient);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  };
  SessionPlan lacking = plan("classification.toml");
  lacking.certificates = folder.path();
  const std::string words = refusal(lacking);
  EXPECT_NE(words.find("no certificate of this build covers bump-1p, 600 mil ("), std::string::npos) << words;
  EXPECT_FALSE(fs::exists(folder.file("session")));

  SessionPlan unnamed = plan("classification.toml");
  unnamed.participant = "two words";
  EXPECT_NE(refusal(unnamed), "");
  SessionPlan absent = plan("no-such.toml");
  EXPECT_NE(refusal(absent), "");
  EXPECT_FALSE(fs::exists(folder.file("session")));

  fs::create_directory(folder.file("session"));
  folder.write("session/notes.txt", "mine");
  EXPECT_NE(refusal(plan("classification.toml")), "");
  EXPECT_EQ(folder.read("session/notes.txt"), "mine");
}

TEST_F(SessionRun, what_a_front_throws_ends_the_loop_and_keeps_the_session) {
  struct Thrown {};
  Patient patient;
  patient.is_open = [](const Screen& screen) {
    if (screen.trial > 0) throw Thrown();
    return true;
  };
  EXPECT_THROW(run(plan("classification.toml"), patient), Thrown);
  const experiments::SavedSession saved = experiments::read_session(folder.file("session"));
  EXPECT_EQ(saved.events.back().kind, experiments::EventKind::run_ended);
}

}  // namespace
}  // namespace forceshade::apparatus
