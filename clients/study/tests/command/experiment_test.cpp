// SPDX-License-Identifier: BSD-3-Clause
// forceshade-study experiment as a lab calls it: sessions on the simulated device, with keys through a pipe, killed and
// resumed.

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <span>
#include <thread>

#include "forceshade/recording.h"
#include "study/experiments/session_folder.h"
#include "study/tests/experiments/protocol_folder.h"
#include "tests/support/command_run.h"
#include "tests/support/temporary_directory.h"

namespace forceshade::tests {
namespace {

namespace fs = std::filesystem;
using experiments::EventKind;

struct Lab : ProtocolFolder {
  CommandRun run(const std::string& line) const { return run_command(*this, words_of(line)); }
};

// The command with its standard input at the test's hand, which ends with the test.
class Running {
 public:
  Running(const Lab& lab, const std::string& line) : lab_(lab) {
    int ends[2];
    if (::pipe(ends) != 0) throw std::runtime_error("no pipe to be had");
    keys_ = ends[1];
    const std::string out = lab.file("out"), err = lab.file("err");
    std::vector<std::string> words = words_of(line);
    process_ = ::fork();
    if (process_ != 0) {
      ::close(ends[0]);
      return;
    }
    ::close(keys_);
    std::string program = FORCESHADE_COMMAND;
    std::vector<char*> argv{program.data()};
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    const auto redirect = [](const std::string& path, int stream) {
      return ::dup2(::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), stream) >= 0;
    };
    if (::dup2(ends[0], STDIN_FILENO) < 0 || !redirect(out, STDOUT_FILENO) || !redirect(err, STDERR_FILENO) ||
        ::chdir(lab.path().c_str()) != 0)
      ::_exit(126);
    ::execv(program.c_str(), argv.data());
    ::_exit(127);
  }
  ~Running() {
    if (keys_ >= 0) ::close(keys_);
    if (process_ > 0) ::kill(process_, SIGKILL), ::waitpid(process_, nullptr, 0);
  }
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;

  void type(const std::string& keys) const {
    if (::write(keys_, keys.data(), keys.size()) < 0) throw std::runtime_error("nobody reads the keys");
  }
  void close_keys() {
    ::close(keys_);
    keys_ = -1;
  }
  void send(int signal) const { ::kill(process_, signal); }

  // The exit code, or 128 and the signal's number.
  int end() {
    int status = 0;
    ::waitpid(process_, &status, 0);
    process_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }
  std::string err() const { return lab_.read("err"); }

  // Waits for it; false where the command ends before.
  bool comes_to(const std::function<bool()>& condition) const {
    for (;; std::this_thread::sleep_for(std::chrono::milliseconds(1))) {
      siginfo_t ended{};  // looked for first, so that its last moment is seen
      ::waitid(P_PID, static_cast<id_t>(process_), &ended, WEXITED | WNOHANG | WNOWAIT);
      try {
        if (condition()) return true;
      } catch (const std::exception&) {  // there is no file yet
      }
      if (ended.si_pid != 0) return false;
    }
  }

 private:
  const Lab& lab_;
  int keys_ = -1;
  pid_t process_ = -1;
};

std::vector<experiments::Event> events_of(const std::string& session) {
  return experiments::read_session(session).events;
}

std::ptrdiff_t count(const std::string& session, EventKind kind) {
  return std::ranges::count(events_of(session), kind, &experiments::Event::kind);
}

bool has(const Running& run, const std::string& session, EventKind kind, std::ptrdiff_t times) {
  return run.comes_to([&] { return count(session, kind) >= times; });
}

std::vector<fs::path> parts_of(const std::string& session, int run) {
  std::vector<fs::path> parts;
  for (const auto& entry : fs::directory_iterator(fs::path(session) / "ticks" / ("run-" + std::to_string(run))))
    if (entry.path().extension() == ".fsr") parts.push_back(entry.path());
  std::ranges::sort(parts);
  return parts;
}

// The ticks that have reached the file, whether or not the run goes on.
std::uint64_t ticks_of(const fs::path& part) {
  recorder::Recording recording(part.string());
  return recording.extent().samples;
}

// A part that began as the run ended has none.
device::Sample last_of(const std::vector<fs::path>& parts) {
  device::Sample last;
  for (const fs::path& part : parts) {
    recorder::Recording recording(part.string());
    recording.for_each_chunk([&](std::span<const device::Sample> samples) { last = samples.back(); });
  }
  return last;
}

constexpr const char* kDriving = " --device simulated --terminal --certificates none";

std::string run_of(const std::string& protocol) {
  return "experiment run " + protocol + " --participant P1 --seed 3 --session S" + kDriving;
}

// From the instructions into the first trial; and a trial with two changes of the radius.
constexpr const char *kBegin = "\n\n", *kTrial = "kjl7\n";

// The gentle start is over, and the simulated hand has met a bump.
bool has_ticks(const Running& run, const std::string& session, std::uint64_t ticks) {
  return run.comes_to([&] { return ticks_of(parts_of(session, 1).back()) > ticks; });
}

TEST(experiment, of_three_matches_goes_from_the_instructions_to_the_results) {
  const Lab lab;
  const std::string session = lab.file("S");
  Running run(lab, run_of("matching.toml"));
  run.type(kBegin);
  ASSERT_TRUE(has(run, session, EventKind::trial_started, 1)) << run.err();
  ASSERT_TRUE(has_ticks(run, session, 2500));
  run.type(kTrial);
  ASSERT_TRUE(has(run, session, EventKind::trial_started, 2)) << run.err();
  ASSERT_TRUE(has_ticks(run, session, 1000));
  run.type(kTrial);
  run.type(kTrial);
  // The questionnaire.
  for (int question = 0; question < 5; ++question) run.type("because\n");
  EXPECT_EQ(run.end(), 0) << run.err();

  EXPECT_EQ(count(session, EventKind::answered), 3);
  EXPECT_EQ(count(session, EventKind::question_answered), 5);
  EXPECT_EQ(count(session, EventKind::session_ended), 1);
  const auto exported = lab.run("experiment export S --csv results");
  EXPECT_EQ(exported.code, 0) << exported.err;
  const std::string rows = lab.read("results/matching.csv");
  EXPECT_EQ(std::ranges::count(rows, '\n'), 4) << rows;

  // Between, three trials, between.
  ASSERT_EQ(parts_of(session, 1).size(), 5U);
  EXPECT_EQ(parts_of(session, 1)[1].filename(), "00002-block-1-trial-1-1.fsr");
  EXPECT_EQ(last_of(parts_of(session, 1)).status, device::Sample::kEnd);
  const auto whole = lab.run("experiment verify S");
  EXPECT_EQ(whole.code, 0) << whole.err;
  EXPECT_TRUE(whole.out.starts_with("whole: 5 parts, ")) << whole.out;
  const auto again = lab.run("experiment recompute S");
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_NE(again.out.find(" in contact, 0 differ\ncommands: "), std::string::npos) << again.out;
  EXPECT_EQ(again.out.find(" 0 in contact"), std::string::npos) << again.out;
  EXPECT_TRUE(again.out.ends_with(", 0 differ\n")) << again.out;
  const auto twice = lab.run(std::string("experiment resume S") + kDriving);
  EXPECT_EQ(twice.code, 2) << "a session that is over";
}

TEST(experiment, warns_of_a_stiffness_that_its_rate_cannot_render) {
  const Lab lab;
  std::string stiff = lab.read("classification.toml");
  stiff.replace(stiff.find("mm = 0.5"), 8, "mm = 4");
  lab.write("stiff.toml", stiff);
  Running run(lab, run_of("stiff.toml"));
  run.close_keys();
  run.end();
  EXPECT_NE(run.err().find("a stiffness of 4 N/mm at 1000 Hz cannot be passive"), std::string::npos) << run.err();
}

TEST(experiment, with_another_bump_in_its_list_is_refused_by_recompute) {
  const Lab lab;
  Running run(lab, run_of("classification.toml"));
  run.type(std::string(kBegin) + "1\n2\n" + "a\na\na\na\na\na\na\na\n");
  run.close_keys();
  EXPECT_EQ(run.end(), 0) << run.err();
  const auto good = lab.run("experiment recompute S");
  EXPECT_EQ(good.code, 0) << good.err;
  std::string list = lab.read("S/ticks/run-1/stimuli.jsonl");
  const std::string radius = "\"stiffness_N_per_mm\":0.5";
  ASSERT_NE(list.find(radius), std::string::npos) << list;
  list.replace(list.find(radius), radius.size(), "\"stiffness_N_per_mm\":0.6");
  lab.write("S/ticks/run-1/stimuli.jsonl", list);
  const auto bad = lab.run("experiment recompute S");
  EXPECT_EQ(bad.code, 2);
  EXPECT_NE(bad.err.find("stimuli.jsonl:"), std::string::npos) << bad.err;
}

// The ticks lost are those that the recorder had not yet taken, less than 100 ms (recorder.loses_less_than_100_ms_when_killed).
TEST(experiment, killed_in_the_middle_of_a_trial_goes_on_at_that_trial) {
  const Lab lab;
  const std::string session = lab.file("S");
  std::uint64_t seen = 0;
  {
    Running run(lab, run_of("matching.toml"));
    run.type(std::string(kBegin) + kTrial + "k");
    ASSERT_TRUE(has(run, session, EventKind::trial_started, 2)) << run.err();
    ASSERT_TRUE(has(run, session, EventKind::radius_changed, 2)) << run.err();
    ASSERT_TRUE(has_ticks(run, session, 500));
    seen = ticks_of(parts_of(session, 1).back());
    run.send(SIGKILL);
    EXPECT_EQ(run.end(), 128 + SIGKILL);
  }
  const std::vector<fs::path> parts = parts_of(session, 1);
  ASSERT_EQ(parts.size(), 3U);
  for (const fs::path& part : parts) {
    recorder::Recording recording(part.string());
    EXPECT_EQ(recording.ended(), part != parts.back()) << part;
    const auto problems = problems_of(recording);
    EXPECT_EQ(problems.size(), part == parts.back() ? 1U : 0U) << part;
  }
  EXPECT_GE(ticks_of(parts.back()), seen);
  const auto before = events_of(session);
  EXPECT_EQ(before.back().kind, EventKind::radius_changed) << "of the trial that was killed";

  Running resumed(lab, std::string("experiment resume S") + kDriving);
  resumed.type("\n");
  ASSERT_TRUE(has(resumed, session, EventKind::trial_started, 3)) << resumed.err();
  const auto after = events_of(session);
  ASSERT_TRUE(std::equal(before.begin(), before.end(), after.begin())) << "nothing of the log was lost";
  EXPECT_EQ(after.back().index, 2);
  EXPECT_EQ(after.back().attempt, 2);
  resumed.type(std::string(kTrial) + kTrial + "a\na\na\na\na\n");
  EXPECT_EQ(resumed.end(), 0) << resumed.err();
  EXPECT_EQ(count(session, EventKind::answered), 3);
  const auto again = lab.run("experiment recompute S");
  EXPECT_EQ(again.code, 0) << again.err << again.out;
}

TEST(experiment, ends_with_zero_force_and_goes_on_later_when_a_signal_comes_or_its_keys_end) {
  const Lab lab;
  const std::string session = lab.file("S");
  {
    Running run(lab, run_of("matching.toml"));
    run.type(kBegin);
    ASSERT_TRUE(has(run, session, EventKind::trial_started, 1)) << run.err();
    run.send(SIGINT);
    EXPECT_EQ(run.end(), 0) << run.err();
    EXPECT_NE(run.err().find("'forceshade-study experiment resume S' goes on with it"), std::string::npos) << run.err();
  }
  EXPECT_EQ(count(session, EventKind::run_ended), 1);
  const device::Sample last = last_of(parts_of(session, 1));
  EXPECT_EQ(last.status, device::Sample::kEnd);
  EXPECT_EQ(last.force, (std::array<float, 3>{0, 0, 0}));
  Running resumed(lab, std::string("experiment resume S") + kDriving);
  resumed.close_keys();
  EXPECT_EQ(resumed.end(), 0) << resumed.err();
  EXPECT_EQ(count(session, EventKind::run_ended), 2);
  const auto whole = lab.run("experiment verify S");
  EXPECT_EQ(whole.code, 0) << whole.err;
}

// A full disk, by the limit of a file's size, which the command inherits.
TEST(experiment, ends_where_the_disk_refuses_the_ticks_and_goes_on_later) {
  const Lab lab;
  const std::string session = lab.file("S");
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit small = before;
  small.rlim_cur = 200'000;  // less than a second
  setrlimit(RLIMIT_FSIZE, &small);
  {
    Running run(lab, run_of("matching.toml"));
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
    run.type(kBegin);
    EXPECT_EQ(run.end(), 2) << "without another key";
    EXPECT_NE(run.err().find("the disk refuses the ticks"), std::string::npos) << run.err();
    EXPECT_NE(run.err().find("'forceshade-study experiment resume S' goes on with it"), std::string::npos) << run.err();
  }
  EXPECT_EQ(count(session, EventKind::run_ended), 1);
  Running resumed(lab, std::string("experiment resume S") + kDriving);
  resumed.close_keys();
  EXPECT_EQ(resumed.end(), 0) << resumed.err();
  EXPECT_EQ(count(session, EventKind::run_ended), 2);
}

TEST(experiment, is_refused_before_the_session_where_a_bump_is_not_certified) {
  const Lab lab;
  const std::string base = "experiment run classification.toml --participant P1 --session S --device simulated --terminal";
  const auto neither = lab.run(base);
  EXPECT_EQ(neither.code, 2);
  EXPECT_NE(neither.err.find("expected --certificates, got none"), std::string::npos) << neither.err;
  const auto lacking = lab.run(base + " --certificates nowhere");
  EXPECT_EQ(lacking.code, 2);
  EXPECT_NE(lacking.err.find("no certificate of this build covers bump-1p, 600 mil"), std::string::npos) << lacking.err;
  EXPECT_FALSE(fs::exists(lab.file("S")));

  const auto prepared = lab.run("experiment prepare classification.toml --out certificates");
  EXPECT_EQ(prepared.code, 0) << prepared.err;
  EXPECT_NE(prepared.out.find("1 bumps, 0 of them certified before"), std::string::npos) << prepared.out;
  const auto kept = lab.run("experiment prepare classification.toml --out certificates");
  EXPECT_EQ(kept.out, "1 bumps, 1 of them certified before\n");
  EXPECT_EQ(lab.run("experiment check classification.toml --certificates certificates").code, 0);
  Running run(lab, base + " --certificates certificates");
  run.close_keys();
  EXPECT_EQ(run.end(), 0) << run.err();
  EXPECT_EQ(run.err().find("UNCERTIFIED"), std::string::npos) << run.err();
}

TEST(experiment, of_virtual_participants_is_recorded_and_can_be_computed_again) {
  const Lab lab;
  for (const char* protocol : {"matching", "classification"}) {
    const std::string line =
        "experiment virtual " + std::string(protocol) + ".toml --participants 2 --certificates none --seed 5 --out ";
    const auto made = lab.run(line + protocol);
    ASSERT_EQ(made.code, 0) << made.err;
    for (const char* id : {"V1", "V2"}) {
      const std::string session = std::string(protocol) + "/" + id;
      EXPECT_EQ(count(lab.file(session), EventKind::session_ended), 1);
      const auto again = lab.run("experiment recompute " + session);
      EXPECT_EQ(again.code, 0) << again.err;
      EXPECT_EQ(again.out.find(" 0 in contact"), std::string::npos) << again.out;
    }
    // The same seed, the same sessions.
    ASSERT_EQ(lab.run(line + "again").code, 0);
    EXPECT_EQ(lab.read("again/V2/trials.jsonl"), lab.read(std::string(protocol) + "/V2/trials.jsonl"));
    fs::remove_all(lab.file("again"));
  }
}

}  // namespace
}  // namespace forceshade::tests
