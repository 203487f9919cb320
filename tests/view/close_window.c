/* SPDX-License-Identifier: GPL-3.0-or-later */
/* close_window TITLE: asks the window with this title to close, as a window
 * manager does. */
#include <X11/Xlib.h>

#include <stdio.h>
#include <string.h>

static Window find(Display *display, Window in, const char *title) {
  Window root, parent, *child = NULL, found = 0;
  unsigned n = 0;
  char *name = NULL;
  if (XFetchName(display, in, &name) && name && !strcmp(name, title))
    found = in;
  if (name)
    XFree(name);
  if (!found && XQueryTree(display, in, &root, &parent, &child, &n))
    for (unsigned k = 0; k < n && !found; k++)
      found = find(display, child[k], title);
  if (child)
    XFree(child);
  return found;
}

int main(int argc, char **argv) {
  Display *display = XOpenDisplay(NULL);
  if (argc != 2 || !display)
    return 2;
  Window window = find(display, DefaultRootWindow(display), argv[1]);
  if (!window) {
    fprintf(stderr, "no window '%s'\n", argv[1]);
    return 1;
  }
  XEvent event = {
      .xclient = {.type = ClientMessage, .window = window, .format = 32}};
  event.xclient.message_type = XInternAtom(display, "WM_PROTOCOLS", False);
  event.xclient.data.l[0] =
      (long)XInternAtom(display, "WM_DELETE_WINDOW", False);
  XSendEvent(display, window, False, NoEventMask, &event);
  XCloseDisplay(display);
  return 0;
}
