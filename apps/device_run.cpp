// SPDX-License-Identifier: BSD-3-Clause
#include "apps/device_run.h"

#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "apps/command.h"
#include "apps/drive_summary.h"
#include "apps/driven.h"
#include "apps/last_ticks.h"
#include "apps/live_view.h"
#include "apps/options.h"
#include "apps/placement_text.h"
#include "apps/run_record.h"
#include "apps/signals.h"
#include "apps/terminal_attendant.h"
#include "apps/trip_words.h"
#include "certificate/build.h"
#include "device/last_samples.h"
#include "files/csv.h"
#include "files/output_file.h"
#include "files/printable.h"
#include "rendering/monitor.h"

namespace forceshade::apps {
namespace {

constexpr const char* kNotBegun = "the run had not begun";

// What the device says of itself; what it does not say is left out.
recorder::Metadata metadata(const RunPlan& plan, const Rendering& what, const device::Capabilities& capabilities) {
  recorder::Metadata metadata = metadata_of_run(plan.device, capabilities, plan.servo);
  metadata.insert({{"certificate_digest", plan.digest.value_or("none")},
                   {"origin_mm", origin_words(plan.servo.placement)},
                   {"axes", axes_words(plan.servo.placement)}});
  metadata.merge(metadata_of(what.identity));
  return metadata;
}

nlohmann::ordered_json summary(const device::ServoResult& run, const std::vector<device::Sample>& last_ticks,
                               const RunPlan& plan, const Rendering& what, const device::Capabilities& capabilities) {
  nlohmann::ordered_json json = summary_of(what.identity);
  json["certificate_digest"] = plan.digest ? nlohmann::ordered_json(*plan.digest) : nlohmann::ordered_json(nullptr);
  json["library_digest"] = properties::current_build().library_digest;
  const Eigen::Vector3d origin = plan.servo.placement.origin().cast<double>();
  json["placement"] = {{"origin_mm", {origin.x(), origin.y(), origin.z()}}, {"axes", axes_words(plan.servo.placement)}};
  json["device"] = {{"name", plan.device}};
  for (const auto& [what_it_is, words] : words_of(capabilities)) json["device"][what_it_is] = words;
  json.update(to_json(run));
  const std::string signal = interrupting_signal();
  json["signal"] = signal.empty() ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(signal);
  json["last_ticks"] = last_ticks_json(last_ticks);
  return json;
}

// N: more than these forces are is seldom commanded.
double bar_of(const device::Capabilities& capabilities) {
  return std::isfinite(capabilities.peak_force) ? static_cast<double>(capabilities.peak_force) : 5;
}

// No line is drawn where the output is no terminal, or where another output goes there.
bool is_watched() {
  return isatty(STDERR_FILENO) != 0 && isatty(STDOUT_FILENO) != 0;
}

bool has_failed(const device::ServoResult& run) {
  return run.trip || run.end_reason == device::EndReason::device_fault;
}

// Names and serial numbers come from a driver, which promises no encoding.
bool wrote_json(const std::string& file, const nlohmann::ordered_json& json) {
  try {
    write_file(file, json.dump(2, ' ', true, nlohmann::ordered_json::error_handler_t::replace) + "\n");
    return true;
  } catch (const files::OutputError& error) {
    std::fprintf(stderr, "forceshade: %s\n", files::printable(error.what()).c_str());
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

RunOutcome run_on(device::Device& device, const Rendering& what, RunPlan plan) {
  const device::Capabilities capabilities = device.capabilities();
  std::optional<RunRecord> record;
  if (!plan.record.empty()) record.emplace(plan.record, metadata(plan, what, capabilities), plan.servo.paced, plan.overwrite);
  std::optional<LiveView> view;
  if (is_watched()) view.emplace(bar_of(capabilities));
  device::LastSamples last(kKeptBeforeTheEnd, plan.servo.rate_hz);
  plan.servo.sinks.push_back(&last);
  if (record) plan.servo.sinks.push_back(&record->sink());
  if (view) plan.servo.sinks.push_back(&*view);
  if (interrupted()) throw Interrupted(kNotBegun);

  const std::unique_ptr<fast::Session> session = what.renderer.open();
  device::ServoResult result = device::run_servo_loop(device, *session, plan.servo, interrupted());
  view.reset();
  bool written = !record || record->close(std::string(name_of(result.end_reason)));
  const std::vector<device::Sample> last_ticks = has_failed(result) ? last.samples() : std::vector<device::Sample>{};
  if (!plan.json.empty()) written = wrote_json(plan.json, summary(result, last_ticks, plan, what, capabilities)) && written;
  if (plan.record != "-" && plan.json != "-") {
    if (const device::Placement& placement = plan.servo.placement; !(placement == device::Placement{}))
      std::printf("placement         origin at %s mm, x, y, z along %s of the device\n", origin_words(placement).c_str(),
                  axes_words(placement).c_str());
    print(result);
    print_last_ticks(last_ticks);
  }
  if (const std::string signal = interrupting_signal(); !signal.empty() && result.end_reason == device::EndReason::stopped)
    std::fprintf(stderr, "forceshade: %s ended the run\n", signal.c_str());
  if (result.trip) std::fprintf(stderr, "forceshade: the supervisor stopped the run: %s\n", words_of_trip(result).c_str());
  if (result.end_reason == device::EndReason::device_fault)
    std::fprintf(stderr, "forceshade: device fault: %s\n", result.fault);
  const int code = has_failed(result) ? kDeviceFault : written ? kHeld : kBadInput;
  return {std::move(result), code};
}

}  // namespace forceshade::apps
