// SPDX-License-Identifier: BSD-3-Clause
// The message of a window manager to the window of this program, which stands right below the root of a display without one.

#include <X11/Xlib.h>

#include <cstring>
#include <memory>
#include <string>

#include "screenshots.h"

namespace forceshade::window {

void ask_to_close() {
  const std::unique_ptr<Display, decltype(&XCloseDisplay)> display(XOpenDisplay(nullptr), &XCloseDisplay);
  ASSERT_NE(display, nullptr);
  ::Window root = 0, parent = 0, *children = nullptr;
  unsigned count = 0;
  ASSERT_NE(XQueryTree(display.get(), DefaultRootWindow(display.get()), &root, &parent, &children, &count), 0);
  int asked = 0;
  for (unsigned i = 0; i < count; ++i) {
    char* name = nullptr;
    if (XFetchName(display.get(), children[i], &name) == 0) continue;
    if (std::string(name) == "forceshade") {
      XEvent event{};
      event.xclient.type = ClientMessage;
      event.xclient.window = children[i];
      event.xclient.message_type = XInternAtom(display.get(), "WM_PROTOCOLS", False);
      event.xclient.format = 32;
      event.xclient.data.l[0] = static_cast<long>(XInternAtom(display.get(), "WM_DELETE_WINDOW", False));
      XSendEvent(display.get(), children[i], False, NoEventMask, &event);
      ++asked;
    }
    XFree(name);
  }
  XFree(children);
  XSync(display.get(), False);
  EXPECT_EQ(asked, 1);
}

}  // namespace forceshade::window
