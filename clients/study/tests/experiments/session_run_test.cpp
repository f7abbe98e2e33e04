// SPDX-License-Identifier: BSD-3-Clause
// A session on a simulated device, called from a program in a simulated world: what the front is shown, what is kept, and how
// it ends.

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "device/simulated/simulated.h"
#include "forceshade/error.h"
#include "forceshade/recording.h"
#include "study/apparatus/apparatus.h"
#include "study/apparatus/bumps.h"
#include "study/apparatus/motion.h"
#include "study/apparatus/recorded_loop.h"
#include "study/experiments/session_folder.h"
#include "study/experiments/session_results.h"
#include "study/experiments/stimulus_list.h"
#include "study/tests/experiments/patient.h"
#include "study/tests/experiments/protocol_folder.h"
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
    is_ready_ = latest && (screen.trial == 0 || felt.left) && ++frame_ % frames_of_a_press == 0;
    if (screen.trial > 0 && felt.left) {
      shown.insert({screen.block, screen.trial, screen.trials});
      stimuli.insert(felt.left->stimulus);
      if (felt.right) stimuli.insert(felt.right->stimulus);
    }
    return is_open(screen);
  }
  std::vector<Press> presses() override {
    if (!is_ready_ || screen_.kind == ScreenKind::end) return {};  // at the end it waits for nothing
    return {experiments::next_press(screen_, presses_of_trial_)};
  }
  bool waits_at_the_end() const override { return false; }

  std::function<bool(const Screen&)> is_open = [](const Screen&) { return true; };
  std::set<std::array<int, 3>> shown;  // block, trial, trials
  std::set<std::string> stimuli;
  int frames_of_a_press = 1;

 private:
  Screen screen_;
  bool is_ready_ = false;
  int presses_of_trial_ = 0, frame_ = 0;
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
  // One tap, and then the hand stays in the air, where every exchange of bumps is possible (study/apparatus/stage.h).
  static device::Intention tap() {
    return {{{0, {20, 0, 10}}, {0.5, {20, 0, -1}}, {1, {20, 0, 10}}}, device::Intention::Between::minimum_jerk};
  }
  Outcome run(const SessionPlan& its, Front& front, const device::Intention& hand = tap()) const {
    Outcome outcome;
    in_the_world(hand, [&](device::Device& device) { outcome = run_session(its, device, front, stop); });
    return outcome;
  }
  void in_the_world(const device::Intention& hand, const std::function<void(device::Device&)>& work) const {
    device::Simulated device(device::premium_1_5(), device::Operator{device::Grip{}, hand, device::Tremor(1, 0.03), false});
    world::World world;
    std::exception_ptr thrown;
    const auto there = [&] {
      try {
        work(device);
      } catch (...) {
        thrown = std::current_exception();
      }
    };
    EXPECT_EQ(world.run(there, 60 * system::kSecond), world::World::End::over);
    if (thrown) std::rethrow_exception(thrown);
  }
  std::vector<fs::path> parts(int run) const { return parts_of(experiments::ticks_of_run(folder.file("session"), run)); }
  std::string with_raised_bumps() {
    std::string text = folder.read("matching.toml");
    text.replace(text.find("bump-1p-shaded"), 14, "bump-3p");
    folder.write("raised.toml", text);
    return "raised.toml";
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
  std::set<std::uint64_t> exchanged;
  for (const fs::path& part : parts(1)) {
    recorder::Recording recording(part);
    EXPECT_EQ(recorder::problems_of(recording), std::vector<std::string>());
    EXPECT_EQ(recording.metadata().at("participant"), "P-1");
    EXPECT_EQ(recording.metadata().at("certified"), "no");
    EXPECT_EQ(recording.metadata().at("run"), "1");
    if (recording.metadata().contains("trial_of_block")) trials.insert(recording.metadata().at("trial_of_block"));
    recording.for_each_chunk([&](std::span<const device::Sample> chunk) {
      for (const device::Sample& sample : chunk) {
        ticks += sample.status == device::Sample::kEnd ? 0 : 1;
        exchanged.insert(sample.shown & 0xFFFF'FFFFU);
      }
    });
  }
  EXPECT_EQ(ticks, outcome.result.ticks);
  EXPECT_EQ(trials, (std::set<std::string>{"1", "2", "3"}));
  const auto listed = experiments::read_stimuli(fs::path(folder.file("session")) / "ticks/run-1/stimuli.jsonl");
  EXPECT_EQ(exchanged.size(), listed.size() + 1) << "all that was offered was felt, after nothing";
}

TEST_F(SessionRun, ends_when_its_front_is_closed_and_goes_on_with_the_next_trial) {
  Patient patient;
  patient.is_open = [](const Screen& screen) { return screen.trial < 2; };
  const Outcome first = run(plan("classification.toml"), patient);
  EXPECT_FALSE(first.is_over);
  EXPECT_EQ(first.result.end_reason, device::EndReason::stopped);
  EXPECT_EQ(experiments::read_session(folder.file("session")).events.back().kind, experiments::EventKind::run_ended);

  SessionPlan again = plan("classification.toml");
  again.protocol.clear();
  Patient next;
  const Outcome second = run(again, next);
  EXPECT_TRUE(second.is_over);
  EXPECT_EQ(second.run, 2);
  EXPECT_EQ(next.shown, (std::set<std::array<int, 3>>{{1, 2, 2}}));
  EXPECT_EQ(std::ranges::count_if(
                parts(2), [](const fs::path& part) { return part.filename().string().ends_with("-block-1-trial-2-2.fsr"); }),
            1)
      << "its second attempt";
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
  EXPECT_GT(parts(1).size(), 0U);
  for (const fs::path& part : parts(1)) EXPECT_TRUE(recorder::Recording(part).ended()) << part;
}

TEST_F(SessionRun, says_who_answered) {
  for (const bool is_virtual : {false, true}) {
    SessionPlan its = plan("classification.toml");
    its.session = folder.file(is_virtual ? "virtual" : "session");
    its.is_virtual = is_virtual;
    Patient patient;
    run(its, patient);
    for (const auto& trial : experiments::results_of(experiments::read_session(its.session)).classification)
      EXPECT_EQ(trial.origin.answered_by, is_virtual ? experiments::AnsweredBy::model : experiments::AnsweredBy::person);
  }
}

// Beside the middle of the scene, where it was moved to, the left bump is felt.
TEST_F(SessionRun, has_its_bumps_on_both_sides_of_its_origin) {
  SessionPlan its = plan(with_raised_bumps());
  its.origin = {30, 0, 0};
  Patient patient;
  patient.frames_of_a_press = 5;
  const device::Intention on_the_left({{0, {5, 0, 20}}, {0.5, {5, 0, 1}}, {1, {5, 0, 20}}},
                                      device::Intention::Between::minimum_jerk);
  run(its, patient, on_the_left);
  float largest = 0;
  for (const fs::path& part : parts(1))
    recorder::Recording(part).for_each_chunk([&](std::span<const device::Sample> chunk) {
      for (const device::Sample& sample : chunk) largest = std::max(largest, sample.law_force[2]);
    });
  EXPECT_GT(largest, 0.2F);
  for (const auto& listed : experiments::read_stimuli(fs::path(folder.file("session")) / "ticks/run-1/stimuli.jsonl"))
    EXPECT_EQ(listed.seam, 30);
}

// A bump that is changed under the tip is felt as it was, and the front is told so.
TEST_F(SessionRun, shows_what_is_felt_and_not_what_waits) {
  struct Changes final : Front {
    bool show(const Screen& screen, const std::optional<device::Sample>& latest, const Scene& felt) override {
      system::sleep_for(std::chrono::milliseconds(16));
      const bool is_in_contact = latest && Eigen::Vector3f::Map(latest->law_force.data()).norm() > 0.3F;
      kind = screen.kind;
      if (pressed > 0) {
        EXPECT_TRUE(is_in_contact);
        EXPECT_EQ(felt, before) << pressed;
        ++pressed;
      }
      is_ready = screen.kind != ScreenKind::matching || (is_in_contact && pressed == 0);
      before = pressed == 0 ? felt : before;
      return pressed < 6;
    }
    std::vector<Press> presses() override {
      if (!is_ready) return {};
      if (kind != ScreenKind::matching) return {{experiments::Action::enter}};
      is_ready = false;
      pressed = 1;
      return {{experiments::Action::bigger}};
    }
    ScreenKind kind{};
    Scene before;
    int pressed = 0;
    bool is_ready = false;
  } front;
  const device::Intention down({{0, {25, 0, 20}}, {2, {25, 0, 20}}, {2.5, {25, 0, 1}}},
                               device::Intention::Between::minimum_jerk);
  EXPECT_FALSE(run(plan(with_raised_bumps()), front, down).is_over);
  EXPECT_EQ(front.pressed, 6);
}

TEST_F(SessionRun, that_is_left_stops_its_loop) {
  Bumps bumps(experiments::read_protocol(folder.file("classification.toml")), read_until(stop));
  in_the_world(tap(), [&](device::Device& device) {
    RecordedLoop loop(device, bumps, {.device = kDevice, .folder = folder.file("ticks"), .certificates = {}}, stop);
    loop.start();
  });
}

}  // namespace
}  // namespace forceshade::apparatus
