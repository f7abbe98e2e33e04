// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Lines that are drawn over themselves in a terminal: never wider than it, because a line that wraps is drawn on a new row each
// time.

#include <string>

namespace forceshade::apps {

// Characters beside each other that the terminal on standard error holds now, less one; 79 where it does not say.
int room_for_a_line();

// The values that are shown during a run.
struct LiveLine {
  double seconds;
  double rate;        // Hz
  double late;        // us
  double force;       // N
  double full_force;  // N, where the bar ends
  double energy;      // mJ
  std::string limits;
};

// At most `room` characters of ASCII: what there is no room for is left out, the force last.
std::string live_line(const LiveLine& shown, int room);

// At the start of the row on standard error that the cursor is in: the text, as far as there is room, and nothing after it.
void draw_line(const std::string& text);

}  // namespace forceshade::apps
