// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// How the participant's window looks and which keys it takes: a small TOML file. The keys: docs/experiments.md.

#include <filesystem>
#include <string>

#include "forceshade/window/error.h"
#include "forceshade/window/keys.h"

namespace forceshade::window {

// The few words that do not come with a screen of the session, in the participant's language.
struct Words {
  std::string trial = "Trial", practice = "Practice";
  std::string reference = "Reference", matching = "Matching";
  std::string smaller = "smaller", bigger = "bigger", done = "done", enter = "continue", return_key = "Return";
  std::string different = "completely different", same = "no difference";  // the ends of the satisfaction index
};

struct Settings {
  bool is_fullscreen = false;
  int monitor = 1;                   // from 1: the one that the window fills, or on which it opens
  int width = 1280, height = 800;    // pixels, of a window that does not fill the monitor
  double text_scale = 1;             // of the size of all text, which follows the height of the window
  std::string font = "DejaVu Sans";  // a family for fontconfig, or the path of a file (TrueType), relative to the settings
  Keys keys;
  Words words;
};

// Throws Error, which names the file, the line, the key, what was expected and what was got. Keys that are not given keep their
// defaults; unknown ones are refused, and so is a key of the keyboard that would have two meanings on one screen.
Settings read_settings(const std::filesystem::path& file);

}  // namespace forceshade::window
