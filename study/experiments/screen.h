// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What a participant sees and may press: what a session shows, and what a window draws or a virtual participant reads.

#include <string>
#include <string_view>
#include <vector>

namespace forceshade::experiments {

enum class ScreenKind {
  text,            // instructions, a break, the end of a block: goes on with enter
  matching,        // two bumps; smaller, bigger, done
  satisfaction,    // a number from 1 to 10, then enter
  classification,  // four pictures; a number from 1 to 4, then enter
  question,        // of the exit questionnaire: text, then enter
  end,             // nothing more to do
};

struct Screen {
  ScreenKind kind = ScreenKind::text;
  std::string title = {}, text = {};  // in the participant's language
  std::string entry = {};             // what was typed so far
  bool shows_scene = true;            // false: the trial is without vision
  int trial = 0, trials = 0;          // of this block, from 1; 0 outside trials
  bool is_practice = false;
};

enum class Action { smaller, bigger, done, enter, erase, type };

struct Press {
  Action action = Action::enter;
  std::string typed = {};  // UTF-8, of type alone
};

}  // namespace forceshade::experiments
