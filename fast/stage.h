// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Which arithmetic decided an answer.

namespace forceshade::fast {

// Cheapest first.
enum class Stage { binary64, double_double, wide };

// Raises `last` to `stage`: an answer that takes several decisions has the last stage of any of them.
inline void raise(Stage& last, Stage stage) noexcept {
  if (last < stage) last = stage;
}

}  // namespace forceshade::fast
