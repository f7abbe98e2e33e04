// SPDX-License-Identifier: BSD-3-Clause
#include "apps/device_run.h"

#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "apps/command.h"
#include "apps/drive_summary.h"
#include "apps/live_view.h"
#include "apps/options.h"
#include "apps/output_options.h"
#include "apps/signals.h"
#include "apps/tell.h"
#include "apps/terminal_attendant.h"
#include "apps/trip_words.h"
#include "device/kinds.h"
#include "device/passive_rate.h"
#include "files/output_file.h"
#include "files/printable.h"
#include "forceshade/checks.h"
#include "run/summary.h"
#include "run/words.h"

namespace forceshade::apps {
namespace {

constexpr const char* kNotBegun = "the run had not begun";

// N: more than these forces are is seldom commanded.
double bar_of(const device::Capabilities& capabilities) {
  return std::isfinite(capabilities.peak_force) ? static_cast<double>(capabilities.peak_force) : 5;
}

// No line is drawn where the output is no terminal, or where another output goes there.
bool is_watched() {
  return isatty(STDERR_FILENO) != 0 && isatty(STDOUT_FILENO) != 0;
}

// Names and serial numbers come from a driver, which promises no encoding.
bool wrote_json(const std::string& file, const nlohmann::ordered_json& json) {
  try {
    write_json(file, json);
    return true;
  } catch (const files::OutputError& error) {
    tell(error.what());
    return false;
  }
}

}  // namespace

void add_in_reset_pose(CLI::App& command, bool& in_reset_pose) {
  command.add_flag("--in-reset-pose", in_reset_pose,
                   "the arm is held in its reset pose: a device that calibrates there waits for no confirmation");
}

void add_watchdog_timeout(CLI::App& command, std::optional<double>& seconds) {
  add_number(
      command, "--watchdog-timeout",
      "for how many seconds ticks may be late before the run is stopped. Without it, 0.02 on a device with an arm, and on "
      "others late ticks are only counted",
      {1 / device::kHighestRateHz, device::kLongestWatchdogTimeout}, [&seconds](double timeout) { seconds = timeout; });
}

std::unique_ptr<device::Attendant> attendant(bool in_reset_pose, bool with_buttons) {
  std::unique_ptr<TerminalAttendant> person;
  if (in_reset_pose)
    person = std::make_unique<HoldsResetPose>();
  else
    person = std::make_unique<TerminalAttendant>("give --in-reset-pose if the arm is held in its reset pose");
  if (with_buttons) person->offer_buttons();
  return person;
}

std::unique_ptr<device::Device> open_for_a_run(const std::string& name, device::Attendant& attendant, device::Forces forces) {
  try {
    auto device = device::open_device(name, attendant, forces);
    if (!interrupted()) return device;
  } catch (const device::DeviceError&) {
    if (!interrupted()) throw;
  }
  throw Interrupted(kNotBegun);
}

void warn_if_active(double stiffness, const device::Capabilities& capabilities, double rate,
                    const damping::Parameters& damping) {
  if (const std::string words = device::words_if_active(stiffness, capabilities, rate, damping); !words.empty()) tell(words);
}

RunOutcome run_on(device::Device& device, const Rendering& what, RunPlan plan) {
  const device::Capabilities capabilities = device.capabilities();
  warn_if_active(static_cast<double>(what.stiffness), capabilities, plan.run.servo.rate_hz,
                 run::damping_of(what, plan.run.servo));
  std::optional<LiveView> view;
  if (is_watched()) view.emplace(bar_of(capabilities));
  if (view) plan.run.servo.sinks.push_back(&*view);
  const run::Outcome outcome = plan.run_loop(device, what, plan.run, interrupted());
  view.reset();
  const device::ServoResult& result = outcome.result;
  for (const std::string& fault : outcome.record_faults) tell(fault);
  bool written = outcome.record_faults.empty();
  if (!plan.json.empty())
    written = wrote_json(plan.json, run::summary(outcome, what, plan.run, capabilities, interrupting_signal())) && written;
  if (plan.run.record != "-" && plan.json != "-") {
    if (const device::Placement& placement = plan.run.servo.placement; !(placement == device::Placement{}))
      std::printf("placement         origin at %s mm, x, y, z along %s of the device\n", run::origin_words(placement).c_str(),
                  run::axes_words(placement).c_str());
    if (device::is_untried(plan.run.device)) std::printf("driver            never tried on hardware\n");
    if (!capabilities.forces.empty())
      std::printf("forces            %s\n", files::printable(std::string(capabilities.forces)).c_str());
    print(result);
    print_last_ticks(outcome.last_ticks);
  }
  if (const std::string signal = interrupting_signal(); !signal.empty() && result.end_reason == device::EndReason::stopped)
    tell(signal + " ended the run");
  if (result.trip) tell("the supervisor stopped the run: " + words_of_trip(result));
  if (result.end_reason == device::EndReason::device_fault) tell("device fault: " + std::string(result.fault));
  return {result, run::has_failed(result) ? kDeviceFault : written ? kHeld : kBadInput};
}

CLI::Option* add_certificate(CLI::App& command, std::string& file, const std::string& of) {
  return command
      .add_option("--certificate", file, "certificate.json of this build" + of + "; or none, which drives uncertified")
      ->type_name("FILE|none")
      ->group(kEvidenceGroup);
}

run::Certified certified(const std::string& file, const Identity& rendering) {
  if (file == kNoCertificate) return {std::nullopt, "because of --certificate none"};
  return run::certified(file, rendering);
}

bool may_be_driven(const run::Certified& certified, const std::string& file) {
  if (certified.digest) return true;
  if (file == kNoCertificate)
    std::fprintf(stderr, "*** DRIVING UNCERTIFIED, %s ***\n", certified.why_not.c_str());
  else
    tell("refused to drive: " + certified.why_not);
  return file == kNoCertificate;
}

}  // namespace forceshade::apps
