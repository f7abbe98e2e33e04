// SPDX-License-Identifier: BSD-3-Clause
// Uses the installed package as a stranger would.

#include <forceshade/device.h>
#include <forceshade/fast.h>
#include <forceshade/servo_loop.h>

#include <cstdio>

int main() {
  using namespace forceshade;
  const auto law = fast::Law::build(LawId::bump_1p_shaded, {.radius = 5, .width = 8, .stiffness = 1});
  if (const auto* error = std::get_if<ParameterError>(&law)) return std::puts(error->message().c_str()), 1;
  device::Replay hand({{{3, 0, -1}, 0.0}, {{3, 0, -2}, 0.001}});
  const std::atomic<bool> stop{false};
  const auto run = device::run_servo_loop(hand, std::get<fast::Law>(law), {.paced = false}, stop);
  const Eigen::Vector3f force = std::get<fast::Law>(law).force({3, 0, -2});
  std::printf("%g %g %g\n", static_cast<double>(force.x()), static_cast<double>(force.y()), static_cast<double>(force.z()));
  return force == Eigen::Vector3f(1.2F, 0, 1.6F) && run.ticks == 2 && run.peak_force_N > 1.9 ? 0 : 1;
}
