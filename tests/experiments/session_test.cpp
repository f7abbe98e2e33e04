// SPDX-License-Identifier: BSD-3-Clause
// A session as a state machine, its log on disk, its resumption and its results.

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
#include "files/output_file.h"
#include "study/experiments/error.h"
#include "study/experiments/random.h"
#include "study/experiments/session_folder.h"
#include "study/experiments/session_results.h"
#include "study/experiments/stimulus_list.h"
#include "study/experiments/trial_log.h"
#include "tests/experiments/patient.h"
#include "tests/support/temporary_directory.h"

namespace forceshade::experiments {
namespace {

namespace fs = std::filesystem;

// Two blocks of six trials: one reference radius, three initial radii, two repetitions.
std::string small_matching(const std::string& resume) {
  return R"(experiment = "matching"
name = "m"
language = ")" FORCESHADE_SOURCE_DIR R"(/examples/experiments/english.toml"
width_mil = 1000
stiffness_N_per_mm = 0.5
spacing_mil = 1500
practice_trials = 1
trials_before_break = 4
resume = ")" +
         resume + R"("
block_order = "as-listed"
reference = { law = "bump-cylinder" }
stimuli = [{ law = "bump-1p-shaded" }]
vision = [true, false]
reference_radii_mil = [1000]
large_initial_radius_mil = 1400
small_initial_radius_mil = 600
repetitions = 2
radius_step_mil = 100
least_radius_mil = 550
largest_radius_mil = 1450
bigger = "higher"
)";
}

const std::string kSmallClassification = R"(experiment = "classification"
name = "c"
language = ")" FORCESHADE_SOURCE_DIR R"(/examples/experiments/german.toml"
width_mil = 1000
stiffness_N_per_mm = 0.5
resume = "trial"
stimuli = [{ law = "bump-1p" }, { law = "bump-cylinder" }]
radii_mil = [600, 1000]
repetitions = 2
)";

// Presses until the session is over or `most` presses are done.
void go_on(Session& session, double& time, int most = 100'000) {
  int presses_of_trial = 0;
  for (int i = 0; i < most && !session.is_over(); ++i)
    session.press(next_press(session.screen(), presses_of_trial), time += 0.5);
}

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

// The practice is block 0, which its line says as that of any other block does.
TEST(trial_log, says_of_every_block_which_it_is) {
  for (const int block : {0, 1}) {
    Event event;
    event.kind = EventKind::block_started;
    event.block = block;
    EXPECT_NE(line_of(event, 1).find("\"block\":" + std::to_string(block)), std::string::npos) << line_of(event, 1);
  }
}

std::string words_of_reading(const fs::path& folder) {
  try {
    read_session(folder);
    return "";
  } catch (const Error& error) {
    return error.what();
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

TEST(session_folder, refuses_what_would_mix_two_sessions) {
  const tests::TemporaryDirectory directory;
  const fs::path folder = directory.file("s");
  const std::string protocol = directory.write("p.toml", kSmallClassification);
  for (const char* id : {"", "Anna Maria", "-x", "ä", "a/b"})
    EXPECT_THROW(RecordedSession::start(folder, protocol, id, 1), Error) << id;
  EXPECT_FALSE(fs::exists(folder));
  double time = 0;
  {
    RecordedSession recorded = RecordedSession::start(folder, protocol, "A-1", 1);
    EXPECT_THROW(RecordedSession::start(folder, protocol, "A-1", 1), Error);
    EXPECT_THROW(RecordedSession::resume(folder), Error) << "it is open";
    go_on(recorded.session(), time);
  }
  EXPECT_THROW(RecordedSession::resume(folder), Error) << "it is over";
  EXPECT_NO_THROW(read_session(folder));
  const std::vector<fs::path> twice{folder, folder};
  EXPECT_THROW(results_of(twice), Error);
}

// A full disk, by the limit of a file's size. An empty folder that was there stays, as it may be the user's.
TEST(session_folder, leaves_nothing_half_written) {
  for (const bool is_there : {false, true}) {
    const tests::TemporaryDirectory directory;
    const fs::path folder = directory.file("s");
    if (is_there) fs::create_directory(folder);
    const std::string protocol = directory.write("p.toml", kSmallClassification);
    rlimit before{};
    ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    rlimit small = before;
    small.rlim_cur = 1000;  // enough for the protocol, too little for the texts
    setrlimit(RLIMIT_FSIZE, &small);
    bool is_refused = false;
    try {
      RecordedSession::start(folder, protocol, "A", 1);
    } catch (const files::OutputError&) {
      is_refused = true;
    }
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
    EXPECT_TRUE(is_refused);
    EXPECT_EQ(fs::exists(folder), is_there);
    if (fs::exists(folder)) {
      EXPECT_TRUE(fs::is_empty(folder));
    }
  }
}

TEST(session_folder, refuses_a_session_json_with_file_and_key) {
  const tests::TemporaryDirectory directory;
  const fs::path folder = directory.file("s");
  RecordedSession::start(folder, directory.write("p.toml", kSmallClassification), "A", 1);
  const std::string right = directory.read("s/session.json");
  const auto with = [&](const std::string& key, const std::string& value) {
    std::string text = right;
    const std::size_t begin = text.find('"' + key + "\": ") + key.size() + 4;
    return text.replace(begin, text.find_first_of(",\n", begin) - begin, value);
  };
  const std::string deep = std::string(17, '[') + std::string(17, ']'), less_deep = deep.substr(2, 30);
  for (const auto& [text, expected] : std::vector<std::pair<std::string, std::string>>{
           {with("schema", "2"), "schema: expected 1, got 2"},
           {with("schema", "1.5"), "schema: expected 1, got 1.5"},
           {with("schema", "18446744073709551615"), "schema: expected 1, got 18446744073709551615"},
           {with("schema", less_deep), "schema: expected 1, got " + less_deep},
           {with("schema", deep), "expected at most 16 levels of objects and lists, got more"},
           {with("participant", "7"), "participant: expected a text in quotes, got 7"},
           {with("participant", "\"A\\u0007\""), "participant: expected letters, digits and dashes"},
           {with("seed", "\"1x\""), "seed: expected a whole number below 2^64 in quotes, got 1x"},
           {"{}", "the key schema is missing"},
           {"[]", "expected an object with the key schema"}}) {
    directory.write("s/session.json", text);
    EXPECT_EQ(words_of_reading(folder), (folder / "session.json").string() + ": " + expected);
  }
  directory.write("s/session.json", right);
  EXPECT_EQ(words_of_reading(folder), "");
}

std::vector<ListedStimulus> some_stimuli() {
  const ListedBump left{"bump-cylinder", 1000, {-19.05F, 0, 0}, R"({"law":"bump-cylinder"})", "c.json", "none"},
      right{"a \"name\"", 0, {19.05F, -0.1F, 3e-41F}, R"({"mesh":"a.off"})", "d.json", "00ff"};
  return {{1, 0, std::nullopt, std::nullopt}, {2, 0.1F, left, right}, {3, 0, right, std::nullopt}};
}

TEST(stimulus_list, reads_back_what_was_written_wherever_a_crash_cut_it_short) {
  const tests::TemporaryDirectory directory;
  const std::vector<ListedStimulus> all = some_stimuli();
  std::string text;
  std::vector<std::size_t> ends;
  for (const ListedStimulus& stimulus : all) ends.push_back((text += line_of(stimulus)).size());
  for (std::size_t size = 0; size <= text.size(); ++size) {
    const auto whole = std::ranges::count_if(ends, [&](std::size_t end) { return end <= size; });
    EXPECT_EQ(read_stimuli(directory.write("s.jsonl", text.substr(0, size))),
              std::vector<ListedStimulus>(all.begin(), all.begin() + whole))
        << size;
  }
  EXPECT_THROW(read_stimuli(directory.file("no_such.jsonl")), Error);
}

TEST(stimulus_list, refuses_another_line_with_file_and_line) {
  const tests::TemporaryDirectory directory;
  const std::string first = line_of(some_stimuli()[0]), second = line_of(some_stimuli()[1]);
  const auto changed = [&](const std::string& what, const std::string& by) {
    std::string text = second;
    EXPECT_NE(text.find(what), std::string::npos) << what;
    return first + text.replace(text.find(what), what.size(), by);
  };
  for (const auto& [text, expected] : std::vector<std::pair<std::string, std::string>>{
           {first + first, "number: expected 2"},
           {changed("\"number\":2", "\"number\":-1"), "number: expected a whole number, 1 to 2147483647, got -1"},
           {changed("\"radius_mil\":1000", "\"radius_mil\":1e300"),
            "radius_mil: expected a whole number, 0 to 2147483647, got 1e+300"},
           {changed("\"radius_mil\":1000", "\"radius_mil\":-1"),
            "radius_mil: expected a whole number, 0 to 2147483647, got -1"},
           {changed("\"seam_mm\":0.1", "\"seam_mm\":1e39,\"x\":0.1"), "seam_mm: expected a number of millimetres"},
           {changed("[-19.0", "[1,-19.0"), "origin_mm: expected a list of three numbers"},
           {changed("[-19.0", "[null,-19.0"), "origin_mm: expected a list of three numbers"},
           {changed("\"c.json\"", "null"), "certificate: expected a text in quotes, got null"},
           {changed("\"left\"", "\"links\""), "the key left is missing"}}) {
    const std::string file = directory.write("s.jsonl", text);
    std::string words;
    try {
      read_stimuli(file);
    } catch (const Error& error) {
      words = error.what();
    }
    EXPECT_EQ(words, file + ":2: " + expected);
  }
}

// What stands on each screen beside its text.
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
