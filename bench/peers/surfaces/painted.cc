/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/peers/surfaces/painted.h"

#include "common/view/view.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <vector>

namespace {

constexpr int64_t PIXEL = 1000 * PAINTED_UNITS;

/* In thousandths of a unit, y downwards. */
struct Point {
  int64_t x, y;
};

/* Reads a number as thousandths. */
const char *read_number(const char *at, int64_t *number) {
  bool negative = *at == '-';
  int64_t value = 0;
  at += negative;
  for (; *at >= '0' && *at <= '9'; at++)
    value = 10 * value + (*at - '0');
  int digits = 0;
  if (*at == '.')
    for (at++; *at >= '0' && *at <= '9'; at++)
      if (digits < 3)
        value = 10 * value + (*at - '0'), digits++;
  for (; digits < 3; digits++)
    value *= 10;
  *number = negative ? -value : value;
  return at;
}

/* Reads "(x,y)(x,y)...". */
void read_points(const char *at, std::vector<Point> *points) {
  points->clear();
  while (*at == '(') {
    Point p;
    at = read_number(at + 1, &p.x);
    if (*at != ',')
      return;
    at = read_number(at + 1, &p.y);
    p.y = -p.y;
    if (*at != ')')
      return;
    at++;
    points->push_back(p);
  }
}

/* The first sample of a row to the right of the edge from a to b. The row is at
 * y, strictly between its ends, or at the upper end. A sample on the edge is to
 * the right of it. */
int64_t first_right(const Point &a, const Point &b, int64_t y) {
  __int128 up = b.y - a.y, along = __int128(y - a.y) * (b.x - a.x);
  if (up < 0)
    up = -up, along = -along;
  /* sample i is at i PIXEL + PIXEL / 2; the least i with
     (i PIXEL + PIXEL / 2 - a.x) up >= along */
  __int128 above = along + (a.x - PIXEL / 2) * up, below = PIXEL * up;
  __int128 i = above / below;
  return int64_t(i * below < above ? i + 1 : i);
}

void paint_row(const std::vector<Point> &points, int j, int m,
               std::vector<int64_t> *crossing, uint32_t id, uint32_t *row) {
  int64_t y = int64_t(j) * PIXEL + PIXEL / 2;
  crossing->clear();
  for (size_t k = 0; k < points.size(); k++) {
    const Point &a = points[k], &b = points[(k + 1) % points.size()];
    if ((a.y <= y) != (b.y <= y))
      crossing->push_back(first_right(a, b, y));
  }
  std::sort(crossing->begin(), crossing->end());
  for (size_t k = 0; k + 1 < crossing->size(); k += 2) {
    int64_t from = std::max<int64_t>((*crossing)[k], 0);
    int64_t to = std::min<int64_t>((*crossing)[k + 1], m);
    for (int64_t i = from; i < to; i++)
      row[i] = id;
  }
}

} // namespace

void paint_drawing(const char *text, int m, int n, uint32_t *ids) {
  static const char head[] = "\\pspolygon[fillcolor=f";
  std::vector<Point> points;
  std::vector<int64_t> crossing;
  std::fill(ids, ids + size_t(m) * size_t(n), HSR_BACKGROUND);
  for (const char *at = text; (at = strstr(at, head));) {
    char *end;
    uint32_t id = uint32_t(strtoul(at + strlen(head), &end, 10));
    at = end;
    const char *list = strchr(at, ']');
    if (!list)
      return;
    read_points(list + 1, &points);
    int64_t top = INT64_MAX, bottom = INT64_MIN;
    for (const Point &p : points)
      top = std::min(top, p.y), bottom = std::max(bottom, p.y);
    if (points.empty() || bottom < 0 || top > int64_t(n) * PIXEL)
      continue;
    int64_t first = std::max<int64_t>(0, top / PIXEL - 1);
    int64_t last = std::min<int64_t>(n - 1, bottom / PIXEL + 1);
    for (int64_t j = first; j <= last; j++)
      paint_row(points, int(j), m, &crossing, id, ids + size_t(j) * size_t(m));
  }
}
