// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The keys of the participant's keyboard, and their actions in the session.

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "study/window/screen.h"
#include "window/canvas.h"

namespace forceshade::window {

// Keys that type no character, as a canvas names them. The Enter key of the number pad is "return", too.
inline constexpr std::array<std::string_view, 26> kNamedKeys{
    "return", "backspace", "delete", "tab", "escape", "insert", "left", "right", "up", "down", "page-up", "page-down", "home",
    "end",    "f1",        "f2",     "f3",  "f4",     "f5",     "f6",   "f7",    "f8", "f9",   "f10",     "f11",       "f12"};

// Each is a character as the participant's own layout types it, in UTF-8, or one of kNamedKeys. Capital letters of ASCII count
// as small ones, so that Caps Lock does not silence a key. Defaults: the keys of the thesis (figures 5-7 and 5-9).
struct Keys {
  std::vector<std::string> smaller{"j"}, bigger{"k"}, done{"l"};
  std::vector<std::string> enter{"return"}, erase{"backspace"};  // named keys alone: a character would be missing in answers
  std::array<std::string, 10> digits{"0", "1", "2", "3", "4", "5", "6", "7", "8", "9"};
};

// The action of a key on this kind of screen; nothing if it has no meaning there. A key that is held down repeats only while an
// answer is typed: one press is one change of the radius, and no screen is skipped by holding Return.
std::optional<Press> press_of(const Keys& keys, ScreenKind kind, const Key& key);

// The actions of keys typed in one frame, in order. Those after one that leaves the screen (enter, done) are left out: they
// were meant for a screen that the participant had not seen.
std::vector<Press> presses_of(const Keys& keys, ScreenKind kind, std::span<const Key> typed);

// The key as a participant reads it on a keyboard: "J", "Enter", "Page up", "F1".
std::string cap(std::string_view name);

}  // namespace forceshade::window
