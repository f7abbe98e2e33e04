// SPDX-License-Identifier: BSD-3-Clause
// A session on disk: its log, which may end or be wrong anywhere, its resumption and its folder.

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <set>
#include <string>
#include <vector>

#include "files/csv.h"
#include "files/input_file.h"
#include "files/output_file.h"
#include "study/experiments/random.h"
#include "study/experiments/session_folder.h"
#include "study/experiments/session_results.h"
#include "study/experiments/trial_log.h"
#include "study/tests/experiments/patient.h"
#include "study/tests/experiments/small_protocols.h"
#include "tests/support/temporary_directory.h"

namespace forceshade::experiments {
namespace {

namespace fs = std::filesystem;

// The log may end anywhere: after each event of a session, and within the line of the next one.
void expect_a_whole_session_wherever_the_log_ends(const std::string& resume) {
  const tests::TemporaryDirectory directory;
  const fs::path whole = directory.file("whole");
  const std::string protocol = directory.write("p.toml", small_matching(resume));
  double time = 0;
  {
    RecordedSession recorded = RecordedSession::start(whole, protocol, "P", 5);
    go_on(recorded.session(), time);
  }
  const std::string log = (std::ostringstream() << std::ifstream(whole / "trials.jsonl").rdbuf()).str();
  int torn = 0, in_trial = 0;
  const fs::path folder = directory.file("cut");
  for (std::size_t end = log.find('\n'); end + 1 < log.size(); end = log.find('\n', end + 1)) {
    fs::remove_all(folder);
    fs::copy(whole, folder, fs::copy_options::recursive);
    const std::size_t extra = end % 3 * 20;  // bytes of the next line
    fs::resize_file(folder / "trials.jsonl", end + 1 + extra);
    const std::size_t events =
        static_cast<std::size_t>(std::count(log.begin(), log.begin() + static_cast<std::ptrdiff_t>(end) + 1, '\n'));
    if (log.find("session-ended") < end) break;
    RecordedSession resumed = RecordedSession::resume(folder, {}, Sync::never);
    EXPECT_EQ(resumed.note().empty(), extra == 0) << resumed.note();
    torn += extra > 0 ? 1 : 0;
    EXPECT_EQ(resumed.run(), 2);
    const SavedSession before = read_session(folder);
    // The end of the session follows without a press where all questions were answered.
    EXPECT_EQ(before.events.size(), events + (resumed.session().is_over() ? 2 : 1));
    in_trial += before.events[events - 1].kind == EventKind::radius_changed ? 1 : 0;
    double later = 0;
    go_on(resumed.session(), later);
    ASSERT_TRUE(resumed.session().is_over());
    const Results results = results_of(read_session(folder));
    EXPECT_EQ(results.matching.size(), 12U);
    std::set<int> trials;
    for (const MatchingResult& trial : results.matching) {
      EXPECT_EQ(trial.steps, 1) << "an interrupted trial begins at its initial radius again";
      trials.insert(trial.trial);
    }
    EXPECT_EQ(trials.size(), 12U);
  }
  std::cout << torn << " logs with a torn line, " << in_trial << " within a trial\n";
  EXPECT_GT(torn, 10);
  EXPECT_GT(in_trial, 10);
}

TEST(session, resumes_at_the_very_trial_wherever_the_log_ends) {
  expect_a_whole_session_wherever_the_log_ends("trial");
}

TEST(session, resumes_with_the_block_wherever_the_log_ends) {
  expect_a_whole_session_wherever_the_log_ends("block");
}

TEST(session, repeats_the_block_with_its_instructions_where_the_protocol_says_so) {
  const tests::TemporaryDirectory directory;
  const fs::path folder = directory.file("s");
  double time = 0;
  {
    RecordedSession recorded = RecordedSession::start(folder, directory.write("p.toml", small_matching("block")), "P", 5);
    go_on(recorded.session(), time, 2 + 4 + 1 + 3 * 4 + 1);  // into the fourth trial of the first block
    EXPECT_EQ(recorded.session().current()->index, 4);
  }
  EXPECT_EQ(results_of(read_session(folder)).matching.size(), 3U);
  RecordedSession resumed = RecordedSession::resume(folder);
  EXPECT_EQ(resumed.session().screen().title, "Part 1 of 2: with a picture");
  double later = 0;
  go_on(resumed.session(), later, 1);
  EXPECT_EQ(resumed.session().current()->index, 1);
  EXPECT_EQ(resumed.session().current()->attempt, 2);
  EXPECT_EQ(results_of(read_session(folder)).matching.size(), 0U);
  go_on(resumed.session(), later);
  EXPECT_EQ(results_of(read_session(folder)).matching.size(), 12U);
}

// A process that is killed in the middle of its presses: every event that its session went on from is in the log.
TEST(session, killed_at_any_time_loses_no_event) {
  const tests::TemporaryDirectory directory;
  const std::string protocol = directory.write("p.toml", small_matching("trial"));
  for (int round = 0; round < 3; ++round) {
    const fs::path folder = directory.file("s" + std::to_string(round));
    int pipe_ends[2];
    ASSERT_EQ(pipe(pipe_ends), 0);
    const pid_t child = fork();
    if (child == 0) {
      RecordedSession recorded = RecordedSession::start(folder, protocol, "P", 5);
      double time = 0;
      int presses = 0;
      for (;;) {
        recorded.session().press(next_press(recorded.session().screen(), presses), time += 0.5);
        const char done = 'x';
        if (write(pipe_ends[1], &done, 1) != 1 || recorded.session().is_over()) pause();
      }
    }
    char byte = 0;
    const int presses = 10 + 7 * round;
    for (int i = 0; i < presses; ++i) ASSERT_EQ(read(pipe_ends[0], &byte, 1), 1);
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    close(pipe_ends[0]);
    close(pipe_ends[1]);
    // The same presses in this process.
    std::vector<Event> expected;
    const Protocol read_again = read_protocol(protocol);
    Session session(read_again, read_language(read_again.language), 5, [&](const Event& event) { expected.push_back(event); });
    double time = 0;
    go_on(session, time, presses);
    const SavedSession saved = read_session(folder);
    ASSERT_GE(saved.events.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_TRUE(saved.events[i] == expected[i]) << i;
    EXPECT_NO_THROW(RecordedSession::resume(folder));
  }
}

// The practice is block 0, which its line says as that of any other block does.
TEST(trial_log, says_of_every_block_which_it_is) {
  for (const int block : {0, 1}) {
    Event event;
    event.kind = EventKind::block_started;
    event.block = block;
    EXPECT_NE(line_of(event, 1).find("\"block\":" + std::to_string(block)), std::string::npos) << line_of(event, 1);
  }
}

TEST(trial_log, any_changed_byte_is_found_out) {
  const tests::TemporaryDirectory directory;
  const fs::path folder = directory.file("s"), file = folder / "trials.jsonl";
  double time = 0;
  {
    RecordedSession recorded = RecordedSession::start(folder, directory.write("p.toml", small_matching("trial")), "P", 5);
    go_on(recorded.session(), time, 12);
  }
  const std::string log = (std::ostringstream() << std::ifstream(file).rdbuf()).str();
  const std::size_t last = log.rfind('\n', log.size() - 2) + 1;
  Random random(1);
  int refused = 0, noted = 0;
  for (int i = 0; i < 300; ++i) {
    std::string changed = log;
    const std::size_t at = random.below(log.size());
    changed[at] = static_cast<char>(changed[at] ^ static_cast<char>(1U << random.below(8)));
    std::ofstream(file, std::ios::binary) << changed;
    if (const std::string words = words_of_reading(folder); !words.empty()) {
      EXPECT_TRUE(words.starts_with(file.string() + ':')) << words;
      ++refused;
    } else {
      EXPECT_GE(at, last - 1) << "a change before the last line was read over";
      EXPECT_FALSE(read_session(folder).note.empty());
      ++noted;
    }
  }
  std::cout << refused << " refused, " << noted << " taken for a torn last line\n";
  EXPECT_GT(refused, 100);
  EXPECT_GT(noted, 5);
}

TEST(trial_log, the_checksum_is_that_of_png_and_zlib) {
  EXPECT_EQ(crc32("123456789"), 0xcbf43926U);  // the check value of CRC-32/ISO-HDLC
}

TEST(trial_log, another_protocol_or_seed_is_refused_with_the_line) {
  const tests::TemporaryDirectory directory;
  const fs::path folder = directory.file("s");
  double time = 0;
  {
    RecordedSession recorded = RecordedSession::start(folder, directory.write("p.toml", small_matching("trial")), "P", 5);
    go_on(recorded.session(), time, 30);
  }
  std::string about = (std::ostringstream() << std::ifstream(folder / "session.json").rdbuf()).str();
  about.replace(about.find("\"5\""), 3, "\"6\"");
  std::ofstream(folder / "session.json") << about;
  const std::string words = words_of_reading(folder);
  EXPECT_TRUE(words.starts_with((folder / "trials.jsonl").string() + ":3: expected another trial: protocol.toml or the seed"))
      << words;
}

// An event of each kind, with a number of its own in each field that it has.
TEST(trial_log, reads_back_each_field_of_each_event) {
  const tests::TemporaryDirectory directory;
  std::vector<Event> events;
  std::string text;
  for (int kind = 0; kind <= static_cast<int>(EventKind::run_ended); ++kind) {
    Event event;
    event.kind = static_cast<EventKind>(kind);
    event.time = 0.1 + kind;
    event.run = 100 + kind;
    event.block = 200 + kind;
    event.index = 300 + kind;
    event.attempt = 400 + kind;
    event.radius = 500 + kind;
    event.answer = 600 + kind;
    event.text = "ö \"" + std::to_string(kind);
    event.device = "device \"" + std::to_string(kind);
    if (kind > 0) event.certified = kind % 2 == 0;
    if (event.kind == EventKind::trial_started) event.trial = {701, "name", 702, InitialRadius::small, 703, 704};
    events.push_back(event);
    text += line_of(event, events.size());
  }
  const LogText log = read_log(directory.write("log.jsonl", text));
  EXPECT_EQ(log.size, text.size());
  EXPECT_EQ(log.note, "");
  ASSERT_EQ(log.events.size(), events.size());
  for (std::size_t i = 0; i < events.size(); ++i) EXPECT_TRUE(log.events[i] == events[i]) << i;
  EXPECT_TRUE(text.starts_with(
      R"({"n":1,"event":"run-started","t":0.1,"run":100,"block":200,"index":300,"attempt":400,"radius_mil":500,"answer":600,)"))
      << text;
  EXPECT_NE(text.find(R"("trial":{"number":701,"stimulus":"name","radius_mil":702,"initial":"small","initial_radius_mil":703,)"
                      R"("repetition":704})"),
            std::string::npos);
}

}  // namespace
}  // namespace forceshade::experiments
