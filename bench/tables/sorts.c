/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The survey names the methods and does not give them. Its bubble sort is the one
 * of its scan-line algorithms: a key that is out of order bubbles to its place, past
 * its neighbors, and stops there. Textbooks call that straight insertion; theirs
 * passes over all keys until none moves. The others are the textbook's: Shell's increments are 2^k - 1; Quicksort divides at the first key;
 * the tree is binary, kept flat by random ranks, and entered at its root;
 * radix sort takes 8 bits in each pass. Records are nearly in sort if a
 * sixteenth of them have changed places with their neighbors. */
#include "bench/tables/sorts.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const double sorts_sizes[SORTS_SIZES] = {64, 256, 1024, 4096, 16384};

enum { MOST = 16384, NONE = -1 };

/* The records, and what a method needs beside them. */
struct records {
  uint32_t key[MOST], other[MOST];
  int n;
  int left[MOST], right[MOST]; /* the tree: node k has key[k] */
  uint32_t rank[MOST];
  uint64_t count, random;
};

static uint32_t draw(struct records *r) {
  r->random = r->random * 6364136223846793005u + 1442695040888963407u;
  return (uint32_t)(r->random >> 33);
}

/* Whether a comes before b: a comparison. */
static bool before(struct records *r, uint32_t a, uint32_t b) {
  r->count++;
  return a < b;
}

static void swap(uint32_t *a, uint32_t *b) {
  uint32_t c = *a;
  *a = *b;
  *b = c;
}

/* --- Sorts ---------------------------------------------------------------- */

/* Moves key k to its place among those `step` apart before it. */
static void settle(struct records *r, int k, int step) {
  for (; k >= step && before(r, r->key[k], r->key[k - step]); k -= step)
    swap(&r->key[k], &r->key[k - step]);
}

static void bubble_sort(struct records *r) {
  for (int k = 1; k < r->n; k++)
    settle(r, k, 1);
}

static void shell_sort(struct records *r) {
  int step = 1;
  while (2 * step + 1 < r->n)
    step = 2 * step + 1;
  for (; step; step /= 2)
    for (int k = step; k < r->n; k++)
      settle(r, k, step);
}

/* The shorter part is sorted first, so that few calls are open at once. */
static void quick(struct records *r, int begin, int end) {
  while (end - begin > 1) {
    int middle = begin;
    for (int k = begin + 1; k < end; k++)
      if (before(r, r->key[k], r->key[begin]))
        swap(&r->key[++middle], &r->key[k]);
    swap(&r->key[begin], &r->key[middle]);
    if (middle - begin < end - middle - 1) {
      quick(r, begin, middle);
      begin = middle + 1;
    } else {
      quick(r, middle + 1, end);
      end = middle;
    }
  }
}

static void quick_sort(struct records *r) {
  quick(r, 0, r->n);
}

static int insert(struct records *r, int root, int k) {
  if (root == NONE)
    return k;
  bool left = before(r, r->key[k], r->key[root]);
  int *side = left ? r->left : r->right, *other = left ? r->right : r->left;
  int below = side[root] = insert(r, side[root], k);
  if (r->rank[below] <= r->rank[root])
    return root;
  side[root] = other[below];
  other[below] = root;
  return below;
}

static int make_tree(struct records *r) {
  int root = NONE;
  for (int k = 0; k < r->n; k++) {
    r->left[k] = r->right[k] = NONE;
    r->rank[k] = draw(r);
    root = insert(r, root, k);
  }
  return root;
}

static int walk(struct records *r, int root, int n) {
  if (root == NONE)
    return n;
  n = walk(r, r->left[root], n);
  r->other[n++] = r->key[root];
  return walk(r, r->right[root], n);
}

static void tree_sort(struct records *r) {
  walk(r, make_tree(r), 0);
  memcpy(r->key, r->other, (size_t)r->n * sizeof *r->key);
}

static void radix_sort(struct records *r) {
  for (int shift = 0; shift < 32; shift += 8) {
    int start[257] = {0};
    for (int k = 0; k < r->n; k++)
      start[(r->key[k] >> shift) % 256 + 1]++;
    for (int d = 0; d < 256; d++)
      start[d + 1] += start[d];
    for (int k = 0; k < r->n; k++, r->count++)
      r->other[start[(r->key[k] >> shift) % 256]++] = r->key[k];
    memcpy(r->key, r->other, (size_t)r->n * sizeof *r->key);
  }
}

/* --- Searches and merges: the mean for a key at random -------------------- */

enum { TRIES = 200 };

static void mean(struct records *r) {
  r->count /= TRIES;
}

/* For the least key, which may be any: all have to be looked at. */
static void search_unordered(struct records *r) {
  uint32_t least = r->key[0];
  for (int k = 0; k < r->n; k++)
    if (before(r, r->key[k], least))
      least = r->key[k];
}

/* Also a merge into a list: it is passed up to the key's place. */
static void search_ordered(struct records *r) {
  quick_sort(r);
  r->count = 0;
  for (int t = 0; t < TRIES; t++) {
    uint32_t key = r->key[draw(r) % (uint32_t)r->n];
    for (int k = 0; before(r, r->key[k], key);)
      k++;
  }
  mean(r);
}

static void search_binary(struct records *r) {
  quick_sort(r);
  r->count = 0;
  for (int t = 0; t < TRIES; t++) {
    uint32_t key = r->key[draw(r) % (uint32_t)r->n];
    for (int begin = 0, end = r->n; begin < end;) {
      int middle = begin + (end - begin) / 2;
      if (before(r, r->key[middle], key))
        begin = middle + 1;
      else
        end = middle;
    }
  }
  mean(r);
}

/* Also an insertion into a tree: down to a leaf. */
static void search_tree(struct records *r) {
  int root = make_tree(r);
  r->count = 0;
  for (int t = 0; t < TRIES; t++) {
    uint32_t key = draw(r);
    for (int k = root; k != NONE;)
      k = before(r, key, r->key[k]) ? r->left[k] : r->right[k];
  }
  mean(r);
}

/* --- The tables ----------------------------------------------------------- */

static double square(double n) {
  return n * n;
}
static double three_halves(double n) {
  return n * sqrt(n);
}
static double n_log_n(double n) {
  return n * log2(n);
}
static double linear(double n) {
  return n;
}
static double half(double n) {
  return n / 2;
}

static const struct method {
  const char *table, *method;
  void (*run)(struct records *);
  bool nearly; /* in sort */
  const char *formula;
  double (*predict)(double n);
} methods[] = {
    {"Sorts", "Bubble sort", bubble_sort, false, "N^2", square},
    {"Sorts", "Bubble sort", bubble_sort, true, "N", linear},
    {"Sorts", "Shell sort", shell_sort, false, "N^3/2", three_halves},
    {"Sorts", "Shell sort", shell_sort, true, "N", linear},
    {"Sorts", "Quick sort", quick_sort, false, "N log N", n_log_n},
    {"Sorts", "Quick sort", quick_sort, true, "N^2", square},
    {"Sorts", "Tree sort", tree_sort, false, "N log N", n_log_n},
    {"Sorts", "Tree sort", tree_sort, true, "N", linear},
    {"Sorts", "Radix sort", radix_sort, false, "N", linear},
    {"Sorts", "Radix sort", radix_sort, true, "N", linear},
    {"Searches", "Sequential, unordered", search_unordered, false, "N", linear},
    {"Searches", "Sequential, ordered", search_ordered, false, "N/2", half},
    {"Searches", "Binary search", search_binary, false, "log N", log2},
    {"Searches", "Binary tree", search_tree, false, "log N", log2},
    {"Merges", "List merge", search_ordered, false, "N/2", half},
    {"Merges", "Tree insertion", search_tree, false, "log N", log2}};
enum { METHODS = sizeof methods / sizeof *methods };

int sorts_rows(void) {
  return METHODS;
}

static bool is_sorted(const struct records *r) {
  for (int k = 1; k < r->n; k++)
    if (r->key[k] < r->key[k - 1])
      return false;
  return true;
}

static void fill(struct records *r, int n, bool nearly) {
  r->n = n;
  r->count = 0;
  r->random = 1;
  for (int k = 0; k < n; k++)
    r->key[k] = nearly ? (uint32_t)k << 16 : draw(r);
  for (int k = 0; nearly && k < n / 16; k++) {
    uint32_t at = draw(r) % (uint32_t)(n - 1);
    swap(&r->key[at], &r->key[at + 1]);
  }
}

bool sorts_row(int k, struct sorts_row *row) {
  const struct method *m = &methods[k];
  struct records *r = malloc(sizeof *r);
  double formula[SORTS_SIZES];
  *row = (struct sorts_row){.table = m->table,
                            .method = m->method,
                            .order = m->nearly ? "nearly in sort" : "random",
                            .formula = m->formula,
                            .sorted = true};
  for (int s = 0; r && s < SORTS_SIZES; s++) {
    fill(r, (int)sorts_sizes[s], m->nearly);
    m->run(r);
    row->count[s] = (double)r->count;
    row->sorted &= is_sorted(r);
    formula[s] = m->predict(sorts_sizes[s]);
  }
  if (r) {
    row->measured = growth_fit(sorts_sizes, row->count, SORTS_SIZES);
    row->survey = growth_fit(sorts_sizes, formula, SORTS_SIZES);
    row->agrees = fabs(row->measured.exponent - row->survey.exponent) <= 0.1;
  }
  free(r);
  return r;
}

bool sorts_print(void) {
  const char *table = "";
  for (int k = 0; k < METHODS; k++) {
    struct sorts_row row;
    if (!sorts_row(k, &row))
      return false;
    if (strcmp(table, row.table)) {
      printf("%s%s of N records: comparisons%s\n\n%-29s", k ? "\n" : "",
             row.table, k ? "" : " (radix sort: moves)", "N");
      for (int s = 0; s < SORTS_SIZES; s++)
        printf(" %8.0f", sorts_sizes[s]);
      printf("\n");
      table = row.table;
    }
    printf("%-29s", row.method);
    for (int s = 0; s < SORTS_SIZES; s++)
      printf(row.count[s] < 1e6 ? " %8.0f" : " %8.3g", row.count[s]);
    printf("\n  %s: N^%.2f; the survey's %s is N^%.2f: %s\n", row.order,
           row.measured.exponent, row.formula, row.survey.exponent,
           row.agrees ? "borne out" : "not borne out");
  }
  return true;
}
