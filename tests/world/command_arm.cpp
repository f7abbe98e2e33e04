// SPDX-License-Identifier: BSD-3-Clause
// A program that drives the arm of a session (docs/command-device.md), as a thread of the simulated world.

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "device/command/command.h"
#include "files/csv.h"
#include "files/lines.h"
#include "tests/world/arms.h"
#include "tests/world/channel.h"

namespace forceshade::world {
namespace {

constexpr Ns kMillisecond = 1'000'000;

// The fault of the next answer of the running session's program.
struct Answering {
  // As it is, in pieces of so many bytes; with another text in place of a part of it; so much too late.
  std::size_t piece = 0;
  const char *part = nullptr, *instead = nullptr;
  Ns late = 0;
  bool is_twice = false;
  // A line of this.
  std::string line = {};
  // It writes without an end, closes its output, reads no more, or ends with this status after words on its standard error.
  bool is_endless = false, closes = false, freezes = false;
  std::optional<int> ends = std::nullopt;
  // At its end it does not end.
  bool hangs = false;
};
Answering answering;

constexpr Ns kAnswer = 50'000;
constexpr const char* kHello =
    R"({"forceshade-device":1,"name":"an arm","workspace_mm":[[-100,-100,-100],[100,100,100]],"peak_force_N":3,)"
    R"("continuous_force_N":1,"resolution_mm":0.05,"buttons":2,"paces":)";
Ns period = 0;  // of the program's clock; 0: it has none

// The output and the end of the program, as our side hears them.
struct Heard {
  enum class Kind { output, error, end_of_output, end } kind;
  std::string bytes = {};
  std::optional<int> status = {};
};
using Kind = Heard::Kind;

struct Streams {
  Channel<std::string> in;
  Channel<Heard> out;
};

// The program.
class Driver {
 public:
  Driver(Arm& arm, std::shared_ptr<Streams> streams) : arm_(arm), streams_(std::move(streams)) {}

  void run() {
    say(kHello + std::string(period > 0 ? "true}\n" : "false}\n"));
    for (std::string read; !is_over_;) {
      const std::optional<std::string> bytes = streams_->in.receive(system::kForever);
      if (!bytes) return finish();
      arm_.is_out_of_reach = false;
      read += *bytes;
      for (std::size_t end = read.find('\n'); end != std::string::npos && !is_over_; end = read.find('\n')) {
        const std::string line = read.substr(0, end);
        read.erase(0, end + 1);
        if (line.find("end") != std::string::npos) return finish();
        double x = 0, y = 0, z = 0;
        if (std::sscanf(line.c_str(), R"({"force_N":[%lf,%lf,%lf]})", &x, &y, &z) != 3) return end_with(1 << 8, "no force");
        arm_.push({x, y, z});
        answer();
      }
    }
  }

 private:
  void say(std::string bytes) { streams_->out.send({Kind::output, std::move(bytes)}); }

  void end_with(int status, const char* words = "") {
    streams_->out.send({Kind::error, words});
    streams_->out.send({Kind::end_of_output});
    streams_->out.send({Kind::end, {}, status});
    is_over_ = true;
  }

  // As the page demands: the force is zero at the end of its input.
  void finish() {
    arm_.push({0, 0, 0});
    arm_.close();
    if (std::exchange(answering.hangs, false)) wait();
    end_with(0);
  }

  void wait() {
    const system::Number nothing = 0;
    for (;;) system::wait_for_change(nothing, 0, system::kForever);
  }

  void answer() {
    const Answering its = std::exchange(answering, Answering{.hangs = answering.hangs});
    next_ = std::max(next_ + period, system::now() + kAnswer);
    system::sleep_until(next_);
    arm_.is_out_of_reach = its.late > 0 || its.freezes || its.ends || its.is_endless;  // until it reads again
    system::sleep_until(system::now() + its.late);
    if (its.ends) return end_with(*its.ends, "the arm was unplugged\n");
    while (its.is_endless && !streams_->in.is_closed()) {
      say(std::string(4096, 'x'));
      system::sleep_until(system::now() + kAnswer);
    }
    if (its.freezes || its.is_endless) return wait();
    if (its.closes) return streams_->out.send({Kind::end_of_output});
    std::string line = its.line.empty() ? state() : its.line;
    if (its.part != nullptr) line.replace(line.find(its.part), std::string(its.part).size(), its.instead);
    line += '\n';
    for (std::size_t i = 0; its.piece > 0 && i < line.size(); i += its.piece) say(line.substr(i, its.piece));
    if (its.piece == 0) say(line);
    if (its.is_twice) say(state() + '\n');
  }

  std::string state() {
    const device::FrameState its = arm_.state();
    const auto& at = its.position;
    return R"({"time_s":)" + shortest(static_cast<double>(++answers_)) + R"(,"position_mm":[)" + shortest(at.x()) + ',' +
           shortest(at.y()) + ',' + shortest(at.z()) + R"(],"buttons":)" + std::to_string(its.buttons) + R"(,"calibrated":)" +
           (its.calibrated ? "true" : "false") + R"(,"forces_on":)" + (its.forces_on ? "true" : "false") + '}';
  }

  Arm& arm_;
  std::shared_ptr<Streams> streams_;
  bool is_over_ = false;
  long answers_ = 0;
  Ns next_ = 0;
};

// Our side of its streams, and the keeper's part.
class Program final : public files::LineProgram {
 public:
  Program(Arm& arm, const files::ProcessLimits& limits)
      : LineProgram(limits, "program"), arm_(arm), grace_(system::in_ns(limits.grace)), streams_(std::make_shared<Streams>()) {
    arm.on_lost = [streams = streams_] { streams->in.close(); };
    system::Thread thread(kPartner, [&arm, streams = streams_] { Driver(arm, streams).run(); });
    thread_ = current()->threads() - 1;
    thread.leave();
  }
  ~Program() override {
    if (!streams_->in.is_closed()) streams_->in.close();
    const Ns until = system::now() + grace_;
    while (!current()->is_over(thread_) && system::now() < until) system::sleep_until(system::now() + kMillisecond);
    end();
  }

 private:
  void end() {
    if (!current()->is_over(thread_)) current()->kill(thread_);
  }

  void move(std::int64_t until) override {
    if (lines_.closes_input() && !streams_->in.is_closed()) {
      streams_->in.close();
      ended_at_ = system::now() + grace_;
    }
    if (const std::string_view rest = lines_.to_send(); !rest.empty()) {
      streams_->in.send(std::string(rest));
      lines_.took(rest.size());
    }
    const std::optional<Heard> heard = streams_->out.receive(std::min(until, ended_at_));
    if (heard) return hear(*heard);
    if (system::now() < ended_at_) return;
    end();
    lines_.ended_output();
    lines_.ended(std::nullopt);
  }

  void hear(const Heard& heard) {
    switch (heard.kind) {
      case Kind::output:
        if (!arm_.sent().empty()) arm_.answered();
        return lines_.said(heard.bytes);
      case Kind::error: return lines_.complained(heard.bytes);
      case Kind::end_of_output: return lines_.ended_output();
      case Kind::end: return lines_.ended(heard.status);
    }
  }

  Arm& arm_;
  Ns grace_, ended_at_ = system::kForever;
  std::shared_ptr<Streams> streams_;
  int thread_ = 0;
};

std::unique_ptr<device::Device> open_command(Arm& arm) {
  static device::Attendant nobody;
  answering = {};
  device::FramedOptions options = device::kCommandOptions;
  options.calibration = kOptions.calibration;
  return device::command::open(std::make_unique<Program>(arm, device::command::limits_of(options)), options, nobody);
}

Fault answers(const char* name, const Answering& its, std::vector<std::string> words = {}) {
  return {name, [=](World&, Arm&) { answering = its; }, std::move(words)};
}

// Each hostile answer, with the words that end the run.
std::vector<Fault> faults_of_the_program() {
  const auto wrong = [](const char* part, const char* instead) { return Answering{.part = part, .instead = instead}; };
  const std::string json = "expected a JSON object in one line", position = "; expected [x, y, z] in mm",
                    longer = "the program wrote a line of more than 65536 bytes",
                    silent = "the program did not answer within 0.01 s";
  return {
      answers("a line in pieces of a byte", {.piece = 1}),
      answers("a line in pieces of seven bytes", {.piece = 7}),
      answers("an answer 5 ms late", {.late = 5 * kMillisecond}),
      answers("an answer 500 ms late", {.late = 500 * kMillisecond}, {silent}),
      answers("it reads no more", {.freezes = true}, {silent}),
      answers("garbage", {.line = "}{"}, {"the program wrote \"}{\"; " + json}),
      answers("a number that is NaN", wrong("position_mm\":[", "position_mm\":[NaN,"), {json}),
      answers("a number that is infinite", wrong("position_mm\":[", "position_mm\":[1e999,"), {json}),
      answers("two coordinates", {.line = R"({"time_s":1e9,"position_mm":[0,0],"buttons":0})"},
              {"the program's answer has position_mm [0,0]" + position}),
      answers("metres away", {.line = R"({"time_s":1e9,"position_mm":[0,0,20000],"buttons":0})"},
              {"the program's answer has position_mm [0,0,20000]" + position}),
      answers("no position", {.line = R"({"time_s":1e9,"buttons":0})"}, {"has no key \"position_mm\""}),
      answers("an old answer", {.line = R"({"time_s":0,"position_mm":[0,0,0],"buttons":0})"},
              {"; expected a later time than "}),
      answers("a button too many", wrong("buttons\":", "buttons\":1"), {"; expected a whole number from 0 to 3"}),
      answers("another key", wrong("{", "{\"velocity\":0,"), {"the program's answer has the key \"velocity\""}),
      answers("an applied force in words", wrong("{", "{\"applied_N\":\"0 0 0\","), {"; expected [x, y, z] in N"}),
      answers("a line that is too long", {.line = std::string(100'000, '[')}, {longer}),
      answers("a line without an end", {.is_endless = true}, {longer, silent}),
      answers("two answers", {.is_twice = true}, {"the program wrote without having been asked"}),
      answers("it fails", {.line = R"({"failure":"motor 2 is too hot"})"}, {"the program failed: \"motor 2 is too hot\""}),
      answers(
          "it ends", {.ends = 1 << 8},
          {"the program ended with exit code 1 without an answer; it wrote last on standard error: \"the arm was unplugged\""}),
      answers("it crashes", {.ends = SIGABRT}, {"the program was killed by signal 6"}),
      answers("it closes its output", {.closes = true}, {"the program closed its output, and did not end"}),
      {"it is not calibrated any more", [](World&, Arm& arm) { arm.is_calibrated = false; }, {"tripped: uncalibrated"}},
      {"the arm leaps by 10 mm", [](World&, Arm& arm) { arm.jump(); }, {"tripped: jump"}}};
}

}  // namespace

ArmKind command_arm(Ns its_period) {
  // The watchdog of the hardware behind the program.
  constexpr Ns kOwnWatchdog = 50 * kMillisecond;
  const auto open = [its_period](Arm& arm) {
    period = its_period;
    return open_command(arm);
  };
  return {"command", open, kOwnWatchdog, faults_of_the_program()};
}

}  // namespace forceshade::world
