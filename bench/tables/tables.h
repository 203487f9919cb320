/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The tables of Sutherland et al. 1974, computed from the counts of hsr bench
 * and printed as text or JSON (hsr tables).
 *
 * They cover three environments and a ladder of harbors, all seen from view 1
 * at 500 x 500, and one walk. A number that was not measured is NAN. */
#ifndef HSR_BENCH_TABLES_H
#define HSR_BENCH_TABLES_H

#include "algorithms/algorithm.h"
#include "bench/tables/growth.h"
#include "bench/tables/paper_1974.h"
#include "bench/results/results.h"

enum { TABLES_VIEW = 1, TABLES_SIZE = 500, MOST_SCENES = 32, MOST_STEPS = 16 };

/* The scenes that the tables need, ended by NULL: the environments, and the
 * ladder on which growth is measured: harbors from 100 to 60,000 relevant
 * faces, all of one depth complexity. */
extern const char *const tables_scenes[];

/* The walk on which what is kept from frame to frame is counted: the first views
 * of a scene, at TABLES_WALK_SIZE a side; and who takes it, ended by NULL. */
enum { TABLES_WALK = 8, TABLES_WALK_SIZE = 250 };
#define TABLES_WALK_SCENE "office:3"
extern const char *const tables_walkers[];

/* A scene of the results, with its Table I as measured, and as the rules of
 * Table II predict it. */
struct table_scene {
  const char *name;
  struct hsr_table1 measured, rules;
  double overlap[3]; /* f_x, f_y, f_z (common/statistics/depth.h) */
};

/* A cost on every scene, and how it grows over the ladder with F_r. */
struct series {
  double measured[MOST_SCENES], predicted[MOST_SCENES];
  struct growth growth, predicted_growth;
};

/* A row of Table III. */
struct table_step {
  const struct hsr_step *step;    /* label, terms, formula */
  const struct paper_step *paper; /* NULL: not in the survey */
  struct series cost;
};

/* A column of Tables IV to VII. */
struct table_algorithm {
  const char *name; /* of the algorithm, or of a variant of it */
  const struct hsr_algorithm *algorithm;
  const struct paper_group *paper; /* NULL: not in the survey's tables */
  const json_t *cell[MOST_SCENES]; /* record in the results; NULL: none */
  int n_steps;
  struct table_step step[MOST_STEPS];
  struct series total; /* over the steps that every frame takes */
};

struct tables {
  const struct results *results;
  struct hsr_prices prices; /* of the kinds of comparison */
  /* First the environments in their order, whether measured or not; then the
   * ladder, ordered by relevant faces. */
  int n_scenes;
  struct table_scene scene[MOST_SCENES];
  int n_algorithms; /* only those that have steps, in the order of the list */
  struct table_algorithm *algorithm;
  int n_variants; /* what the survey proposes as options: for its claims only */
  struct table_algorithm *variant;
};

/* Their names, ended by NULL. */
extern const char *const tables_variants[];

/* Computes the tables: what the results counted, by these prices. HSR_E_INPUT if
 * the results hold none of the scenes. The results are borrowed and must outlive
 * the tables, which are freed with tables_delete. */
enum hsr_status tables_new(struct tables **tables,
                           const struct results *results,
                           const struct hsr_prices *prices,
                           struct hsr_error *err);
void tables_delete(struct tables *tables); /* NULL is allowed */

/* The same by the standard prices, to be deleted. NULL if the prices are these,
 * or for lack of memory. */
struct tables *tables_of_standard(const struct tables *t);

/* --- Looking things up: algorithms and variants --------------------------- */

const struct table_algorithm *tables_algorithm(const struct tables *t,
                                               const char *name);

/* The cost of a step, or of all steps if `step` is NULL. Returns NULL if there
 * is no such algorithm or step. */
const struct series *tables_cost(const struct tables *t, const char *algorithm,
                                 const char *step);

/* Table I of a view of the results. What it does not have is NAN. */
struct hsr_table1 tables_table1(const json_t *view);

/* The value of an algorithm's counter of that key on a scene; NAN if it has
 * none. */
double tables_count(const struct tables *t, const char *algorithm,
                    const char *key, int scene);

/* The comparisons of a frame that a cell of the results counted: the costs of
 * all steps that every frame takes. NAN if its picture is not right, or if its
 * algorithm has no steps. */
double tables_frame_cost(const json_t *cell, const struct hsr_prices *prices);

/* The cost of all frames of the walk, as tables_frame_cost. */
double tables_walk_cost(const struct tables *t, const char *algorithm);

/* How `values`, one for each scene, grow over the ladder. */
struct growth tables_growth(const struct tables *t, const double *values);

/* Why an algorithm has no counts on a scene: "timeout". NULL if it has them. */
const char *tables_missing(const struct table_algorithm *a, int scene);

/* A number in three digits, as "12.3K". K, M, G, T stand for 10^3, 10^6, 10^9,
 * 10^12. "-" for NAN. */
struct short_number {
  char text[16];
};
struct short_number short_number(double x);

/* --- Printing ------------------------------------------------------------- */

void tables_print(const struct tables *t);

/* A new reference, or NULL for lack of memory. */
json_t *tables_json(const struct tables *t);

#endif
