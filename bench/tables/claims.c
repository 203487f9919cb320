/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A claim is about numbers from the tables: one number for each of some
 * environments, or the exponent with which something grows with the relevant
 * faces. It is borne out if all these numbers lie within its limits; for an
 * exponent, its whole interval must.
 *
 * The survey's words are rarely so exact. Its authors compare orders of
 * magnitude. So two costs count as an order apart if they differ by more than
 * half an order, 10^1/2. The exponents that they name are multiples of 1/2, and
 * follow from their formulas where clusters and depth complexity stay as they are.
 * On our ladder they do not stay so. So a measured exponent is compared with that
 * of the formula applied to the measured Table I, and may differ by 1/4. */
#include "bench/tables/claims.h"

#include <math.h>
#include <stdarg.h>
#include <string.h>

enum { MOST_NAMES = 6 };
enum {
  IN_HOUSE = 1,
  IN_HARBOR = 2,
  IN_BIG_HARBOR = 4,
  IN_ALL = 7,
  ON_WALK = 1 << ENVIRONMENTS
};
#define HALF_ORDER 3.1622776601683795
#define QUARTER 0.25

/* A text of items, separated by commas. It is cut off where the room ends. */
struct text {
  char *start;
  size_t size;
};

struct claim {
  const char *section;
  const char *sentence; /* how the survey's sentence begins */
  const char *claim;
  const char *measure; /* what the number is */
  double low, high;    /* limits; infinite: none */
  bool by_formula;     /* they are added to the exponent of the formula */
  const char
      *erratum; /* how the survey contradicts it itself; NULL: it does not */

  /* Returns the number of a scene, or of one of the algorithms on it, and may
   * add a remark. NULL: the claim is about the exponent of a growth. */
  double (*number)(const struct tables *t, const struct claim *claim,
                   const char *algorithm, int scene, struct text remark);
  /* Whether a scene is what the claim speaks of. Adds why not, and what is known
   * of it. NULL: every scene is. */
  bool (*premise)(const struct tables *t, int scene, struct text remark);
  unsigned environments;                 /* IN_... */
  const char *algorithm[MOST_NAMES + 1]; /* each of these; may be none */
  const char *step;                      /* NULL: all steps */
  const char *with; /* of a growth: a step whose cost is added; or NULL */
  size_t statistic; /* offset in struct hsr_table1, if it is that which grows,
                       and not a cost */
};

/* The algorithms that the survey compares. */
static const char *const ten[] = {
    "roberts", "appel",   "loutrel", "galimberti", "schumacker",
    "newell",  "warnock", "romney",  "bouknight",  "watkins"};
enum { TEN = sizeof ten / sizeof *ten, OBJECT_SPACE = 4 };

static void add(struct text text, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
static void add(struct text text, const char *format, ...) {
  size_t used = strlen(text.start);
  if (used && used + 2 < text.size) {
    memcpy(text.start + used, ", ", 3);
    used += 2;
  }
  va_list args;
  va_start(args, format);
  vsnprintf(text.start + used, text.size - used, format, args);
  va_end(args);
}

static double cost(const struct tables *t, const char *algorithm,
                   const char *step, int scene) {
  const struct series *series = tables_cost(t, algorithm, step);
  return series ? series->measured[scene] : NAN;
}

static double total(const struct tables *t, const char *algorithm, int scene) {
  return cost(t, algorithm, NULL, scene);
}

/* The quotient of the greater and the smaller. */
static double factor_between(double a, double b) {
  return isnan(a) || isnan(b) ? NAN : fmax(a / b, b / a);
}

#define NUMBER(name)                                                           \
  static double name(const struct tables *t, const struct claim *claim,        \
                     const char *algorithm, int scene, struct text remark)
#define UNUSED (void)claim, (void)algorithm, (void)remark

/* --- Numbers of all the ten ----------------------------------------------- */

/* The range of the totals of ten[first], ..., except one. NAN if one of them is
 * NAN. */
struct range {
  double least, most, mean; /* geometric */
};
static struct range range_from(const struct tables *t, int first,
                               const char *but, int scene) {
  struct range r = {INFINITY, 0, 0};
  int n = 0;
  for (int k = first; k < TEN; k++) {
    double x = total(t, ten[k], scene);
    if (but && !strcmp(ten[k], but))
      continue;
    if (isnan(x))
      return (struct range){NAN, NAN, NAN};
    r.least = fmin(r.least, x);
    r.most = fmax(r.most, x);
    r.mean += log(x);
    n++;
  }
  r.mean = exp(r.mean / n);
  return r;
}

static void add_total(struct text text, const struct tables *t,
                      const char *algorithm, int scene) {
  add(text, "%s %s", algorithm, short_number(total(t, algorithm, scene)).text);
}

NUMBER(around_a_million) {
  UNUSED;
  int n = 0;
  for (int k = 0; k < TEN; k++) {
    double x = total(t, ten[k], scene);
    if (isnan(x))
      return NAN;
    n += x >= 1e5 && x <= 1e7;
    add_total(remark, t, ten[k], scene);
  }
  return (double)n / TEN;
}

NUMBER(against_the_others) {
  UNUSED;
  return total(t, algorithm, scene) / range_from(t, 0, algorithm, scene).mean;
}

NUMBER(object_space_against_others) {
  UNUSED;
  struct range others = range_from(t, OBJECT_SPACE, NULL, scene);
  double cheapest = INFINITY;
  for (int k = 0; k < OBJECT_SPACE; k++) {
    double x = total(t, ten[k], scene);
    cheapest = isnan(x) || isnan(cheapest) ? NAN : fmin(cheapest, x);
    add_total(remark, t, ten[k], scene);
  }
  add(remark, "the others %s to %s", short_number(others.least).text,
      short_number(others.most).text);
  return cheapest / others.most;
}

NUMBER(farthest_from_mean) {
  UNUSED;
  struct range r = range_from(t, OBJECT_SPACE, NULL, scene);
  add(remark, "%s to %s", short_number(r.least).text,
      short_number(r.most).text);
  return isnan(r.mean) ? NAN : fmax(r.mean / r.least, r.most / r.mean);
}

/* Takes the pairs of counted algorithms whose costs in Table VII are at least
 * `apart` times apart. Returns the part of them that is in its order. */
static double pairs_in_order(const struct tables *t, double apart, int scene,
                             struct text remark) {
  int n = 0, good = 0;
  for (int k = 0; k < TEN; k++)
    for (int l = 0; l < TEN; l++) {
      double dearer = paper_group(ten[k])->total[scene];
      double cheaper = paper_group(ten[l])->total[scene];
      double a = total(t, ten[k], scene), b = total(t, ten[l], scene);
      if (dearer <= cheaper || dearer < apart * cheaper || isnan(a - b))
        continue;
      n++;
      good += a > b;
      if (a <= b)
        add(remark, "not %s before %s", ten[l], ten[k]);
    }
  return n ? (double)good / n : NAN;
}

NUMBER(far_pairs_in_order) {
  UNUSED;
  return pairs_in_order(t, 10, scene, remark);
}

/* The costliest step of those charged in each frame, except `but`, which may be
 * NULL. */
static const struct table_step *largest(const struct table_algorithm *a,
                                        const char *but, int scene) {
  const struct table_step *best = NULL;
  for (int k = 0; k < a->n_steps; k++) {
    const struct table_step *row = &a->step[k];
    if ((row->paper && row->paper->once) ||
        (but && !strcmp(row->step->label, but)))
      continue;
    if (!best || row->cost.measured[scene] > best->cost.measured[scene])
      best = row;
  }
  return best;
}

/* Considers those of the ten that were counted. */
NUMBER(one_step_preponderates) {
  UNUSED;
  int n = 0, many = 0;
  for (int k = 0; k < TEN; k++) {
    const struct table_algorithm *a = tables_algorithm(t, ten[k]);
    if (!a || isnan(a->total.measured[scene]))
      continue;
    const struct table_step *row = largest(a, NULL, scene);
    double part = row->cost.measured[scene] / a->total.measured[scene];
    n++;
    many += part > 0.5;
    if (part <= 0.5)
      add(remark, "not %s: %s %.0f %%", ten[k], row->step->label, 100 * part);
  }
  return n ? (double)many / n : NAN;
}

/* --- Numbers of an algorithm ---------------------------------------------- */

NUMBER(against_largest_step) {
  const struct table_algorithm *a = tables_algorithm(t, algorithm);
  double own = cost(t, algorithm, claim->step, scene);
  double all = a ? a->total.measured[scene] : NAN;
  if (isnan(own) || isnan(all))
    return NAN;
  const struct table_step *other = largest(a, claim->step, scene);
  add(remark, "%.0f %% of the cost; %s %.0f %%", 100 * own / all,
      other->step->label, 100 * other->cost.measured[scene] / all);
  return own / other->cost.measured[scene];
}

NUMBER(part_of_total) {
  (void)remark;
  return cost(t, algorithm, claim->step, scene) / total(t, algorithm, scene);
}

NUMBER(against_house) {
  (void)remark;
  return cost(t, algorithm, claim->step, scene) /
         cost(t, algorithm, claim->step, HOUSE);
}

NUMBER(worst_prediction) {
  (void)claim;
  const struct table_algorithm *a = tables_algorithm(t, algorithm);
  const struct table_step *worst = NULL;
  double factor = NAN;
  for (int k = 0; a && k < a->n_steps; k++) {
    const struct series *s = &a->step[k].cost;
    double x = factor_between(s->measured[scene], s->predicted[scene]);
    if (!isnan(x) && !(x <= factor)) {
      factor = x;
      worst = &a->step[k];
    }
  }
  if (worst)
    add(remark, "%s", worst->step->label);
  return factor;
}

/* Compares claim->algorithm[0] with the cheapest of those after it. */
NUMBER(against_origins) {
  (void)algorithm, (void)remark;
  double least = INFINITY;
  for (int k = 1; claim->algorithm[k]; k++) {
    double x = cost(t, claim->algorithm[k], claim->step, scene);
    least = isnan(x) || isnan(least) ? NAN : fmin(least, x);
  }
  return cost(t, claim->algorithm[0], claim->step, scene) / least;
}

/* The same with the dearest of those after it. */
NUMBER(against_dearer) {
  (void)algorithm, (void)remark;
  double most = 0;
  for (int k = 1; claim->algorithm[k]; k++) {
    double x = cost(t, claim->algorithm[k], claim->step, scene);
    most = isnan(x) || isnan(most) ? NAN : fmax(most, x);
  }
  return cost(t, claim->algorithm[0], claim->step, scene) / most;
}

/* The same of all frames of the walk. */
NUMBER(against_origins_on_walk) {
  (void)algorithm, (void)scene, (void)remark;
  double least = INFINITY;
  for (int k = 1; claim->algorithm[k]; k++) {
    double x = tables_walk_cost(t, claim->algorithm[k]);
    least = isnan(x) || isnan(least) ? NAN : fmin(least, x);
  }
  return tables_walk_cost(t, claim->algorithm[0]) / least;
}

NUMBER(newell_against_watkins) {
  UNUSED;
  return factor_between(total(t, "newell", scene), total(t, "watkins", scene));
}

/* --- Numbers of Table I, and of counters ---------------------------------- */

/* The parts of the pairs of faces that overlap in a direction are alike in X, Y
 * and Z if the greatest is no more than so often the least. */
#define ISOTROPIC 2

NUMBER(anisotropy) {
  UNUSED;
  const double *f = t->scene[scene].overlap;
  double least = fmin(f[0], fmin(f[1], f[2]));
  double most = fmax(f[0], fmax(f[1], f[2]));
  if (isnan(f[0] + f[1] + f[2]) || least <= 0)
    return NAN;
  add(remark, "f_x %s, f_y %s, f_z %s", short_number(f[0]).text,
      short_number(f[1]).text, short_number(f[2]).text);
  return most / least;
}

static bool is_isotropic(const struct tables *t, int scene,
                         struct text remark) {
  char overlaps[100] = "";
  double x = anisotropy(t, NULL, NULL, scene,
                        (struct text){overlaps, sizeof overlaps});
  if (isnan(x))
    add(remark, "not known to be isotropic");
  else
    add(remark, x <= ISOTROPIC ? "%s" : "not isotropic: %s", overlaps);
  return x <= ISOTROPIC;
}

NUMBER(part_relevant) {
  UNUSED;
  const struct hsr_table1 *m = &t->scene[scene].measured;
  return m->F_r / m->F_t;
}

NUMBER(edges_a_face) {
  UNUSED;
  const struct hsr_table1 *m = &t->scene[scene].measured;
  return m->E_t / m->F_t;
}

NUMBER(depth_from_heights) {
  UNUSED;
  const struct hsr_table1 *m = &t->scene[scene].measured;
  return m->F_r * (m->H_f / m->n) * (m->H_f / m->m) / m->D_c;
}

NUMBER(edges_put_to_objects) {
  UNUSED;
  const struct hsr_table1 *m = &t->scene[scene].measured;
  return tables_count(t, "roberts", "minimax", scene) / (m->E_s * m->C_t);
}

/* Of the vertices whose invisibility is found, either by a search or promoted. */
NUMBER(part_searched) {
  UNUSED;
  double searched = tables_count(t, algorithm, "search", scene);
  return searched / (searched + tables_count(t, algorithm, "promoted", scene));
}

NUMBER(saved_by_contours) {
  UNUSED;
  return 1 - tables_count(t, "galimberti", "contour-pair", scene) /
                 tables_count(t, "galimberti", "edge-intersection", scene);
}

NUMBER(spans_reused) {
  UNUSED;
  return tables_count(t, "romney", "span-reused", scene) /
         tables_count(t, "romney", "span", scene);
}

NUMBER(comparisons_an_edge) {
  (void)claim, (void)remark;
  const struct hsr_table1 *m = &t->scene[scene].measured;
  return tables_count(t, algorithm, "x-sort", scene) / (2 * m->n * m->S_l);
}

NUMBER(spans_against_bouknight) {
  UNUSED;
  return tables_count(t, "watkins", "span", scene) /
         tables_count(t, "bouknight", "span", scene);
}

NUMBER(raster_against_z) {
  UNUSED;
  return cost(t, "warnock:output=raster", "raster sort", scene) /
         cost(t, "warnock:output=raster", "Z sort", scene);
}

NUMBER(spans_a_visible_segment) {
  UNUSED;
  const struct hsr_table1 *m = &t->scene[scene].measured;
  return tables_count(t, "watkins", "span", scene) / (m->n * m->S_v);
}

/* Pairs are searched once in a span. Every division leads to another comparison of its
 * pair, and so do second halves. */
NUMBER(undivided) {
  UNUSED;
  double pairs = tables_count(t, "watkins", "depth-search", scene) -
                 tables_count(t, "watkins", "depth-division", scene) -
                 tables_count(t, "watkins", "second-half", scene);
  return 1 - tables_count(t, "watkins", "pair-divided", scene) / pairs;
}

/* --- Judging -------------------------------------------------------------- */

#define BY_FORMULA                                                             \
  "exponent less that of its formula on the measured Table I", -QUARTER,       \
      QUARTER, .by_formula = true
#define AT_MOST(x) -INFINITY, (x)
#define AT_LEAST(x) (x), INFINITY
#define LEADS                                                                  \
  "cost / that of the largest other step", AT_LEAST(1),                        \
      .number = against_largest_step
#define APPEL_GROUP                                                            \
  { "appel", "loutrel", "galimberti" }
#define TABLE1(field) offsetof(struct hsr_table1, field)

static const struct claim claims[] = {
#include "bench/tables/claims.def"
};

int claims_count(void) {
  return (int)(sizeof claims / sizeof *claims);
}

const char *finding_name(enum finding finding) {
  static const char *const name[] = {[BORNE_OUT] = "borne out",
                                     [UNDECIDED] = "undecided",
                                     [NOT_MEASURED] = "not measured",
                                     [NOT_BORNE_OUT] = "not borne out"};
  return name[finding];
}

static void outweigh(enum finding *finding, enum finding other) {
  if (other > *finding)
    *finding = other;
}

/* Compares an interval with the limits; for a single number, low == high. */
static enum finding within(const struct claim *claim, double low, double high) {
  if (isnan(low) || isnan(high))
    return NOT_MEASURED;
  if (low >= claim->low && high <= claim->high)
    return BORNE_OUT;
  return high < claim->low || low > claim->high ? NOT_BORNE_OUT : UNDECIDED;
}

static void tell(struct conclusion *c, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
static void tell(struct conclusion *c, const char *format, ...) {
  size_t used = strlen(c->evidence);
  va_list args;
  va_start(args, format);
  vsnprintf(c->evidence + used, sizeof c->evidence - used, format, args);
  va_end(args);
}

static const char *separator(const struct conclusion *c) {
  return c->evidence[0] ? "; " : "";
}

/* `formula` is the exponent of the formula, or NAN. */
static void judge_exponent(const struct claim *claim, const char *of,
                           struct growth g, double formula,
                           struct conclusion *c) {
  double from = claim->by_formula ? formula : 0;
  outweigh(&c->finding, within(claim, g.low - from, g.high - from));
  if (isnan(g.low))
    return;
  tell(c, "%s%s %.2f [%.2f, %.2f]", separator(c), of, g.exponent, g.low,
       g.high);
  if (!isnan(formula))
    tell(c, ", by its formula %.2f", formula);
}

/* The growth of a step's cost, or that of two steps together. */
static struct growth growth_of(const struct tables *t,
                               const struct claim *claim,
                               const struct series *s, const char *algorithm) {
  double values[MOST_SCENES];
  if (!s)
    return (struct growth){NAN, NAN, NAN, 0};
  for (int k = 0; k < t->n_scenes; k++)
    values[k] =
        s->measured[k] + (claim->with ? cost(t, algorithm, claim->with, k) : 0);
  return tables_growth(t, values);
}

static double statistic_of(const struct hsr_table1 *table, size_t statistic) {
  double value;
  memcpy(&value, (const char *)table + statistic, sizeof value);
  return value;
}

static void judge_growth(const struct tables *t, const struct claim *claim,
                         struct conclusion *c) {
  for (int a = 0; claim->algorithm[a]; a++) {
    const struct series *s = tables_cost(t, claim->algorithm[a], claim->step);
    judge_exponent(claim, claim->algorithm[a],
                   growth_of(t, claim, s, claim->algorithm[a]),
                   s ? s->predicted_growth.exponent : NAN, c);
  }
  if (!claim->statistic)
    return;
  double values[MOST_SCENES], rules[MOST_SCENES];
  for (int s = 0; s < t->n_scenes; s++) {
    values[s] = statistic_of(&t->scene[s].measured, claim->statistic);
    rules[s] = statistic_of(&t->scene[s].rules, claim->statistic);
  }
  judge_exponent(claim, "measured", tables_growth(t, values),
                 tables_growth(t, rules).exponent, c);
}

/* Judges the number of one environment, and of one algorithm unless that is
 * NULL. */
static enum finding judge_number(const struct tables *t,
                                 const struct claim *claim,
                                 const char *algorithm, int scene,
                                 struct conclusion *c) {
  char remark[300] = "";
  double x = claim->number(t, claim, algorithm, scene,
                           (struct text){remark, sizeof remark});
  if (algorithm)
    tell(c, "%s ", algorithm);
  tell(c, "%s", isnan(x) ? "not measured" : short_number(x).text);
  if (!isnan(x) && remark[0])
    tell(c, " (%s)", remark);
  return within(claim, x, x);
}

static enum finding judge_environment(const struct tables *t,
                                      const struct claim *claim, int scene,
                                      struct conclusion *c) {
  tell(c, "%s%s: ", separator(c),
       scene == ENVIRONMENTS ? "walk in " TABLES_WALK_SCENE
                             : paper_environments[scene].scene);
  char remark[200] = "";
  bool holds = !claim->premise ||
               claim->premise(t, scene, (struct text){remark, sizeof remark});
  tell(c, "%s%s", remark, holds && remark[0] ? ": " : "");
  if (!holds)
    return NOT_MEASURED;
  /* The algorithms of against_origins are taken together. */
  if (!claim->algorithm[0] || claim->number == against_origins ||
      claim->number == against_dearer ||
      claim->number == against_origins_on_walk)
    return judge_number(t, claim, NULL, scene, c);
  enum finding finding = BORNE_OUT;
  for (int a = 0; claim->algorithm[a]; a++) {
    if (a)
      tell(c, ", ");
    outweigh(&finding, judge_number(t, claim, claim->algorithm[a], scene, c));
  }
  return finding;
}

/* An environment, or the walk, that was not measured is named. The finding then comes from
 * the others, if there are any. */
static void judge_numbers(const struct tables *t, const struct claim *claim,
                          struct conclusion *c) {
  bool measured = false;
  for (int e = 0; e <= ENVIRONMENTS; e++)
    if (claim->environments & 1u << e) {
      enum finding finding = judge_environment(t, claim, e, c);
      if (finding == NOT_MEASURED)
        continue;
      measured = true;
      outweigh(&c->finding, finding);
    }
  if (!measured)
    c->finding = NOT_MEASURED;
}

static void tell_criterion(const struct claim *claim, struct conclusion *c) {
  if (isinf(claim->low))
    snprintf(c->criterion, sizeof c->criterion, "%s: at most %.3g",
             claim->measure, claim->high);
  else if (isinf(claim->high))
    snprintf(c->criterion, sizeof c->criterion, "%s: at least %.3g",
             claim->measure, claim->low);
  else
    snprintf(c->criterion, sizeof c->criterion, "%s: %.3g to %.3g",
             claim->measure, claim->low, claim->high);
}

struct conclusion claims_judge(const struct tables *t, int k) {
  const struct claim *claim = &claims[k];
  struct conclusion c = {.section = claim->section,
                         .sentence = claim->sentence,
                         .claim = claim->claim,
                         .erratum = claim->erratum,
                         .finding = BORNE_OUT};
  tell_criterion(claim, &c);
  if (claim->number)
    judge_numbers(t, claim, &c);
  else
    judge_growth(t, claim, &c);
  return c;
}
