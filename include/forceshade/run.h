// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A certified run: the servo loop with a rendering, recorded, and refused where no certificate covers it. The library is
// forceshade::run, of the component run; it links nothing of the exact side.
//
//   const Rendering bump = std::get<Rendering>(rendering_of(LawId::bump_2p, {15.24F, 25.4F, 0.5F}));
//   const run::Certified covered = run::certified("certificate.json", bump.identity);
//   if (!covered.digest) throw std::runtime_error(covered.why_not);
//   const auto device = device::open_device("phantom");
//   const std::atomic<bool> stop = false;
//   const run::Outcome outcome = run::run(*device, bump, {.device = "phantom", .digest = covered.digest, .record = "run.fsr"},
//   stop);
//
// Lengths are in mm, forces in N, times in s.
//
// Errors: certified() and run() throw std::runtime_error before the first tick alone; afterwards Outcome says how the run
// ended.
//
// Threads: run() owns the device until it returns; `stop` may be set by any thread or a signal handler. certified() keeps no
// state.
//
// Not promised: that run() looks at the certificate. A run without one leaves Plan::digest empty, which the record has.

#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "forceshade/device.h"
#include "forceshade/identity.h"
#include "forceshade/renderer.h"
#include "forceshade/servo_loop.h"

namespace forceshade::run {

// The verdict on a certificate for what is to be driven.
struct Certified {
  std::optional<std::string> digest;  // SHA-256 of the certificate's file, in hex; none where it does not cover the rendering
  std::string why_not;                // then the reason
};

// file: certificate.json, as `forceshade certify` or certify() writes it; an empty name is no file. The certificate has to be
// of this build, of a rendering with this identity, and sufficient. Throws std::runtime_error for a file that is no
// certificate.
Certified certified(const std::string& file, const Identity& rendering);

// The place where a rendering is driven, its certificate, and what is kept of the run.
struct Plan {
  std::string device;                 // its name, for the record and the summary
  std::optional<std::string> digest;  // of the certificate: certified(). None is an uncertified run, which its record then says
  std::string record = {};            // FILE.fsr, FILE.npy or else CSV; - is CSV on standard output; empty: no recording
  bool overwrite = false;             // a recording that is there already
  device::ServoOptions servo = {};
};

// The damping of such a run, at the rate of its loop: that of the rendering, or where it has none that of the loop's options.
damping::Parameters damping_of(const Rendering& what, const device::ServoOptions& servo);

// The outcome of a run.
struct Outcome {
  device::ServoResult result;
  std::vector<device::Sample> last_ticks;  // those of its last 0.2 s, where the supervisor or a fault of the device ended it
  std::vector<std::string> record_faults;  // why the record lacks ticks; empty where it has all
};

// True if the supervisor or a fault of the device ended it.
bool has_failed(const device::ServoResult& result);

// Blocks until the run is over; stop ends it in order, with zero force, from any thread or signal. Throws
// std::runtime_error for another rate than the rendering's and for a record that cannot be begun, and Interrupted where stop
// was set before.
Outcome run(device::Device& device, const Rendering& what, const Plan& plan, const std::atomic<bool>& stop);

// The summary of a run for programs, as a text in JSON: what was rendered, where, and what came of it (run/summary.md).
// signal: the one that ended the run; empty: no signal.
std::string summary_text(const Outcome& outcome, const Rendering& what, const Plan& plan,
                         const device::Capabilities& capabilities, const std::string& signal = "");

}  // namespace forceshade::run
