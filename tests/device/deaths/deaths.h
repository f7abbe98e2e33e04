// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Every way in which a process that drives a PHANToM may end, at every phase of a run, and what the arm feels afterwards.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "tests/device/stand_in_hd/stand_in_hd.h"

namespace forceshade::deaths {

using stand_in_hd::Moment;

inline constexpr std::array kPhases{Moment::before_start, Moment::free, Moment::contact, Moment::tripping, Moment::stopping};
const char* name_of(Moment phase);

enum class Expected {
  lets_go,   // the force is zero afterwards, and the process of the driver gone
  goes_on,   // nothing happens to the run
  stays_on,  // no zero can be sent: the device's own time-out decides
};

struct Death {
  std::string what;
  Expected expected = Expected::lets_go;
  std::optional<int> signal = std::nullopt;                     // sent by the driver's process, at the moment
  int times = 1;                                                // in a row
  bool to_driver = false;                                       // to itself instead of the servo loop's
  std::string way = "";                                         // in which mortal dies; empty: forceshade drive is run
  std::optional<stand_in_hd::Crash::How> crash = std::nullopt;  // of the driver
};

std::vector<Death> catalogue();

struct Outcome {
  bool took_effect = false;  // the moment came
  Expected seen = Expected::lets_go;
  double force = 0;             // N, as long as nothing else happens to the device
  double to_zero = 0;           // ms from the death to the last moment of force; 0 if there was none
  std::string end;              // of the program: "exit 0", "signal 9"
  bool driver_is_left = false;  // its process, long after the program's end
};

// In this process, whose memory of the stand-in is used for it.
Outcome tried(const Death& death, Moment phase);

}  // namespace forceshade::deaths
