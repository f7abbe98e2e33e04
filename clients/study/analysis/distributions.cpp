// SPDX-License-Identifier: BSD-3-Clause
#include "study/analysis/distributions.h"

#include <boost/math/special_functions/beta.hpp>
#include <boost/math/special_functions/erf.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <limits>
#include <numbers>

namespace forceshade::analysis {
namespace {

// No promotion to long double: its precision is not needed here, and differs between machines.
using InDouble = boost::math::policies::policy<boost::math::policies::promote_double<false>>;

}  // namespace

double normal_cdf(double z) {
  return boost::math::erfc(-z / std::numbers::sqrt2, InDouble()) / 2;
}

double normal_quantile(double probability) {
  if (probability <= 0) return -std::numeric_limits<double>::infinity();
  if (probability >= 1) return std::numeric_limits<double>::infinity();
  return -std::numbers::sqrt2 * boost::math::erfc_inv(2 * probability, InDouble());
}

double chi_square_tail(double value, double degrees_of_freedom) {
  return boost::math::gamma_q(degrees_of_freedom / 2, value / 2, InDouble());
}

double beta_quantile(double probability, double a, double b) {
  return boost::math::ibeta_inv(a, b, probability, InDouble());
}

}  // namespace forceshade::analysis
