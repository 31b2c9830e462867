#pragma once

#include <X11/Xlib.h>
#include <X11/Xutil.h>

#include <string>

// Xlib defines these common names as macros.
#undef Bool
#undef None
#undef Status
#undef Success

namespace x11 {

/// Asks the windows whose title begins with this text to close, as the button in their title bar does.
inline void closeWindows(const std::string& title) {
  Display* display = XOpenDisplay(nullptr);
  if (!display) return;
  // A listed window may be gone when its name is requested, which would end the program.
  const auto handler = XSetErrorHandler([](Display*, XErrorEvent*) { return 0; });
  const Atom protocols = XInternAtom(display, "WM_PROTOCOLS", False),
             remove = XInternAtom(display, "WM_DELETE_WINDOW", False);
  Window root, parent, *children = nullptr;
  unsigned count = 0;
  XQueryTree(display, DefaultRootWindow(display), &root, &parent, &children, &count);
  for (unsigned i = 0; i < count; ++i) {
    char* name = nullptr;
    if (!XFetchName(display, children[i], &name)) continue;
    if (std::string(name).rfind(title, 0) == 0) {
      XEvent event{};
      event.xclient.type = ClientMessage;
      event.xclient.window = children[i];
      event.xclient.message_type = protocols;
      event.xclient.format = 32;
      event.xclient.data.l[0] = static_cast<long>(remove);
      XSendEvent(display, children[i], False, NoEventMask, &event);
    }
    XFree(name);
  }
  if (children) XFree(children);
  XSync(display, False);
  XSetErrorHandler(handler);
  XCloseDisplay(display);
}

}  // namespace x11
