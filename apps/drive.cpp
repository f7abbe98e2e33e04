// SPDX-License-Identifier: BSD-3-Clause
// forceshade drive: run a certified renderer on a device, and refuse one that is not certified.

#include <limits>
#include <memory>
#include <optional>

#include "apps/command.h"
#include "apps/device_run.h"
#include "apps/drive_window.h"
#include "apps/options.h"
#include "apps/output_options.h"
#include "apps/signals.h"
#include "apps/steering_attendant.h"
#include "apps/subject_option.h"
#include "apps/surface_cut.h"
#include "device/kinds.h"
#include "device/placement_text.h"
#include "forceshade/run.h"
#include "text/joined.h"

namespace forceshade::apps {
namespace {

using Controller = device::Passivity;

constexpr const char* kNoPace = "none";
constexpr NumberRange kSeconds{1 / device::kHighestRateHz, 1e9};
constexpr WholeRange kButtons{0, std::numeric_limits<decltype(device::Reading::buttons)>::digits - 1};

struct DriveOptions {
  std::string place, certificate, device, out, json;
  std::optional<double> rate, seconds, watchdog_timeout;
  std::optional<int> dead_man;
  std::string passivity = "damping", pace = "device";
  bool in_reset_pose = false, overwrite = false;
};

Controller controller_named(const std::string& name) {
  for (const Controller kind : {Controller::tank, Controller::observer})
    if (name == name_of(kind)) return kind;
  return Controller::damping;
}

// Each of them alone is fine.
void expect_consistent(const DriveOptions& options) {
  if (!options.out.empty() && options.out == options.json)
    throw Error("--out and --json: expected two files, got \"" + options.json + "\" for both");
  if (options.pace == kNoPace && options.watchdog_timeout)
    throw Error("--watchdog-timeout: expected another pace beside it than none, in which no tick is late");
}

// mouse, mouse:MODEL or simulated:MODEL:mouse.
bool is_of_a_mouse(const std::string& device) {
  return device.starts_with("mouse") || device.ends_with(":mouse");
}

// A starting position above the surface, over the middle of the window.
Eigen::Vector3d start_above(const SurfaceCut& cut, const device::Placement& placement) {
  const window::Region& region = cut.region();
  const Eigen::Vector3d start((region.left + region.right) / 2, cut.middle_y(),
                              region.top - 0.1 * (region.top - region.bottom));
  return (placement.origin() + placement.turned_to_device(start.cast<float>())).cast<double>();
}

std::string words_of(const run::Certified& covered, const std::string& file) {
  if (covered.digest)
    return "Certified: every force is the binary32 number nearest to the exact one, by " + file + " (SHA-256 " +
           covered.digest->substr(0, 12) + "…).";
  return "NOT CERTIFIED, " + covered.why_not + ".";
}

int run(const DriveOptions& options, const SubjectOption& subject) {
  expect_consistent(options);
  const device::Placement placement = device::parse_placement(options.place);
  auto described = std::make_unique<const Description>(subject.description());
  const Rendering what = built(rendering_of(*described));
  const run::Certified covered = certified(options.certificate, what.identity);
  if (!may_be_driven(covered, options.certificate)) return kFailed;

  if (described->moves() && is_of_a_mouse(options.device))
    throw Error(described->name + ": expected no object with a motion, since the window of a mouse shows a surface that stays");
  end_runs_in_order();
  std::optional<SurfaceCut> cut;  // of a device that is steered in a window
  SteeringAttendant prepares(options.in_reset_pose, options.dead_man.has_value(),
                             [&] { return start_above(cut.emplace(*described, what), placement); });
  const std::unique_ptr<device::Device> device = open_for_a_run(options.device, prepares);
  RunPlan plan{.run = {.device = options.device,
                       .digest = covered.digest,
                       .record = options.out,
                       .overwrite = options.overwrite,
                       .servo = {.rate_hz = options.rate.value_or(what.rate_hz.value_or(1000)),
                                 .max_seconds = options.seconds,
                                 .paced = options.pace != kNoPace,
                                 .follows_device = options.pace == "device",
                                 .passivity = controller_named(options.passivity),
                                 .watchdog_timeout = options.watchdog_timeout,
                                 .dead_man_button = options.dead_man,
                                 .placement = placement}},
               .json = options.json};
  std::optional<DriveWindow> window;
  if (prepares.steered() != nullptr) {
    window.emplace(*described, *cut, placement, *prepares.steered(), words_of(covered, options.certificate));
    plan.run_loop = [&window](auto&... arguments) { return window->run(arguments...); };
  } else {
    described.reset();  // a mesh is large
  }
  return run_on(*device, what, std::move(plan)).code;
}

// "null, at rest, feels nothing; ..."
std::string kinds_of_device() {
  return joined(device::kinds(), "; ", [](const device::Kind& kind) { return kind.form() + ", " + kind.words(); });
}

}  // namespace

void add_drive(CLI::App& app, int& result) {
  const auto options = std::make_shared<DriveOptions>();
  CLI::App* command = app.add_subcommand("drive", "Drive a device with a certified renderer");
  const auto subject = std::make_shared<SubjectOption>(*command, subjects::Laws::one, true);
  command
      ->add_option("--place", options->place,
                   "the place of the law's or map's origin in the device's workspace: X,Y,Z in mm, or with units (mm, mil, in, "
                   "cm, m), default: 0,0,0; and its turn there, about the device's axes and through its own origin: z90, or "
                   "x-90,z180 one after the other; multiples of 90 degrees")
      ->type_name("X,Y,Z|TURNS|X,Y,Z,TURNS")
      ->group(kPlaceGroup);
  add_certificate(*command, options->certificate);
  command->option_defaults()->group(kDeviceGroup);
  command->add_option("--device", options->device, kinds_of_device())->type_name("DEVICE")->required();
  add_number(*command, "--rate", "ticks per second; default: the scene's motion rate, which no other one fits, else 1000",
             {device::kLowestRateHz, device::kHighestRateHz}, [options](double rate) { options->rate = rate; });
  add_number(*command, "--seconds", "stop after so many seconds' worth of ticks", kSeconds,
             [options](double seconds) { options->seconds = seconds; });
  add_word(*command, "--passivity", options->passivity,
           "the guard against a force that gives energy: damping, tank (shortens it) or observer (nothing: for measuring)",
           {"damping", "tank", "observer"});
  add_word(
      *command, "--pace", options->pace,
      "the clock of the ticks: device, the frames of one that has its own (a PHANToM); clock, this machine's, as for any other "
      "device; or none, as fast as it goes: for checks, not for hands",
      {"device", "clock", kNoPace});
  add_watchdog_timeout(*command, options->watchdog_timeout);
  add_whole(
      *command, "--dead-man",
      "button of the device to be held down, from 0; else there is no force. Of a simulated device: a key of the terminal, "
      "0 or 1, typed once to press and again to let go",
      kButtons, [options](std::uint64_t button) { options->dead_man = static_cast<int>(button); });
  add_in_reset_pose(*command, options->in_reset_pose);
  add_output(
      *command, "--out", options->out,
      "every tick: FILE.fsr, a recording that survives a crash; FILE.npy, a structured array for numpy.load; else its CSV, - "
      "for standard output",
      {".fsr", ".npy", ".csv"});
  add_json(*command, options->json, "the summary");
  command->callback([options, subject, command, &result] {
    options->overwrite = overwrites(*command);
    result = run(*options, *subject);
  });
}

}  // namespace forceshade::apps
