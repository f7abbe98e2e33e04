// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Positions by bit pattern over all binades, and positions aimed at whatever is hard for a law.

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <random>

#include "forceshade/properties.h"
#include "properties/law_claims.h"
#include "reference/position.h"
#include "rendering/breakdown.h"

namespace forceshade::properties {

inline constexpr std::size_t kAims = kAimNames.size();

// True if the position is in the domain, as the definition states it.
inline bool is_valid(const Eigen::Vector3f& position) {
  return reference::in_domain(position);
}

// The number of it that is nearest, mm.
inline double kept_in_domain(double coordinate) {
  constexpr auto kEnd = static_cast<double>(reference::kDomainEnd);
  return std::clamp(coordinate, -kEnd, kEnd);
}

// Numbers of the kinds that positions are made of, repeatable.
class Draws {
 public:
  explicit Draws(std::uint64_t seed) : random_(seed) {}

  std::uint64_t bits() { return random_(); }
  double uniform(double low, double high);
  int small_step();    // -3 to 3
  float any_float();   // any bits
  float any_binade();  // 2^-30 to 16 mm, every binade as likely
  float few_bits(double reach);
  float tiny();        // within three steps of the position quantum
  float domain_end();  // of an end of the domain

 private:
  std::mt19937_64 random_;
};

// Half by bit pattern or spread over the working volume, half aimed at surface neighbours,
// facet lines, the position quantum, domain ends, rounding ties, the axis, and numbers of few bits (which make exact ties).
class PositionSource final : public Positions, private Draws {
 public:
  PositionSource(const reference::Law& law, std::uint64_t seed) : Draws(seed), law_(law), claims_(law) {}

  Aimed next() override;

 private:
  float in_volume_x();
  float near_surface(float x);
  float near_line();
  Eigen::Vector3f near_tie(Eigen::Vector3f position);

  reference::Law law_;
  LawClaims claims_;
};

}  // namespace forceshade::properties
