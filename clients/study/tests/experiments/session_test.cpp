// SPDX-License-Identifier: BSD-3-Clause
// A session as a state machine, and its results.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "study/experiments/session_folder.h"
#include "study/experiments/session_results.h"
#include "study/tests/experiments/patient.h"
#include "study/tests/experiments/small_protocols.h"
#include "tests/support/temporary_directory.h"

namespace forceshade::experiments {
namespace {

namespace fs = std::filesystem;

TEST(session, goes_through_a_whole_experiment_and_its_results_are_what_was_pressed) {
  const tests::TemporaryDirectory directory;
  const fs::path folder = directory.file("s");
  RecordedSession recorded = RecordedSession::start(folder, directory.write("p.toml", small_matching("trial")), "P-1", 11);
  double time = 0;
  go_on(recorded.session(), time);
  recorded.session().close(time);
  EXPECT_EQ(recorded.session().screen().kind, ScreenKind::end);
  EXPECT_EQ(recorded.ticks(), folder / "ticks" / "run-1");
  const SavedSession saved = read_session(folder);
  const Results results = results_of(saved);
  ASSERT_EQ(results.matching.size(), 12U);
  int number = 0, at_reference = 0;
  for (const MatchingResult& trial : results.matching) {
    EXPECT_EQ(trial.participant, "P-1");
    EXPECT_EQ(trial.trial, ++number);
    EXPECT_EQ(trial.vision, number <= 6);
    EXPECT_EQ(trial.satisfaction, 7);
    EXPECT_EQ(trial.steps, 1);
    // The key for a bigger bump lowers the radius by a step, or to the limit.
    EXPECT_EQ(trial.final_radius, std::max(550.0, trial.initial_radius - 100));
    EXPECT_DOUBLE_EQ(trial.seconds, 2);  // four presses after the one that began it
    at_reference += trial.initial == InitialRadius::same ? 1 : 0;
  }
  EXPECT_EQ(at_reference, 4);
  ASSERT_EQ(results.radius_changes.size(), 24U);
  EXPECT_EQ(results.radius_changes[1].step, 1);
  EXPECT_DOUBLE_EQ(results.radius_changes[1].seconds, 0.5);
  const auto count = [&](EventKind kind) { return std::ranges::count(saved.events, kind, &Event::kind); };
  EXPECT_EQ(count(EventKind::break_started), 2);
  EXPECT_EQ(count(EventKind::question_answered), 5);
  EXPECT_EQ(count(EventKind::trial_started), 13);  // one of them practice
  EXPECT_EQ(count(EventKind::session_ended), 1);
  EXPECT_EQ(saved.events.back().kind, EventKind::run_ended);
}

TEST(session, shows_and_renders_what_the_trial_is_about) {
  const tests::TemporaryDirectory directory;
  RecordedSession recorded =
      RecordedSession::start(directory.file("s"), directory.write("p.toml", small_matching("trial")), "A", 1);
  Session& session = recorded.session();
  EXPECT_EQ(session.scene(), Scene());
  EXPECT_NE(session.screen().text.find("press j to make it smaller and k"), std::string::npos) << session.screen().text;
  session.press({Action::smaller}, 1);  // means nothing here
  session.press({Action::enter}, 1);
  session.press({Action::enter}, 2);
  const Screen practice = session.screen();
  EXPECT_EQ(practice.kind, ScreenKind::matching);
  EXPECT_TRUE(practice.is_practice);
  const auto current = session.current();
  ASSERT_TRUE(current);
  EXPECT_EQ(session.scene().left, (Bump{"bump-cylinder", 1000, -750}));
  EXPECT_EQ(session.scene().right, (Bump{"bump-1p-shaded", current->trial.initial_radius, 750}));
  session.press({Action::done}, 3);
  session.press({Action::enter}, 4);  // nothing entered yet
  EXPECT_EQ(session.screen().kind, ScreenKind::satisfaction);
  for (const char* typed : {"0", "x", "1", "1", "0", "0"}) session.press(type(typed), 5);
  EXPECT_EQ(session.screen().entry, "10");
  session.press({Action::erase}, 6);
  EXPECT_EQ(session.screen().entry, "1");
  EXPECT_TRUE(session.scene().right);
  session.press({Action::enter}, 7);
  EXPECT_EQ(session.screen().kind, ScreenKind::text);
  EXPECT_EQ(session.screen().title, "Part 1 of 2: with a picture");
  session.close(8);
  session.press({Action::enter}, 9);
  EXPECT_EQ(session.scene(), Scene());
}

TEST(session, knows_when_its_trial_began) {
  const tests::TemporaryDirectory directory;
  RecordedSession recorded =
      RecordedSession::start(directory.file("s"), directory.write("p.toml", small_matching("trial")), "A", 1);
  Session& session = recorded.session();
  session.press({Action::enter}, 1);
  session.press({Action::enter}, 2.5);
  session.press({Action::smaller}, 4);
  ASSERT_TRUE(session.current());
  EXPECT_EQ(session.current()->started, 2.5);
}

TEST(session, the_keys_stop_at_the_limits) {
  const tests::TemporaryDirectory directory;
  RecordedSession recorded =
      RecordedSession::start(directory.file("s"), directory.write("p.toml", small_matching("trial")), "A", 1);
  Session& session = recorded.session();
  session.press({Action::enter}, 0);
  session.press({Action::enter}, 0);
  for (int i = 0; i < 20; ++i) session.press({Action::bigger}, 1);
  EXPECT_EQ(session.scene().right->radius, 550);
  for (int i = 0; i < 20; ++i) session.press({Action::smaller}, 2);
  EXPECT_EQ(session.scene().right->radius, 1450);
}

TEST(session, a_classification_has_one_bump_and_an_answer_that_can_be_changed) {
  const tests::TemporaryDirectory directory;
  RecordedSession recorded =
      RecordedSession::start(directory.file("s"), directory.write("p.toml", kSmallClassification), "A", 1);
  Session& session = recorded.session();
  session.press({Action::enter}, 0);
  session.press({Action::enter}, 0);
  EXPECT_EQ(session.screen().kind, ScreenKind::classification);
  EXPECT_TRUE(session.scene().left && !session.scene().right);
  EXPECT_EQ(session.scene().left->position, 0);
  for (const char* typed : {"5", "2", "4"}) session.press(type(typed), 1);
  EXPECT_EQ(session.screen().entry, "4");
  double time = 1;
  go_on(session, time);
  const std::vector<fs::path> folders{recorded.folder()};
  const Results results = results_of(folders);
  ASSERT_EQ(results.classification.size(), 8U);
  EXPECT_EQ(results.classification[0].answer, 4);
  EXPECT_EQ(results.classification[1].answer, 3);
}

// The numbers of the trials of both experiments are from 1 on.
TEST(session, of_each_experiment_may_be_done_by_the_same_participant) {
  const tests::TemporaryDirectory directory;
  std::vector<fs::path> folders;
  for (const std::string& protocol : {small_matching("trial"), kSmallClassification}) {
    folders.push_back(directory.file("s" + std::to_string(folders.size())));
    RecordedSession recorded = RecordedSession::start(folders.back(), directory.write("p.toml", protocol), "A", 1);
    double time = 0;
    go_on(recorded.session(), time);
  }
  const Results results = results_of(folders);
  EXPECT_EQ(results.matching.size(), 12U);
  EXPECT_EQ(results.classification.size(), 8U);
}

TEST(session, a_log_that_fails_leaves_the_session_where_it_was) {
  const tests::TemporaryDirectory directory;
  const Protocol protocol = read_protocol(directory.write("p.toml", small_matching("trial")));
  bool fails = false;
  Session session(protocol, read_language(protocol.language), 1, [&](const Event&) {
    if (fails) throw std::runtime_error("disk full");
  });
  session.press({Action::enter}, 0);
  session.press({Action::enter}, 0);
  const Scene before = session.scene();
  fails = true;
  EXPECT_THROW(session.press({Action::smaller}, 1), std::runtime_error);
  EXPECT_EQ(session.scene(), before);
  fails = false;
  session.press({Action::smaller}, 1);
  EXPECT_FALSE(session.scene() == before);
}

// Checks the words on each screen beside its text.
TEST(session, says_on_each_screen_where_it_is) {
  const tests::TemporaryDirectory directory;
  KeyNames keys;
  keys.smaller = "links";
  keys.bigger = "rechts";
  keys.done = "fertig";
  keys.enter = "weiter";
  keys.erase = "weg";
  RecordedSession recorded =
      RecordedSession::start(directory.file("s"), directory.write("p.toml", small_matching("trial")), "A", 1, keys);
  Session& session = recorded.session();
  const Language& language = session.language();
  int presses = 0, trial = 0, question = 0;
  double time = 0;
  bool is_practice = true, had_break = false;
  while (!session.is_over()) {
    const Screen screen = session.screen();
    const auto current = session.current();
    switch (screen.kind) {
      case ScreenKind::matching:
        if (presses == 0) ++trial;
        [[fallthrough]];
      case ScreenKind::satisfaction: {
        ASSERT_TRUE(current);
        EXPECT_EQ(screen.trial, trial);
        EXPECT_EQ(screen.trials, is_practice ? 1 : 6);
        EXPECT_EQ(screen.is_practice, is_practice);
        EXPECT_EQ(screen.shows_scene, current->trial.number <= 6) << "the second block is without vision";
        EXPECT_EQ(current->run, 1);
        EXPECT_EQ(current->block, is_practice ? 0 : (current->trial.number - 1) / 6 + 1);
        EXPECT_EQ(current->index, trial);
        EXPECT_EQ(current->attempt, 1);
        EXPECT_EQ(current->is_practice, is_practice);
        EXPECT_EQ(current->radius, session.scene().right->radius);
        const bool is_matching = screen.kind == ScreenKind::matching;
        EXPECT_EQ(screen.title, (is_matching ? language.match : language.satisfy).title);
        EXPECT_EQ(screen.text, is_matching ? "links: smaller   rechts: bigger   fertig: as alike as possible"
                                           : "Type a number from 1 (entirely different) to 10 (no difference), then press "
                                             "weiter. weg deletes a digit.");
        break;
      }
      case ScreenKind::question:
        EXPECT_EQ(screen.title, language.question.title);
        EXPECT_EQ(screen.text, "Please type your answer, as short or as long as you like, and press weiter.\n\n" +
                                   language.questions_after_matching.at(static_cast<std::size_t>(question)));
        question += screen.entry.empty() ? 0 : 1;
        break;
      case ScreenKind::text:
        EXPECT_EQ(screen.trial, 0);
        EXPECT_EQ(screen.trials, 0);
        EXPECT_FALSE(current);
        if (screen.title.starts_with("Part ")) {
          is_practice = false;
          trial = 0;
        }
        if (screen.title == "A break") {
          EXPECT_TRUE(
              screen.text.starts_with(trial == 4 && !had_break ? "4 of 12 trials are done." : "10 of 12 trials are done."))
              << screen.text;
          had_break = true;
        }
        break;
      default: ADD_FAILURE();
    }
    session.press(next_press(screen, presses), time += 0.5);
  }
  EXPECT_EQ(question, 5);
  EXPECT_TRUE(had_break);
  EXPECT_EQ(session.screen().title, language.end.title);
}

// The results of a matching trial by its events.
TEST(session_results, are_those_of_the_events) {
  const tests::TemporaryDirectory directory;
  const Protocol protocol = read_protocol(directory.write("p.toml", small_matching("trial")));
  SavedSession saved{"Q", 1, protocol, read_language(protocol.language), {}, {}};
  Session session(saved.protocol, saved.language, 1, [&](const Event& event) { saved.events.push_back(event); });
  double time = 0;
  go_on(session, time);
  const Results results = results_of(saved);
  const std::vector<Block> blocks = order(protocol, 1);
  ASSERT_EQ(results.matching.size(), 12U);
  for (std::size_t i = 0; i < 12; ++i) {
    const Block& block = blocks[i < 6 ? 1 : 2];
    const Trial& planned = block.trials[i % 6];
    const MatchingResult& trial = results.matching[i];
    EXPECT_EQ(trial.participant, "Q");
    EXPECT_EQ(trial.trial, planned.number);
    EXPECT_EQ(trial.vision, block.vision);
    EXPECT_EQ(trial.stimulus, planned.stimulus);
    EXPECT_EQ(trial.initial, planned.initial);
    EXPECT_EQ(trial.repetition, planned.repetition);
    EXPECT_EQ(trial.reference_radius, planned.radius);
    EXPECT_EQ(trial.initial_radius, planned.initial_radius);
    EXPECT_EQ(trial.final_radius, std::max(550, planned.initial_radius - 100));
    for (const std::size_t step : {0U, 1U}) {
      const RadiusChange& change = results.radius_changes.at(2 * i + step);
      EXPECT_EQ(change.participant, "Q");
      EXPECT_EQ(change.trial, planned.number);
      EXPECT_EQ(change.step, static_cast<int>(step));
      EXPECT_DOUBLE_EQ(change.seconds, step == 0 ? 0 : 0.5);
      EXPECT_EQ(change.radius, step == 0 ? planned.initial_radius : trial.final_radius);
    }
  }
}

TEST(session_results, of_a_classification_are_those_of_the_events) {
  const tests::TemporaryDirectory directory;
  const Protocol protocol = read_protocol(directory.write("p.toml", kSmallClassification));
  SavedSession saved{"Q", 1, protocol, read_language(protocol.language), {}, {}};
  Session session(saved.protocol, saved.language, 1, [&](const Event& event) { saved.events.push_back(event); });
  double time = 0;
  go_on(session, time);
  const Results results = results_of(saved);
  const std::vector<Block> blocks = order(protocol, 1);
  ASSERT_EQ(results.classification.size(), 8U);
  EXPECT_TRUE(results.radius_changes.empty());
  for (std::size_t i = 0; i < 8; ++i) {
    const Trial& planned = blocks.back().trials[i];
    const ClassificationResult& trial = results.classification[i];
    EXPECT_EQ(trial.participant, "Q");
    EXPECT_EQ(trial.trial, planned.number);
    EXPECT_EQ(trial.stimulus, planned.stimulus);
    EXPECT_EQ(trial.radius, planned.radius);
    EXPECT_EQ(trial.repetition, planned.repetition);
    EXPECT_EQ(trial.answer, 3);
    EXPECT_DOUBLE_EQ(trial.seconds, 1);
  }
}

}  // namespace
}  // namespace forceshade::experiments
