// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Searches for a session that breaks a rule: among random schedules, among all places of a hold, and among all places of a
// fault. A session that is found is shrunk to the decisions that it takes.

#include <functional>
#include <string>
#include <vector>

#include "tests/world/session.h"

namespace forceshade::world {

struct Found {
  long tried = 0, broken = 0;
  std::string first;            // the breach of the first one, in words; with its shortest schedule where that is known
  double seconds = 0;           // in the world, of all
  std::uint64_t digest = 0;     // of all
  double without_watchdog = 0;  // ms, as of an Outcome, the longest
  double longest = 0;           // ms, from the fault to the last moment of force, of those that it ended
  long go_on = 0, stay = 0;     // sessions that end in order, and at the end of which the force stays
};

// A session of whatever kind, in a world of its own; session() is that of an arm.
using Session = std::function<Outcome(const Plan&)>;

// A session of each seed from 1 on, with holds of any magnitude.
Found random_sessions(int count, const Plan& plan, const Session& its);
inline Found random_sessions(int count, const Plan& plan, const Open& open) {
  return random_sessions(count, plan, [&](const Plan& seeded) { return session(seeded, open); });
}

// The shortest part of the session's decisions with which it still breaks a rule.
std::vector<Entry> shrunk(Plan plan, const Session& its, std::vector<Entry> decisions);

// A window of a session's steps, and which of them are tried.
struct Window {
  Ns from;  // since the session's begin
  long steps;
  long stride = 1;
};

// At each step of the window, each of these faults. The session goes on in a process of its own with it, and here without.
struct Fault {
  std::string name;
  std::function<void(World&, Arm&)> happens;
  // The end's words have one of these in them; without any, every end is right that has words.
  std::vector<std::string> words = {};
};
Found placed(const std::vector<Fault>& faults, const Window& window, const Plan& plan, const Open& open);
// The same with a session from its beginning for each, where a process that is forked would share files with this one.
Found placed_anew(const std::vector<Fault>& faults, const Window& window, const Plan& plan, const Session& its);
// As placed(), for each pair of a first and a later second one, whose window begins with the first.
Found placed_pairs(const std::vector<Fault>& firsts, const Window& window, const std::vector<Fault>& seconds,
                   const Window& second, const Plan& plan, const Open& open);

// The thread that makes the step is held up until the others have made 1 to `most` steps.
std::vector<Fault> holds(long most);

}  // namespace forceshade::world
