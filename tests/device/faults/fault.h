// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The fault campaign: what may go wrong while a hand is on the device, done on purpose in a run of the servo loop, in a
// simulated world (tests/world/world.h). docs/tables/faults.md is the table that comes out of it.

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace forceshade::faults {

enum class Kind { device, timing, disk };
std::string name_of(Kind kind);

struct Outcome {
  std::string reaction = {};
  bool took_effect = false;  // the fault was there
  double before = 0;         // N: the force right before it
  double highest = 0;        // N: of the whole run; infinite if one was not finite
  // Ticks from the fault to the first zero force after which no other follows; none: there is force.
  std::optional<std::size_t> to_zero = std::nullopt;
  std::size_t lost = 0;  // samples that the loop pushed and that are not to be read in the recording
};

// Defects of the campaign itself, for the tests that it notices them.
struct Bench {
  bool supervised = true;
  bool records_all = true;  // else every hundredth sample is dropped on its way
};

struct Fault {
  Kind kind;
  std::string what;
  std::string reaction;                               // has to be in the outcome's
  std::optional<std::size_t> to_zero = std::nullopt;  // ticks at most; none: the force goes on, as it should
  std::size_t lost = 0;                               // at most
  bool under_force = true;                            // else there must be no force before it either
  std::function<Outcome(const Bench&)> run = {};
};

// The outcome of it in a world of its own; whatever is thrown becomes its reaction.
Outcome tried(const Fault& fault, const Bench& bench = {});

// The reason why the outcome is not as it should be; empty if it is.
std::vector<std::string> complaints(const Fault& fault, const Outcome& outcome);

// Every fault, and those of each file.
std::vector<Fault> catalogue();
std::vector<Fault> position_faults();  // of device_faults.cpp, as the next
std::vector<Fault> device_faults();
std::vector<Fault> disk_faults();

}  // namespace forceshade::faults
