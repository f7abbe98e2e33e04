// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Acts on the display itself, by Xlib, whose macros stay in the source file. The display has no window manager, so the
// participant's window stands right below its root.

namespace forceshade::window {

// Sends the window the message of a window manager whose button to close it was clicked. Returns true if there is a window.
bool ask_to_close();

}  // namespace forceshade::window
