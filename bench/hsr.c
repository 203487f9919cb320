/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The hsr command: chooses the subcommand, and ends the program. */
#include "config.h"

#include "bench/options/command.h"
#include "bench/options/complete.h"
#include "bench/options/parser.h"
#include "bench/modules/outside.h"
#include "bench/ranks/ranks.h"
#include "bench/run/terminate.h"
#include "bench/suite/suite.h"
#include "bench/options/streams.h"
#include "bench/terminal/pager.h"
#include "bench/terminal/terminal.h"
#include "common/base/names.h"

#include <fcntl.h>
#include <locale.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const struct hsr_command commands[] = {
    {"list", "the algorithms, with their place in the taxonomy", command_list},
    {"scenes", "the scenes, their views and face counts", command_scenes},
    {"stats", "Table I of a scene and view, beside Table II's rules",
     command_stats},
    {"render", "make a picture with one algorithm", command_render},
    {"view", "look around in a scene, as algorithms draw it", command_view},
    {"export", "a scene, or what an algorithm works with, for other programs",
     command_export},
    {"generate", "a scene with the statistics of Table I that are asked for",
     command_generate},
    {"check", "every algorithm against the oracle, sample for sample",
     command_check},
    {"judge", "anybody's picture against the oracle, and what is wrong",
     command_judge},
    {"suite", "scenes, cameras and right answers, to test any renderer with",
     command_suite},
    {"bench", "time the algorithms that are right, in turn", command_bench},
    {"times",
     "the table of what bench recorded: text, CSV, JSON, LaTeX, a plot",
     command_times},
    {"tables", "the survey's Tables I to VII measured, and its conclusions",
     command_tables},
    {"report", "make pages of what bench found", command_report},
    {"trace", "every step of one algorithm, as lines of JSON", command_trace},
    {"lesson", "a page on which algorithms are watched, step by step",
     command_lesson},
    {"lab", "a page in which the algorithms run, on a scene to be changed",
     command_lab},
    {"areas", "how much of the picture shows which face, exactly",
     command_areas},
    {"errors", "how far filtered pictures are from the exact areas",
     command_errors},
    {"voxels", "which solid of a scene each voxel is in", command_voxels},
    {"worker", NULL, command_worker},
    {NULL, NULL, NULL}};

static void print_help(FILE *out) {
  fputs("usage: hsr COMMAND [ARGUMENT...]\n"
        "\n"
        "A testbed for the classic hidden-surface algorithms: one correct\n"
        "picture, every algorithm must produce it, and its work is counted.\n"
        "\n"
        "to begin with:\n"
        "  hsr render house          a picture\n"
        "  hsr check house           who draws it right\n"
        "  hsr list watkins          all of one algorithm\n"
        "\n"
        "commands:\n",
        out);
  for (const struct hsr_command *c = commands; c->name; c++)
    if (c->about)
      fprintf(out, "  hsr %-8s %s\n", c->name, c->about);
  fputs(
      "\n"
      "  hsr help COMMAND explains each; hsr --version tells the version, and\n"
      "  hsr --cite how to cite it. hsr -m FILE.so COMMAND ... loads a module\n"
      "  that is not in hsr; an algorithm whose name has a slash is a "
      "program.\n"
      "\n"
      "A scene is a built-in name with parameters (house, soup:1000:7), a\n"
      "real mesh of Debian's libcgal-demo (mesh:elephant), a mesh file (.off\n"
      ".obj .ply .stl .vtp .gltf .glb), a volume (.nii .nii.gz .mhd .mha .vtk "
      ".vti\n"
      ".vtr) or a .scene.json.\n"
      "\n"
      "exit status: 0 good, 1 a difference or a failed check, 2 usage, 3 bad\n"
      "input, 4 out of memory or a limit, 5 internal.\n",
      out);
}

/* The same as CITATION.cff says, for BibTeX, with the year of the version. */
static void print_citation(void) {
  puts("@misc{hsr,\n"
       "  author = {{The hsr authors}},\n"
       "  title = {hsr: a testbed for hidden-surface algorithms},\n"
       "  year = {2026},\n"
       "  note = {Version " PACKAGE_VERSION "}\n"
       "}\n"
       "\n"
       "@article{sutherland1974,\n"
       "  author = {Sutherland, Ivan E. and Sproull, Robert F. and Schumacker, "
       "Robert A.},\n"
       "  title = {A Characterization of Ten Hidden-Surface Algorithms},\n"
       "  journal = {Computing Surveys},\n"
       "  volume = {6},\n"
       "  number = {1},\n"
       "  pages = {1--55},\n"
       "  year = {1974}\n"
       "}");
}

/* Makes sure that all output has reached stdout. */
static enum hsr_status finish(enum hsr_status status, struct hsr_error *err) {
  if (fflush(stdout) || ferror(stdout))
    if (!status)
      status = hsr_fail(err, HSR_E_INPUT, "standard output: cannot be written");
  return status;
}

/* A file that is opened must not take the number of a standard file that is
 * closed. finish still notices if stdout cannot be written. */
static void hold_standard_files(void) {
  int file;
  do
    file = open("/dev/null", O_RDONLY);
  while (file >= 0 && file <= STDERR_FILENO);
  if (file >= 0)
    close(file);
}

static const struct hsr_command *find_command(const char *name) {
  const struct hsr_command *c = commands;
  while (c->name && strcmp(name, c->name))
    c++;
  return c->name ? c : NULL;
}

static int no_command(const char *name) {
  struct hsr_names list = {0};
  char hint[256] = "", plain[TERMINAL_NAME];
  for (const struct hsr_command *c = commands; c->name; c++)
    if (c->about && hsr_names_add(&list, c->name, strlen(c->name)))
      break; /* there is no hint without memory */
  hsr_names_like(&list, name, hint, sizeof hint);
  hsr_names_free(&list);
  fprintf(stderr, "hsr: no command '%s'%s\n",
          terminal_plain(name, plain, sizeof plain),
          *hint ? hint : " (see hsr --help)");
  return HSR_E_USAGE;
}

static bool is_help(const char *word) {
  static const char *const words[] = {"--help", "-h", "-?", "help"};
  for (size_t k = 0; k < sizeof words / sizeof *words; k++)
    if (!strcmp(word, words[k]))
      return true;
  return false;
}

/* The commands that print a text, at once. */
static bool is_text(const struct hsr_command *command) {
  return command->run == command_list || command->run == command_scenes ||
         command->run == command_stats || command->run == command_tables ||
         command->run == command_times;
}

/* The groups and scenes of hsr suite --scenes A,B; else what the options say. */
static void complete_command(const struct argp *argp, int n,
                             char *const *words) {
  if (n < 3 || strcmp(words[0], "suite") || strcmp(words[n - 2], "--scenes")) {
    complete_words(argp, n, words);
    return;
  }
  const char *comma = strrchr(words[n - 1], ',');
  int stays = comma ? (int)(comma + 1 - words[n - 1]) : 0;
  char name[SUITE_NAME], word[1000];
  for (const struct suite_row *row = suite_rows; row->scene; row++) {
    suite_name(row->scene, name);
    snprintf(word, sizeof word, "%.*s%s", stays, words[n - 1], name);
    if (row == suite_rows || strcmp(row[-1].scene, row->scene))
      complete_offer(words[n - 1], word);
    snprintf(word, sizeof word, "%.*s%s", stays, words[n - 1], row->group);
    if ((row == suite_rows || strcmp(row[-1].group, row->group)) &&
        strcmp(row->group, name))
      complete_offer(words[n - 1], word);
  }
}

/* hsr complete WORD...: prints what the last word may become. */
static int complete(int n, char **words) {
  static const char *const alone[] = {"help", "--help", "--version", "--cite"};
  const char *last = n ? words[n - 1] : "";
  struct hsr_error err;
  if (n > 1 && !is_help(words[0])) {
    const struct hsr_command *command = find_command(words[0]);
    parse_instead(complete_command);
    if (command)
      command->run(n, words, &err);
    return 0;
  }
  for (const struct hsr_command *c = commands; c->name && n < 3; c++)
    if (c->about)
      complete_offer(last, c->name);
  for (size_t k = 0; k < sizeof alone / sizeof *alone && n < 2; k++)
    if (!k || *last == '-')
      complete_offer(last, alone[k]);
  return 0;
}

/* The commands whose work several ranks share. */
static bool takes_ranks(const struct hsr_command *command) {
  return command->run == command_render || command->run == command_check;
}

/* Joins the other ranks, if this is a command for them. */
static enum hsr_status begin(const struct hsr_command *command,
                             struct hsr_error *err) {
  enum hsr_status status = ranks_join(err);
  if (!status && ranks_count() > 1 && !takes_ranks(command))
    status =
        hsr_fail(err, HSR_E_USAGE, "hsr %s is for one process, not for mpirun",
                 command->name);
  return status;
}

/* What fails in several ranks is told by one. */
static void tell(const struct hsr_error *err) {
  char plain[TERMINAL_NAME];
  if (ranks_count() > 1)
    ranks_claim_failure();
  else if (ranks_are_started() && !ranks_is_spokesman())
    return;
  fprintf(stderr, "hsr: %s\n", terminal_plain(err->text, plain, sizeof plain));
}

/* Tells of a failure and leaves the ranks. Returns the exit status. */
static int end(enum hsr_status status, const struct hsr_error *err) {
  int exit_status = status == HSR_E_REFUSED || status == HSR_E_STOPPED
                        ? HSR_E_NOMEM
                        : (int)status;
  if (status && status != HSR_E_DIFFERENCE) {
    tell(err);
    ranks_end(exit_status);
  }
  ranks_leave();
  if (status == HSR_E_NOMEM)
    end_process(exit_status);
  return exit_status;
}

/* Loads the modules that the words -m FILE name, which come before all others.
 * *argc and *argv are moved past them. */
static enum hsr_status load_modules(int *argc, char ***argv,
                                    struct hsr_error *err) {
  enum hsr_status status = outside_inherit(err);
  while (!status && *argc > 1 &&
         (!strcmp((*argv)[1], "-m") || !strcmp((*argv)[1], "--module"))) {
    if (*argc < 3)
      return hsr_fail(err, HSR_E_USAGE, "%s: which module?", (*argv)[1]);
    status = outside_load((*argv)[2], err);
    *argc -= 2;
    *argv += 2;
  }
  return status;
}

int main(int argc, char **argv) {
  hold_standard_files();
  setlocale(LC_CTYPE, "");
  end_in_one_line();
  struct hsr_error err = {.text = "unexplained failure"};
  enum hsr_status status = load_modules(&argc, &argv, &err);
  if (status)
    return end(status, &err);
  if (argc < 2) {
    fputs("hsr: a command is needed, as in hsr render house; hsr help lists "
          "them\n",
          stderr);
    return HSR_E_USAGE;
  }
  if (!strcmp(argv[1], "--version") || !strcmp(argv[1], "-V")) {
    puts("hsr " PACKAGE_VERSION);
    return 0;
  }
  if (!strcmp(argv[1], "--cite")) {
    print_citation();
    return 0;
  }
  bool help = is_help(argv[1]);
  if (!strcmp(argv[1], "complete"))
    return complete(argc - 2, argv + 2);
  if (help && (argc == 2 || is_help(argv[2]))) {
    pager_begin();
    print_help(stdout);
    return 0;
  }
  /* "help COMMAND" is "COMMAND --help" */
  char option[] = "--help",
       *of_command[] = {help ? argv[2] : NULL, option, NULL};
  char **words = help ? of_command : argv + 1;
  int n = help ? 2 : argc - 1;
  const struct hsr_command *command = find_command(words[0]);
  if (!command)
    return no_command(words[0]);
  if (help || is_text(command))
    pager_begin();
  status = begin(command, &err);
  if (!status)
    status = streams_end(command->run(n, words, &err), &err);
  return end(finish(status, &err), &err);
}
