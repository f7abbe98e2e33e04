// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The end of the process that holds a PHANToM, as a machine that asks the system for nothing: from what is true to what is done
// next. proofs/device/phantom.pml runs the same table, which a program of the tests prints from here.

#include <chrono>

namespace forceshade::device {

enum class Ending {
  held,          // frames run
  closing,       // the next frame is to send zero and to switch the output off
  interrupting,  // that frame does not end: its own thread is to release the device
  released,      // the force has ended; the driver has time to stop
  over           // the process ends, whatever the driver's calls are stuck in
};

struct EndingSeen {
  bool is_alone = false;       // the other process is gone, or has closed its end
  bool words_are_due = false;  // a call of the driver's did not return in time
  bool is_closed = false;      // zero was sent and the output is off, or the device was released
  bool is_late = false;        // the state has lasted for longest_of() it
};

constexpr Ending next(Ending now, const EndingSeen& seen) noexcept {
  switch (now) {
    case Ending::held: return seen.is_alone || seen.words_are_due ? Ending::closing : Ending::held;
    case Ending::closing: return seen.is_closed ? Ending::released : seen.is_late ? Ending::interrupting : Ending::closing;
    case Ending::interrupting: return seen.is_closed ? Ending::released : seen.is_late ? Ending::over : Ending::interrupting;
    case Ending::released: return seen.words_are_due || seen.is_late ? Ending::over : Ending::released;
    case Ending::over: break;
  }
  return Ending::over;
}

constexpr std::chrono::milliseconds longest_of(Ending state) noexcept {
  return std::chrono::milliseconds(state == Ending::released ? 1000 : 200);
}

}  // namespace forceshade::device
