/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/terminal/pager.h"
#include "bench/terminal/terminal.h"

#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/wait.h>
#include <unistd.h>

static FILE *kept;      /* what is written to standard output */
static int screen = -1; /* where it goes in the end */
static pid_t owner;     /* no child that was forked shows it */

static const char *pager(void) {
  const char *chosen = getenv("PAGER");
  return chosen ? chosen : "less -FRX";
}

/* The lines of the text, and of the screen. A line that is wider takes more. */
static bool is_long(void) {
  struct winsize size = {.ws_row = 0};
  if (ioctl(screen, TIOCGWINSZ, &size) || !size.ws_row || !size.ws_col)
    return false;
  long lines = 0, columns = 0;
  rewind(kept);
  for (int c; (c = getc(kept)) != EOF;) {
    columns = c == '\n' ? 0 : columns + ((c & 0xc0) != 0x80);
    lines += c == '\n' || (columns > 1 && columns % size.ws_col == 1);
  }
  return lines >= size.ws_row;
}

static void copy(void) {
  char part[4096];
  size_t n;
  rewind(kept);
  while ((n = fread(part, 1, sizeof part, kept)) > 0)
    for (size_t done = 0; done < n;) {
      ssize_t written = write(screen, part + done, n - done);
      if (written <= 0)
        return;
      done += (size_t)written;
    }
}

/* Whether the pager has shown it. */
static bool page(void) {
  rewind(kept);
  fflush(kept);
  pid_t child = fork();
  if (child < 0)
    return false;
  if (child == 0) {
    lseek(fileno(kept), 0, SEEK_SET);
    if (dup2(fileno(kept), STDIN_FILENO) < 0 || dup2(screen, STDOUT_FILENO) < 0)
      _exit(127);
    setenv("LESSCHARSET", "utf-8", 0);
    execl("/bin/sh", "sh", "-c", pager(), (char *)NULL);
    _exit(127);
  }
  int end = 0;
  void (*before)(int) = signal(SIGINT, SIG_IGN); /* it is the pager's */
  waitpid(child, &end, 0);
  signal(SIGINT, before);
  return !WIFEXITED(end) || WEXITSTATUS(end) != 127;
}

static void show(void) {
  if (getpid() != owner)
    return;
  fflush(stdout);
  if (!is_long() || !page())
    copy();
}

void pager_begin(void) {
  if (!isatty(STDOUT_FILENO) || !*pager() || !strcmp(pager(), "cat"))
    return;
  const int columns = terminal_columns(stdout);
  kept = tmpfile();
  screen = dup(STDOUT_FILENO);
  if (!kept || screen < 0 || dup2(fileno(kept), STDOUT_FILENO) < 0)
    return;
  owner = getpid();
  terminal_keep(columns);
  atexit(show);
}
