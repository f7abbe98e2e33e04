// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A virtual participant on a simulated device: the session goes through the same log, loop and recording as a person's.

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

namespace forceshade::apparatus {

struct VirtualPlan {
  std::filesystem::path protocol, out;
  std::map<std::string, std::string> certificates;  // certificates_of(); empty: uncertified
  std::uint64_t seed = 1;
  std::string model = "premium-1.5";  // of the simulated PHANToM
};

// Session folder OUT/V<number>, from start to end; how many ticks it took. In every trial the simulated hand strokes across the
// bumps once, through the servo loop and with its ticks recorded, and then the participant presses keys as their model has it:
// what they feel is computed from the laws (study/experiments/virtual_participant.h). The times of a session are those of the
// simulated device, so its trials are much shorter than a person's. The same seed gives the same session, tick by tick, but for
// what the machine's clock says. Throws Interrupted, what RecordedSession throws, and std::runtime_error where the supervisor
// stopped the run.
std::size_t run_virtual_session(const VirtualPlan& plan, int number, const std::atomic<bool>& stop);

}  // namespace forceshade::apparatus
