// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Two distributions, in binary64, by Boost.Math: the standard normal and chi-square.

namespace forceshade::analysis {

double normal_cdf(double z);

// z of which normal_cdf(z) is `probability`, which lies between 0 and 1; infinite at 0 and 1.
double normal_quantile(double probability);

// The probability that a chi-square variable of so many degrees of freedom (above 0) exceeds `value` (0 or more).
double chi_square_tail(double value, double degrees_of_freedom);

// The number below which a variable with the beta distribution lies with this probability.
double beta_quantile(double probability, double a, double b);

}  // namespace forceshade::analysis
