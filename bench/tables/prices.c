/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/tables/prices.h"

#include <jansson.h>
#include <math.h>
#include <string.h>

/* The number of a kind by its name, from 0; -1: there is none. */
static int kind_named(const char *name) {
  for (int k = 0; k < HSR_N_KINDS; k++)
    if (!strcmp(hsr_kinds[k].name, name))
      return k;
  return -1;
}

static enum hsr_status read_object(struct hsr_prices *prices, const char *path,
                                   json_t *object, struct hsr_error *err) {
  const char *name;
  json_t *value;
  if (!json_is_object(object))
    return hsr_fail(err, HSR_E_INPUT,
                    "%s: is no object of prices: {\"kind\": price, ...}", path);
  json_object_foreach(object, name, value) {
    int kind = kind_named(name);
    double price = json_number_value(value);
    if (kind < 0)
      return hsr_fail(
          err, HSR_E_INPUT,
          "%s: \"%.60s\" is no kind of comparison; hsr tables lists "
          "them",
          path, name);
    if (!json_is_number(value) || !isfinite(price) || price < 0)
      return hsr_fail(err, HSR_E_INPUT,
                      "%s: the price of \"%s\" must be a number from 0 on",
                      path, name);
    prices->of[kind] = price;
  }
  return HSR_OK;
}

enum hsr_status prices_read(struct hsr_prices *prices, const char *path,
                            struct hsr_error *err) {
  json_error_t why;
  json_t *object = json_load_file(path, JSON_REJECT_DUPLICATES, &why);
  *prices = hsr_prices_standard;
  if (!object && json_error_code(&why) == json_error_out_of_memory)
    return hsr_fail_nomem(err);
  if (!object && why.line < 0)
    return hsr_fail(err, HSR_E_INPUT, "%s", why.text);
  if (!object)
    return hsr_fail(err, HSR_E_INPUT, "%s: line %d: %s", path, why.line,
                    why.text);
  enum hsr_status status = read_object(prices, path, object, err);
  json_decref(object);
  return status;
}

bool prices_are_standard(const struct hsr_prices *prices) {
  for (int k = 0; k < HSR_N_KINDS; k++)
    if (prices->of[k] < hsr_kinds[k].price ||
        prices->of[k] > hsr_kinds[k].price)
      return false;
  return true;
}
