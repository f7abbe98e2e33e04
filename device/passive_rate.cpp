// SPDX-License-Identifier: BSD-3-Clause
#include "device/passive_rate.h"

#include <cmath>

#include "device/simulated/hand.h"
#include "text/number_text.h"

namespace forceshade::device {
std::string words_if_active(double stiffness, const Capabilities& capabilities, double rate) {
  if (!std::isfinite(capabilities.peak_force)) return {};
  const double flesh = Grip{}.flesh_damping, its = static_cast<double>(capabilities.damping);  // N·s/m
  const double needed = 1e3 * stiffness / (2 * rate), there = flesh + its;
  if (needed <= there) return {};
  const std::string damping =
      its > 0 ? std::string(capabilities.model) + " has " + digits(its, 3) : std::string("the device's own is not known");
  return "a stiffness of " + digits(stiffness, 6) + " N/mm at " + digits(rate, 6) +
         " Hz cannot be passive, so a hand may be made to swing: b >= KT/2 takes a damping of " + digits(needed, 3) +
         " N s/m; " + damping + ", and a hand's flesh has some " + digits(flesh, 3) + ". That suffices for " +
         digits(2 * rate * there / 1e3, 3) + " N/mm at this rate, or for this stiffness from " +
         digits(std::ceil(1e3 * stiffness / (2 * there)), 6) + " Hz on";
}

}  // namespace forceshade::device
