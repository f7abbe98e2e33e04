// SPDX-License-Identifier: BSD-3-Clause
#include "ask_to_close.h"

#include <X11/Xlib.h>

#include <memory>
#include <string_view>

namespace forceshade::window {

bool ask_to_close() {
  const std::unique_ptr<Display, decltype(&XCloseDisplay)> display(XOpenDisplay(nullptr), &XCloseDisplay);
  Window root = 0, parent = 0, *children = nullptr;
  unsigned count = 0;
  if (!display || XQueryTree(display.get(), DefaultRootWindow(display.get()), &root, &parent, &children, &count) == 0)
    return false;
  bool was_there = false;
  for (unsigned i = 0; i < count; ++i) {
    char* name = nullptr;
    if (XFetchName(display.get(), children[i], &name) == 0) continue;
    if (name == std::string_view("forceshade")) {
      XEvent event{};
      event.xclient.type = ClientMessage;
      event.xclient.window = children[i];
      event.xclient.message_type = XInternAtom(display.get(), "WM_PROTOCOLS", False);
      event.xclient.format = 32;
      event.xclient.data.l[0] = static_cast<long>(XInternAtom(display.get(), "WM_DELETE_WINDOW", False));
      XSendEvent(display.get(), children[i], False, NoEventMask, &event);
      was_there = true;
    }
    XFree(name);
  }
  XFree(children);
  XSync(display.get(), False);
  return was_there;
}

}  // namespace forceshade::window
