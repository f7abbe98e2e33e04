// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Makes certificates: checks a renderer against the exact definition at many points, runs the properties, and writes down what
// was found. The library is forceshade::certify, of the component properties.
//
//   const auto wall = std::shared_ptr(properties::law_subject(LawId::wall, {.stiffness = 0.5F}));  // N/mm
//   const std::atomic<bool> stop = false;
//   const auto certificate = properties::certify({.subjects = {wall}, .points = 10000}, [](auto, double) {}, stop);
//   if (certificate) std::puts(properties::to_json(*certificate).c_str());
//
// Errors: a failed check is a result, Certificate::held(); under a fast::arithmetic_fault() certify() throws
// std::runtime_error. assessed() of certificate.h tells if a certificate is too little for driving. A certificate of
// a program's own renderer or subject says so, and permits no driving of what the library renders.
//
// Threads: certify() uses as many threads as its options say. `stop` may be set by any thread or a signal handler.
//
// Not promised: how long it takes; the seconds are in the certificate. The same seed gives the same points and cases.

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "forceshade/certificate.h"
#include "forceshade/properties.h"

namespace forceshade::properties {

struct CertifyOptions {
  std::vector<std::shared_ptr<const Subject>> subjects;
  std::uint64_t points = points_of_kind(kLawKind);  // per subject; and a quarter as many with drawn parameters
  int cases = static_cast<int>(kCases);             // per property
  std::uint64_t seed = 0;
  unsigned threads = 1;
  // Called before each case of a property with the subject, the property, and the share of it that is done.
  std::function<void(std::string_view subject, const std::string& property, double done)> on_case = {};
};

// done in [0, 1]; called from one thread at a time.
using Progress = std::function<void(std::string_view name, double done)>;

// The points do not depend on the number of threads. Empty when `stop` was set before the end. Throws
// std::runtime_error on a fast::arithmetic_fault(): the threads inherit it.
std::optional<Certificate> certify(const CertifyOptions& options, const Progress& progress, const std::atomic<bool>& stop);

// Exhaustive sweeps.

// All sweeps of one law and kind together.
struct SweepTotal {
  LawId law;
  SweepKind kind;
  std::vector<float> radii;  // mm; none for the wall
  std::uint64_t sweeps = 0, inputs = 0, mismatches = 0;
};
std::vector<SweepTotal> totals(const Sweeps& sweeps);

// The kinds to sweep; line and column go together.
struct SweepPlan {
  std::vector<LawId> laws;
  Parameters parameters;     // width and stiffness of all, radius of lines and columns
  std::vector<float> radii;  // mm: of directions and heights
  bool directions = true, heights = true, lines = true;
};

// Throws std::invalid_argument naming the parameter if one is outside the domain of one of the laws.
Sweeps planned(const SweepPlan& plan);

// A plan: what certify() does, or sweeps, divided into units of work in a folder, which any number of processes and machines
// do.
//
//   make_plan("plan", {.subject = {{"law", "wall"}}}, stop);
//   work_on_plan("plan", {.threads = 8}, stop);
//   const MergedPlan merged = merged_plan("plan", stop);  // merged.state.missing is empty: the certificate is whole

struct PlanRequest {
  std::vector<std::pair<std::string, std::string>> subject = {};  // options of docs/subjects.md; empty: the sweeps
  std::uint64_t points = 0;                                       // 0: those of the subject's kind
  std::uint64_t cases = kCases, seed = 1;
  SweepPlan sweeps{{}, {}, {}};
  std::uint64_t units = 1000;  // about how many
  std::uint64_t lease = 300;   // s: after which the units of a process that gives no sign of life are taken by others
};

struct PlanState {
  std::string digest;  // of the plan
  std::uint64_t units = 0, done = 0, taken = 0;
  std::uint64_t expired = 0;             // units that were taken, and whose lease ran out
  std::string missing = {};              // "units 3 to 7, 9 of 20"; empty where all are done
  std::vector<std::string> alarms = {};  // files that differ from the result of the same unit: one machine computes wrongly
};

struct PlanWorker {
  unsigned threads = 1;
  bool waits = true;                               // for units that others have taken
  std::function<void(double done)> progress = {};  // of the plan, in [0, 1]; called from one thread at a time
};

struct Worked {
  std::uint64_t units = 0, alarms = 0;  // alarms: units of which another result was there
  bool is_complete = false;             // every unit has a result
};

struct MergedPlan {
  PlanState state;
  Certificate certificate;  // from the units that are done; empty where there are alarms
};

// Each throws Error, naming the option or file, where the subject, the folder, a result or the build is not what it should be,
// or a file cannot be written. make_plan() and work_on_plan() throw Interrupted where `stop` was set while a mesh was checked.
PlanState make_plan(const std::string& folder, const PlanRequest& request, const std::atomic<bool>& stop);
PlanState state_of_plan(const std::string& folder, const std::atomic<bool>& stop);
Worked work_on_plan(const std::string& folder, const PlanWorker& worker, const std::atomic<bool>& stop);
MergedPlan merged_plan(const std::string& folder, const std::atomic<bool>& stop);

}  // namespace forceshade::properties
