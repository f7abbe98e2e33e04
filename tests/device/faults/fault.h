// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The fault campaign: everything that may go wrong while a hand is on the device, done on purpose in a real run of the servo
// loop. docs/tables/faults.md is the table that comes out of it.

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace forceshade::faults {

enum class Kind { device, timing, disk, input };
std::string name_of(Kind kind);

// What happened.
struct Outcome {
  std::string reaction = {};
  bool took_effect = false;  // the fault was there
  double before = 0;         // N: the force right before it
  double highest = 0;        // N: of the whole run; infinite if one was not finite
  std::optional<double> to_zero =
      std::nullopt;  // from the fault to the first zero force after which no other follows; none: there is force
  double lost = 0;   // pushed by the loop and not to be read in the recording
};

// How the campaign itself is broken, for the tests that it notices.
struct Bench {
  bool supervised = true;
  bool records_all = true;  // else every hundredth sample is dropped on its way
};

struct Fault {
  Kind kind;
  std::string what;
  std::string reaction;                          // has to be in the outcome's
  std::optional<double> to_zero = std::nullopt;  // at most; none: the force goes on, as it should
  std::string unit = "ticks";                    // of to_zero; a tick is 1 ms
  double lost = 0;                               // at most
  std::string lost_unit = "samples";
  bool under_force = true;  // else there must be no force before it either
  bool is_timed = false;    // in ms of real time: judged by faults_real_test alone
  std::function<Outcome(const Bench&)> run = {};
};

// The outcome of it; whatever is thrown becomes its reaction.
Outcome tried(const Fault& fault, const Bench& bench = {});

// Why the outcome is not what it should be; empty if it is.
std::vector<std::string> complaints(const Fault& fault, const Outcome& outcome);

// Every fault, and those of each file.
std::vector<Fault> catalogue();
std::vector<Fault> position_faults();
std::vector<Fault> device_faults();
std::vector<Fault> phantom_faults();
std::vector<Fault> timing_faults();
std::vector<Fault> disk_faults();
std::vector<Fault> command_faults();

}  // namespace forceshade::faults
