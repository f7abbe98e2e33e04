// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A run of the servo loop with all that the command line keeps and says of it.

#include <CLI/CLI.hpp>
#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "forceshade/device.h"
#include "forceshade/run.h"

namespace forceshade::apps {

struct RunPlan {
  run::Plan run;     // the device as the command line names it
  std::string json;  // the summary's file; "-" writes to standard output; empty: no file
  // run::run(), or what shows a window meanwhile.
  std::function<run::Outcome(device::Device&, const Rendering&, const run::Plan&, const std::atomic<bool>& stop)> run_loop =
      run::run;
};

struct RunOutcome {
  device::ServoResult result;
  int code;  // exit code
};

// --in-reset-pose, and the attendant: it prompts the person at the terminal, unless --in-reset-pose was given.
// with_buttons: a simulated device gets keys for buttons.
void add_in_reset_pose(CLI::App& command, bool& in_reset_pose);
std::unique_ptr<device::Attendant> attendant(bool in_reset_pose, bool with_buttons = false);

void add_watchdog_timeout(CLI::App& command, std::optional<double>& seconds);

// The device by its name. Throws Interrupted where a signal came meanwhile, whatever error the device then reports.
std::unique_ptr<device::Device> open_for_a_run(const std::string& name, device::Attendant& attendant,
                                               device::Forces forces = device::Forces::as_commanded);

// Says on standard error that a stiffness (N/mm) with this damping cannot be passive at this rate (Hz) on this device.
void warn_if_active(double stiffness, const device::Capabilities& capabilities, double rate,
                    const damping::Parameters& damping = {});

// Call end_runs_in_order() first. Records, runs, and writes the summary: to standard output unless something else goes there.
// A file that cannot be written is reported on standard error; the others are still written. Throws Interrupted if a signal
// came before the run.
RunOutcome run_on(device::Device& device, const Rendering& what, RunPlan plan);

// --certificate FILE, or none: it drives uncertified, which may_be_driven() says loudly.
inline constexpr const char* kNoCertificate = "none";
CLI::Option* add_certificate(CLI::App& command, std::string& file, const std::string& of = "");
// The verdict of the certificate on what is to be driven. Throws Error.
run::Certified certified(const std::string& file, const Identity& rendering);
// Prints why it may not be driven, or that it is driven uncertified.
bool may_be_driven(const run::Certified& certified, const std::string& file);

}  // namespace forceshade::apps
