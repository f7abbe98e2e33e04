// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Searches for a session that breaks a rule: among random schedules, among all places of a hold, and among all places of a
// fault. What is found is shrunk to the decisions that it takes.

#include <functional>
#include <string>
#include <vector>

#include "tests/world/session.h"

namespace forceshade::world {

struct Found {
  long tried = 0, broken = 0;
  std::string first;            // how the first one broke, in words; with its shortest schedule where that is known
  double seconds = 0;           // in the world, of all
  std::uint64_t digest = 0;     // of all
  double without_watchdog = 0;  // ms, the longest
};

// A session of each seed from 1 on, with holds of any magnitude.
Found random_sessions(int count, const Plan& plan, const Open& open);

// The shortest part of the session's decisions with which it still breaks a rule.
std::vector<Entry> shrunk(Plan plan, const Open& open, std::vector<Entry> decisions);

// A window of a session's steps, and which of them are tried.
struct Window {
  Ns from;  // since the session's begin
  long steps;
  long stride = 1;
};

// At each step of the window, each of these faults. The session goes on in a process of its own with it, and here without.
struct Fault {
  std::string name;
  std::function<void(World&)> happens;
};
Found placed(const std::vector<Fault>& faults, const Window& window, const Plan& plan, const Open& open);
// The same for each pair of a first and a later second one, whose window begins with the first.
Found placed_pairs(const std::vector<Fault>& firsts, const Window& window, const std::vector<Fault>& seconds,
                   const Window& second, const Plan& plan, const Open& open);

// Whoever makes the step is held up until the others have made 1 to `most` steps.
std::vector<Fault> holds(long most);

}  // namespace forceshade::world
