// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A recording of another system, judged: fitted on demand, held against the exact forces of a subject where there
// is one, and looked at for what needs no definition.

#include <optional>
#include <string>
#include <vector>

#include "forceshade/checks.h"
#include "forceshade/description.h"
#include "properties/conformance/judge.h"
#include "properties/conformance/recordings/fit.h"
#include "properties/conformance/recordings/invariants.h"
#include "properties/conformance/recordings/recording.h"

namespace forceshade::conformance {

struct RecordingOptions {
  std::optional<Eigen::Matrix3d> turn = {};    // of the recording's axes, where it is given
  std::optional<Eigen::Vector3d> offset = {};  // N, of the force sensor along these axes, the same
  std::optional<double> lag = {};              // s, by which a force comes after its position, the same
  bool fits = false;
  Tolerance tolerance = {};
  double noise = 0;   // N, that a measured force may be off by
  double energy = 0;  // mJ, that a loop may give
  std::uint64_t seed = 1;
};

// The sizes of differences: each is the size that this share of them does not exceed.
struct Spread {
  double half = 0, p90 = 0, p99 = 0, all = 0;
};

// The size of a force and of the exact one, in N; the latter is no number where it is not known.
struct TimedForce {
  double time = 0;  // s, from the first sample on
  double measured = 0, exact = 0;
};

struct SampleComparison {
  Description description;  // with the stiffness that was fitted
  Identity identity;
  Judgement judgement;
  Spread newtons, percent;  // percent of the exact force, of samples that have one
  std::vector<TimedForce> course;
};

struct JudgedRecording {
  std::string file;
  std::size_t samples = 0;
  Pace pace;
  std::optional<Fit> fit = {};
  std::optional<SampleComparison> comparison = {};
  std::vector<Invariant> invariants;

  bool held() const;
};

// description: of the subject, if there is one; a fit needs it. Throws std::invalid_argument and Interrupted.
JudgedRecording judge_recording(const Measurements& measured, const std::optional<Description>& description,
                                const RecordingOptions& options, const Monitor& monitor = {});

}  // namespace forceshade::conformance
