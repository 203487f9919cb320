/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a module says of its work, and what an engine says of its own: counters,
 * cost steps, sorts and lines of an outline.
 *
 * An engine exports one `const struct hsr_part`. The descriptor of a module that
 * works by it lists the part, and gets its counters and its cost steps. The
 * module's outline and sorts say where the part's stand.
 *
 * Notation   own counter -> a counter of the module, numbered from 0
 *            counter of a part -> numbered from HSR_FIRST_OF(its number)
 * Invariant  a counter's number is the same in whichever module it is raised.
 *            Where it is kept in the tally is decided by the module, when it is
 *            registered (registry.c) */
#ifndef HSR_ALGORITHMS_PART_H
#define HSR_ALGORITHMS_PART_H

#include "algorithms/prices.h"
#include "common/base/count.h"
#include "common/statistics/statistics.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The parts by number. A new part takes the next one. */
enum hsr_part_number {
  HSR_PART_OWN, /* the module's own counters */
  HSR_PART_TILER,
  HSR_PART_PEEL,
  HSR_PART_SHADOW,
  HSR_PART_LIGHT_VIEW,
  HSR_PART_SHADOW_PAIRS,
  HSR_PART_INEQUALITIES,
  HSR_PART_HZ,
  HSR_PART_BSP,
  HSR_PART_MAP,
  HSR_PART_CELLS,
  HSR_PART_CLUSTER_ORDER,
  HSR_PART_PRIORITY_LIST,
  HSR_PART_PAINTING,
  HSR_PART_BEADS,
  HSR_PART_SCAN_LINE,
  HSR_PART_X_LIST,
  HSR_PART_SPANS,
  HSR_PART_DEPTH_SEARCH,
  HSR_PART_WARNOCK,
  HSR_PART_FINISHED,
  HSR_PART_TILING,
  HSR_PART_LAZY,
  HSR_PART_LOOSE,
  HSR_PART_NETWORK,
  HSR_PART_HIDING,
  HSR_PART_BOX_SORT,
  HSR_PART_SPLATS,
  HSR_PART_FOLDS,
  HSR_PART_TEXTURES,
  HSR_PART_BUILT,
  HSR_PART_PRIORITY_SEARCH,
  HSR_PART_KEPT_ORDER,
  HSR_PART_SURROUND,
  HSR_N_PARTS
};

/* The number of a part's first counter. The others follow it, in the order in
 * which the part describes them. */
#define HSR_FIRST_OF(part) ((part)*HSR_PART_SIZE)

struct hsr_part;

/* A sort that the algorithm makes, as in figure 29b; or all those of a part. */
struct hsr_sort {
  const char *what;            /* "edges" */
  const char *key;             /* "Y" */
  const char *method;          /* "bucket sort" */
  const char *often;           /* "once a frame" */
  const struct hsr_part *part; /* not NULL: its sorts stand here */
};

/* What a count costs: its price * count. The price is that of its kind of
 * comparison, the complexity factor of appendix B. */
struct hsr_term {
  int counter;
  enum hsr_kind kind;
  bool less; /* the cost is taken off: the count is of those comparisons among
                another counter's that were not made after all */
};

/* A cost step, as in Table III: cost = price * count, and likewise for `more`; or
 * all those of a part. A step that has the label of one before adds its terms to
 * that one. */
#define HSR_MORE_TERMS 7
struct hsr_step {
  const char *label; /* "X merge" */
  int counter;
  enum hsr_kind kind;
  const char *formula; /* the paper's prediction of the cost, or NULL */
  double (*predict)(const struct hsr_table1 *); /* the same; NULL: none made */
  struct hsr_term more[HSR_MORE_TERMS];         /* ended by .kind == 0 */
  const struct hsr_part *part; /* not NULL: its steps stand here. Those of parts
                                  that stand nowhere come first */
};

/* Gives term k of a step, from 0 on. Returns false if it has no more. */
static inline bool hsr_step_term(const struct hsr_step *step, int k,
                                 struct hsr_term *term) {
  if (k > HSR_MORE_TERMS)
    return false;
  term->counter = k ? step->more[k - 1].counter : step->counter;
  term->kind = k ? step->more[k - 1].kind : step->kind;
  term->less = k && step->more[k - 1].less;
  return term->kind != HSR_NO_KIND;
}

/* What one of a term's counts adds to the cost. */
static inline double hsr_term_price(const struct hsr_term *term,
                                    const struct hsr_prices *prices) {
  double price = prices->of[term->kind - HSR_FIRST_KIND];
  return term->less ? -price : price;
}

/* A line of an algorithm's outline: its pseudocode, in the paper's words; or all
 * lines of a group of a part's. */
#define HSR_MOST_RAISED 6
struct hsr_line {
  const char
      *text; /* two blanks before it for each level of nesting. If it stands
                       for a group: the blanks before each line, or NULL */
  int raises[HSR_MOST_RAISED], n_raises; /* HSR_RAISES(...): steps of these
                       counters are taken here; a counter belongs to one line */
  const struct hsr_part *part;           /* not NULL: lines[group] of it */
  int group;
};
#define HSR_RAISES(...)                                                        \
  {__VA_ARGS__}, (int)(sizeof((int[]){__VA_ARGS__}) / sizeof(int))

#define HSR_MOST_GROUPS 4
struct hsr_part {
  enum hsr_part_number number;
  const struct hsr_counter *counters; /* ended by .name == NULL */
  const struct hsr_step *steps;       /* ended by .label == NULL; NULL: none */
  const struct hsr_sort *sorts;       /* ended by an empty one; NULL: none */
  const struct hsr_line
      *lines[HSR_MOST_GROUPS]; /* each ended by an empty one */
};

/* A part as a module uses it. */
struct hsr_use {
  const struct hsr_part *part;
  const char *prefix; /* before the names of its counters and the labels of its
                         steps, where they would be the same as another part's;
                         or NULL */
};

#ifdef __cplusplus
}
#endif
#endif
