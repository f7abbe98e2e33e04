// SPDX-License-Identifier: BSD-3-Clause
// What only a whole process can be given: wrong files and options, signals. Each drives with forceshade drive.

#include <cmath>
#include <csignal>
#include <stdexcept>
#include <thread>

#include "files/csv.h"
#include "forceshade/recording.h"
#include "tests/device/faults/command.h"
#include "tests/device/faults/press.h"
#include "tests/support/wait_until.h"

namespace forceshade::faults {
namespace {

using tests::TemporaryDirectory;

constexpr const char* kRecording = "run.fsr";

// A hand that presses from 0.2 s on, for a minute.
constexpr const char* kHand = "t_s,x_mm,y_mm,z_mm\n0,0,0,3\n0.08,0,0,3\n0.2,0,0,-6\n60,0,0,-6\n";
constexpr double kBusy = 0.2;  // s: within which a busy machine wakes the loop
constexpr std::chrono::seconds kLongest{20};

Words operator+(Words a, const Words& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

Words drive(const std::string& device, const std::string& law = "wall") {
  return {"drive", "--law", law, "--device", device, "--record", kRecording};
}

std::vector<device::Sample> recorded(const TemporaryDirectory& directory) {
  std::vector<device::Sample> samples;
  recorder::Recording(directory.file(kRecording)).for_each_chunk([&](std::span<const device::Sample> chunk) {
    samples.insert(samples.end(), chunk.begin(), chunk.end());
  });
  if (samples.size() < 2) throw std::runtime_error("nothing was recorded");
  return samples;
}

double force_of(const device::Sample& sample) {
  return Eigen::Vector3f(sample.force.data()).cast<double>().norm();
}

// From sample `fault` on. The recording has to be whole.
void judge_recording(Outcome& outcome, const TemporaryDirectory& directory, std::size_t fault,
                     const std::vector<device::Sample>& samples) {
  outcome.took_effect = fault > 0;
  if (fault > 0) outcome.before = force_of(samples[fault - 1]);
  for (const device::Sample& sample : samples) outcome.highest = std::max(outcome.highest, force_of(sample));
  std::size_t zero = samples.size();
  while (zero > fault && force_of(samples[zero - 1]) == 0) --zero;
  outcome.to_zero = static_cast<double>(zero - fault);
  recorder::Recording recording(directory.file(kRecording));
  for (const std::string& problem : problems_of(recording)) {
    outcome.reaction += "; " + problem;
    outcome.lost = HUGE_VAL;
  }
}

using Prepare = std::function<void(const TemporaryDirectory&)>;

// Nothing is driven, and no recording begun.
Fault refused(Kind kind, std::string what, std::string reaction, Words arguments, Prepare prepare = {},
              Words environment = {}) {
  return {.kind = kind,
          .what = std::move(what),
          .reaction = std::move(reaction),
          .to_zero = 0,
          .under_force = false,
          .run = [=](const Bench&) {
            const TemporaryDirectory directory;
            if (prepare) prepare(directory);
            Outcome outcome{.reaction = Command(directory, arguments, environment).end(), .took_effect = true, .to_zero = 0};
            if (std::filesystem::exists(directory.file(kRecording))) outcome.reaction += "; a recording is left";
            return outcome;
          }};
}

Fault bad_input(std::string what, std::string reaction, Words arguments, Prepare prepare = {}) {
  return refused(Kind::input, std::move(what), "exit 2 ... " + std::move(reaction), std::move(arguments), std::move(prepare));
}

struct Replacement {
  std::string text, by;  // the first place of a text; by nothing: all from there on goes
  std::size_t more = 0;  // characters after it that go too
};

constexpr const char* kLacks = "\"lacks\": \"the certificate has 2000 points for wall; driving needs at least 1000000\"";

// A certificate of the wall, with something in it replaced.
Fault uncertified(std::string what, std::string reaction, std::vector<Replacement> replacements, std::string law = "wall") {
  return refused(Kind::input, std::move(what), std::move(reaction),
                 drive("null", law) + Words{"--certificate", "certificate.json"}, [=](const TemporaryDirectory& directory) {
                   Command(directory, {"certify", "--law", "wall", "--points", "2000", "--cases", "20", "--out", "."}).end();
                   std::string text = directory.read("certificate.json");
                   for (const auto& [replaced, by, more] : replacements) {
                     const std::size_t at = text.find(replaced);
                     if (at == std::string::npos) throw std::runtime_error("the certificate has no " + replaced);
                     text.replace(at, by.empty() ? text.size() : replaced.size() + more, by);
                   }
                   directory.write("certificate.json", text);
                 });
}

// A recorded hand with a fault in its file.
Fault bad_hand(std::string what, std::string reaction, std::string rows) {
  return bad_input(std::move(what), std::move(reaction), drive("replay:hand.csv") + Words{"--uncertified", "--free-run"},
                   [=](const TemporaryDirectory& directory) { directory.write("hand.csv", rows); });
}

bool is_pushing(const TemporaryDirectory& directory) {
  const auto samples = recorded(directory);
  return !samples.empty() && force_of(samples.back()) > 0.25;
}

Words pressing() {
  return drive("simulated:premium-1.5:hand.csv") + Words{"--uncertified", "--watchdog-timeout", files::shortest(kBusy)};
}

Outcome stopped_and_continued() {
  const TemporaryDirectory directory;
  directory.write("hand.csv", kHand);
  Command command(directory, pressing());
  tests::comes_true_within(kLongest, [&] { return is_pushing(directory); });
  command.send(SIGSTOP);
  std::this_thread::sleep_for(std::chrono::milliseconds(400));
  command.send(SIGCONT);
  Outcome outcome{.reaction = command.end()};
  const auto samples = recorded(directory);
  std::size_t woken = 0;
  for (std::size_t k = 1; k + 1 < samples.size(); ++k)
    if (static_cast<double>(samples[k].wall_ns - samples[k - 1].wall_ns) > kBusy * 1e9) woken = k;
  judge_recording(outcome, directory, woken, samples);
  return outcome;
}

// The loop is asked to stop while it reads: that tick has its force, and the next is the end.
Outcome stopped(const Bench& bench) {
  std::atomic<bool> stop = false;
  const Wrong wrong{.read = [&](device::ReadResult&, Wrong::Since) { stop = true; }};
  return press(wrong, bench, {.stop = &stop});
}

Outcome interrupted(int signal) {
  const TemporaryDirectory directory;
  directory.write("hand.csv", kHand);
  Command command(directory, pressing());
  tests::comes_true_within(kLongest, [&] { return is_pushing(directory); });
  command.send(signal);
  Outcome outcome{.reaction = command.end()};
  const auto samples = recorded(directory);
  judge_recording(outcome, directory, samples.size() - 1, samples);
  // From the last force to zero: the time of the signal is not in the recording.
  const std::int64_t last = samples[samples.size() - 2].wall_ns;
  if (outcome.to_zero == 0) outcome.to_zero = static_cast<double>(samples.back().wall_ns - last) / 1e6;
  return outcome;
}

Fault interruption(std::string what, int signal) {
  return {.kind = Kind::input,
          .what = std::move(what),
          .reaction = "exit 0 ... (stopped)",
          .to_zero = 1000 * kBusy + 1,
          .unit = "ms",
          .is_timed = true,
          .run = [=](const Bench&) { return interrupted(signal); }};
}

// One row of a hand in contact is NaN.
Outcome nan_row(const std::string& device) {
  const TemporaryDirectory directory;
  std::string rows = "t_s,x_mm,y_mm,z_mm\n";
  for (int k = 0; k < 1000; ++k)
    rows += std::to_string(0.001 * k) + ",0,0," +
            (k == 700  ? "nan"
             : k < 100 ? "3"
             : k < 220 ? std::to_string(3 - 0.05 * (k - 100))
                       : "-3") +
            "\n";
  directory.write("hand.csv", rows);
  Outcome outcome{.reaction = Command(directory, drive(device) + Words{"--uncertified", "--free-run"}).end()};
  const auto samples = recorded(directory);
  judge_recording(outcome, directory, std::min<std::size_t>(700, samples.size() - 1), samples);
  if (samples.size() == 1001) outcome.to_zero.reset();
  return outcome;
}

}  // namespace

std::vector<Fault> command_faults() {
  const Words null = drive("null") + Words{"--uncertified"};
  return {
      {.kind = Kind::timing,
       .what = "the process is stopped for 0.4 s (SIGSTOP, SIGCONT)",
       .reaction = "exit 3 ... the supervisor stopped the run: watchdog",
       .to_zero = 1,  // it may be stopped in the middle of a tick, which then ends as it began
       .is_timed = true,
       .run = [](const Bench&) { return stopped_and_continued(); }},
      {.kind = Kind::input, .what = "told to stop in contact", .reaction = "ends: stopped", .to_zero = 1, .run = stopped},
      interruption("Ctrl-C in contact (SIGINT)", SIGINT),
      interruption("SIGTERM in contact", SIGTERM),
      refused(Kind::input, "no certificate", "exit 1 ... no certificate was given", drive("null")),
      bad_input("the certificate is missing", "certificate.json: cannot be read",
                drive("null") + Words{"--certificate", "certificate.json"}),
      uncertified("the certificate is of another build", "exit 1 ... the certificate is for another build",
                  {{"\"library_digest\": \"", "\"library_digest\": \"dead", 4}}),
      uncertified("the certificate is cut short", "exit 2 ... expected a forceshade certificate", {{"\"library_digest\"", ""}}),
      uncertified("the certificate is of another law", "exit 1 ... the certificate does not cover the law bump-1p", {},
                  "bump-1p"),
      uncertified("the certificate is of a check that failed", "exit 1 ... the certificate says that wall failed",
                  {{"\"held\": true", "\"held\": false"},
                   {"\"held\": true", "\"held\": false"},
                   {"\"standing\": \"insufficient\"", "\"standing\": \"failed\""},
                   {"\"standing\": \"insufficient\"", "\"standing\": \"failed\""},
                   {kLacks, "\"lacks\": \"\""},
                   {kLacks, "\"lacks\": \"\""},
                   {"\"mismatches\": 0", "\"mismatches\": 1"},
                   {"\"counterexamples\": []", "\"counterexamples\": [\"at 0\"]"}}),
      uncertified("the certificate contradicts itself",
                  "exit 2 ... subjects[0].counterexamples is an array; expected the first of 1",
                  {{"\"mismatches\": 0", "\"mismatches\": 1"}}),
      uncertified("the certificate is of 2000 points",
                  "exit 1 ... the certificate has 2000 points for wall; driving needs at least 1000000", {}),
      bad_hand("the recorded hand is empty", "hand.csv:1: expected a header row", ""),
      bad_hand("the recorded hand has no rows", "hand.csv: expected at least one recorded position", "t_s,x_mm,y_mm,z_mm\n"),
      bad_hand("the recorded hand's time goes backwards", "hand.csv:3: column 1 (t_s): expected a time after 1",
               "t_s,x_mm,y_mm,z_mm\n1,0,0,0\n0,0,0,0\n"),
      bad_hand("the recorded hand has words in it", "hand.csv:2: column 4 (z_mm): expected a number, got \"deep\"",
               "t_s,x_mm,y_mm,z_mm\n0,0,0,deep\n"),
      {.kind = Kind::input,
       .what = "a position of the replayed hand is NaN",
       .reaction = "exit 0 ... invalid positions 1",
       .to_zero = std::nullopt,
       .run = [](const Bench&) { return nan_row("replay:hand.csv"); }},
      {.kind = Kind::input,
       .what = "a position that the simulated hand means is NaN",
       .reaction = "exit 3 ... the simulated arm's position is no longer finite",
       .to_zero = 0,
       .run = [](const Bench&) { return nan_row("simulated:premium-1.5:hand.csv"); }},
      refused(Kind::input, "the simulated hand starts out of the arm's reach",
              "exit 3 ... the simulated hand starts where the arm does not reach",
              drive("simulated:premium-1.5:hand.csv") + Words{"--uncertified", "--free-run"},
              [](const TemporaryDirectory& d) { d.write("hand.csv", "t_s,x_mm,y_mm,z_mm\n0,900,0,0\n1,900,0,0\n"); }),
      bad_input("stiffness out of range", "--stiffness is 0 N/mm; expected", null + Words{"--stiffness", "0"}),
      bad_input("stiffness is NaN", "--stiffness: expected a stiffness such as", null + Words{"--stiffness", "nan"}),
      bad_input("a bump wider than its cylinder", "--width is 31 mm; expected",
                drive("null", "bump-1p") + Words{"--uncertified", "--width", "31"}),
      bad_input("an unknown device", "unknown device \"teapot\"", drive("teapot") + Words{"--uncertified"}),
      refused(Kind::input, "an unknown law", "exit 2 ... --law: expected one of",
              drive("null", "teapot") + Words{"--uncertified"}),
      refused(Kind::input, "a rate out of range", "exit 2 ... --rate: expected a number from 100 to 10000",
              null + Words{"--rate", "50"}),
      refused(Kind::input, "a duration that is NaN", "exit 2 ... --seconds: expected a number from 0.0001",
              null + Words{"--seconds", "nan"}),
      bad_input("a dead-man button that the device lacks", "dead-man button: expected none", null + Words{"--dead-man", "0"}),
      refused(Kind::device, "PHANToM: the driver's library is missing",
              "exit 3 ... /nowhere/libHD.so: cannot open shared object file", drive("phantom") + Words{"--uncertified"}, {},
              {"FORCESHADE_HD_LIBRARY=/nowhere/libHD.so"}),
      refused(Kind::device, "PHANToM: the library is not the driver's", "exit 3 ... libm.so.6: is not the HDAPI",
              drive("phantom") + Words{"--uncertified"}, {}, {"FORCESHADE_HD_LIBRARY=libm.so.6"}),
  };
}

}  // namespace forceshade::faults
