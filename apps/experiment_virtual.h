// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Virtual participants on a simulated device: their sessions go through the same session, loop and recording as a person's.

#include <cstdint>
#include <filesystem>
#include <string>

namespace forceshade::apps {

struct VirtualOptions {
  std::filesystem::path protocol, out;
  std::filesystem::path certificates;  // empty: uncertified
  int participants = 5;
  std::uint64_t seed = 1;
  unsigned threads = 1;
  std::string model = "premium-1.5";  // of the simulated PHANToM
};

// Session folders OUT/V1, OUT/V2 and so on, each from start to end. In every trial the simulated hand strokes across the bumps
// once, through the servo loop and with its ticks recorded, and then the participant presses keys as their model has it: what
// they feel is computed from the laws (study/experiments/virtual_participant.h). The times of a session are those of the
// simulated device, so its trials are much shorter than a person's. The same seed gives the same sessions, tick by tick, but
// for what the machine's clock says. Returns the exit code. Throws Interrupted.
int run_virtual(const VirtualOptions& options);

}  // namespace forceshade::apps
