// SPDX-License-Identifier: BSD-3-Clause
// forceshade device try: a guided first contact with a device, as gentle as can be felt.

#include <algorithm>
#include <cstdio>
#include <limits>
#include <memory>

#include "apps/command.h"
#include "apps/device_run.h"
#include "apps/options.h"
#include "apps/output_options.h"
#include "apps/signals.h"
#include "apps/tell.h"
#include "apps/terminal_attendant.h"
#include "files/csv.h"
#include "files/output_file.h"
#include "files/quantity.h"
#include "forceshade/checks.h"
#include "forceshade/device.h"
#include "forceshade/fast.h"
#include "forceshade/run.h"
#include "system/system.h"

namespace forceshade::apps {
namespace {

// Chosen to be felt by a hand that searches for it, and to be held by two fingers whatever the device does with it.
constexpr float kPeakForce = 0.5F;         // N
constexpr float kHighestStiffness = 0.2F;  // N/mm
constexpr const char* kNoButton = "none";

struct DeviceTryOptions {
  std::string device, certificate, stiffness = "0.05", dead_man = "0", out, json;
  double seconds = 30;
  std::optional<double> watchdog_timeout;
  bool in_reset_pose = false, overwrite = false;
};

// The contacts of a hand with the wall.
class Felt final : public device::SampleSink {
 public:
  void push(const device::Sample& sample) noexcept override {
    if (sample.status != static_cast<std::uint8_t>(Status::contact)) return;
    ++ticks_;
    deepest_ = std::max(deepest_, -sample.position[2]);
  }
  void print(const device::ServoResult& run) const {
    std::printf("felt              a wall in %zu of %zu ticks, pressed %.3f mm deep at most; largest force %.3f N of %.1f N\n",
                ticks_, run.ticks, static_cast<double>(deepest_), run.peak_force_N, static_cast<double>(kPeakForce));
  }

 private:
  std::size_t ticks_ = 0;
  float deepest_ = 0;  // mm
};

float gentle_stiffness(const std::string& text) {
  const float stiffness = files::parse_stiffness("--stiffness", text);
  built(fast::Law::build(LawId::wall, {.stiffness = stiffness}));
  if (stiffness <= kHighestStiffness) return stiffness;
  throw Error("--stiffness: expected at most " + shortest(kHighestStiffness) + " N/mm for a first contact, got " +
              shortest(stiffness) + "; 'forceshade drive' renders stiffer walls");
}

std::optional<int> dead_man_button(const DeviceTryOptions& options, int buttons) {
  if (options.dead_man == kNoButton) {
    if (buttons == 0) return std::nullopt;
    throw Error("--dead-man: expected a button from 0 to " + std::to_string(buttons - 1) +
                ", got \"none\"; without a button to let go of, only letting go of the stylus stops a run");
  }
  if (buttons == 0)
    throw Error("--dead-man: expected none, because the device has no buttons, got \"" + options.dead_man + '"');
  return static_cast<int>(parse_whole("--dead-man", options.dead_man, {0, static_cast<std::uint64_t>(buttons) - 1}));
}

void expect_done(device::Attendant& person, const std::string& words) {
  if (person.did(words)) return;
  if (interrupted()) throw Interrupted("the run had not begun");
  throw Error("the terminal: expected somebody who goes through the steps of a first contact, got no answer");
}

std::string first_step(float stiffness) {
  return "First contact, step 1 of 2. Nothing pushes yet.\n"
         "You will feel a wall: the horizontal plane at the height of the device's origin, " +
         shortest(stiffness) + " N/mm, never more than " + shortest(kPeakForce) +
         " N.\n"
         "Clear the space around the arm. Have the power switch or the emergency switch of the device within reach.";
}

std::string second_step(const std::optional<int>& button, double seconds) {
  const std::string hold = button ? "hold button " + std::to_string(*button) +
                                        " down, and keep it down: without it there is no "
                                        "force. To stop, let go of it, or press Ctrl-C."
                                  : "the device has no button to hold down. To stop, let go of the stylus, or press Ctrl-C.";
  return "First contact, step 2 of 2. The run begins when this is done, and lasts " + shortest(seconds) +
         " s.\n"
         "Take the stylus with two fingers, well above the plane; " +
         hold + "\nAfter half a second in the air, lower the tip slowly onto the wall, press a little, and rise again.";
}

int run(DeviceTryOptions options) {
  const float stiffness = gentle_stiffness(options.stiffness);
  if (options.out.empty()) options.out = system::date("forceshade-try-%Y%m%d-%H%M%SZ.fsr");
  if (files::format_ending(options.out) != ".fsr")
    throw Error("--out: expected FILE.fsr, a recording that survives a crash, got \"" + options.out + '"');
  const Rendering wall = built(rendering_of(LawId::wall, {.stiffness = stiffness}));
  const run::Certified covered = certified(options.certificate, wall.identity);
  if (!may_be_driven(covered, options.certificate)) {
    tell("to have one: forceshade certify --law wall --stiffness " + shortest(stiffness) + " --out DIR");
    return kFailed;
  }

  end_runs_in_order();
  TerminalAttendant person("a first contact needs somebody at a terminal");
  expect_done(person, first_step(stiffness));
  const auto prepares = attendant(options.in_reset_pose);
  device::Limited device(open_for_a_run(options.device, *prepares), kPeakForce);
  const std::optional<int> button = dead_man_button(options, device.capabilities().buttons);
  expect_done(person, second_step(button, options.seconds));
  Felt felt;
  const RunOutcome outcome = run_on(device, wall,
                                    {.run = {.device = options.device,
                                             .digest = covered.digest,
                                             .record = options.out,
                                             .overwrite = options.overwrite,
                                             .servo = {.max_seconds = options.seconds,
                                                       .watchdog_timeout = options.watchdog_timeout,
                                                       .dead_man_button = button,
                                                       .sinks = {&felt}}},
                                     .json = options.json});
  if (options.json != "-") felt.print(outcome.result);
  person.report("the run is over and there is no force; its recording is " + options.out);
  return outcome.code;
}

}  // namespace

void add_device_try(CLI::App& device, int& result) {
  const auto options = std::make_shared<DeviceTryOptions>();
  CLI::App* command = device.add_subcommand(
      "try", "A guided first contact: a gentle wall, at most 0.5 N, a button to be held down, everything recorded");
  command->add_option("device", options->device, "as for drive --device")->type_name("DEVICE")->required();
  add_certificate(*command, options->certificate, ", of the wall at this stiffness");
  add_stiffness(*command, options->stiffness, "K, stiffness, at most 0.2 N/mm");
  command->add_option("--dead-man", options->dead_man, "button to be held down, from 0; none for a device without buttons")
      ->type_name("BUTTON")
      ->capture_default_str()
      ->check([](const std::string& text) {
        if (text != kNoButton) parse_whole("--dead-man", text, {0, std::numeric_limits<std::uint16_t>::digits - 1});
        return std::string();
      });
  add_number(*command, "--seconds", "stop after so many seconds' worth of ticks; default: 30", {0.1, 600},
             [options](double seconds) { options->seconds = seconds; });
  add_watchdog_timeout(*command, options->watchdog_timeout);
  add_in_reset_pose(*command, options->in_reset_pose);
  add_output(*command, "--out", options->out, "the recording, FILE.fsr; default: forceshade-try-DATE-TIME.fsr", {".fsr"});
  add_json(*command, options->json, "the summary");
  command->callback([options, command, &result] {
    options->overwrite = overwrites(*command);
    result = run(*options);
  });
}

}  // namespace forceshade::apps
