/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The counts of every module on small scenes, against those that a person last
 * looked at. golden/BRANCH.txt has those of one branch of the taxonomy. A line
 * is of one module or variant, one scene and one view, and has all counts that
 * are not zero:
 *
 *   watkins  house  view 1  Y sort=255, X merge=1739, ...
 *
 * Of what keeps a state from frame to frame, a line is also of a walk: a turn
 * around the point looked at, from view 1 on.
 *
 * What takes grids only is counted on grids. What makes further kinds of
 * answers is counted when it makes those as well: SCENE:mix=linear,
 * SCENE:shadows=cast.
 *
 *   golden_test [NAME...]            compares: all, or those modules with their
 *                                    variants
 *   golden_test --write [NAME...]    writes their lines anew; see `rewrite`
 *
 * A change that alters a count fails here, until its commit has the new figure
 * and says why. A module that has no lines fails as well, but is skipped if it
 * was named: its author is still at work. */
#include "tests/draw.h"
#include "tests/tap.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char *const scenes[] = {
    "house",        "cyclic-overlap", "penetration", "coplanar",
    "shared-edges", "lattice:40:3",   "near-plane",  "non-convex",
    "deep-stack",   "color-cube:2"};
static const char *const grids[] = {"checker-cube:5", "checker-cube:20",
                                    "grid",           "grid:9:7",
                                    "heights:4",      "checker-plane"};
enum {
  N_SCENES = sizeof scenes / sizeof *scenes,
  N_GRIDS = sizeof grids / sizeof *grids,
  M = 41,
  N = 29,
  VIEWS = 2,
  FRAMES = 8, /* of a walk, in steps of */
  DEGREES = 3
};

/* All counts that are not zero, and the end of the line. */
static void write_counts(const struct hsr_algorithm *a,
                         const struct hsr_tally *tally, FILE *out) {
  const char *between = "";
  for (int k = 0; a->counters && a->counters[k].name; k++) {
    if (!tally->count[k])
      continue;
    fprintf(out, "%s%s=%llu", between, a->counters[k].name,
            (unsigned long long)tally->count[k]);
    between = ", ";
  }
  fprintf(out, "\n");
}

/* The line of one view. `choice` is NULL for the standard one. */
static void count_view(const struct hsr_algorithm *a,
                       const struct hsr_choice *choice,
                       const struct both_worlds *worlds, const char *scene,
                       uint32_t number, FILE *out) {
  struct hsr_view view;
  struct hsr_answer answer;
  struct hsr_tally tally = {.trace = NULL};
  must_view(&view, &worlds->scene->views[number], M, N);
  bool drawn = draw_chosen(a, choice, &worlds->world, &view, &answer, &tally);
  hsr_answer_free(&answer);
  fprintf(out, "%s\t%s\tview %u\t", a->name, scene, number + 1);
  if (drawn)
    write_counts(a, &tally, out);
  else
    fprintf(out, "refused\n");
}

/* Frame k of a walk. */
static void turn(const struct hsr_camera *first, int k, struct hsr_view *view) {
  struct hsr_camera camera = *first;
  const double angle = k * DEGREES * acos(-1) / 180;
  double x = first->eye[0] - first->at[0], z = first->eye[2] - first->at[2];
  camera.eye[0] = first->at[0] + x * cos(angle) + z * sin(angle);
  camera.eye[2] = first->at[2] + z * cos(angle) - x * sin(angle);
  must_view(view, &camera, M, N);
}

/* The line of a walk: one prepared object draws all frames. */
static void count_walk(const struct hsr_algorithm *a,
                       const struct both_worlds *worlds, const char *scene,
                       FILE *out) {
  static uint32_t ids[M * N];
  struct hsr_setup setup;
  struct hsr_arena scratch = HSR_ARENA_EMPTY;
  struct hsr_error err = {.text = "out of memory"};
  struct hsr_tally tally = {.trace = NULL};
  struct hsr_answer answer = hsr_answer_of_ids(ids, M, N);
  must_setup(&setup, a, NULL, &worlds->world);
  for (int k = 0; k < FRAMES; k++) {
    struct hsr_view view;
    turn(&worlds->scene->views[0], k, &view);
    struct hsr_job job = {
        .view = &view, .scratch = &scratch, .tally = &tally, .answer = &answer};
    hsr_arena_reset(&scratch);
    if (hsr_setup_render(&setup, &job, &err))
      bail("%s: %s", a->name, err.text);
  }
  hsr_setup_free(&setup);
  hsr_arena_free(&scratch);
  fprintf(out, "%s\t%s\twalk of %d\t", a->name, scene, FRAMES);
  write_counts(a, &tally, out);
}

/* The counts of the first view, for each further kind. */
static void count_also(const struct hsr_algorithm *a,
                       const struct both_worlds *worlds, const char *scene,
                       FILE *out) {
  for (int k = 0; hsr_makes_besides(a, k); k++) {
    char name[200];
    const struct hsr_answer_type *type = hsr_makes_besides(a, k);
    struct hsr_choice choice = choose_also(a, type);
    const struct hsr_option *first = type->options;
    snprintf(name, sizeof name, "%s:%s=%s", scene, first->name,
             first->words[choice.form.values.option[0]].name);
    count_view(a, &choice, worlds, name, 0, out);
  }
}

/* All lines of a module. Owned by the caller. */
static char *count_all(const struct hsr_algorithm *a) {
  char *text = NULL;
  size_t size = 0;
  FILE *out = open_memstream(&text, &size);
  bool takes_faces = a->subjects & 1 << HSR_FACES;
  for (int s = 0; out && s < (takes_faces ? N_SCENES : N_GRIDS); s++) {
    struct both_worlds worlds;
    const char *name = takes_faces ? scenes[s] : grids[s];
    open_worlds(&worlds, name);
    for (uint32_t v = 0; v < VIEWS && v < worlds.scene->n_views; v++)
      count_view(a, NULL, &worlds, name, v, out);
    if (a->flags & HSR_FRAME_STATE && hsr_own_kind(a) == &hsr_answer_ids)
      count_walk(a, &worlds, name, out);
    count_also(a, &worlds, name, out);
    close_worlds(&worlds);
  }
  if (!out || fclose(out))
    abort();
  return text;
}

/* --- The files ------------------------------------------------------------ */

static const char *const branch_names[] = {
    [HSR_OBJECT_SPACE_VOLUMES] = "edges_against_volumes",
    [HSR_OBJECT_SPACE_EDGES] = "edges_against_edges",
    [HSR_LIST_PRIORITY_FIXED] = "list_priority_fixed",
    [HSR_LIST_PRIORITY_PER_FRAME] = "list_priority_per_frame",
    [HSR_IMAGE_SPACE_AREA] = "image_space_area",
    [HSR_IMAGE_SPACE_POINT] = "image_space_point",
    [HSR_BRUTE_FORCE] = "brute_force",
    [HSR_HIERARCHICAL] = "hierarchical",
    [HSR_VOLUME_SPACE] = "volume",
    [HSR_YARDSTICK] = "yardstick"};

static FILE *open_golden(const struct hsr_algorithm *a, const char *mode) {
  char path[4096];
  const char *source = getenv("HSR_SOURCE");
  snprintf(path, sizeof path, "%s/tests/counts/golden/%s.txt",
           source ? source : ".", branch_names[a->taxonomy]);
  return fopen(path, mode);
}

/* The golden lines of a module; "" if there are none. Owned by the caller. */
static char *read_golden(const struct hsr_algorithm *a) {
  char *text = NULL, *line = NULL;
  size_t size = 0, room = 0, length = strlen(a->name);
  FILE *out = open_memstream(&text, &size), *in = open_golden(a, "r");
  while (out && in && getline(&line, &room, in) > 0)
    if (!strncmp(line, a->name, length) && line[length] == '\t')
      fputs(line, out);
  free(line);
  if (!out || fclose(out) || (in && fclose(in)))
    abort();
  return text;
}

static bool is_player(const struct hsr_algorithm *a) {
  return !(a->flags & (HSR_JUDGE | HSR_NO_PICTURE));
}

/* Writes the file of a module's branch anew, with these lines for the module.
 * The lines of the others stay as they are. */
static void write_golden(const struct hsr_algorithm *a, const char *counted) {
  char *text = NULL;
  size_t size = 0;
  FILE *out = open_memstream(&text, &size);
  for (const struct hsr_listed *l = all_listed(); out && l->plain; l++) {
    const struct hsr_algorithm *other = l->counting;
    if (!is_player(other) || other->taxonomy != a->taxonomy)
      continue;
    char *lines = read_golden(other);
    fputs(strcmp(other->name, a->name) ? lines : counted, out);
    free(lines);
  }
  if (!out || fclose(out) || !(out = open_golden(a, "w")) ||
      fputs(text, out) < 0 || fclose(out))
    abort();
  free(text);
}

/* --- Comparison ----------------------------------------------------------- */

/* An entry of a list "NAME=COUNT, ..."; "refused" is one, too, of count 1. */
struct entry {
  const char *name;
  int length;
  unsigned long long count;
};

/* The entry at *at, which then stands at the next one. False after the last. */
static bool next_entry(const char **at, struct entry *entry) {
  *at += strspn(*at, ", ");
  entry->name = *at;
  entry->length = (int)strcspn(*at, "=,\n");
  const char *end = *at + entry->length;
  entry->count = *end == '=' ? strtoull(end + 1, NULL, 10) : 1;
  *at = end + strcspn(end, ",\n");
  return entry->length > 0;
}

/* The count of that name in a list; 0 if it is not there. */
static unsigned long long find_count(const char *list,
                                     const struct entry *wanted) {
  struct entry entry;
  while (next_entry(&list, &entry))
    if (entry.length == wanted->length &&
        !strncmp(entry.name, wanted->name, (size_t)entry.length))
      return entry.count;
  return 0;
}

/* A text of lines, and the place of the list in a line. */
static const char *next_line(const char *line) {
  return line + strcspn(line, "\n") + 1;
}

static int list_at(const char *line) {
  const char *at = line;
  for (int tabs = 0; tabs < 3; at++)
    tabs += *at == '\t';
  return (int)(at - line);
}

/* The list of the line that begins as this one does; "" if there is none. */
static const char *find_list(const char *text, const char *wanted) {
  int length = list_at(wanted);
  for (const char *line = text; *line; line = next_line(line))
    if (!strncmp(line, wanted, (size_t)length))
      return line + length;
  return "";
}

enum { MOST_TOLD = 5 };

/* Counts a difference in *differ. Tells the first ones. */
static void tell(long *differ, const char *line, const struct entry *entry,
                 unsigned long long counted, unsigned long long golden) {
  if (++*differ <= MOST_TOLD)
    printf("# %.*s%.*s: counted %llu, golden %llu\n", list_at(line), line,
           entry->length, entry->name, counted, golden);
}

/* How many counts differ, and lines that are not empty. */
static long compare(const char *counted, const char *golden) {
  struct entry entry;
  long differ = 0;
  for (const char *line = counted; *line; line = next_line(line)) {
    const char *list = line + list_at(line), *other = find_list(golden, line);
    while (next_entry(&list, &entry))
      if (find_count(other, &entry) != entry.count)
        tell(&differ, line, &entry, entry.count, find_count(other, &entry));
  }
  for (const char *line = golden; *line; line = next_line(line)) {
    const char *list = line + list_at(line), *other = find_list(counted, line);
    while (next_entry(&list, &entry))
      if (!find_count(other, &entry))
        tell(&differ, line, &entry, 0, entry.count);
  }
  if (!differ && strcmp(counted, golden) && ++differ)
    printf("# the order of the lines or of the counters differs\n");
  return differ;
}

/* Compares a module's counts, and writes them if asked to. */
static void check(struct tap *tap, const struct hsr_algorithm *a, bool write,
                  bool named) {
  char *counted = count_all(a), *golden = read_golden(a);
  bool none = !*golden;
  long differ = none ? 0 : compare(counted, golden);
  if (write) {
    write_golden(a, counted);
    ok(tap, true, "%s: written, %ld counts differ", a->name, differ);
  } else if (none)
    ok(tap, named, "%s%s: no golden counts yet: run tests/counts/rewrite %s",
       named ? "# SKIP " : "", a->name, a->name);
  else
    ok(tap, !differ, "%s: counts as they were (%ld differ)", a->name, differ);
  free(golden);
  free(counted);
}

int main(int argc, char **argv) {
  bool write = argc > 1 && !strcmp(argv[1], "--write");
  argc -= 1 + write;
  argv += 1 + write;
  int n = 0;
  for (const struct hsr_listed *l = all_listed(); l->plain; l++)
    n += is_player(l->counting) && is_asked(l->counting, argc, argv);
  if (n == 0)
    bail("no module of such a name");
  struct tap tap = plan(n);
  for (const struct hsr_listed *l = all_listed(); l->plain; l++)
    if (is_player(l->counting) && is_asked(l->counting, argc, argv))
      check(&tap, l->counting, write, argc > 0);
  return finish(&tap);
}
