/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/terminal/terminal.h"
#include "bench/options/words.h"
#include "common/base/clock.h"

#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

static int kept_columns; /* of standard output; 0: it is shown at once */

void terminal_keep(int columns) {
  kept_columns = columns;
}

int terminal_columns(FILE *out) {
  struct winsize size = {.ws_col = 0};
  if (kept_columns && out == stdout)
    return kept_columns;
  if (!isatty(fileno(out)))
    return 0;
  const char *variable = getenv("COLUMNS");
  long columns;
  if (!variable || !parse_count(variable, 1, 10000, &columns))
    columns = ioctl(fileno(out), TIOCGWINSZ, &size) ? 80 : size.ws_col;
  return columns == 0 ? 80 : columns < 40 ? 40 : (int)columns;
}

/* --- Names ---------------------------------------------------------------- */

/* How many bytes the control character at `text` has; 0 if there is none. In
 * UTF-8, those from U+0080 to U+009F have two. */
static int control_bytes(const unsigned char *text) {
  if (text[0] < 0x20 || text[0] == 0x7f)
    return 1;
  return text[0] == 0xc2 && text[1] >= 0x80 && text[1] < 0xa0 ? 2 : 0;
}

char *terminal_plain(const char *name, char *plain, size_t size) {
  const unsigned char *at = (const unsigned char *)name;
  size_t length = 0;
  while (*at && length + 9 < size) {
    int n = control_bytes(at);
    for (int k = 0; k < n; k++)
      length +=
          (size_t)snprintf(plain + length, size - length, "\\x%02x", *at++);
    if (!n)
      plain[length++] = (char)*at++;
  }
  plain[length] = '\0';
  return plain;
}

char *terminal_word(const char *name, char *word, size_t size) {
  char plain[TERMINAL_NAME];
  terminal_plain(name, plain, sizeof plain);
  bool bare = !plain[strspn(plain, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQ"
                                   "RSTUVWXYZ0123456789_@%+=:,./-")];
  if (bare || strchr(plain, '\''))
    snprintf(word, size, bare ? "%s" : "\"%s\"", plain);
  else
    snprintf(word, size, "'%s'", plain);
  return word;
}

char *terminal_number(uint64_t n, const char *things,
                      char text[TERMINAL_NUMBER]) {
  int length = (int)strlen(things);
  bool hes = length > 3 && !strcmp(things + length - 3, "hes");
  int letters = length - (n != 1 ? 0 : hes ? 2 : 1);
  snprintf(text, TERMINAL_NUMBER, "%llu %.*s", (unsigned long long)n, letters,
           things);
  return text;
}

/* --- Lines ---------------------------------------------------------------- */

/* Columns that a word takes: continuing bytes of UTF-8 take none. */
static int width_of(const char *word, size_t bytes) {
  int width = 0;
  for (size_t k = 0; k < bytes; k++)
    width += ((unsigned char)word[k] & 0xc0) != 0x80;
  return width;
}

void terminal_wrap(FILE *out, int used, int indent, const char *text) {
  char plain[4 * TERMINAL_NAME];
  int columns = terminal_columns(out);
  const char *word = terminal_plain(text, plain, sizeof plain);
  bool first = true;
  while (*(word += strspn(word, " "))) {
    size_t bytes = strcspn(word, " ");
    int width = width_of(word, bytes);
    if (!first && columns && used + 1 + width > columns) {
      fprintf(out, "\n%*s", indent, "");
      used = indent;
    } else if (!first) {
      putc(' ', out);
      used++;
    }
    fwrite(word, 1, bytes, out);
    used += width;
    word += bytes;
    first = false;
  }
  putc('\n', out);
}

/* --- Progress ------------------------------------------------------------- */

struct progress progress_begin(FILE *out) {
  double now = hsr_seconds_now();
  bool terminal = isatty(fileno(out));
  return (struct progress){out, terminal || getenv("HSR_PROGRESS"), terminal,
                           now, now};
}

/* A terminal is told at most ten times a second. */
static bool is_time(struct progress *p) {
  double now = hsr_seconds_now();
  if (now - p->last < (p->rewrites ? .1 : 8) && p->last > p->begin)
    return false;
  if (!p->rewrites && now - p->begin < 8)
    return false;
  p->last = now;
  return true;
}

void progress_tell(struct progress *p, size_t done, size_t all,
                   const char *things, const char *now) {
  if (!p->told || !is_time(p))
    return;
  char name[TERMINAL_NAME], rest[60] = "", of[30] = "", tail[160];
  double passed = p->last - p->begin;
  double left = done ? passed / (double)done * (double)(all - done) : 0;
  if (done && done < all && passed > 1 && left >= .5)
    snprintf(rest, sizeof rest, ", about %.0f s left", left);
  terminal_plain(now, name, sizeof name);
  if (all)
    snprintf(of, sizeof of, " of %zu", all);
  snprintf(tail, sizeof tail, ": %zu%s %s%s", done, of, things, rest);
  int columns = p->rewrites ? terminal_columns(p->out) : 0;
  int room = columns ? columns - (int)strlen(tail) - 1 : TERMINAL_NAME;
  room = room > 10 ? room : 10;
  if (strlen(name) > (size_t)room)
    memcpy(name + room - 3, "...", 4);
  fprintf(p->out, "%s%s%s%s", p->rewrites ? "\r\033[K" : "", name, tail,
          p->rewrites ? "" : "\n");
  fflush(p->out);
}

enum { MOST_WAITED = 3 };

static int count(const char *text, char letter) {
  int n = 0;
  for (; *text; text++)
    n += *text == letter;
  return n;
}

/* Whether a list, as `progress_add` writes it, has a name. */
static bool names(const char *open, const char *name) {
  size_t length = strlen(name);
  for (const char *at = open; at; at = strstr(at + 1, ", "))
    if (!strncmp(at + 2, name, length) && strchr(", ", at[2 + length]))
      return true;
  return false;
}

void progress_add(char text[PROGRESS_TEXT], const char *name) {
  const char *open = strstr(text, " (");
  size_t used = strlen(text);
  if (names(open, name))
    return;
  int n = open ? 1 + count(open, ',') : 0;
  if (n <= MOST_WAITED)
    snprintf(text + used, PROGRESS_TEXT - used, "%s%.60s", open ? ", " : " (",
             n < MOST_WAITED ? name : "...");
}

void progress_close(char text[PROGRESS_TEXT]) {
  size_t used = strlen(text);
  if (strstr(text, " ("))
    snprintf(text + used, PROGRESS_TEXT - used, ")");
}

void progress_end(struct progress *p) {
  if (p->rewrites)
    fputs("\r\033[K", p->out);
  fflush(p->out);
}
