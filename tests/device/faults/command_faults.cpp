// SPDX-License-Identifier: BSD-3-Clause
// Wrong files and options, which only a whole process can be given. Each drives with forceshade drive.

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <stdexcept>

#include "forceshade/recording.h"
#include "tests/device/faults/press.h"
#include "tests/support/command_run.h"

namespace forceshade::faults {
namespace {

using tests::TemporaryDirectory;

constexpr const char* kRecording = "run.fsr";

using Words = std::vector<std::string>;

Words operator+(Words a, const Words& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

Words drive(const std::string& device, const std::string& law = "wall") {
  return {"drive", "--law", law, "--device", device, "--record", kRecording};
}

// "exit 0: ", and all that it printed.
std::string ran(const TemporaryDirectory& directory, const Words& arguments) {
  const tests::CommandRun run = tests::run_command(directory, arguments);
  return "exit " + std::to_string(run.code) + ": " + run.out + run.err;
}

using Prepare = std::function<void(const TemporaryDirectory&)>;

// Nothing is driven, and no recording begun.
Fault refused(std::string what, std::string reaction, Words arguments, Prepare prepare = {}) {
  return {.kind = Kind::input,
          .what = std::move(what),
          .reaction = std::move(reaction),
          .to_zero = 0,
          .under_force = false,
          .run = [=](const Bench&) {
            const TemporaryDirectory directory;
            if (prepare) prepare(directory);
            Outcome outcome{.reaction = ran(directory, arguments), .took_effect = true, .to_zero = 0};
            if (std::filesystem::exists(directory.file(kRecording))) outcome.reaction += "; a recording is left";
            return outcome;
          }};
}

Fault bad_input(std::string what, std::string reaction, Words arguments, Prepare prepare = {}) {
  return refused(std::move(what), "exit 2 ... " + std::move(reaction), std::move(arguments), std::move(prepare));
}

struct Replacement {
  std::string text, by;  // the first place of a text; by nothing: all from there on goes
  std::size_t more = 0;  // characters after it that go too
};

constexpr const char* kLacks = "\"lacks\": \"the certificate has 2000 points for wall; driving needs at least 1000000\"";

// A certificate of the wall, with something in it replaced.
Fault uncertified(std::string what, std::string reaction, std::vector<Replacement> replacements, std::string law = "wall") {
  return refused(std::move(what), std::move(reaction), drive("null", law) + Words{"--certificate", "certificate.json"},
                 [=](const TemporaryDirectory& directory) {
                   ran(directory, {"certify", "--law", "wall", "--points", "2000", "--cases", "20", "--out", "."});
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

// The loop is asked to stop while it reads: that tick has its force, and the next is the end.
Outcome stopped(const Bench& bench) {
  std::atomic<bool> stop = false;
  const Wrong wrong{.read = [&](device::ReadResult&, Wrong::Since) { stop = true; }};
  return press(wrong, bench, {.stop = &stop});
}

// One row of a hand in contact is NaN.
constexpr std::size_t kNan = 700;
Outcome nan_row(const std::string& device) {
  const TemporaryDirectory directory;
  std::string rows = "t_s,x_mm,y_mm,z_mm\n";
  for (std::size_t k = 0; k < 1000; ++k)
    rows += std::to_string(0.001 * static_cast<double>(k)) + ",0,0," +
            (k == kNan ? "nan"
             : k < 100 ? "3"
             : k < 220 ? std::to_string(3 - 0.05 * static_cast<double>(k - 100))
                       : "-3") +
            "\n";
  directory.write("hand.csv", rows);
  Outcome outcome{.reaction = ran(directory, drive(device) + Words{"--uncertified", "--free-run"})};
  recorder::Recording recording(directory.file(kRecording));
  for (const std::string& problem : problems_of(recording)) outcome.reaction = problem;
  std::vector<double> forces;
  recording.for_each_chunk([&](std::span<const device::Sample> chunk) {
    for (const device::Sample& sample : chunk) forces.push_back(Eigen::Vector3f(sample.force.data()).cast<double>().norm());
  });
  if (forces.size() < 2) return outcome;
  const std::size_t fault = std::min(kNan, forces.size() - 1);
  outcome.took_effect = true;
  outcome.before = forces[fault - 1];
  outcome.highest = *std::ranges::max_element(forces);
  while (!forces.empty() && forces.back() == 0) forces.pop_back();
  if (forces.size() < 1000) outcome.to_zero = forces.size() - std::min(fault, forces.size());
  return outcome;
}

}  // namespace

std::vector<Fault> command_faults() {
  const Words null = drive("null") + Words{"--uncertified"};
  return {
      {.kind = Kind::input, .what = "told to stop in contact", .reaction = "ends: stopped", .to_zero = 1, .run = stopped},
      refused("no certificate", "exit 1 ... no certificate was given", drive("null")),
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
      refused("the simulated hand starts out of the arm's reach",
              "exit 3 ... the simulated hand starts where the arm does not reach",
              drive("simulated:premium-1.5:hand.csv") + Words{"--uncertified", "--free-run"},
              [](const TemporaryDirectory& d) { d.write("hand.csv", "t_s,x_mm,y_mm,z_mm\n0,900,0,0\n1,900,0,0\n"); }),
      bad_input("stiffness out of range", "--stiffness is 0 N/mm; expected", null + Words{"--stiffness", "0"}),
      bad_input("stiffness is NaN", "--stiffness: expected a stiffness such as", null + Words{"--stiffness", "nan"}),
      bad_input("a bump wider than its cylinder", "--width is 31 mm; expected",
                drive("null", "bump-1p") + Words{"--uncertified", "--width", "31"}),
      bad_input("an unknown device", "unknown device \"teapot\"", drive("teapot") + Words{"--uncertified"}),
      refused("an unknown law", "exit 2 ... --law: expected one of", drive("null", "teapot") + Words{"--uncertified"}),
      refused("a rate out of range", "exit 2 ... --rate: expected a number from 100 to 10000", null + Words{"--rate", "50"}),
      refused("a duration that is NaN", "exit 2 ... --seconds: expected a number from 0.0001",
              null + Words{"--seconds", "nan"}),
      bad_input("a dead-man button that the device lacks", "dead-man button: expected none", null + Words{"--dead-man", "0"}),
  };
}

}  // namespace forceshade::faults
