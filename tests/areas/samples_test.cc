/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Exact areas against 4,096 jittered samples a pixel of the point oracle: one at
 * random in each of 64 x 64 squares of the pixel. A sample shows a face that has
 * some area in its square. The areas in the squares add up to that in the pixel.
 *
 * Bound       of a face in a pixel, the number S of samples that show it has the
 *             mean E = Σ p, p being its share of a square. k squares have 0 < p < 1.
 *             By Hoeffding's inequality |S - E| >= t has a probability of at most
 *             2 exp(-2 t²/k). With t = √(k/2 · ln(2T/d)) for T faces in pixels,
 *             chance breaks any of the bounds with a probability of at most d,
 *             which is 10^-9 here.
 *
 * usage: samples_test [SEED]      standard: 1 */
#include "bench/modules/modules.h"
#include "algorithms/setup.h"
#include "tests/areas/shares.h"
#include "tests/draw.h"
#include "tests/tap.h"

#include <cmath>

namespace {

constexpr int SIDE = 64, SQUARES = SIDE * SIDE;

struct faces {
  std::vector<std::map<uint32_t, long>> seen; /* a pixel: samples by face */
  long impossible;                            /* samples */
};

/* Draws one sample a square in every pixel; the same one in all pixels. */
faces draw_samples(uint64_t seed, const hsr_world &world, const hsr_view &of,
                   const std::vector<shares> &squares) {
  const hsr_algorithm *oracle = hsr_algorithm_find("oracle")->plain;
  const int m = of.m, n = of.n;
  std::vector<uint32_t> ids(size_t(m) * size_t(n));
  faces f = {std::vector<std::map<uint32_t, long>>(ids.size()), 0};
  constexpr int64_t fine = 1 << 30;
  for (int b = 0; b < SIDE; b++)
    for (int a = 0; a < SIDE; a++) {
      hsr_view view = of;
      const auto offset = [&](int k) {
        return (k + double(draw_integer(&seed, 1, fine - 1)) / double(fine)) /
                   SIDE -
               .5;
      };
      view.offset_x = offset(a);
      view.offset_y = offset(b);
      draw_ids(oracle, &world, &view, ids.data(), nullptr);
      for (int j = 0; j < n; j++)
        for (int i = 0; i < m; i++) {
          const uint32_t face = ids[size_t(j * m + i)];
          f.seen[size_t(j * m + i)][face]++;
          f.impossible +=
              share(squares[size_t((j * SIDE + b) * m * SIDE + i * SIDE + a)],
                    face) == 0;
        }
    }
  return f;
}

struct expected {
  mpq_class mean;
  long open = 0; /* squares in which a sample may show the face or not */
};

/* Of the faces in a pixel. */
std::map<uint32_t, expected> expect(const std::vector<shares> &squares, int m,
                                    int i, int j) {
  std::map<uint32_t, expected> all;
  for (int b = 0; b < SIDE; b++)
    for (int a = 0; a < SIDE; a++)
      for (const auto &s :
           squares[size_t((j * SIDE + b) * m * SIDE + i * SIDE + a)]) {
        expected &e = all[s.first];
        e.mean += s.second;
        e.open += s.second < 1;
      }
  return all;
}

void check_scene(struct tap *tap, uint64_t seed, const char *name) {
  constexpr int m = 5, n = 4;
  hsr_scene *scene;
  hsr_world world;
  hsr_view view, fine;
  scene = must_open(name);
  must_world(&world, scene);
  must_view(&view, &scene->views[0], m, n);
  must_view(&fine, &scene->views[0], m * SIDE, n * SIDE);
  const std::vector<shares> pixels = shares_of(world, view),
                            squares = shares_of(world, fine);
  const faces found = draw_samples(seed, world, view, squares);
  long pairs = 0, outside = 0, different = 0;
  double worst = 0, bound = 0;
  for (const shares &pixel : pixels)
    pairs += long(pixel.size());
  for (int j = 0; j < n; j++)
    for (int i = 0; i < m; i++) {
      const size_t at = size_t(j * m + i);
      const auto wanted = expect(squares, m, i, j);
      different += wanted.size() != pixels[at].size();
      for (const auto &w : wanted) {
        different += w.second.mean != SQUARES * share(pixels[at], w.first);
        const auto seen = found.seen[at].find(w.first);
        const double error =
            std::fabs(double(seen == found.seen[at].end() ? 0 : seen->second) -
                      w.second.mean.get_d());
        const double t = std::sqrt(double(w.second.open) / 2 *
                                   std::log(2e9 * double(pairs)));
        outside += error > t;
        if (error > worst) {
          worst = error;
          bound = t;
        }
      }
    }
  ok(tap, different == 0, "%s: squares add up to pixels, %ld faces in %d", name,
     pairs, m * n);
  ok(tap, found.impossible == 0, "%s: all samples show what is there", name);
  ok(tap, outside == 0,
     "%s: %ld beyond the bounds; the largest error: %.5f of a pixel, of %.5f "
     "that chance may make",
     name, outside, worst / SQUARES, bound / SQUARES);
  hsr_world_free(&world);
  hsr_scene_delete(scene);
}

} // namespace

int main(int argc, char **argv) {
  const uint64_t seed = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 1;
  struct tap tap = plan(5 * 3);
  for (const char *name : {"house", "house@parallel=same", "penetration",
                           "t-junction", "lattice:40:3"})
    check_scene(&tap, seed, name);
  return finish(&tap);
}
