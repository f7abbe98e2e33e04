// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The invariants of a recording, without a definition and, where there is one, with the exact forces beside it.

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "properties/conformance/invariants/invariant.h"
#include "properties/conformance/recordings/recording.h"

namespace forceshade::conformance {

struct Pace {
  double seconds = 0, rate = 0;                         // from the first to the last sample; Hz, of the median interval
  double rate_of_positions = 0;                         // Hz, at which a hand that moves has new ones; 0 if it never moves
  double median = 0, p99 = 0, longest = 0, jitter = 0;  // s, of the intervals; jitter: their mean distance from the median
  std::size_t repeats = 0;                              // samples at the position of the one before
  double noise = 0;                                     // N, root mean square of what the force changed by at these
};

// mm: the median of the steps that are not zero; 0 of a hand that never moves.
double usual_step_of(const Measurements& measured);

Pace pace_of(const Measurements& measured);

// The deviations that are allowed.
struct Allowed {
  double force = 0;   // N, that a measured force may be off by
  double energy = 0;  // mJ, that a loop may give
};

// The exact force (N) at each sample where it is known; empty where there is no definition.
using ExactForces = std::vector<std::optional<Eigen::Vector3d>>;

std::vector<Invariant> invariants_of(const Measurements& measured, const ExactForces& exact, const Allowed& allowed);

// The two of energy, which are among those.
std::vector<Invariant> energy_invariants_of(const Measurements& measured, const ExactForces& exact, const Allowed& allowed);

// The stays of a recording at one position: a hand at rest, a sensor with coarse steps, or samples that were repeated.

// The longest time that a force may be held without a new position.
inline constexpr double kLongestHold = 0.01;  // s

// Samples first to last are at one position, and those beside them at others. Where all samples were copied, and noise was
// added to them, they are nearly at one.
struct Stay {
  std::size_t first, last;
};

class Stays {
 public:
  // measured is to outlive this.
  explicit Stays(const Measurements& measured);
  explicit Stays(Measurements&&) = delete;

  // In their order, also those of one sample.
  const std::vector<Stay>& all() const { return stays_; }

  // Samples that were repeated while the hand moved on: it then is where it would have been at the speed that it had before.
  // That is not known of the first position and of the last one, of a hand slower than half of what is usual, and of steps no
  // larger than a few of the smallest ones, since a slow hand stays between two steps of a sensor, too.
  bool is_stale(const Stay& stay) const;

  // From its first sample to that of the next position; for more than kLongestHold.
  double seconds(const Stay& stay) const;
  bool is_long(const Stay& stay) const;

  // mm, between this position and the one before or after it.
  double step_before(const Stay& stay) const { return step(stay.first); }
  double step_after(const Stay& stay) const { return step(stay.last + 1); }

  // Hz, of new positions. A long stay that is not stale is a hand at rest, and is left out. 0 where nothing is left.
  double rate() const;

 private:
  void divide(double nearly);        // at steps of more mm
  double step(std::size_t i) const;  // mm, to a sample from the one before
  bool has_neighbours(const Stay& stay) const { return stay.first > 0 && stay.last + 1 < samples_.size(); }
  bool are_copied() const;

  const std::vector<Measured>& samples_;
  std::vector<Stay> stays_;
  double usual_speed_ = 0, small_step_ = 0;  // mm/s, mm
  bool are_copied_ = false;                  // all positions, from data of a lower rate
};

}  // namespace forceshade::conformance
