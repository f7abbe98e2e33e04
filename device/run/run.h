// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A certified run: the servo loop with a rendering, recorded, and refused where no certificate covers it.
//
//   const Rendering bump = std::get<Rendering>(rendering_of(LawId::bump_2p, {15.24F, 25.4F, 0.5F}));
//   const run::Certified covered = run::certified("certificate.json", bump.identity);
//   if (!covered.digest) throw std::runtime_error(covered.why_not);
//   const auto device = device::open_device("phantom");
//   const std::atomic<bool> stop = false;
//   const run::Outcome outcome = run::run(*device, bump, {.device = "phantom", .digest = covered.digest, .record = "run.fsr"},
//   stop);

#include <atomic>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "device/device.h"
#include "device/run/certified.h"
#include "device/sample.h"
#include "device/servo_loop.h"
#include "rendering/renderer/rendering.h"

namespace forceshade::run {

struct Plan {
  std::string device;                 // its name, for the record and the summary
  std::optional<std::string> digest;  // of the certificate: certified(). None is an uncertified run, which its record then says
  std::string record = {};            // FILE.fsr, FILE.npy or else CSV; - is CSV on standard output; empty is none
  bool overwrite = false;             // a recording that is there already
  device::ServoOptions servo = {};
};

struct Outcome {
  device::ServoResult result;
  std::vector<device::Sample> last_ticks;  // those of its last 0.2 s, where the supervisor or a fault of the device ended it
  std::vector<std::string> record_faults;  // why the record lacks ticks; empty where it has all
};

// Whether the supervisor or a fault of the device ended it.
bool has_failed(const device::ServoResult& result);

// Blocks until the run is over; stop ends it in order, with zero force, from any thread or signal. Throws
// recorder::RecordingError and files::OutputError for a record that cannot be begun, and Interrupted where stop was set before.
Outcome run(device::Device& device, const Rendering& what, const Plan& plan, const std::atomic<bool>& stop);

// For programs: what was rendered, where, and what came of it (device/run/summary.md). signal: the one that ended the run; empty
// is none.
nlohmann::ordered_json summary(const Outcome& outcome, const Rendering& what, const Plan& plan,
                               const device::Capabilities& capabilities, const std::string& signal = "");

}  // namespace forceshade::run
