// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The screens, stimuli and key presses of an experiment's participant: a session shows, and a window, a terminal or a program
// answers. The library is forceshade::experiments, of the component study.
//
//   const experiments::Screen screen{.kind = experiments::ScreenKind::satisfaction, .title = "How content are you?"};
//   const experiments::Press press{experiments::Action::type, "8"};
//   const experiments::Scene scene{.left = experiments::Bump{"bump-1p-shaded", 800, 0}, .right = {}};
//
// Lengths are in mil, thousandths of an inch, as in the thesis.
//
// Errors: these are plain values, and nothing here fails.
//
// Threads: as plain values.
//
// Not promised: that a press has a meaning on the screen; one that has none changes nothing.

#include <optional>
#include <string>

namespace forceshade::experiments {

// Radii are whole mil everywhere in an experiment, so that a radius reached by keys is exactly the one of a condition.
using Mil = int;

inline constexpr double kMillimetresPerMil = 0.0254;

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

// A stimulus as it is rendered: its width, stiffness and placement are those of the protocol.
struct Bump {
  std::string stimulus;  // its name in the protocol
  Mil radius = 0;        // 0 for a stimulus of one shape
  Mil position = 0;      // of the middle of the bump along x, to the right

  friend bool operator==(const Bump&, const Bump&) = default;
};

// The bumps that the servo loop renders now: none, one, or reference and matching bump.
struct Scene {
  std::optional<Bump> left, right;  // a single bump, at position 0, is `left`
  friend bool operator==(const Scene&, const Scene&) = default;
};

}  // namespace forceshade::experiments
