// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A renderer of anybody's, held against the exact definition and against what needs no definition.

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "forceshade/checks.h"
#include "forceshade/properties.h"
#include "properties/conformance/judge.h"
#include "properties/conformance/renderer_under_test.h"

namespace forceshade::conformance {

struct ConformOptions {
  std::uint64_t points = 20000, seed = 1;
  Tolerance tolerance = {};
};

// One invariant: what needs no definition.
struct Invariant {
  std::string name;
  std::uint64_t cases = 0;
  std::optional<std::string> violation = {};  // the first case, with what a hand would feel
};

struct Conformance {
  Hello hello;
  Judgement judgement;
  // The shortest path, in mm, at whose end the answer was found to be beyond the tolerance; one position of a renderer without
  // memory. Its simplest case is the judgement's.
  std::vector<Eigen::Vector3f> shortest_path;
  std::vector<Invariant> invariants;
  std::optional<std::string> failure = {};  // that ended the run

  bool is_applicable() const { return !hello.refusal; }
  bool held() const;
};

// Asks the renderer for its forces at positions of the subject, in paths, and looks at each answer; then for the invariants. A
// renderer that fails ends the run. Throws Interrupted.
Conformance conform(const std::shared_ptr<const properties::Subject>& subject, const OpenRenderer& open,
                    const ConformOptions& options, const Monitor& monitor = {});

}  // namespace forceshade::conformance
