// SPDX-License-Identifier: BSD-3-Clause
// The folder of a session: whole from its first moment on, one's own, and with words about who answers.

#include "study/experiments/session_folder.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "files/input_file.h"
#include "files/output_file.h"
#include "files/printable.h"
#include "study/experiments/session_results.h"
#include "study/tests/experiments/small_protocols.h"
#include "tests/support/temporary_directory.h"

namespace forceshade::experiments {
namespace {

namespace fs = std::filesystem;

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

// The folder states from its first moment on who answers and what gives the forces, and a session stays one's own.
TEST(session_folder, says_who_answers_and_on_which_device) {
  const tests::TemporaryDirectory directory;
  const std::string protocol = directory.write("p.toml", kSmallClassification);
  const fs::path folder = directory.file("s");
  double time = 0;
  const Origin model{AnsweredBy::model, "simulated:premium-1.5:mouse", false}, person{AnsweredBy::person, "arm\n\xff", true};
  {
    RecordedSession recorded = RecordedSession::start(folder, protocol, "V1", 1, {}, Sync::never, model);
    go_on(recorded.session(), time, 4);
  }
  EXPECT_NE(directory.read("s/session.json").find("\"answered_by\": \"virtual participant\""), std::string::npos);
  EXPECT_NE(directory.read("s/trials.jsonl").find("\"device\":\"simulated:premium-1.5:mouse\",\"certified\":false"),
            std::string::npos);
  try {
    RecordedSession::resume(folder, {}, Sync::never, person);
    ADD_FAILURE() << "a person went on with a model's session";
  } catch (const Error& error) {
    EXPECT_EQ(error.what(),
              folder.string() + ": the session was begun by a virtual participant, so a person cannot go on with it");
  }
  Origin certified = model;
  certified.certified = true;
  {
    RecordedSession resumed = RecordedSession::resume(folder, {}, Sync::never, certified);
    go_on(resumed.session(), time);
  }
  const SavedSession saved = read_session(folder);
  EXPECT_EQ(saved.answered_by, AnsweredBy::model);
  EXPECT_EQ(origin_of(saved, 1), model);
  EXPECT_EQ(origin_of(saved, 2), certified);
  for (const ClassificationResult& trial : results_of(saved).classification)
    EXPECT_EQ(trial.origin, trial.trial == 1 ? model : certified) << trial.trial;
  // A person's, on a device whose name no file can hold as it is; and a session of an earlier version.
  RecordedSession::start(directory.file("p"), protocol, "P1", 1, {}, Sync::never, person);
  EXPECT_EQ(origin_of(read_session(directory.file("p")), 1),
            (Origin{AnsweredBy::person, files::printable(person.device), true}));
  RecordedSession::start(directory.file("old"), protocol, "P1", 1, {}, Sync::never);
  EXPECT_EQ(directory.read("old/session.json").find("answered_by"), std::string::npos);
  EXPECT_EQ(origin_of(read_session(directory.file("old")), 1), Origin());
}

TEST(session_folder, results_refuse_participants_that_differ_in_capital_letters_alone) {
  const tests::TemporaryDirectory directory;
  const std::string protocol = directory.write("p.toml", kSmallClassification);
  const std::vector<fs::path> both{directory.file("one"), directory.file("two")};
  RecordedSession::start(both[0], protocol, "P-a", 1, {}, Sync::never);
  RecordedSession::start(both[1], protocol, "p-A", 1, {}, Sync::never);
  try {
    results_of(both);
    ADD_FAILURE() << "P-a and p-A were taken for two";
  } catch (const Error& error) {
    EXPECT_TRUE(
        std::string(error.what()).starts_with(both[1].string() + ": participants P-a and p-A differ in capital letters"))
        << error.what();
  }
}

// Eight processes at once, of which each holds its session: one has the folder, with its own files alone, and the others are
// told which folder it is.
TEST(session_folder, is_that_of_one_of_several_processes) {
  const tests::TemporaryDirectory directory;
  const std::string protocol = directory.write("p.toml", kSmallClassification);
  constexpr int kProcesses = 8, kHasIt = 10, kIsTold = 11;
  for (int round = 0; round < 10; ++round)
    for (const bool is_there : {false, true}) {
      const fs::path folder = directory.file("s" + std::to_string(2 * round + (is_there ? 1 : 0)));
      if (is_there) fs::create_directory(folder);
      std::array<int, 2> gate{}, all_tried{};
      ASSERT_EQ(pipe(gate.data()) + pipe(all_tried.data()), 0);
      std::vector<pid_t> processes;
      for (int k = 1; k <= kProcesses; ++k) {
        const pid_t process = fork();
        if (process != 0) {
          processes.push_back(process);
          continue;
        }
        char byte = 0;
        close(gate[1]);
        close(all_tried[1]);
        if (read(gate[0], &byte, 1) != 0) _exit(1);  // until the gate is closed
        int code = 0;
        try {
          const RecordedSession session =
              RecordedSession::start(folder, protocol, "P" + std::to_string(k), static_cast<std::uint64_t>(k), {}, Sync::never);
          code = kHasIt + 10 * k;
          [[maybe_unused]] const auto waits = read(all_tried[0], &byte, 1);
          _exit(code);
        } catch (const std::exception& error) {
          _exit(std::string(error.what()).starts_with(folder.string() + ": ") ? kIsTold : 1);
        }
      }
      close(gate[1]);
      int told = 0, owner = 0;
      for (int k = 0; k < kProcesses - 1; ++k) {
        int status = 0;
        waitpid(-1, &status, 0);
        told += WEXITSTATUS(status) == kIsTold ? 1 : 0;
      }
      close(all_tried[1]);
      int status = 0;
      waitpid(-1, &status, 0);
      owner = (WEXITSTATUS(status) - kHasIt) / 10;
      close(gate[0]);
      close(all_tried[0]);
      EXPECT_EQ(told, kProcesses - 1);
      ASSERT_GE(owner, 1);
      const SavedSession saved = read_session(folder);
      EXPECT_EQ(saved.participant, "P" + std::to_string(owner));
      EXPECT_EQ(saved.seed, static_cast<std::uint64_t>(owner));
      EXPECT_EQ(std::ranges::distance(fs::directory_iterator(folder)), 5);
    }
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

}  // namespace
}  // namespace forceshade::experiments
