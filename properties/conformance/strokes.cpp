// SPDX-License-Identifier: BSD-3-Clause
#include "properties/conformance/strokes.h"

#include <cmath>

namespace forceshade::conformance {
namespace {

constexpr int kTicks = 4;  // of a stroke

}  // namespace

Tick Strokes::next() {
  if (coming_.empty()) {
    const properties::Aimed aimed = positions_->next();
    if (!has_damping_) return {aimed};
    if (drawn() % 2 == 0 || !aimed.position.allFinite())
      return {aimed, drawn() % 4 == 0 ? static_cast<std::uint32_t>(drawn() % (kPause + 1)) : 1};
    // Its step is 2^-9 to 1/2 mm long in each coordinate.
    Eigen::Vector3f step;
    for (float& one : step) {
      const std::uint64_t random = drawn();
      one =
          std::ldexp(static_cast<float>(random >> 40U), -25 - static_cast<int>(random % 9)) * (random & 0x100U ? 1.0F : -1.0F);
    }
    for (int to_go = kTicks - 1; to_go >= 0; --to_go) {
      Tick tick{{aimed.position - static_cast<float>(to_go) * step, properties::Aim::volume}};
      tick.periods = to_go == kTicks - 1 ? kPause : 1 + static_cast<std::uint32_t>(drawn() % 8 == 0) * 2;
      coming_.push_back(tick);
    }
    coming_.back().aimed = aimed;
  }
  const Tick tick = coming_.front();
  coming_.pop_front();
  return tick;
}

}  // namespace forceshade::conformance
