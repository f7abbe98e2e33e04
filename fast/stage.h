// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The last of several stages.

#include "forceshade/session.h"

namespace forceshade::fast {

// Raises `last` to `stage`: an answer that takes several decisions has the last stage of any of them.
inline void raise(Stage& last, Stage stage) noexcept {
  if (last < stage) last = stage;
}

}  // namespace forceshade::fast
