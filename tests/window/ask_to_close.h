// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Closes the window as a window manager does when its button is clicked. Apart from the tests, for Xlib's macros.

namespace forceshade::window {

// Sends the window of this program, which stands right below the root of a display without a window manager, the message to
// close. Whether there was one.
bool ask_to_close();

}  // namespace forceshade::window
