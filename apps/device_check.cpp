// SPDX-License-Identifier: BSD-3-Clause
// forceshade device check: whether a device is ready for its first force, without giving any.

#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>

#include "apps/command.h"
#include "apps/device_run.h"
#include "apps/options.h"
#include "apps/output_options.h"
#include "apps/signals.h"
#include "apps/troubleshooting.h"
#include "device/check.h"
#include "device/kinds.h"
#include "device/machine.h"
#include "files/csv.h"
#include "files/printable.h"
#include "forceshade/checks.h"

namespace forceshade::apps {
namespace {

using device::Check;
using device::Grade;

constexpr double kRate = 1000;  // Hz

struct DeviceCheckOptions {
  std::string device = "phantom", json;
  double seconds = 5;
  bool in_reset_pose = false;
};

class Checks {
 public:
  explicit Checks(bool printed) : printed_(printed) {}

  // Shown as soon as it is known: what follows may take its time.
  void add(Check check) {
    if (printed_) {
      std::printf("%-18s %-17s %s\n", check.name.c_str(), name_of(check.grade).data(),
                  files::printable(with_page(check.words)).c_str());
      std::fflush(stdout);
    }
    all_.push_back(std::move(check));
  }
  void add(std::vector<Check> checks) {
    for (Check& check : checks) add(std::move(check));
  }

  std::size_t count(Grade grade) const {
    return static_cast<std::size_t>(
        std::count_if(all_.begin(), all_.end(), [&](const Check& check) { return check.grade == grade; }));
  }
  const std::vector<Check>& all() const { return all_; }

 private:
  bool printed_;
  std::vector<Check> all_;
};

// Joins the lines of text about opening the device.
std::string on_one_line(const std::string& text) {
  std::istringstream in(text);
  std::string line;
  for (std::string word; in >> word;) line.append(line.empty() ? "" : " ").append(word);
  return line;
}

void check_open(const DeviceCheckOptions& options, device::Attendant& prepares, Checks& checks, device::Observed& seen) {
  std::unique_ptr<device::Device> opened;
  try {
    opened = open_for_a_run(options.device, prepares, device::Forces::never);
  } catch (const device::DeviceError& error) {
    return checks.add({"opening", Grade::wrong, on_one_line(error.what())});
  }
  const device::Capabilities capabilities = opened->capabilities();
  checks.add(check_identity(capabilities));
  prepares.report("reading the device for " + shortest(options.seconds) +
                  " s without any force; leave it at rest to measure its noise, or move it and press its buttons to see them");
  const double rate = std::min(kRate, capabilities.highest_rate);
  seen = device::observe_without_force(*opened, rate, options.seconds, interrupted());
  if (interrupted()) throw Interrupted("the check was not finished");
  checks.add(check_readings(seen, capabilities, rate));
  checks.add(device::machine_checks(device::this_machine(), seen, rate));
}

nlohmann::ordered_json json_of(const DeviceCheckOptions& options, const Checks& checks, const device::Observed& seen) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const Check& check : checks.all())
    all.push_back({{"check", check.name}, {"grade", name_of(check.grade)}, {"words", check.words}});
  const auto array = [](const Eigen::Vector3d& v) { return nlohmann::ordered_json{v.x(), v.y(), v.z()}; };
  return {{"device", options.device},
          {"held", checks.count(Grade::wrong) == 0},
          {"checks", all},
          {"readings", seen.readings},
          {"rate_hz", seen.rate},
          {"jitter_ms", seen.jitter},
          {"longest_gap_ms", seen.longest_gap},
          {"noise_rms_mm", array(seen.noise)},
          {"peak_to_peak_mm", array(seen.extent)}};
}

int run(const DeviceCheckOptions& options) {
  end_runs_in_order();
  const auto prepares = attendant(options.in_reset_pose);
  Checks checks(options.json != "-");
  device::Observed seen;
  checks.add(device::checks_before_opening(options.device));
  check_open(options, *prepares, checks, seen);
  const std::size_t wrong = checks.count(Grade::wrong), lacking = checks.count(Grade::lacking),
                    unknown = checks.count(Grade::unknown);
  write_json(options.json, json_of(options, checks, seen));
  if (options.json != "-")
    std::printf("%s: %zu of %zu checks wrong, %zu lacking, %zu could not be made\n", wrong == 0 ? "held" : "FAILED", wrong,
                checks.all().size(), lacking, unknown);
  return wrong == 0 ? kHeld : kDeviceFault;
}

}  // namespace

void add_device_check(CLI::App& device, int& result) {
  const auto options = std::make_shared<DeviceCheckOptions>();
  CLI::App* command = device.add_subcommand("check",
                                            "Driver, permissions, calibration, update rate, encoders, kinematics, buttons, "
                                            "noise, real-time settings; no force is switched on");
  command->add_option("device", options->device, "as for drive --device; default: phantom")->type_name("DEVICE");
  add_number(*command, "--seconds", "time for which the device is read; default: 5", {0.1, 600},
             [options](double seconds) { options->seconds = seconds; });
  add_in_reset_pose(*command, options->in_reset_pose);
  add_json(*command, options->json, "the checks and what was measured");
  command->callback([options, &result] { result = run(*options); });
}

}  // namespace forceshade::apps
