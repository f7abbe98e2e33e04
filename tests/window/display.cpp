// SPDX-License-Identifier: BSD-3-Clause
#include "display.h"

#include <X11/Xlib.h>
#include <X11/Xutil.h>

#include <memory>
#include <string_view>

namespace forceshade::window {
namespace {

using Connection = std::unique_ptr<Display, decltype(&XCloseDisplay)>;

Connection connection() {
  return {XOpenDisplay(nullptr), &XCloseDisplay};
}

// A window may go while it is looked at; by default Xlib ends the program then.
int ignore_error(Display*, XErrorEvent*) {
  return 0;
}

// 0 if there is none.
::Window participants_window(Display* display) {
  XSetErrorHandler(&ignore_error);
  ::Window root = 0, parent = 0, *children = nullptr, found = 0;
  unsigned count = 0;
  if (XQueryTree(display, DefaultRootWindow(display), &root, &parent, &children, &count) == 0) return 0;
  for (unsigned i = 0; i < count; ++i) {
    char* name = nullptr;
    XWindowAttributes attributes;
    if (XFetchName(display, children[i], &name) == 0) continue;
    if (name == std::string_view("forceshade") && XGetWindowAttributes(display, children[i], &attributes) != 0 &&
        attributes.map_state == IsViewable)
      found = children[i];
    XFree(name);
  }
  if (children != nullptr) XFree(children);
  return found;
}

}  // namespace

bool ask_to_close() {
  const Connection display = connection();
  const ::Window window = display ? participants_window(display.get()) : 0;
  if (window == 0) return false;
  XEvent event{};
  event.xclient.type = ClientMessage;
  event.xclient.window = window;
  event.xclient.message_type = XInternAtom(display.get(), "WM_PROTOCOLS", False);
  event.xclient.format = 32;
  event.xclient.data.l[0] = static_cast<long>(XInternAtom(display.get(), "WM_DELETE_WINDOW", False));
  XSendEvent(display.get(), window, False, NoEventMask, &event);
  XSync(display.get(), False);
  return true;
}

}  // namespace forceshade::window
