/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The tables as text, as wide as the terminal, but no wider than 100 columns.
 */
#include "bench/modules/modules.h"
#include "bench/tables/claims.h"
#include "bench/tables/greene.h"
#include "bench/tables/prices.h"
#include "bench/results/descriptor.h"
#include "bench/terminal/terminal.h"

#include <math.h>
#include <string.h>

/* Columns: of all; of the title of a row; of the space before the figures of a
 * step; of the four figures of an environment; before the bars of a summary. */
enum { WIDEST = 100, ROW = 24, STEP = 2, FIGURES = 25, SUMMARY = 60 };

static int width(void) {
  int columns = terminal_columns(stdout);
  return columns && columns < WIDEST ? columns : WIDEST;
}

/* --- Pieces --------------------------------------------------------------- */

static void title(const char *text) {
  printf("\n%s\n", text);
  for (size_t k = strlen(text); k; k--)
    putchar('-');
  putchar('\n');
}

/* Prints words on lines that begin `indent` columns in. The first line already
 * has a text that wide. */
static void wrap(int indent, const char *text) {
  int column = indent;
  while (*text) {
    int length = (int)strcspn(text, " ");
    if (column > indent && column + 1 + length > width()) {
      printf("\n%*s", indent, "");
      column = indent;
    }
    column += printf("%s%.*s", column > indent ? " " : "", length, text);
    text += length + (text[length] == ' ');
  }
  putchar('\n');
}

struct short_number short_number(double x) {
  static const char unit[] = " KMGT";
  struct short_number n = {"-"};
  int u = 0;
  if (isnan(x))
    return n;
  for (; u < 4 && fabs(x) >= 999.5; u++)
    x /= 1000;
  int digits = fabs(x) >= 99.95   ? 0
               : fabs(x) >= 9.995 ? 1
               : fabs(x) >= 0.995 ? 2
                                  : 3;
  if (u == 0 && x == nearbyint(x))
    digits = 0;
  if (x != 0 && fabs(x) < 0.0005)
    snprintf(n.text, sizeof n.text, "%.0e", x);
  else
    snprintf(n.text, sizeof n.text, "%.*f%.*s", digits, x, u > 0, unit + u);
  return n;
}

/* A figure of the survey, which has two or three digits: 2.5K, 60K. */
static struct short_number printed(double x) {
  struct short_number n = short_number(x);
  char *point = strchr(n.text, '.');
  if (!point)
    return n;
  char *unit = point + strspn(point, ".0123456789"), *end = unit;
  while (end[-1] == '0')
    end--;
  memmove(end - (end[-1] == '.'), unit, strlen(unit) + 1);
  return n;
}

/* The ratio of measured to predicted. */
static struct short_number ratio(double measured, double foretold) {
  return short_number(measured > 0 && foretold > 0 ? measured / foretold : NAN);
}

/* Those of the environments that fit beside one another after `indent` columns:
 * from `first` to before `end`. After the last ones, none. */
struct block {
  int first, end;
};
static struct block next_block(struct block before, int indent) {
  int n = (width() - indent) / FIGURES, left = ENVIRONMENTS - before.end;
  n = n < 1 ? 1 : n > left ? left : n;
  return (struct block){before.end, before.end + n};
}
static struct block first_block(int indent) {
  return next_block((struct block){0, 0}, indent);
}

static void print_environments(struct block block, int indent,
                               const char *after) {
  printf("%*s", indent, "");
  for (int e = block.first; e < block.end; e++)
    printf(" %*s", FIGURES - 1, paper_environments[e].scene);
  printf("\n%*s", indent, "");
  for (int e = block.first; e < block.end; e++)
    fputs("  paper pred. meas. ratio", stdout);
  puts(after);
}

/* Prints the survey's figure, the prediction from our Table I, the measured
 * figure, and the ratio of measured to predicted. */
static void print_four(struct block block, const double *paper,
                       const double *predicted, const double *measured) {
  for (int e = block.first; e < block.end; e++)
    printf("  %5s %5s %5s %5s", printed(paper ? paper[e] : NAN).text,
           short_number(predicted[e]).text, short_number(measured[e]).text,
           ratio(measured[e], predicted[e]).text);
}

/* --- Tables I to III ------------------------------------------------------ */

static void print_table1(void) {
  title("Table I. Environment statistics");
#define X(field, symbol, meaning) printf("%-4s %s\n", symbol, meaning);
  HSR_TABLE1(X)
#undef X
}

static void print_table2_block(const struct tables *t, struct block block) {
  putchar('\n');
  print_environments(block, ROW, "");
#define X(field, symbol, meaning)                                              \
  {                                                                            \
    const struct paper_statistic *s = paper_statistic(symbol);                 \
    double rule[ENVIRONMENTS], measured[ENVIRONMENTS];                         \
    for (int e = 0; e < ENVIRONMENTS; e++) {                                   \
      rule[e] = t->scene[e].rules.field;                                       \
      measured[e] = t->scene[e].measured.field;                                \
    }                                                                          \
    printf("%-4s %-19s", symbol, s && s->rule ? s->rule : "-");                \
    print_four(block, s ? s->figure : NULL, rule, measured);                   \
    putchar('\n');                                                             \
  }
  HSR_TABLE1(X)
#undef X
}

static void print_table2(const struct tables *t) {
  title("Table II. Statistics of the three environments");
  wrap(0, "paper: as printed; pred.: the rule applied to the measured n, m, "
          "F_r, F_c and D_c; meas.: measured; ratio: measured to predicted.");
  for (struct block b = first_block(ROW); b.first < b.end;
       b = next_block(b, ROW))
    print_table2_block(t, b);
}

/* Whether there is room for a column behind all environments. */
static bool growth_fits(void) {
  enum { GROWTH = 20 };
  return STEP + ENVIRONMENTS * FIGURES + GROWTH <= width();
}

static void print_growth(const struct series *s) {
  if (!growth_fits())
    printf("\n%*sgrowth measured:", 2 * STEP, "");
  if (isnan(s->growth.exponent))
    printf("%6s", "-");
  else if (isnan(s->growth.low))
    printf("%6.2f", s->growth.exponent);
  else
    printf("%6.2f [%.2f, %.2f]", s->growth.exponent, s->growth.low,
           s->growth.high);
}

/* Whether one of the terms before number k has its kind, too. */
static bool has_term_before(const struct hsr_step *step, int k,
                            const struct hsr_term *term) {
  struct hsr_term before;
  for (int l = 0; l < k && hsr_step_term(step, l, &before); l++)
    if (before.kind == term->kind && before.less == term->less)
      return true;
  return false;
}

/* Writes " + 100 face-window" for each kind of a step's terms. */
static void write_terms(const struct hsr_step *step,
                        const struct hsr_prices *prices, char text[200]) {
  struct hsr_term term;
  text[0] = '\0';
  for (int k = 0; hsr_step_term(step, k, &term); k++) {
    size_t used = strlen(text);
    if (has_term_before(step, k, &term))
      continue;
    snprintf(text + used, 200 - used, "%s%g %s",
             term.less ? " - "
             : k       ? " + "
                       : "",
             prices->of[term.kind - HSR_FIRST_KIND],
             hsr_kinds[term.kind - HSR_FIRST_KIND].name);
  }
}

static void print_step(const struct table_step *row,
                       const struct hsr_prices *prices) {
  const struct hsr_step *step = row->step;
  bool once = row->paper && row->paper->once;
  char text[600], predicted[40] = "", terms[200];
  if (!isnan(row->cost.predicted_growth.exponent))
    snprintf(predicted, sizeof predicted, "   ~ F_r^%.2f",
             row->cost.predicted_growth.exponent);
  write_terms(step, prices, terms);
  snprintf(text, sizeof text, "%s: %s%s   (%s)%s", step->label,
           step->formula ? step->formula : "-",
           once && !strstr(step->formula, "not per frame") ? ", not per frame"
                                                           : "",
           terms, predicted);
  printf("%*s", STEP, "");
  wrap(STEP, text);
  for (struct block b = first_block(STEP); b.first < b.end;
       b = next_block(b, STEP)) {
    printf("%s%*s", b.first ? "\n" : "", STEP, "");
    print_four(b, row->paper ? row->paper->figure : NULL, row->cost.predicted,
               row->cost.measured);
  }
  print_growth(&row->cost);
  putchar('\n');
}

/* Says what was done to the scenes before they were counted: the predictions are
 * those of the scenes as they are. */
static void print_adapted(const struct tables *t,
                          const struct table_algorithm *a) {
  char names[200] = "";
  for (int s = 0; s < t->n_scenes && !names[0]; s++) {
    size_t k;
    json_t *name;
    json_array_foreach(json_object_get(a->cell[s], "adapted"), k, name) {
      size_t used = strlen(names);
      snprintf(names + used, sizeof names - used, "%s%s", used ? ", " : "",
               json_string_value(name));
    }
  }
  if (names[0])
    printf("    counted after: %s; the predictions are of the scene as it is\n",
           names);
}

/* Says on which scenes there are no counts, and why. */
static void print_missing(const struct tables *t,
                          const struct table_algorithm *a) {
  for (int s = 0; s < t->n_scenes; s++) {
    const char *why = tables_missing(a, s);
    if (why)
      printf("    no counts of %s: %s\n", t->scene[s].name, why);
  }
}

/* The faces that the core leaves out before the algorithm sees them, by kind. */
static void print_culled(const struct table_algorithm *a) {
  enum { INDENT = 4 };
  for (int c = 0; c < HSR_N_CULLS; c++) {
    char text[300];
    int used = snprintf(text, sizeof text,
                        "left out by the core, %s:", hsr_cull_name[c]);
    const int begin = used;
    for (int e = 0; e < ENVIRONMENTS; e++) {
      const json_t *n = json_object_get(json_object_get(a->cell[e], "culled"),
                                        hsr_cull_name[c]);
      if (n)
        used += snprintf(text + used, sizeof text - (size_t)used, "%s %s %s",
                         used > begin ? "," : "", paper_environments[e].scene,
                         short_number((double)json_integer_value(n)).text);
    }
    if (used == begin)
      continue;
    printf("%*s", INDENT, "");
    wrap(INDENT, text);
  }
}

static void print_ladder(const struct tables *t) {
  if (t->n_scenes == ENVIRONMENTS) {
    puts("There is no ladder of harbor:N among the results: no growth.");
    return;
  }
  char text[1200] = "Growth: the e of cost ~ F_r^e, measured (with its "
                    "95 % interval) and of the formula (behind it), over";
  for (int s = ENVIRONMENTS; s < t->n_scenes; s++) {
    size_t used = strlen(text);
    snprintf(text + used, sizeof text - used, " %s%s", t->scene[s].name,
             s + 1 < t->n_scenes ? "," : ".");
  }
  wrap(0, text);
}

static void print_prices(const struct tables *t) {
  enum { SOURCE = 23 };
  title("Prices. What a comparison costs, by its kind");
  wrap(0, "The survey calls them complexity factors. One kind has one price in "
          "all algorithms; a number in parentheses is a paragraph of the "
          "survey's appendix B, CF its \"Complexity Factors\". Other prices: "
          "hsr tables --prices FILE.");
  for (int k = 0; k < HSR_N_KINDS; k++) {
    const struct hsr_kind_described *kind = &hsr_kinds[k];
    char text[400], changed[40] = "";
    if (t->prices.of[k] < kind->price || t->prices.of[k] > kind->price)
      snprintf(changed, sizeof changed, " [standard: %g]", kind->price);
    printf("%-15s %6g ", kind->name, t->prices.of[k]);
    snprintf(text, sizeof text, "%s%s. %s", kind->meaning, changed,
             kind->source);
    wrap(SOURCE, text);
  }
}

static void print_table3(const struct tables *t) {
  title("Table III. Costs in the three environments, step by step");
  wrap(
      0,
      "cost = price x count, of each kind of comparison that a step makes; the "
      "price and the kind are behind its formula. paper: as printed, for its "
      "own Table "
      "II; pred.: its formula applied to our Table I; meas.: measured; "
      "ratio: measured to predicted.");
  print_ladder(t);
  putchar('\n');
  for (struct block b = first_block(STEP); b.first < b.end;
       b = next_block(b, STEP))
    print_environments(b, STEP, growth_fits() ? "  growth measured" : "");
  for (int a = 0; a < t->n_algorithms; a++) {
    printf("\n%s\n", t->algorithm[a].algorithm->name);
    for (int k = 0; k < t->algorithm[a].n_steps; k++)
      print_step(&t->algorithm[a].step[k], &t->prices);
    print_culled(&t->algorithm[a]);
    print_adapted(t, &t->algorithm[a]);
    print_missing(t, &t->algorithm[a]);
  }
}

/* --- Tables IV to VII ----------------------------------------------------- */

/* Prints a part of the whole as a bar, "#####". */
static void print_bar(double part) {
  int room = width() - SUMMARY;
  int length = (int)nearbyint((room < 30 ? room : 30) * part);
  if (length > 0)
    printf("  ");
  for (int k = 0; k < length; k++)
    putchar('#');
}

static void print_summary_of(const struct table_algorithm *a, int e) {
  double total = a->total.measured[e];
  const char *why = tables_missing(a, e);
  printf("%-30s %6s %6s %6s %6s  ", a->algorithm->name,
         printed(a->paper ? a->paper->total[e] : NAN).text,
         short_number(a->total.predicted[e]).text, short_number(total).text,
         ratio(total, a->total.predicted[e]).text);
  wrap(SUMMARY, why ? why : "");
  for (int k = 0; k < a->n_steps; k++) {
    const struct table_step *row = &a->step[k];
    double measured = row->cost.measured[e];
    bool once = row->paper && row->paper->once;
    printf("  %-28s %6s %6s %6s %6s", row->step->label,
           printed(row->paper ? row->paper->figure[e] : NAN).text,
           short_number(row->cost.predicted[e]).text,
           short_number(measured).text,
           ratio(measured, row->cost.predicted[e]).text);
    if (once)
      printf("  not charged");
    else if (!isnan(total))
      print_bar(measured / total);
    putchar('\n');
  }
}

static void print_summary(const struct tables *t, int e) {
  static const char *const numeral[ENVIRONMENTS] = {"IV", "V", "VI"};
  char text[100];
  snprintf(text, sizeof text, "Table %s. Cost summary: %s, %s", numeral[e],
           paper_environments[e].scene, paper_environments[e].title);
  title(text);
  printf("%-30s %6s %6s %6s %6s  %s\n", "", "paper", "pred.", "meas.", "ratio",
         "part of what was measured");
  for (int a = 0; a < t->n_algorithms; a++)
    print_summary_of(&t->algorithm[a], e);
}

static void print_table7_block(const struct tables *t, struct block block) {
  print_environments(block, ROW, "");
  for (int a = 0; a < t->n_algorithms; a++) {
    const struct table_algorithm *row = &t->algorithm[a];
    printf("%-*s", ROW, row->algorithm->name);
    print_four(block, row->paper ? row->paper->total : NULL,
               row->total.predicted, row->total.measured);
    putchar('\n');
  }
  putchar('\n');
}

static void print_table7(const struct tables *t) {
  title("Table VII. Cost summary: the three environments");
  for (struct block b = first_block(ROW); b.first < b.end;
       b = next_block(b, ROW))
    print_table7_block(t, b);
  wrap(0, "Measured totals include the steps for which there is no prediction. "
          "For an algorithm made of two, the prediction is what both would "
          "cost alone.");
}

/* --- The taxonomy --------------------------------------------------------- */

static bool is_yardstick(const struct hsr_algorithm *a) {
  return a->taxonomy == HSR_YARDSTICK;
}

static void print_leaf(const struct hsr_algorithm *a, const char *before) {
  printf("%s%-20s", before, a->name);
  if (a->year)
    printf(" %d  %s\n", a->year, a->authors);
  else
    puts("       not published");
}

/* Whether more algorithms of the branch follow; after the last one the branch's
 * line in the tree ends. */
static bool more_of_branch(const struct hsr_listed *after, enum hsr_branch b) {
  for (after++; after->plain; after++)
    if (after->plain->taxonomy == b)
      return true;
  return false;
}

static void print_branch(enum hsr_branch branch, const char *indent) {
  for (const struct hsr_listed *l = hsr_algorithms(); l->plain; l++)
    if (l->plain->taxonomy == branch) {
      char before[40];
      snprintf(before, sizeof before, "%s%s-- ", indent,
               more_of_branch(l, branch) ? "|" : "`");
      print_leaf(l->plain, before);
    }
}

static void print_figure13(void) {
  title("Figure 13. The algorithms arranged in a tree");
  puts("hidden-surface algorithms");
  const char *class = "";
  for (int b = 0; b < HSR_YARDSTICK; b++) {
    struct taxonomy place = taxonomy((enum hsr_branch)b);
    struct taxonomy next = taxonomy((enum hsr_branch)(b + 1));
    bool last_class = b + 1 == HSR_YARDSTICK;
    if (strcmp(class, place.class))
      printf("%s-- %s\n", last_class ? "`" : "|", place.class);
    class = place.class;
    bool last = strcmp(next.class, place.class) != 0;
    if (place.branch)
      printf("|   %s-- %s\n", last ? "`" : "|", place.branch);
    print_branch((enum hsr_branch)b, last_class      ? "    "
                                     : !place.branch ? "|   "
                                     : last          ? "|       "
                                                     : "|   |   ");
  }
}

/* Prints one more name, in the same row or in the next. Returns the column
 * after it. */
static int print_next(const char *name, int column) {
  if (column + 2 + (int)strlen(name) < width())
    return column + printf(", %s", name);
  puts(",");
  return printf("%-10s %s", "", name);
}

static void print_orders(void) {
  title("Sorting orders");
  for (const struct hsr_listed *l = hsr_algorithms(); l->plain; l++) {
    const char *order = l->plain->sort_order;
    bool before = false;
    for (const struct hsr_listed *b = hsr_algorithms(); order && b != l; b++)
      before = before ||
               (b->plain->sort_order && !strcmp(b->plain->sort_order, order));
    if (!order || before)
      continue;
    int column = printf("%-10s %s", order, l->plain->name);
    for (const struct hsr_listed *m = l + 1; m->plain; m++)
      if (m->plain->sort_order && !strcmp(m->plain->sort_order, order))
        column = print_next(m->plain->name, column);
    putchar('\n');
  }
}

static void print_figure29a(void) {
  title("Figure 29a, reconstructed. What restricts the environment");
  wrap(0, "The survey's own figure is lost in the scans that we have: this is "
          "made from its text, and from what our modules need. x: the module "
          "needs it; o: the survey's algorithm does, the module does not.");
  puts("CC  clusters are closed convex polyhedra  NP  no penetrating faces\n"
       "CF  faces are convex polygons             TP  topology is needed\n"
       "TR  faces are triangles                   PF  planar faces only\n"
       "LS  clusters are linearly separable       OF  no faces out of view\n"
       "                                          BE  no faces behind the "
       "observer\n");
  printf("%-20s", "");
  for (int k = 0; k < HSR_N_RESTRICTIONS; k++)
    printf(" %s", hsr_restriction_code(1u << k));
  putchar('\n');
  for (const struct hsr_listed *l = hsr_algorithms(); l->plain; l++) {
    if (is_yardstick(l->plain))
      continue;
    char row[2 + 9 * 3] = "";
    for (int k = 0; k < HSR_N_RESTRICTIONS; k++)
      strcat(row, l->plain->restrictions & 1u << k ? "  x"
                  : l->plain->lifted & 1u << k     ? "  o"
                                                   : "  .");
    printf("%-20s%s\n", l->plain->name, row);
  }
}

static void print_figure29b(void) {
  title(
      "Figure 29b, reconstructed. What is sorted, by what key and method, how "
      "often");
  puts("Of the survey's own: from its text; its figure is lost in the scans.");
  for (const struct hsr_listed *l = hsr_algorithms(); l->plain; l++) {
    const struct hsr_algorithm *a = l->plain;
    if (is_yardstick(a))
      continue;
    printf("%-20s ", a->name);
    char text[400];
    snprintf(text, sizeof text, "%s%scoherence: %s",
             a->sort_order ? a->sort_order : "", a->sort_order ? "; " : "",
             a->coherence ? a->coherence : "none");
    wrap(21, text);
    int n = 0;
    for (const struct hsr_sort *s = a->sorts; s && s->what; s++) {
      printf("  %d. ", ++n);
      snprintf(text, sizeof text, "%s (%s): %s, %s", s->what, s->key, s->method,
               s->often);
      wrap(5, text);
    }
  }
}

/* --- Conclusions ---------------------------------------------------------- */

/* Tells which verdicts are others by the standard prices. */
static void print_changed(const struct tables *t) {
  struct tables *standard = tables_of_standard(t);
  int n = 0;
  for (int k = 0; standard && k < claims_count(); k++) {
    struct conclusion c = claims_judge(t, k), was = claims_judge(standard, k);
    if (c.finding == was.finding)
      continue;
    if (!n++)
      puts("\nBy the standard prices these are judged otherwise:");
    char text[sizeof was.evidence + 400];
    snprintf(text, sizeof text, "%s (%s)", c.claim, was.evidence);
    printf("%-14s ", finding_name(was.finding));
    wrap(15, text);
  }
  if (standard && !n)
    puts("\nThe standard prices give the same verdicts.");
  tables_delete(standard);
}

static void print_conclusions(const struct tables *t) {
  title("The survey's conclusions, and whether the counts bear them out");
  wrap(0,
       "Judged by computation: each by the criterion below it. Behind a claim "
       "are the section and the beginning of the sentence that makes it. An "
       "erratum: where the survey contradicts itself.");
  int n[NOT_BORNE_OUT + 1] = {0};
  for (int k = 0; k < claims_count(); k++) {
    struct conclusion c = claims_judge(t, k);
    n[c.finding]++;
    printf("\n%-14s ", finding_name(c.finding));
    char text[400];
    snprintf(text, sizeof text, "%s (%s: \"%s\")", c.claim, c.section,
             c.sentence);
    wrap(15, text);
    printf("%15s", "");
    wrap(15, c.criterion);
    if (c.evidence[0]) {
      printf("%15s", "");
      wrap(15, c.evidence);
    }
    if (c.erratum) {
      snprintf(text, sizeof text, "erratum: %s", c.erratum);
      printf("%15s", "");
      wrap(15, text);
    }
  }
  printf("\n%d claims: %d borne out, %d not borne out, %d undecided, %d not "
         "measured\n",
         claims_count(), n[BORNE_OUT], n[NOT_BORNE_OUT], n[UNDECIDED],
         n[NOT_MEASURED]);
  print_changed(t);
}

void tables_print(const struct tables *t) {
  wrap(
      0,
      "The tables of Sutherland, Sproull and Schumacker, A Characterization of "
      "Ten Hidden-Surface Algorithms, Computing Surveys 6(1), 1974, measured. "
      "K = 1,000; M = 1,000,000; G = 10^9; T = 10^12.");
  puts("-: none, or not measured.");
  print_table1();
  print_table2(t);
  print_prices(t);
  print_table3(t);
  for (int e = 0; e < ENVIRONMENTS; e++)
    print_summary(t, e);
  print_table7(t);
  print_figure13();
  print_orders();
  print_figure29a();
  print_figure29b();
  print_conclusions(t);
}

/* --- Greene --------------------------------------------------------------- */

/* Prints a reason; "as above" if it is the same as the last one. */
static void print_reason(const char *reason, int indent, const char **last) {
  printf("%*s> ", indent, "");
  wrap(indent + 2, !strcmp(reason, *last) ? "as above" : reason);
  *last = reason;
}

static void print_figure(const struct greene_figure *f, double ours,
                         const char **last) {
  enum { TEXT = 29 };
  printf("%8s %8s %9s  ", short_number(f->printed).text,
         short_number(ours).text, ratio(ours, f->printed).text);
  char text[300];
  snprintf(text, sizeof text, *f->source ? "%s (%s)" : "%s%s", f->what,
           f->source);
  wrap(TEXT, text);
  const char *reason = greene_reason(f, ours);
  if (reason)
    print_reason(reason, TEXT, last);
}

void greene_print(const struct results *results) {
  wrap(0,
       "Greene's figures on hierarchical visibility beside ours: counts, and "
       "ratios of times, each the least time of a frame. 1993: with Kass and "
       "Miller, SIGGRAPH. 1995: thesis. 1996: SIGGRAPH. -: he prints none, or "
       "the results do not have it. >: why ours is off by more than a factor "
       "of 2.");
  puts("K = 1,000; M = 1,000,000.");
  const char *last = "";
  for (const struct greene_figure *f = greene_figures; f->what; f++)
    if (f->source) {
      print_figure(f, greene_measured(f, results), &last);
    } else {
      title(f->what);
      printf("%8s %8s %9s\n", "his", "ours", "ours/his");
    }
}
