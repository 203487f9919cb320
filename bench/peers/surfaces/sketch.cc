/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sketch, which makes drawings for TeX: Newell's depth sort, which divides
 * polygons where it must, or a BSP tree.
 *
 * Program     Sketch is a program. Each frame starts it, hands it the scene in
 *             its own language through a file in memory, and reads its drawing
 *             through a pipe.
 * Input       Faces that exist, after the perspective transform, as triangles.
 *             The name of a face's colour is its id.
 * Units       hundredths of a pixel. Sketch draws in centimetres for TeX, with
 *             three digits after the point. Were a pixel one unit, this
 *             rounding would be most of what is wrong.
 * Output      polygons from back to front, in whole numbers of thousandths of a
 *             unit. They are painted at the samples in whole numbers, too, so
 *             nothing is lost here.
 * Sample      as docs/correct-picture.md has it: displaced to the right by
 *             nothing, and down by still less.
 * Clipping    Sketch does not clip; see clipped.h. */
#include "config.h"

#include "bench/peers/lines/clipped.h"
#include "bench/peers/surfaces/painted.h"
#include "bench/peers/shared/peers.h"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>
#include <string>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace {

struct State {
  bool tree;
  const struct hsr_world *world;
  uint32_t *ids;
};

enum hsr_status sketch_fail(struct hsr_error *err) {
  try {
    throw;
  } catch (const std::bad_alloc &) {
    return hsr_fail_nomem(err);
  } catch (...) {
    return hsr_fail(err, HSR_E_INTERNAL, "sketch: an exception");
  }
}

/* --- The program ---------------------------------------------------------- */

/* A file in memory that holds a text; -1: there is none. */
int hold(const std::string &text) {
  int file = memfd_create("scene.sk", 0);
  size_t done = 0;
  while (file >= 0 && done < text.size()) {
    ssize_t n = write(file, text.data() + done, text.size() - done);
    if (n < 0) {
      close(file);
      return -1;
    }
    done += size_t(n);
  }
  return file;
}

using Words = std::vector<const char *>; /* of a command, and a null */

/* Runs in the new process, which ends with the one that began it. */
[[noreturn]] void become(const Words &words, int out) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (dup2(out, STDOUT_FILENO) >= 0 && freopen("/dev/null", "w", stderr))
    execv(SKETCH_PROGRAM, const_cast<char *const *>(words.data()));
  _exit(HSR_E_INTERNAL);
}

/* What Sketch answers. False if it fails; then *status is that of waitpid. */
bool run_sketch(const Words &words, std::string *answer, int *status) {
  int out[2];
  *status = -1;
  if (pipe(out))
    return false;
  fflush(nullptr);
  pid_t child = fork();
  if (child == 0)
    become(words, out[1]);
  close(out[1]);
  char bytes[1 << 16];
  for (ssize_t n; child > 0 && (n = read(out[0], bytes, sizeof bytes)) > 0;)
    answer->append(bytes, size_t(n));
  close(out[0]);
  while (child > 0 && waitpid(child, status, 0) < 0 && errno == EINTR) {
  }
  return child > 0 && WIFEXITED(*status) && WEXITSTATUS(*status) == 0;
}

/* --- The scene ------------------------------------------------------------ */

std::string describe(const State *state, const struct hsr_view *view) {
  Clipped clipped = clip_world(state->world, view);
  std::string text;
  const double units = PAINTED_UNITS;
  for (const ClippedFace &face : clipped.face) {
    char words[160];
    snprintf(words, sizeof words,
             "polygon[fillcolor=f%u,linestyle=none,cull=false]",
             hsr_world_parent(state->world, face.face));
    text += words;
    for (uint32_t c : face.corner) {
      const double *at = clipped.corner[c].point;
      snprintf(words, sizeof words, "(%.9f,%.9f,%.9f)", units * at[0],
               units * at[1], units * at[2]);
      text += words;
    }
    text += '\n';
  }
  return text;
}

/* --- The peer's functions ------------------------------------------------- */

enum hsr_status sketch_setup(const struct peer *peer,
                             const struct peer_canvas *canvas, void **out,
                             struct hsr_error *err) {
  State *state = new (std::nothrow) State;
  *out = state;
  if (!state)
    return hsr_fail_nomem(err);
  state->tree = peer == &peer_sketch_bsp;
  state->world = canvas->setup->world;
  state->ids = canvas->ids;
  return HSR_OK;
}

enum hsr_status sketch_draw(void *opaque, const struct hsr_view *view,
                            struct hsr_error *err) try {
  const State *state = static_cast<const State *>(opaque);
  std::string text = describe(state, view), drawing;
  int status, file = hold(text);
  if (file < 0)
    return hsr_fail_nomem(err);
  char path[32];
  snprintf(path, sizeof path, "/dev/fd/%d", file);
  Words words = {"sketch"};
  if (state->tree)
    words.push_back("-b");
  words.push_back(path);
  words.push_back(nullptr);
  bool good = run_sketch(words, &drawing, &status);
  close(file);
  if (!good && WIFSIGNALED(status))
    return hsr_fail(err, HSR_E_INTERNAL, "sketch: ended by signal %d",
                    WTERMSIG(status));
  if (!good)
    return hsr_fail(err, HSR_E_INTERNAL, "sketch: it failed");
  paint_drawing(drawing.c_str(), view->m, view->n, state->ids);
  return HSR_OK;
} catch (...) {
  return sketch_fail(err);
}

void sketch_release(void *opaque) {
  delete static_cast<State *>(opaque);
}

/* "% sketch version 0.3 (build 7d, ...": 0.3 7d. */
void sketch_version(char *text) try {
  std::string answer;
  int status;
  char number[16], build[16];
  if (run_sketch({"sketch", "-v", nullptr}, &answer, &status) &&
      sscanf(answer.c_str(), "%% sketch version %15s (build %15[^,]", number,
             build) == 2)
    snprintf(text, PEER_VERSION, "%s %s", number, build);
} catch (...) {
  *text = '\0';
}

/* --- The peers ------------------------------------------------------------ */

struct peer sketch_peer(const char *name, const char *title, const char *what) {
  struct peer peer = {};
  peer.name = name;
  peer.title = title;
  peer.source = "E. K. Ressler, Sketch: simple 3D sketching for TeX";
  peer.what = what;
  peer.kind = "ids";
  peer.demands = &takes_triangles;
  peer.version = sketch_version;
  peer.setup = sketch_setup;
  peer.draw = sketch_draw;
  peer.release = sketch_release;
  return peer;
}

} // namespace

#define FRAME                                                                  \
  " A frame transforms the vertices, writes the scene, runs the program, "     \
  "reads "                                                                     \
  "its drawing and paints it at the samples. Its coordinates are rounded to "  \
  "a "                                                                         \
  "thousandth of a pixel."

const struct peer peer_sketch =
    sketch_peer("sketch", "Sketch, Newell's depth sort",
                "Newell's depth sort, which divides polygons." FRAME);
const struct peer peer_sketch_bsp =
    sketch_peer("sketch-bsp", "Sketch, BSP tree",
                "A BSP tree, which divides polygons." FRAME);
