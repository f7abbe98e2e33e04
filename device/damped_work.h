// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The work of damped forces on the hand in the three parts of docs/damping.md: in binary64 in the loop, in rational numbers
// where it is to be exact.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>

#include "forceshade/damping.h"
#include "forceshade/law.h"

namespace forceshade::device {

// A tick's position, mm, the force without and with damping, N, and the velocity of the damper, mm/s.
struct DampedTick {
  Eigen::Vector3f position, spring, damped;
  std::array<float, 3> velocity;
};

template <class Number>
struct DampedWork {
  Number spring{0}, damper{0}, sampling{0};  // mJ
  Number squares{0};                         // mm², the sum of the squares of the hand's steps

  // From the tick before to this one, in which the force of that tick was held. periods: those between the two. Nothing, for a
  // position that is invalid, ends what can be counted until the next one.
  void add(const std::optional<DampedTick>& tick, std::uint32_t periods, float rate) {
    for (Eigen::Index i = 0; before_ && tick && i < 3; ++i) {
      const auto number = [](float value) { return Number(static_cast<double>(value)); };
      const Number way = number(tick->position(i)) - number(before_->position(i)), force = number(before_->spring(i)),
                   added = number(before_->damped(i)) - force,
                   own = number(before_->velocity[static_cast<std::size_t>(i)]) * Number(periods) / number(rate);
      spring += force * way;
      damper += added * own;
      sampling += added * (way - own);
      squares += way * way;
    }
    is_even_ = is_even_ && tick && (!before_ || periods == 1);
    before_ = tick;
  }

  // The most that damper and sampling give together, mJ: γ (B/T) times the squares. NaN where a tick was late or invalid, for
  // which nothing is proved.
  double most(const damping::Parameters& parameters) const {
    if (!is_even_) return std::numeric_limits<double>::quiet_NaN();
    return damping::sampling_factor(static_cast<double>(parameters.share)) * static_cast<double>(parameters.larger()) *
           static_cast<double>(parameters.rate) * static_cast<double>(squares);
  }

 private:
  std::optional<DampedTick> before_;
  bool is_even_ = true;
};

}  // namespace forceshade::device
