// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A third-party renderer, held against the exact definition and against what needs no definition.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "forceshade/checks.h"
#include "forceshade/description.h"
#include "forceshade/identity.h"
#include "properties/conformance/invariants/invariant.h"
#include "properties/conformance/judge.h"
#include "properties/conformance/renderer_under_test.h"
#include "properties/conformance/timing.h"

namespace forceshade::conformance {

struct ConformOptions {
  std::uint64_t points = 20000, seed = 1;
  Tolerance tolerance = {};
  bool is_timed = false;                    // the time of an answer is measured
  std::optional<double> most_seconds = {};  // that one may take; then a slower one fails
};

struct Conformance {
  Identity identity = {};  // of the scene
  Hello hello;
  Judgement judgement;  // without cases where the renderer does not claim the definition
  // The shortest path, in mm, at whose end the answer was found to be beyond the tolerance; one position of a renderer without
  // memory.
  std::vector<Eigen::Vector3f> shortest_path;
  std::vector<std::uint32_t> periods_of_shortest_path;  // of a renderer with damping: those before each position
  std::optional<Judged> counterexample = {};            // the answer there
  std::vector<Invariant> invariants;
  std::optional<Timing> timing = {};        // where it was requested
  std::optional<std::string> failure = {};  // that ended the run

  bool is_applicable() const { return !hello.refusal; }
  bool held() const;  // all that is applicable
};

// Requests the renderer's forces at positions of the subject, in paths, and judges each answer where the renderer claims the
// definition; then looks at the invariants. A renderer that fails ends the run. Throws Interrupted, and Error for a
// tolerance that has no meaning for its units.
Conformance conform(const Description& description, const OpenRenderer& open, const ConformOptions& options,
                    const Monitor& monitor = {});

}  // namespace forceshade::conformance
