/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What comparisons cost: one price for each kind of them (prices.def). */
#ifndef HSR_ALGORITHMS_PRICES_H
#define HSR_ALGORITHMS_PRICES_H

#ifdef __cplusplus
extern "C" {
#endif

/* Kinds have numbers that no price has. So a price in the place of a kind is
 * found when the module is registered. */
enum hsr_kind {
  HSR_NO_KIND,
  HSR_BEFORE_KINDS = 0x1000,
#define X(id, name, price, meaning, source) HSR_KIND_##id,
#include "algorithms/prices.def"
#undef X
  HSR_AFTER_KINDS,
  HSR_FIRST_KIND = HSR_BEFORE_KINDS + 1
};
enum { HSR_N_KINDS = HSR_AFTER_KINDS - HSR_FIRST_KIND };

struct hsr_kind_described {
  const char *name;
  double price;
  const char *meaning, *source;
};

/* By kind - HSR_FIRST_KIND. */
extern const struct hsr_kind_described hsr_kinds[HSR_N_KINDS];

/* Prices by kind. hsr_prices_standard are those of hsr_kinds. */
struct hsr_prices {
  double of[HSR_N_KINDS];
};
extern const struct hsr_prices hsr_prices_standard;

#ifdef __cplusplus
}
#endif
#endif
