// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Parameters from all of the domain, for what a certificate checks besides the given ones.

#include <cstdint>
#include <random>

#include "forceshade/law.h"

namespace forceshade::properties {

// Repeatable. Each number is spread evenly over the binades of its domain. Of eight sets, six have numbers of all 24 bits, so
// that products round; one has numbers of at most 6 bits; and one is a bump whose depth of axis is rational too, on which ties
// and exact contacts are common. In one of eight, one number is an end of its domain.
class ParameterSource {
 public:
  explicit ParameterSource(std::uint64_t seed) : random_(seed) {}

  Parameters next();

 private:
  void make_rational(Parameters& p);
  float drawn(float low, float high, bool few_bits);
  double uniform(double low, double high);

  std::mt19937_64 random_;
};

}  // namespace forceshade::properties
