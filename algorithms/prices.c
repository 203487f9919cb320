/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "algorithms/prices.h"

const struct hsr_kind_described hsr_kinds[HSR_N_KINDS] = {
#define X(id, name, price, meaning, source) {name, price, meaning, source},
#include "algorithms/prices.def"
#undef X
};

const struct hsr_prices hsr_prices_standard = {{
#define X(id, name, price, meaning, source) price,
#include "algorithms/prices.def"
#undef X
}};
