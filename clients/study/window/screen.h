// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The screens and key presses of a person at a window: a program shows, and a window, a terminal or another program answers.
// All are plain values.

#include <string>

namespace forceshade::window {

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
  std::string entry = {};             // the text that was typed so far
  bool shows_scene = true;            // false: the trial is without vision
  int block = 0;                      // its number, from 1; 0 for practice and outside trials
  int trial = 0, trials = 0;          // of this block, from 1; 0 outside trials
  bool is_practice = false;
};

enum class Action { smaller, bigger, done, enter, erase, type };

struct Press {
  Action action = Action::enter;
  std::string typed = {};  // UTF-8, of type alone
};

// Short words beside what a window draws.
struct Labels {
  std::string trial = "Trial", practice = "Practice";
  std::string reference = "Reference", matching = "Matching";            // the left bump and the right one
  std::string different = "entirely different", same = "no difference";  // the ends of the scale of satisfaction
};

// The names of the keys in a window.
struct KeyNames {
  std::string smaller = "j", bigger = "k", done = "l", enter = "Enter", erase = "Backspace";
};

}  // namespace forceshade::window
