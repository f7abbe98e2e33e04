// SPDX-License-Identifier: BSD-3-Clause
// The behaviour of a session at its limits, after a break, and with its disk.

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "study/experiments/session.h"
#include "study/experiments/session_folder.h"
#include "study/experiments/session_results.h"
#include "study/tests/experiments/small_protocols.h"
#include "tests/support/temporary_directory.h"

namespace {

std::atomic<int> file_syncs = 0, folder_syncs = 0;

}  // namespace

// Stand before those of the C library in this program, and count.
extern "C" int fdatasync(int descriptor) {
  ++file_syncs;
  return static_cast<int>(::syscall(SYS_fdatasync, descriptor));
}
extern "C" int fsync(int descriptor) {
  // A session's folder with its log, whose name is the last one to be made.
  if (::faccessat(descriptor, "trials.jsonl", F_OK, 0) == 0) ++folder_syncs;
  return static_cast<int>(::syscall(SYS_fsync, descriptor));
}

namespace forceshade::experiments {
namespace {

namespace fs = std::filesystem;

// One block of twelve trials after seven for practice, a break after four.
std::string twelve_trials(const std::string& resume) {
  return small_matching(resume, {.vision = "true", .practice_trials = 7, .repetitions = 4});
}

struct Lab : tests::TemporaryDirectory {
  explicit Lab(const std::string& resume = "trial") { write("p.toml", twelve_trials(resume)); }
  RecordedSession start(Sync sync = Sync::never) const {
    return RecordedSession::start(folder(), file("p.toml"), "P", 5, {}, sync);
  }
  RecordedSession resume() const { return RecordedSession::resume(folder(), {}, Sync::never); }
  fs::path folder() const { return file("s"); }
  std::vector<Event> events() const { return read_session(folder()).events; }
  long count(EventKind kind) const { return std::ranges::count(events(), kind, &Event::kind); }
};

// Satisfied at once with every trial: until the screen has this title, the session is over, or the trial of this index begins.
void answer_until(Session& session, const std::string& title, int index = 0) {
  for (int i = 0; i < 1000 && !session.is_over(); ++i) {
    const Screen screen = session.screen();
    if (screen.title == title) return;
    if (index > 0 && screen.kind == ScreenKind::matching && !screen.is_practice && screen.trial == index) return;
    if (screen.kind == ScreenKind::matching)
      session.press({Action::done}, i);
    else if (screen.kind != ScreenKind::text && screen.entry.empty())
      session.press({Action::type, "7"}, i);
    else
      session.press({Action::enter}, i);
  }
}

// The interruption is a break itself: a run that ends in a break goes on with the text for participants who come back, then
// with the trial that the break was before, and the next break comes as many trials later as without an interruption.
TEST(session_break, that_the_end_of_a_run_interrupts_is_not_repeated) {
  const Lab lab;
  {
    RecordedSession recorded = lab.start();
    answer_until(recorded.session(), "A break");
    ASSERT_EQ(recorded.session().screen().title, "A break");
    recorded.session().close(1000);
  }
  RecordedSession resumed = lab.resume();
  const Language language = resumed.session().language();
  EXPECT_EQ(resumed.session().screen().title, language.resumed.title);
  EXPECT_NE(language.resumed.title, "A break");
  resumed.session().press({Action::enter}, 0);
  ASSERT_TRUE(resumed.session().current());
  EXPECT_EQ(resumed.session().current()->index, 5);
  EXPECT_EQ(resumed.session().current()->attempt, 1);
  answer_until(resumed.session(), "A break");
  const auto events = lab.events();
  EXPECT_EQ(events.back().kind, EventKind::break_started);
  EXPECT_EQ(events[events.size() - 2].index, 8);
  answer_until(resumed.session(), "");
  EXPECT_TRUE(resumed.session().is_over());
  EXPECT_EQ(lab.count(EventKind::break_started), 2);
  EXPECT_EQ(lab.count(EventKind::break_ended), 1);
}

// A run that ended between the answer and its break: the same.
TEST(session_break, whose_beginning_a_crash_prevented_is_not_made_up_for) {
  const Lab lab;
  {
    RecordedSession recorded = lab.start();
    answer_until(recorded.session(), "A break");
  }
  const std::vector<Event> events = lab.events();
  ASSERT_EQ(events.back().kind, EventKind::break_started);
  std::vector<Event> logged;
  const SavedSession saved = read_session(lab.folder());
  Session session(
      saved.protocol, saved.language, saved.seed, [&](const Event& event) { logged.push_back(event); },
      std::span(events).first(events.size() - 1));
  session.press({Action::enter}, 0);
  ASSERT_EQ(logged.size(), 2U);
  EXPECT_EQ(logged[1].kind, EventKind::trial_started);
  EXPECT_EQ(logged[1].index, 5);
}

// The match is done, and how content the participant is was not answered: the trial is not over.
TEST(session_interrupted, at_the_question_of_satisfaction_begins_its_trial_again_or_its_block) {
  for (const std::string unit : {"trial", "block"}) {
    const Lab lab(unit);
    {
      RecordedSession recorded = lab.start();
      answer_until(recorded.session(), "", 3);
      recorded.session().press({Action::done}, 900);
      ASSERT_EQ(recorded.session().screen().kind, ScreenKind::satisfaction);
    }
    RecordedSession resumed = lab.resume();
    Session& session = resumed.session();
    EXPECT_EQ(session.screen().title, unit == "trial" ? session.language().resumed.title : "Part 1 of 1: with a picture");
    EXPECT_FALSE(session.current());
    session.press({Action::enter}, 0);
    ASSERT_TRUE(session.current());
    EXPECT_EQ(session.current()->index, unit == "trial" ? 3 : 1);
    EXPECT_EQ(session.current()->attempt, 2);
    EXPECT_EQ(session.screen().kind, ScreenKind::matching);
    answer_until(session, "");
    EXPECT_TRUE(session.is_over());
    EXPECT_EQ(results_of(read_session(lab.folder())).matching.size(), 12U);
  }
}

TEST(session_break, comes_again_where_its_block_is_repeated) {
  const Lab lab("block");
  {
    RecordedSession recorded = lab.start();
    answer_until(recorded.session(), "A break");
  }
  RecordedSession resumed = lab.resume();
  EXPECT_EQ(resumed.session().screen().title, "Part 1 of 1: with a picture");
  answer_until(resumed.session(), "");
  EXPECT_EQ(lab.count(EventKind::break_started), 3);
}

TEST(session_break, comes_in_no_practice) {
  const Lab lab;
  RecordedSession recorded = lab.start();
  answer_until(recorded.session(), "A break");
  const std::vector<Event> events = lab.events();
  EXPECT_EQ(std::ranges::count(events, EventKind::answered, &Event::kind), 7 + 4);
  EXPECT_EQ(lab.count(EventKind::break_started), 1);
}

TEST(session_rules, a_press_at_a_limit_is_no_change_of_the_radius) {
  const Lab lab;
  RecordedSession recorded = lab.start();
  answer_until(recorded.session(), "", 1);
  const int initial = recorded.session().current()->trial.initial_radius;
  for (int i = 0; i < 20; ++i) recorded.session().press({Action::bigger}, 1000);
  EXPECT_EQ(recorded.session().current()->radius, 550);
  EXPECT_EQ(lab.count(EventKind::radius_changed), (initial - 550 + 99) / 100);
}

TEST(session_rules, the_reference_keeps_its_radius_while_the_other_bump_changes) {
  const Lab lab;
  RecordedSession recorded = lab.start();
  answer_until(recorded.session(), "", 1);
  const Scene before = recorded.session().scene();
  recorded.session().press({before.right->radius > 1000 ? Action::bigger : Action::smaller}, 1000);
  const Scene after = recorded.session().scene();
  EXPECT_NE(after.right, before.right);
  EXPECT_EQ(after.left, before.left);
  EXPECT_EQ(after.left->radius, 1000);
}

// 4000 bytes: what would make an answer longer is not taken, the whole of it.
TEST(session_rules, an_answer_to_a_question_has_a_longest_length) {
  const Lab lab;
  RecordedSession recorded = lab.start();
  for (int i = 0; i < 1000 && recorded.session().screen().kind != ScreenKind::question; ++i) {
    const Screen screen = recorded.session().screen();
    if (screen.kind == ScreenKind::matching)
      recorded.session().press({Action::done}, i);
    else if (screen.kind == ScreenKind::satisfaction && screen.entry.empty())
      recorded.session().press({Action::type, "7"}, i);
    else
      recorded.session().press({Action::enter}, i);
  }
  ASSERT_EQ(recorded.session().screen().kind, ScreenKind::question);
  for (int i = 0; i < 3999; ++i) recorded.session().press({Action::type, "a"}, 1000);
  recorded.session().press({Action::type, "ö"}, 1000);
  EXPECT_EQ(recorded.session().screen().entry.size(), 3999U);
  recorded.session().press({Action::type, "b"}, 1000);
  recorded.session().press({Action::type, "c"}, 1000);
  const std::string entry = recorded.session().screen().entry;
  EXPECT_EQ(entry.size(), 4000U);
  EXPECT_TRUE(entry.ends_with("aab"));
}

// A log in which one number of an event is another one: none is read.
TEST(session_rules, an_event_of_another_attempt_trial_block_or_run_is_refused) {
  const Lab lab;
  {
    RecordedSession recorded = lab.start();
    answer_until(recorded.session(), "", 2);
    recorded.session().press({Action::bigger}, 1000);
    recorded.session().close(1001);
  }
  const SavedSession saved = read_session(lab.folder());
  const auto replays = [&](const std::vector<Event>& events) {
    try {
      Session(
          saved.protocol, saved.language, saved.seed, [](const Event&) {}, events);
    } catch (const ReplayError&) {
      return false;
    }
    return true;
  };
  EXPECT_TRUE(replays(saved.events));
  int refused = 0;
  for (std::size_t i = 0; i < saved.events.size(); ++i) {
    const EventKind kind = saved.events[i].kind;
    if (kind != EventKind::trial_started && kind != EventKind::radius_changed && kind != EventKind::answered &&
        kind != EventKind::match_done)
      continue;
    for (int Event::*number : {&Event::attempt, &Event::index, &Event::block})
      for (const int by : {-1, 1}) {
        std::vector<Event> events = saved.events;
        events[i].*number += by;
        EXPECT_FALSE(replays(events)) << "event " << i;
        ++refused;
      }
  }
  EXPECT_GT(refused, 50);
}

// A disk that takes the beginning of a line alone, then has room again: the next line stands by itself.
TEST(session_rules, a_line_that_was_written_in_part_is_taken_back) {
  const Lab lab;
  RecordedSession recorded = lab.start();
  const fs::path log = lab.folder() / "trials.jsonl";
  const auto size = fs::file_size(log);
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto previous = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit little{.rlim_cur = size + 10, .rlim_max = before.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &little), 0);
  recorded.session().press({Action::enter}, 0);
  EXPECT_ANY_THROW(recorded.session().press({Action::enter}, 0));
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, previous);
  EXPECT_EQ(fs::file_size(log), size);
  recorded.session().press({Action::enter}, 0);
  EXPECT_EQ(lab.events().size(), 3U);
  EXPECT_EQ(read_session(lab.folder()).note, "");
}

// Whole lines with their checksums, of which one is missing.
TEST(session_rules, a_log_without_one_of_its_lines_is_refused_with_the_line) {
  const Lab lab;
  {
    RecordedSession recorded = lab.start();
    answer_until(recorded.session(), "", 1);
    recorded.session().press({Action::bigger}, 1000);
    recorded.session().press({Action::smaller}, 1001);
  }
  const std::string file = (lab.folder() / "trials.jsonl").string(), text = lab.read("s/trials.jsonl");
  std::size_t number = 0;
  for (std::size_t begin = 0; begin < text.size(); begin = text.find('\n', begin) + 1) {
    ++number;
    std::string cut = text;
    cut.erase(begin, text.find('\n', begin) + 1 - begin);
    if (begin + 1 >= cut.size()) break;  // without its last line a log is one that ended earlier
    lab.write("s/trials.jsonl", cut);
    try {
      read_session(lab.folder());
      ADD_FAILURE() << "without line " << number;
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(std::string(error.what()), file + ":" + std::to_string(number) + ": expected event " + std::to_string(number));
    }
  }
  EXPECT_GT(number, 20U);
}

// Each event is on the disk before the session goes on, and so are the names of a new session's files.
TEST(session_rules, each_event_and_the_names_of_files_reach_the_disk) {
  const Lab lab;
  const int before = file_syncs, folders_before = folder_syncs;
  RecordedSession recorded = lab.start(Sync::each_event);
  EXPECT_EQ(folder_syncs - folders_before, 1);
  EXPECT_EQ(file_syncs - before, 1);  // the start of the run
  recorded.session().press({Action::enter}, 0);
  recorded.session().press({Action::enter}, 0);
  EXPECT_EQ(lab.events().size(), 3U);
  EXPECT_EQ(file_syncs - before, 3);
}

}  // namespace
}  // namespace forceshade::experiments
