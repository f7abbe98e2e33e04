// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The stiffness at which sampling and encoders make a virtual spring lively, found by simulating it.

namespace forceshade::device {

// A mass on a rail, seen through an encoder and pushed by a held force: the plant of Abbott and Okamura (2005).
struct SampledWall {
  double mass = 0.05;     // kg
  double damping = 0.5;   // b: N·s/m
  double coulomb = 0.05;  // f_c: N
  double quantum = 3e-5;  // Δ: m; 0: continuous
  double period = 1e-3;   // T: s
  bool latency = false;   // of one sample
};

// Runs the simulated device under the force -K x of a spring of `stiffness` K N/m, twice: from far away, where only damping
// matters, it has to lose energy; and between two encoder counts, with a hand pushing so that the force of neither is
// balanced, it has to come to rest.
bool is_quiet(const SampledWall& wall, double stiffness);

// The largest quiet stiffness, N/m, to half a per cent.
double largest_quiet_stiffness(const SampledWall& wall);

// min(2b/T, 2f_c/Δ), N/m.
double passive_stiffness(const SampledWall& wall) noexcept;

}  // namespace forceshade::device
