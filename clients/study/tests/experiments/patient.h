// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A participant who answers every screen.

#include "study/experiments/participant.h"

namespace forceshade::experiments {

inline Press type(const std::string& text) {
  return {Action::type, text};
}

// The presses of a patient participant, one at a time: one step up, done, 7; or picture 3.
inline Press next_press(const Screen& screen, int& presses_of_trial) {
  switch (screen.kind) {
    case ScreenKind::matching: return {presses_of_trial++ == 0 ? Action::bigger : Action::done};
    case ScreenKind::satisfaction: presses_of_trial = 0; return screen.entry.empty() ? type("7") : Press{Action::enter};
    case ScreenKind::classification: return screen.entry.empty() ? type("3") : Press{Action::enter};
    case ScreenKind::question: return screen.entry.empty() ? type("ö") : Press{Action::enter};
    default: return {Action::enter};
  }
}

}  // namespace forceshade::experiments
