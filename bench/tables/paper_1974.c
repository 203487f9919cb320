/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The available scans of the survey have lost many decimal points. The figures
 * here were computed anew from its formulas. They agree, cell by cell, with all
 * figures of Tables III to VII that can be read. A comment says so if more than
 * a decimal point is wrong. */
#include "bench/tables/paper_1974.h"

#include <math.h>
#include <string.h>

#define K *1e3
#define M *1e6
#define G *1e9

const struct paper_environment paper_environments[ENVIRONMENTS] = {
    {"house", "the simple environment"},
    {"harbor", "the middle environment"},
    {"big-harbor", "the complex environment"}};

/* The rules of C_t, E_t and E_c have F_t, F_t and F_c, not F_r as printed: only
 * then do they give the figures beside them. S_f has no row of its own. */
const struct paper_statistic paper_statistics[] = {
    {"n", "given", {500, 500, 500}},
    {"m", "given", {500, 500, 500}},
    {"F_t", "2 F_r", {200, 5 K, 120 K}},
    {"F_r", "given", {100, 2500, 60 K}},
    {"D_c", "given", {3, 3, 3}},
    {"C_t", "F_t/F_c", {20, 200, 600}},
    {"C_r", NULL, {NAN, NAN, NAN}},
    {"F_c", "given", {10, 25, 200}},
    {"E_t", "4 F_t", {800, 20 K, 480 K}},
    {"E_r", "E_t/2", {400, 10 K, 240 K}},
    {"E_s", "(E_r - E_c)/2 + E_c", {290, 6.4 K, 130 K}},
    {"E_c", "E_r/(F_c/2)^1/2", {180, 2.8 K, 24 K}},
    {"X_r", "(D_c - 1) E_r/4", {200, 5 K, 120 K}},
    {"X_v", "X_r/D_c", {70, 1.7 K, 40 K}},
    {"X_f", NULL, {NAN, NAN, NAN}},
    {"H_f", "(n m D_c/F_r)^1/2", {86, 17, 4}},
    {"S_f", "n S_l", {NAN, NAN, NAN}},
    {"S_l", "(D_c F_r m/n)^1/2", {17, 87, 420}},
    {"S_v", "S_l/D_c", {5, 29, 140}},
    {"L_v", "2 n S_v", {5 K, 29 K, 140 K}},
    {NULL, NULL, {0}}};

const struct paper_group paper_groups[] = {
    {"Roberts",
     {"roberts"},
     {{"back-edge cull", {800, 20 K, 480 K}, false},
      {"clipping cull", {29 K, 640 K, 13 M}, false},
      /* f = 4, not 1 as printed: only then does it give these figures. */
      {"edge/volume test", {2.3 M, 510 M, 31 G}, false}},
     {2.4 M, 510 M, 31 G}},
    {"Appel, Loutrel, Galimberti and Montanari",
     {"appel", "loutrel", "galimberti"},
     {{"back and contour cull", {800, 20 K, 480 K}, false},
      {"initial visibility", {200 K, 50 M, 3.6 G}, false},
      {"edge intersection", {1.6 M, 540 M, 93 G}, false},
      {"invisibility correction", {52 K, 1.2 M, 23 M}, false},
      {"sort along edge", {290, 6.4 K, 130 K}, false}},
     {1.8 M, 590 M, 97 G}},
    {"Schumacker et al",
     {"schumacker"},
     {{"intra-cluster priority", {200 K, 12 M, 2.4 G}, true},
      {"inter-cluster priority", {200, 2 K, 6 K}, false},
      {"back-face cull", {100, 2.5 K, 60 K}, false},
      {"Y cull", {150 K, 3.2 M, 65 M}, false},
      {"X sort and priority search", {4.2 M, 22 M, 100 M}, false}},
     {4.2 M, 25 M, 170 M}},
    {"Newell et al",
     {"newell"},
     {{"Z sort", {200, 5 K, 120 K}, false},
      {"Newell special", {45 K, 650 K, 60 M}, false},
      {"segment generator, Y sort", {86 K, 420 K, 2.4 M}, false},
      {"X merge", {11 K, 310 K, 8.4 M}, false}},
     {140 K, 1.4 M, 71 M}},
    {"Warnock",
     {"warnock"},
     {{"Z sort", {200, 5 K, 120 K}, false},
      {"Warnock special", {1.5 M, 8.7 M, 42 M}, false},
      {"depth search", {15 K, 87 K, 420 K}, false}},
     {1.5 M, 9 M, 43 M}},
    {"Romney et al",
     {"romney"},
     {{"Y sort", {200, 5 K, 120 K}, false},
      {"X sort", {8.5 K, 43 K, 210 K}, false},
      {"X priority search", {250 K, 250 K, 250 K}, false},
      {"depth search", {510 K, 2.6 M, 13 M}, false}},
     {770 K, 2.9 M, 14 M}},
    {"Watkins, Bouknight",
     {"bouknight", "watkins"},
     {{"Y sort", {400, 10 K, 240 K}, false},
      {"X merge", {3.4 K, 430 K, 50 M}, false},
      {"X sort", {8.5 K, 43 K, 210 K}, false},
      {"span cull", {8.5 K, 43 K, 210 K}, false},
      {"depth search", {450 K, 2.6 M, 13 M}, false}},
     {470 K, 3 M, 64 M}},
    {"Brute force, no memory",
     {"raycast"},
     {{"search of all faces", {2.5 G, 62 G, 1500 G}, false}},
     {2.5 G, 62 G, 1500 G}},
    {"Brute force, large memory",
     {"zbuffer"},
     {{"depth comparison", {7.5 M, 7.5 M, 7.5 M}, false}},
     {7.5 M, 7.5 M, 7.5 M}},
    {0}};

const struct paper_statistic *paper_statistic(const char *symbol) {
  for (const struct paper_statistic *s = paper_statistics; s->symbol; s++)
    if (!strcmp(s->symbol, symbol))
      return s;
  return NULL;
}

const struct paper_group *paper_group(const char *algorithm) {
  for (const struct paper_group *g = paper_groups; g->name; g++)
    for (int k = 0; g->algorithm[k]; k++)
      if (!strcmp(g->algorithm[k], algorithm))
        return g;
  return NULL;
}

const struct paper_step *paper_step(const struct paper_group *group,
                                    const char *label) {
  for (int k = 0; group && group->step[k].label; k++)
    if (!strcmp(group->step[k].label, label))
      return &group->step[k];
  return NULL;
}
