// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The stays of a recording at one position: a hand at rest, a sensor with coarse steps, or samples that were repeated.

#include <cstddef>
#include <vector>

#include "properties/conformance/recordings/recording.h"

namespace forceshade::conformance {

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
