// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The look and the keys of the participant's window: a small TOML file. Its keys: clients/study/README.md.

#include <filesystem>
#include <string>

#include "study/window/keys.h"
#include "study/window/screen.h"

namespace forceshade::window {

struct WindowSettings : Settings {
  double text_scale = 1;  // times the usual size of text, which follows that of the window
  Keys keys;
};

// Throws Error, which names the file, the line and the key, what was expected and what was got. What is not given
// keeps its default; the path of a font is relative to the file. Unknown keys are refused, and so is a key of the keyboard that
// would have two meanings on one screen.
WindowSettings read_settings(const std::filesystem::path& file);

// The names of these keys in the texts of a session: the first one for each action.
KeyNames key_names(const Keys& keys);

}  // namespace forceshade::window
