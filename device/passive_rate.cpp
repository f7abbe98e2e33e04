// SPDX-License-Identifier: BSD-3-Clause
#include "device/passive_rate.h"

#include <cmath>

#include "device/simulated/hand.h"
#include "text/number_text.h"

namespace forceshade::device {
namespace {

constexpr double kLargestStep = 0.02;  // N

std::string words_of_counts(const Capabilities& capabilities, const damping::Parameters& damping) {
  const double step = static_cast<double>(damping.larger()) * static_cast<double>(damping.share) *
                      static_cast<double>(damping.rate) * static_cast<double>(capabilities.resolution);
  if (!(step > kLargestStep)) return {};
  return "one count of the device, " + digits(static_cast<double>(capabilities.resolution), 3) +
         " mm, changes the damped force by " + digits(step, 3) +
         " N, which may be felt as chatter; with a smaller share of "
         "the filter, or less damping, it is less";
}

}  // namespace

std::string words_if_active(double stiffness, const Capabilities& capabilities, double rate,
                            const damping::Parameters& damping) {
  if (!std::isfinite(capabilities.peak_force)) return {};
  const double flesh = Grip{}.flesh_damping, its = static_cast<double>(capabilities.damping);  // N·s/m
  const double sampled =
      1e3 * damping::sampling_factor(static_cast<double>(damping.share)) * static_cast<double>(damping.larger());
  const double needed = 1e3 * stiffness / (2 * rate) + sampled, there = flesh + its, left = there - sampled;
  const std::string counts = words_of_counts(capabilities, damping);
  if (needed <= there) return counts;
  const std::string own =
      its > 0 ? std::string(capabilities.model) + " has " + digits(its, 3) : std::string("the device's own is not known");
  const std::string with = sampled > 0 ? " with a damping of " + shortest(damping.larger()) + " N s/mm" : std::string(),
                    more = sampled > 0 ? " + " + digits(sampled, 3) + " N s/m" : std::string();
  return "a stiffness of " + digits(stiffness, 6) + " N/mm at " + digits(rate, 6) + " Hz" + with +
         " cannot be passive, so a hand may be made to swing: b >= KT/2" + more + " takes a damping of " + digits(needed, 3) +
         " N s/m; " + own + ", and a hand's flesh has some " + digits(flesh, 3) + ". That suffices for " +
         (left > 0 ? digits(2 * rate * left / 1e3, 3) + " N/mm at this rate, or for this stiffness from " +
                         digits(std::ceil(1e3 * stiffness / (2 * left)), 6) + " Hz on"
                   : std::string("no stiffness with this damping")) +
         (counts.empty() ? "" : "; besides, " + counts);
}

}  // namespace forceshade::device
