// SPDX-License-Identifier: BSD-3-Clause
// forceshade drive: run a certified renderer on a device, and refuse one that is not certified.

#include <sched.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "forceshade/apps/command.h"
#include "forceshade/apps/drive_summary.h"
#include "forceshade/apps/height_map_option.h"
#include "forceshade/apps/live_view.h"
#include "forceshade/apps/options.h"
#include "forceshade/apps/run_record.h"
#include "forceshade/csv/csv.h"
#include "forceshade/csv/printable.h"
#include "forceshade/device/open_device.h"
#include "forceshade/properties/build.h"
#include "forceshade/properties/certificate.h"
#include "forceshade/properties/digest.h"

namespace forceshade::apps {
namespace {

using Controller = device::PassivityController::Kind;

constexpr NumberRange kSeconds{1 / device::kHighestRateHz, 1e9};
constexpr NumberRange kPatience{1 / device::kHighestRateHz, device::kLongestPatience};
constexpr WholeRange kButtons{0, std::numeric_limits<decltype(device::Reading::buttons)>::digits - 1};
constexpr WholeRange kProcessors{0, CPU_SETSIZE - 1};

struct Options {
  std::string certificate, device, record, json;
  double rate = 1000;
  std::optional<double> seconds, patience;
  std::optional<int> cpu, dead_man;
  std::string passivity = "damping";
  bool unpaced = false, uncertified = false;
};

Controller controller_named(const std::string& name) {
  for (const Controller kind : {Controller::tank, Controller::observer})
    if (name == name_of(kind)) return kind;
  return Controller::damping;
}

// Each of them alone is fine.
void expect_consistent(const Options& options) {
  if (!options.record.empty() && options.record == options.json)
    throw BadInput("--record and --json: expected two files, got \"" + options.json + "\" for both");
  if (!options.cpu) return;
  cpu_set_t allowed;
  CPU_ZERO(&allowed);
  sched_getaffinity(0, sizeof allowed, &allowed);
  if (CPU_ISSET(*options.cpu, &allowed)) return;
  std::string processors;
  for (int cpu = 0; cpu < CPU_SETSIZE; ++cpu)
    if (CPU_ISSET(cpu, &allowed)) processors += (processors.empty() ? "" : ", ") + std::to_string(cpu);
  throw BadInput("--cpu: expected one of the processors that the command may run on (" + processors + "), got " +
                 std::to_string(*options.cpu));
}

// What is driven: a law or a height map.
struct Driven {
  fast::Renderer renderer;
  std::function<std::optional<std::string>(const properties::Certificate&, const properties::Build&)> refusal;
  nlohmann::ordered_json summary;
  recorder::Metadata metadata;
};

Driven driven(LawId law, const Parameters& p) {
  nlohmann::ordered_json parameters{{"stiffness_N_per_mm", static_cast<double>(p.stiffness)}};
  recorder::Metadata metadata{{"law", std::string(name_of(law))}, {"stiffness_N_per_mm", csv::shortest(p.stiffness)}};
  if (has_bump_geometry(law)) {
    parameters["radius_mm"] = static_cast<double>(p.radius);
    parameters["width_mm"] = static_cast<double>(p.width);
    metadata["radius_mm"] = csv::shortest(p.radius);
    metadata["width_mm"] = csv::shortest(p.width);
  }
  return {built(fast::Law::build(law, p)),
          [law, p](const auto& certificate, const auto& build) { return properties::refusal(certificate, build, law, p); },
          {{"law", name_of(law)}, {"parameters", parameters}},
          std::move(metadata)};
}

Driven driven(const std::string& name, const heights::Spec& spec, float stiffness) {
  const properties::HeightIdentity identity = properties::identity_of(spec.map, spec.rendering, stiffness);
  const std::string rendering(name_of(spec.rendering));
  return {built(fast::HeightLaw::build(spec.map, spec.rendering, stiffness)),
          [identity](const auto& certificate, const auto& build) { return properties::refusal(certificate, build, identity); },
          {{"height_map", name},
           {"map_digest", identity.map_digest},
           {"rendering", rendering},
           {"parameters", {{"stiffness_N_per_mm", static_cast<double>(stiffness)}}}},
          {{"height_map", name},
           {"map_digest", identity.map_digest},
           {"rendering", rendering},
           {"stiffness_N_per_mm", csv::shortest(stiffness)}}};
}

// The certificate's digest; nothing where there is none or it does not cover what is to be driven, with the reason why.
std::optional<std::string> certified(const Options& options, const Driven& what, std::string& why) {
  if (options.certificate.empty()) {
    why = "no certificate was given; expected --certificate FILE, as written by 'forceshade certify'";
    return std::nullopt;
  }
  const std::string text = properties::read_certificate(options.certificate);
  const properties::Certificate certificate = properties::from_json(text, options.certificate);
  const auto refused = what.refusal(certificate, properties::current_build());
  if (!refused) {
    properties::Digest digest;
    digest.text(text);
    return digest.hex();
  }
  why = options.certificate + ": " + *refused;
  return std::nullopt;
}

nlohmann::ordered_json summary(const device::ServoResult& run, const Driven& what, const std::optional<std::string>& digest) {
  nlohmann::ordered_json json = what.summary;
  json["certificate_digest"] = digest ? nlohmann::ordered_json(*digest) : nlohmann::ordered_json(nullptr);
  json["library_digest"] = properties::current_build().library_digest;
  json.update(to_json(run));
  return json;
}

recorder::Metadata metadata(const Options& options, const Driven& what, const std::optional<std::string>& digest) {
  const properties::Build build = properties::current_build();
  recorder::Metadata metadata{{"certificate_digest", digest.value_or("none")},
                              {"library_digest", build.library_digest},
                              {"version", build.version},
                              {"revision", build.revision},
                              {"compiler", build.compiler},
                              {"flags", build.flags},
                              {"instruction_set", build.instruction_set},
                              {"device", options.device},
                              {"rate_hz", csv::shortest(options.rate)},
                              {"paced", options.unpaced ? "no" : "yes"},
                              {"passivity", options.passivity}};
  metadata.insert(what.metadata.begin(), what.metadata.end());
  return metadata;
}

// N: more than these forces are is seldom commanded.
double bar_of(const device::Capabilities& capabilities) {
  return std::isfinite(capabilities.peak_force) ? static_cast<double>(capabilities.peak_force) : 5;
}

// Where nobody looks, or where the words of something else go, no line is drawn.
bool is_watched() {
  return isatty(STDERR_FILENO) != 0 && isatty(STDOUT_FILENO) != 0;
}

int run(const Options& options, const LawOptions& law_options, const HeightMapOption& height_map) {
  expect_consistent(options);
  const float stiffness = law_options.stiffness();
  const Driven what = height_map.is_given() ? driven(height_map.name(), height_map.read(stiffness), stiffness)
                                            : driven(law_options.law(), law_options.parameters());
  std::string why;
  const std::optional<std::string> digest = certified(options, what, why);
  if (!digest && !options.uncertified) {
    std::fprintf(stderr, "forceshade: refused to drive: %s\n", csv::printable(why).c_str());
    return kFailed;
  }
  if (!digest) std::fprintf(stderr, "*** DRIVING UNCERTIFIED, as told by --uncertified: %s ***\n", csv::printable(why).c_str());

  const std::unique_ptr<device::Device> device = device::open_device(options.device);
  std::optional<RunRecord> record;
  if (!options.record.empty()) record.emplace(options.record, metadata(options, what, digest), !options.unpaced);
  watch_for_interrupt();
  std::optional<LiveView> view;
  if (is_watched()) view.emplace(bar_of(device->capabilities()));
  device::ServoOptions servo{.rate_hz = options.rate,
                             .max_seconds = options.seconds,
                             .paced = !options.unpaced,
                             .cpu = options.cpu,
                             .passivity = controller_named(options.passivity),
                             .patience = options.patience,
                             .dead_man_button = options.dead_man};
  if (record) servo.sinks.push_back(&record->sink());
  if (view) servo.sinks.push_back(&*view);
  const device::ServoResult result = device::run_servo_loop(*device, what.renderer, servo, interrupted());
  view.reset();
  const bool recorded = !record || record->close(std::string(name_of(result.end_reason)));
  if (!options.json.empty()) write_file(options.json, summary(result, what, digest).dump(2) + "\n");
  if (options.record != "-" && options.json != "-") print(result);
  if (result.trip) std::fprintf(stderr, "forceshade: the supervisor stopped the run: %s\n", name_of(result.trip->rule).data());
  if (result.end_reason == device::EndReason::device_fault)
    std::fprintf(stderr, "forceshade: device fault: %s\n", result.fault);
  if (result.trip || result.end_reason == device::EndReason::device_fault) return kDeviceFault;
  return recorded ? kHeld : kBadInput;
}

}  // namespace

void add_drive(CLI::App& app, int& result) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("drive", "Drive a device with a certified renderer");
  const auto law = std::make_shared<LawOptions>(*command, LawOptions::Laws::one, LawOptions::Defaults::thesis);
  const auto height_map = std::make_shared<HeightMapOption>(*command, *law);
  command->add_option("--certificate", options->certificate, "certificate.json of this build")->type_name("FILE");
  command
      ->add_option("--device", options->device,
                   "null; replay:FILE.csv, a recording with columns t_s, x_mm, y_mm, z_mm; simulated[:MODEL[:FILE.csv]], a "
                   "PHANToM (premium-1.5, premium-1.0, omni) in a hand that means to go as recorded, or strokes the bump; or "
                   "phantom[:NAME], a real one through the vendor's driver")
      ->type_name("DEVICE")
      ->required();
  add_number(*command, "--rate", "ticks per second; 1000 unless said", {device::kLowestRateHz, device::kHighestRateHz},
             [options](double rate) { options->rate = rate; });
  add_number(*command, "--seconds", "stop after so many seconds' worth of ticks", kSeconds,
             [options](double seconds) { options->seconds = seconds; });
  add_word(*command, "--passivity", options->passivity,
           "what keeps the force from giving energy: damping, tank (shortens it) or observer (nothing: for measuring)",
           {"damping", "tank", "observer"});
  add_number(*command, "--patience", "for how many seconds ticks may be late before the run is stopped; 0.02 unless said",
             kPatience, [options](double patience) { options->patience = patience; });
  add_whole(*command, "--dead-man", "button of the device to be held down, from 0; else there is no force", kButtons,
            [options](std::uint64_t button) { options->dead_man = static_cast<int>(button); });
  add_whole(*command, "--cpu", "processor to run the loop on; the last one unless said", kProcessors,
            [options](std::uint64_t cpu) { options->cpu = static_cast<int>(cpu); });
  command->add_flag("--unpaced", options->unpaced, "as fast as it goes: for checks, not for hands")
      ->excludes("--cpu")
      ->excludes("--patience");
  command->add_flag("--uncertified", options->uncertified, "drive even where the certificate does not allow it");
  command
      ->add_option("--record", options->record,
                   "every tick: FILE.fsr, a recording that survives a crash; else its CSV, - for standard output")
      ->type_name("FILE");
  command->add_option("--json", options->json, "summary for programs, - for standard output")->type_name("FILE");
  command->callback([options, law, height_map, &result] { result = run(*options, *law, *height_map); });
}

}  // namespace forceshade::apps
