// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The errors of a fit's numbers that its samples leave.

#include <Eigen/Core>
#include <vector>

#include "properties/conformance/recordings/recording.h"

namespace forceshade::conformance {

struct FitErrors {
  Eigen::VectorXd error;  // of each number, in its unit
  Eigen::VectorXd free;   // from 0 to 1: how much of each number the samples do not determine
};

// derivatives: of the residuals (N, three of each sample, in the order of time), by the numbers in their units, each of which
// changes the forces by about themselves. force: N, root mean square of a sample. rounding: N, the worst that one residual may
// be off by in the same sense as all others.
//
// A direction of the numbers is not determined if moving by its unit changes forces by less than 1 %, or by less than ten
// standard deviations of one residual. The errors of the others are four standard errors, or what is as likely in Student's
// distribution of as many independent samples, with the largest of three variances: that of independent residuals, times how
// many samples their autocorrelation lasts; that of what each sample pushes the numbers by, so that noise which is larger in
// contact counts where it is, times the same; and that of Newey and West, which sums the products of neighbours' pushes.
FitErrors fit_errors_of(const Eigen::MatrixXd& derivatives, const Eigen::VectorXd& residuals, double force, double rounding);

// The most (s) by which a fit's lag is pulled towards the middle between two samples: a spline through noisy positions has less
// noise there than at a sample. slopes: of the residuals by the lag, 0 where there is no force, so that the residuals there are
// the noise of forces, and what those in contact have more is that of positions.
double pull_of_noisy_positions(const Eigen::VectorXd& slopes, const Eigen::VectorXd& residuals,
                               const std::vector<Measured>& samples);

// The derivatives, with zeros for the samples whose force, which is the first column, is at most `least` (N).
Eigen::MatrixXd without_weak_forces(Eigen::MatrixXd derivatives, double least);

}  // namespace forceshade::conformance
