// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The best place of a recording near another, by the method of Levenberg and Marquardt.

#include <Eigen/Core>
#include <limits>
#include <vector>

#include "properties/conformance/recordings/fit_beginning.h"
#include "properties/conformance/recordings/misfit.h"

namespace forceshade::conformance {

// The numbers that are fitted, and the samples that they are fitted to. All of it is to outlive the call.
struct Fitted {
  const Renderer& renderer;
  const Path& path;
  const Samples& samples;
  const Scale& scale;
  const Unknowns& unknowns;
};

struct Solution {
  Placement placement;
  double factor = 1, rms = std::numeric_limits<double>::infinity();  // on the stiffness; N
  Eigen::VectorXd residuals = {};                                    // N, none of them shortened

  Beginning beginning() const { return {placement, factor}; }
};

Solution solution_at(const Fitted& fitted, const Beginning& place);

// The derivatives of the residuals, as Misfit has them.
Eigen::MatrixXd derivatives_at(const Fitted& fitted, const Solution& place);

// most: N, as Misfit has it. tolerance: by which share numbers and residuals may still change in the last step.
Solution solved(const Fitted& fitted, const Beginning& from, double most, double tolerance);

// Those that differ by more than the accuracy of a beginning, the best one first.
std::vector<Solution> different(std::vector<Solution> all);

}  // namespace forceshade::conformance
