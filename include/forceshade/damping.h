// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Damping behind any renderer: its parameters and its state, numbers only. Their meaning: docs/damping.md.
//
//   const damping::Parameters oil{.rate = 1000, .damping = 0.002F};  // Hz, N·s/mm
//   auto damping = std::get<fast::Damping>(fast::Damping::build(oil));
//   const auto law = std::get<fast::Law>(fast::Law::build(LawId::wall, {.stiffness = 0.5F}));
//   for (const Eigen::Vector3f& position : {Eigen::Vector3f(0, 0, 0.1F), Eigen::Vector3f(0, 0, -0.2F)}) {
//     const fast::Evaluation damped = damping.tick(position, 1, law.evaluate(position));  // (0, 0, 0.2) N at last
//     std::printf("%g N\n", double{damped.force.z()});
//   }
//
// Forces are in N, positions in mm, velocities in mm/s, damping in N·s/mm. fast::Damping of fast.h damps in real time,
// reference::Damping of reference.h defines the force; both look whether the parameters are in their ranges.
//
// Not promised: that a device with these parameters is passive or stable.

#include <array>
#include <cmath>
#include <cstdint>

namespace forceshade::damping {

// The share of a filter with a time constant: the binary32 number nearest to 1/(1 + rate * time). rate: Hz, time: s, positive.
inline float share_of(float rate, float time) noexcept {
  const double product = double{rate} * double{time};  // exact
  // The sign of middle * (1 + product) - 1.
  const auto side = [product](double middle) {
    const double high = middle * product;
    return middle - 1 + high + std::fma(middle, product, -high);
  };
  const auto share = static_cast<float>(1 / (1 + product));
  const float above = std::nextafter(share, 2.0F), below = std::nextafter(share, 0.0F);
  if (side((double{share} + double{above}) / 2) < 0) return above;
  return side((double{share} + double{below}) / 2) > 0 ? below : share;
}

// γ: by sampling, damping B at the rate 1/T gives at most γ (B/T) times the sum of the squares of the hand's steps.
constexpr double sampling_factor(double share) noexcept {
  return share >= 0.5 ? share / (2 - share) : 1 / (4 * (1 - share) * (2 - share));
}

struct Parameters {
  float rate = 0;         // r, Hz: 1 to 2^17, of the device or file; there is no default
  float share = 1;        // α: 2^-10 to 1, the filter's share of the new velocity; RN(1/(1 + rτ)) for a time constant τ
  float damping = 0;      // B, N·s/mm along the force: 0, or 2^-20 to 16
  float most = 2;         // S: 1 to 1024, or infinite; the most by which damping lengthens the force
  float drag = 0;         // B_t, N·s/mm across the force: 0, or 2^-20 to 16
  float full_at = 0.25F;  // F₀, N: 2^-10 to 1024, the force from which on drag is full

  // The damped force is the spring's own, bit for bit, and there is no state.
  constexpr bool is_off() const noexcept { return damping == 0 && drag == 0; }

  constexpr float larger() const noexcept { return damping > drag ? damping : drag; }  // of B and B_t

  friend bool operator==(const Parameters&, const Parameters&) = default;
};

// The most that a surface lets act of a path's B and B_t: each 0, 2^-20 to 16, or infinite, which lets all of it act.
struct Limits {
  float damping = HUGE_VALF;  // N·s/mm
  float drag = HUGE_VALF;     // the same

  friend bool operator==(const Limits&, const Limits&) = default;
};

// Damping as a subject has it, before a rate is known.
struct Described {
  Parameters parameters;  // without their rate
  float time = 0;         // s: the filter's time constant, of which the rate makes the share; 0: the share is that above

  // rate: Hz, rounded to binary32.
  Parameters at(double rate) const noexcept {
    Parameters its = parameters;
    its.rate = static_cast<float>(rate);
    if (time > 0) its.share = share_of(its.rate, time);
    return its;
  }
};

// The state between two ticks. At the start and after a reset there is no position; then all else is 0, too.
struct State {
  bool has_position = false;
  std::array<float, 3> position{};  // mm, the last valid one as it is read
  std::array<float, 3> velocity{};  // mm/s: each 0, or of a size from 2^-20 to 2^32
  std::uint8_t periods = 0;         // since that position; 17 stands for all above 16

  friend bool operator==(const State&, const State&) = default;
};

}  // namespace forceshade::damping
