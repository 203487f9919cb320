/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The integral of a grid along the rays of pixels.
 *
 * Source      docs/integral.md.
 * Input       of the grid its arrays and its palette; of the view E, F, R, U, near,
 *             m, n, offsets and window, but not its matrices.
 * Method      a ray is cut into stretches within one box of samples (path.h). Each
 *             is a piece, whose effect intervals bound (pieces.h). Pieces are
 *             halved, from front to back, while what reaches the eye through what
 *             is before them makes their bounds too wide. Then the effects are put
 *             one behind the other, from back to front.
 * Rounds      a ray is gone through in rounds, whose width is always the same: of
 *             the first it is 1/64, and of each further one 1/32 of the one
 *             before. What holds in all of them is the answer of each. So the
 *             answers to narrower questions lie within those to wider ones.
 * Cost        about 2 microseconds a piece; a ray through 100 boxes has some 200
 *             pieces at a width of .001, and some 300 at .0001. */
#include "bench/judge/integral/integral.h"
#include "bench/judge/integral/path.h"

#include <atomic>
#include <chrono>
#include <exception>
#include <mutex>
#include <new>
#include <thread>

const struct integral_field_name integral_fields[N_INTEGRAL_FIELDS] = {
    {"pre", "samples are classified, and then interpolated"},
    {"post", "samples are interpolated, and then classified"},
    {"sums", "as pre, but nothing absorbs what is behind it"}};

namespace integral {

namespace {

using judge::Upward;

using bounds_of_pixel = std::array<Interval, INTEGRAL_CHANNELS>;

constexpr double FIRST_ROUND = 0x1p-6, NEXT_ROUND = 0x1p-5;
constexpr int ROUNDS = 9;
constexpr size_t MOST_PIECES = 200000; /* of a ray, in a round */
constexpr int MOST_HALVINGS = 40;

/* Of a round's width, that any piece may have: where opacity reaches 1, no piece
 * is as narrow as it is short. */
constexpr double LEAST_SHARE = 0x1p-12;

template <class Piece> struct step {
  Piece piece;
  effect all;
};

template <class Piece> class tracer {
  const field &f_;
  const hsr_view &view_;
  std::vector<stretch> stretches_;
  std::vector<step<Piece>> steps_;
  std::vector<effect> behind_one_another_;
  double length_;           /* of all pieces */
  double target_, through_; /* of a round: its width; the light that passes */
  Interval passed_;

  void collect(const ray &r);
  double uncertainty(const effect &e) const;
  void take(const effect &e);
  void look(const Piece &piece, const effect &e, int halvings);
  bounds_of_pixel go(double target);
  bounds_of_pixel composited(bool rest) const;

public:
  uint64_t pieces = 0;

  tracer(const field &f, const hsr_view &view) : f_(f), view_(view) {}
  bounds_of_pixel find(int i, int j, double asked);
  bounds_of_pixel sums(int i, int j);
};

template <class Piece> void tracer<Piece>::collect(const ray &r) {
  cut_ray(f_, view_, r, &stretches_);
  steps_.clear();
  length_ = 0;
  for (const stretch &s : stretches_) {
    if (f_.clear[f_.place(s.at)])
      continue;
    const uint16_t *corner[8];
    f_.corners(s.at, corner);
    const Piece piece(f_, corner, first_point(f_, r, s), last_point(f_, r, s),
                      length_in_box(f_, r, s));
    steps_.push_back({piece, piece.find()});
    length_ += piece.length();
    pieces++;
  }
}

template <class Piece>
double tracer<Piece>::uncertainty(const effect &e) const {
  double most = width(e.opacity);
  for (const Interval &c : e.emitted)
    most = std::max(most, width(c));
  return most * through_;
}

template <class Piece> void tracer<Piece>::take(const effect &e) {
  behind_one_another_.push_back(e);
  passed_ = passed_ * unit(Interval(1) - e.opacity);
  through_ = passed_.sup();
}

template <class Piece>
void tracer<Piece>::look(const Piece &piece, const effect &e, int halvings) {
  const double share = std::max(piece.length() / length_, LEAST_SHARE);
  if (uncertainty(e) <= target_ * share || halvings == MOST_HALVINGS ||
      behind_one_another_.size() >= MOST_PIECES) {
    take(e);
    return;
  }
  Piece low, high;
  piece.split(&low, &high);
  pieces += 2;
  look(low, low.find(), halvings + 1);
  look(high, high.find(), halvings + 1);
}

/* A mean of two intervals, the first of which has a weight in `part`. */
Interval mixture(const Interval &part, const Interval &a, const Interval &b) {
  const Interval low(part.inf()), high(part.sup());
  const Interval one = low * a + (Interval(1) - low) * b,
                 other = high * a + (Interval(1) - high) * b;
  return hull(one, other);
}

/* What is one behind the other. What comes last lets no more through than
 * `through_`; if there is a rest behind it, that is anything. */
template <class Piece>
bounds_of_pixel tracer<Piece>::composited(bool rest) const {
  bounds_of_pixel sum;
  sum.fill(rest ? Interval(0, 1) : Interval(0));
  for (size_t k = behind_one_another_.size(); k-- > 0;) {
    const effect &e = behind_one_another_[k];
    const Interval passes = unit(Interval(1) - e.opacity);
    for (size_t c = 0; c < 3; c++)
      sum[c] = narrowed(e.emitted[c] + passes * sum[c],
                        mixture(e.opacity, e.colour[c], sum[c]));
    sum[3] = mixture(e.opacity, Interval(1), sum[3]);
  }
  for (Interval &s : sum)
    s = unit(s);
  return sum;
}

template <class Piece> bounds_of_pixel tracer<Piece>::go(double target) {
  target_ = target / 2; /* both of what is emitted and of what passes */
  passed_ = 1;
  through_ = 1;
  behind_one_another_.clear();
  for (const step<Piece> &s : steps_) {
    if (through_ < target / 8)
      return composited(true);
    look(s.piece, s.all, 0);
  }
  return composited(false);
}

template <class Piece>
bounds_of_pixel tracer<Piece>::find(int i, int j, double asked) {
  collect(ray(view_, i, j));
  bounds_of_pixel best;
  best.fill(Interval(0, 1));
  double target = FIRST_ROUND;
  for (int k = 0; k < ROUNDS; k++, target *= NEXT_ROUND) {
    const bounds_of_pixel found = go(target);
    double widest = 0;
    for (size_t c = 0; c < best.size(); c++) {
      best[c] = common(best[c], found[c]);
      widest = std::max(widest, width(best[c]));
    }
    if (widest <= asked || behind_one_another_.size() >= MOST_PIECES)
      break;
  }
  return best;
}

template <> bounds_of_pixel tracer<pre_piece>::sums(int i, int j) {
  collect(ray(view_, i, j));
  bounds_of_pixel sum;
  sum.fill(Interval(0));
  for (const step<pre_piece> &s : steps_)
    for (size_t c = 0; c < sum.size(); c++)
      sum[c] = sum[c] + s.piece.sum(c);
  return sum;
}

/* --- Pictures ------------------------------------------------------------- */

/* One piece of work for all threads: rows are taken one by one. */
struct work {
  const field &f;
  const hsr_view &view;
  const integral_options &options;
  double (*const bounds)[2];
  std::atomic<int> next_row;
  std::atomic<size_t> rows = 0;
  std::atomic<bool> stopped = false;
  std::mutex guard; /* of what follows */
  integral_reach reach = {0, 0, 0};
  std::exception_ptr failure;
};

template <class Piece>
bounds_of_pixel bounds_at(tracer<Piece> *t, const work &w, int i, int j) {
  return t->find(i, j, w.options.width);
}
bounds_of_pixel bounds_at(tracer<pre_piece> *t, const work &w, int i, int j) {
  return w.options.field == INTEGRAL_SUMS ? t->sums(i, j)
                                          : t->find(i, j, w.options.width);
}

template <class Piece>
void fill_row(tracer<Piece> *t, work *w, int j, integral_reach *reach) {
  for (int i = w->view.window.x0; i < w->view.window.x1; i++) {
    const bounds_of_pixel found = bounds_at(t, *w, i, j);
    double(*out)[2] =
        w->bounds + 4 * (size_t(j) * size_t(w->view.m) + size_t(i));
    double widest = 0;
    for (size_t c = 0; c < found.size(); c++) {
      out[c][0] = found[c].inf();
      out[c][1] = found[c].sup();
      widest = std::max(widest, width(found[c]));
    }
    reach->widest = std::max(reach->widest, widest);
    reach->n_wide += widest > w->options.width;
  }
}

/* Not inlined, so that all is computed after the rounding mode is changed. */
template <class Piece> [[gnu::noinline]] void fill_rows(work *w, bool tells) {
  const Upward upward;
  tracer<Piece> t(w->f, w->view);
  integral_reach reach = {0, 0, 0};
  const size_t all = size_t(w->view.window.y1 - w->view.window.y0);
  for (int j; !w->stopped && (j = w->next_row++) < w->view.window.y1;) {
    fill_row(&t, w, j, &reach);
    const size_t done = ++w->rows;
    if (tells && w->options.tell &&
        !w->options.tell(w->options.whom, done, all))
      w->stopped = true;
  }
  const std::lock_guard<std::mutex> lock(w->guard);
  w->reach.widest = std::max(w->reach.widest, reach.widest);
  w->reach.n_wide += reach.n_wide;
  w->reach.pieces += t.pieces;
}

void fill_some(work *w, bool tells) noexcept {
  try {
    if (w->options.field == INTEGRAL_POST)
      fill_rows<post_piece>(w, tells);
    else
      fill_rows<pre_piece>(w, tells);
  } catch (...) {
    w->stopped = true;
    const std::lock_guard<std::mutex> lock(w->guard);
    w->failure = std::current_exception();
  }
}

void fill(work *w) {
  std::vector<std::thread> others;
  others.reserve(size_t(w->options.threads));
  try {
    for (int k = 1; k < w->options.threads; k++)
      others.emplace_back(fill_some, w, false);
  } catch (const std::system_error &) {
    /* fewer threads */
  }
  fill_some(w, true);
  for (std::thread &t : others)
    t.join();
  if (w->failure)
    std::rethrow_exception(w->failure);
}

} // namespace

} // namespace integral

enum hsr_status integral_find(const struct hsr_grid *grid,
                              const struct hsr_view *view,
                              const struct integral_options *options,
                              double (*bounds)[2], struct integral_reach *reach,
                              struct hsr_error *err) {
  try {
    if (!judge::is_rounding_honoured())
      return hsr_fail(err, HSR_E_INTERNAL,
                      "integral: directed rounding has no effect here");
    const integral::field f(*grid, *view, options->field);
    integral::work w = {f, *view, *options, bounds, view->window.y0};
    integral::fill(&w);
    *reach = w.reach;
    return w.stopped ? hsr_fail(err, HSR_E_STOPPED, "integral: stopped")
                     : HSR_OK;
  } catch (const std::bad_alloc &) {
    return hsr_fail_nomem(err);
  } catch (const std::exception &e) {
    return hsr_fail(err, HSR_E_INTERNAL, "integral: %s", e.what());
  }
}
