// SPDX-License-Identifier: BSD-3-Clause
// forceshade drive: run a certified renderer on a device, and refuse one that is not certified.

#include <openssl/sha.h>

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "forceshade/apps/command.h"
#include "forceshade/csv/csv.h"
#include "forceshade/device/open_device.h"
#include "forceshade/device/servo_loop.h"
#include "forceshade/properties/build.h"
#include "forceshade/properties/certificate.h"
#include "forceshade/recorder/recorder.h"

namespace forceshade::apps {
namespace {

struct Options {
  std::string certificate, device, record, json;
  double rate = 1000;
  std::optional<double> seconds;
  bool unpaced = false, uncertified = false;
};

std::string sha256(const std::string& text) {
  unsigned char digest[SHA256_DIGEST_LENGTH];
  SHA256(reinterpret_cast<const unsigned char*>(text.data()), text.size(), digest);
  std::string hex;
  for (const unsigned char byte : digest) {
    char pair[3];
    std::snprintf(pair, sizeof pair, "%02x", byte);
    hex += pair;
  }
  return hex;
}

// The certificate's digest; nothing where there is none or it does not cover what is to be driven, with the reason why.
std::optional<std::string> certified(const Options& options, LawId law, const Parameters& parameters, std::string& why) {
  if (options.certificate.empty()) {
    why = "no certificate was given; expected --certificate FILE, as written by 'forceshade certify'";
    return std::nullopt;
  }
  const std::string text = read_file(options.certificate);
  const properties::Certificate certificate = properties::from_json(text, options.certificate);
  const auto refused = properties::refusal(certificate, properties::current_build(), law, parameters);
  if (!refused) return sha256(text);
  why = options.certificate + ": " + *refused;
  return std::nullopt;
}

void print(const device::ServoResult& run) {
  std::printf("ticks             %zu (%s)\n", run.ticks, std::string(name_of(run.end_reason)).c_str());
  std::printf("rate              %.1f Hz\n", run.achieved_rate_hz);
  std::printf("missed deadlines  %zu\n", run.missed_deadlines);
  std::printf("compute time      worst %.1f us, 99.9 %% %.1f us, 99 %% %.1f us, median %.1f us\n", run.compute_us.max,
              run.compute_us.p999, run.compute_us.p99, run.compute_us.p50);
  std::printf("peak force        %.3f N\n", run.peak_force_N);
  std::printf("energy            %.3f mJ given to the hand, %.3f mJ taken from it\n", run.energy_given_mJ, run.energy_taken_mJ);
  if (run.invalid_positions > 0) std::printf("invalid positions %zu (zero force)\n", run.invalid_positions);
  std::printf("scheduling        %s, memory %s\n", run.realtime_scheduling ? "real-time (SCHED_FIFO)" : "ordinary",
              run.memory_locked ? "locked" : "not locked");
}

nlohmann::ordered_json summary(const device::ServoResult& run, LawId law, const Parameters& p,
                               const std::optional<std::string>& digest) {
  nlohmann::ordered_json parameters{{"stiffness_N_per_mm", static_cast<double>(p.stiffness)}};
  if (has_bump_geometry(law)) {
    parameters["radius_mm"] = static_cast<double>(p.radius);
    parameters["width_mm"] = static_cast<double>(p.width);
  }
  return {
      {"law", name_of(law)},
      {"parameters", parameters},
      {"certificate_digest", digest ? nlohmann::ordered_json(*digest) : nlohmann::ordered_json(nullptr)},
      {"library_digest", properties::current_build().library_digest},
      {"end_reason", name_of(run.end_reason)},
      {"ticks", run.ticks},
      {"missed_deadlines", run.missed_deadlines},
      {"invalid_positions", run.invalid_positions},
      {"rate_hz", run.achieved_rate_hz},
      {"compute_us",
       {{"p50", run.compute_us.p50}, {"p99", run.compute_us.p99}, {"p999", run.compute_us.p999}, {"max", run.compute_us.max}}},
      {"peak_force_N", run.peak_force_N},
      {"energy_given_mJ", run.energy_given_mJ},
      {"energy_taken_mJ", run.energy_taken_mJ},
      {"realtime_scheduling", run.realtime_scheduling},
      {"memory_locked", run.memory_locked}};
}

recorder::Metadata metadata(const Options& options, LawId law, const Parameters& p, const std::optional<std::string>& digest) {
  const properties::Build build = properties::current_build();
  recorder::Metadata metadata{{"law", std::string(name_of(law))},
                              {"stiffness_N_per_mm", csv::shortest(p.stiffness)},
                              {"certificate_digest", digest.value_or("none")},
                              {"library_digest", build.library_digest},
                              {"version", build.version},
                              {"revision", build.revision},
                              {"compiler", build.compiler},
                              {"flags", build.flags},
                              {"instruction_set", build.instruction_set},
                              {"device", options.device},
                              {"rate_hz", csv::shortest(options.rate)},
                              {"paced", options.unpaced ? "no" : "yes"}};
  if (has_bump_geometry(law)) {
    metadata["radius_mm"] = csv::shortest(p.radius);
    metadata["width_mm"] = csv::shortest(p.width);
  }
  return metadata;
}

// Whether the disk took every tick; says so where it did not.
bool finish(recorder::Recorder& recording, const Options& options, const device::ServoResult& run) {
  const auto [written, lost, error] = recording.close(std::string(name_of(run.end_reason)));
  if (lost == 0 && error.empty()) return true;
  const std::string why = error.empty() ? options.record + ": the disk was too slow" : error;
  std::fprintf(stderr, "forceshade: %s; recorded %llu samples, lost %llu\n", why.c_str(),
               static_cast<unsigned long long>(written), static_cast<unsigned long long>(lost));
  return false;
}

int run(const Options& options, const LawOptions& law_options) {
  const LawId id = law_options.law();
  const Parameters parameters = law_options.parameters();
  std::string why;
  const std::optional<std::string> digest = certified(options, id, parameters, why);
  if (!digest && !options.uncertified) {
    std::fprintf(stderr, "forceshade: refused to drive: %s\n", why.c_str());
    return kFailed;
  }
  if (!digest) std::fprintf(stderr, "*** DRIVING UNCERTIFIED, as told by --uncertified: %s ***\n", why.c_str());

  const std::unique_ptr<device::Device> device = device::open_device(options.device);
  const auto law = std::get<fast::Law>(fast::Law::build(id, parameters));
  std::optional<recorder::Recorder> recording;
  if (options.record.ends_with(".fsr")) recording.emplace(options.record, metadata(options, id, parameters, digest));
  watch_for_interrupt();
  const device::ServoResult result = device::run_servo_loop(*device, law,
                                                            {.rate_hz = options.rate,
                                                             .max_seconds = options.seconds,
                                                             .paced = !options.unpaced,
                                                             .sink = recording ? &*recording : nullptr},
                                                            interrupted());
  if (!options.record.empty() && !recording) device::write_record(result.record, options.record);
  if (!options.json.empty()) write_file(options.json, summary(result, id, parameters, digest).dump(2) + "\n");
  if (options.record != "-" && options.json != "-") print(result);
  const bool recorded = !recording || finish(*recording, options, result);
  if (result.end_reason != device::EndReason::device_fault) return recorded ? kHeld : kBadInput;
  std::fprintf(stderr, "forceshade: device fault: %s\n", result.fault);
  return kDeviceFault;
}

}  // namespace

void add_drive(CLI::App& app, int& result) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("drive", "Drive a device with a certified renderer");
  const auto law = std::make_shared<LawOptions>(*command, LawOptions::Laws::one, LawOptions::Defaults::thesis);
  command->add_option("--certificate", options->certificate, "certificate.json of this build")->type_name("FILE");
  command
      ->add_option("--device", options->device,
                   "null; replay:FILE.csv, a recording with columns t_s, x_mm, y_mm, z_mm; simulated[:MODEL[:FILE.csv]], a "
                   "PHANToM (premium-1.5, premium-1.0, omni) in a hand that means to go as recorded, or strokes the bump; or "
                   "phantom[:NAME], a real one through the vendor's driver")
      ->type_name("DEVICE")
      ->required();
  command->add_option("--rate", options->rate, "ticks per second")
      ->type_name("HZ")
      ->check(CLI::Range(device::kLowestRateHz, device::kHighestRateHz))
      ->capture_default_str();
  command->add_option("--seconds", options->seconds, "stop after so many seconds' worth of ticks")
      ->type_name("N")
      ->check(CLI::PositiveNumber);
  command->add_flag("--unpaced", options->unpaced, "as fast as it goes: for checks, not for hands");
  command->add_flag("--uncertified", options->uncertified, "drive even where the certificate does not allow it");
  command
      ->add_option("--record", options->record,
                   "every tick: FILE.fsr, a recording that survives a crash; else CSV, - for standard output")
      ->type_name("FILE");
  command->add_option("--json", options->json, "summary for programs, - for standard output")->type_name("FILE");
  command->callback([options, law, &result] { result = run(*options, *law); });
}

}  // namespace forceshade::apps
