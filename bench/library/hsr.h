/* SPDX-License-Identifier: GPL-3.0-or-later */
/* libhsr: hidden-surface algorithms, a judge of their answers, and a count of
 * their work. docs/library.md has a program to begin with.
 *
 * Source      Sutherland, Sproull and Schumacker, "A characterization of ten
 *             hidden-surface algorithms", 1974. hsr's pages
 *             docs/correct-picture.md, docs/correct-drawing.md and others
 *             beside them define the right answers.
 * Frame       the world is right-handed, in any unit. The picture has m columns
 *             from the left and n rows from the top. Pixel (i, j) of an array
 *             is at [j * m + i]; rows have no padding.
 * Camera      F = (at - eye)/|at - eye|, right = F x up/|F x up|, U = h (right
 *             x F), R = (m/n) h right; h = tan(fov/2), or half the height of a
 *             parallel projection. The ray of the sample in column i and row j
 *             starts at the eye and runs along F + x R + y U, x = (2i + 1)/m -
 *             1, y = 1 - (2j + 1)/n. In parallel projection it starts at eye +
 *             x R + y U and runs along F. Depth is the parameter of a point on
 *             its ray. A sample is displaced infinitesimally to the right and
 *             much less down, so that no ray meets an edge.
 * Ids         a face is the number 0, 1, 2 ... that it has in the scene's
 *             order; HSR_NO_FACE is none.
 * Errors      a function that can fail returns an enum hsr_status. If it fails
 *             it fills the struct hsr_error of its caller, which may be NULL;
 *             otherwise it leaves it alone. After a failure a new handle is
 *             NULL and arrays are as they were. A NULL that is not allowed
 *             gives HSR_E_USAGE, and so does a number that is out of range. Any
 *             function may return HSR_E_NOMEM, and HSR_E_INTERNAL for a fault
 *             of hsr itself. Nothing is printed, and the program is never
 *             ended, but for one case: exact numbers cannot fail, and end it
 *             if memory has run out and their reserve of 1 MB is used up.
 * Structs     the caller sets `size` to sizeof of the struct, also if the
 *             struct is filled in. All that the caller does not set is 0, which
 *             is each member's standard. A later version may add members at the
 *             end. A struct that is too small for version 1, or that has
 *             members which this version does not know and which are not 0,
 *             gives HSR_E_USAGE.
 * Ownership   handles are the caller's, who frees them by the function named.
 *             Text and arrays that a function gives out belong to the handle
 *             and last as long as that. Text about algorithms is the library's
 *             and lasts for ever. What the caller gives is copied, or used
 *             within the call.
 * Threads     any functions may run at once with different handles. Several
 *             threads at once may draw one scene, and read one answer. A thread
 *             frees a handle when no other uses it. A callback must not call
 *             functions with the scene that is being drawn.
 * Arithmetic  the caller's thread rounds to nearest and keeps denormal numbers,
 *             as C programs do unless they ask for something else. */
#ifndef HSR_H
#define HSR_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#if defined __GNUC__
#define HSR_API __attribute__((visibility("default")))
#else
#define HSR_API
#endif

/* --- Version and errors --------------------------------------------------- */

#define HSR_VERSION_MAJOR 1 /* of this header, as in libhsr.so.1 */

/* Returns hsr's own version, "0.1.0". */
HSR_API const char *hsr_version(void);

#ifndef HSR_COMMON_STATUS_H /* hsr's own sources have these from there */

enum hsr_status {
  HSR_OK = 0,
  HSR_E_DIFFERENCE = 1, /* no function returns this: see struct hsr_verdict */
  HSR_E_USAGE = 2,      /* an argument is wrong */
  HSR_E_INPUT = 3,      /* a file or a scene cannot be used as it is */
  HSR_E_NOMEM = 4,      /* memory ran out, or a limit was met */
  HSR_E_INTERNAL = 5,   /* a fault of hsr, or of a library below it */
  HSR_E_REFUSED = 6,    /* the algorithm cannot take this scene */
  HSR_E_STOPPED = 7     /* the caller's callback stopped the work */
};

/* A failure in one line of text, without a newline. It is "file:line: what is
 * wrong" if a file is at fault. Control characters are replaced by '?'. */
struct hsr_error {
  enum hsr_status status;
  char text[480];
};

#endif

/* --- What there is -------------------------------------------------------- */

/* These functions fill *info about item k of a list, from 0. HSR_E_USAGE if the
 * list has no such item; so a loop ends there. */

/* A built-in scene. */
struct hsr_builtin_info {
  size_t size;
  const char *name;    /* "soup" */
  const char *usage;   /* "soup:N:SEED": the words that hsr_open takes */
  const char *about;   /* a sentence */
  const char *package; /* the Debian package that it needs; NULL: none */
  int is_there;        /* 1; 0 if that package is not installed */
};
HSR_API enum hsr_status hsr_get_builtin(size_t k, struct hsr_builtin_info *info,
                                        struct hsr_error *err);

/* A kind of answer. */
struct hsr_kind_info {
  size_t size;
  const char *name;    /* "ids" */
  const char *meaning; /* "the visible face of every sample" */
  const char *places;  /* "samples": what the judge compares */
  int has_windows;     /* 1: windows of it can be drawn, also by several threads
                          at once */
};
HSR_API enum hsr_status hsr_get_kind(size_t k, struct hsr_kind_info *info,
                                     struct hsr_error *err);

/* An algorithm. The oracles come first. */
struct hsr_algorithm_info {
  size_t size;
  const char *name;       /* "watkins" */
  const char *title;      /* "Watkins' scan-line algorithm" */
  const char *authors;    /* "G. S. Watkins" */
  int year;               /* of publication; 0: never published */
  const char *source;     /* where it is published and described */
  const char *class_name; /* in figure 13 of the survey: "image space" */
  const char *branch;     /* "point sampling"; NULL: the class has none */
  const char *sort_order; /* "YXZ"; NULL: none */
  const char *coherence;  /* what it bets on; NULL: nothing */
  char restrictions[48];  /* codes of figure 29, "CF TR"; scenes are adapted */
  uint64_t kinds;         /* 1 << k for each kind k that it can be asked for */
  size_t kind;            /* its own kind */
  size_t n_options, n_counters;
  int is_oracle;      /* 1: it defines what is right */
  int draws_nothing;  /* 1: it is a yardstick, and is not judged */
  int is_known_wrong; /* 1: its answer is wrong sometimes, as published */
};
HSR_API enum hsr_status hsr_get_algorithm(size_t k,
                                          struct hsr_algorithm_info *info,
                                          struct hsr_error *err);

/* Sets *k to the number of the algorithm with this name. HSR_E_USAGE if there
 * is none; the text names one that is like it. */
HSR_API enum hsr_status hsr_find_algorithm(const char *name, size_t *k,
                                           struct hsr_error *err);

/* An option that may be chosen in the text of a request: the algorithm's own,
 * then `window`, then those of the kinds of answers that it can be asked for.
 * */
struct hsr_option_info {
  size_t size;
  const char *name;    /* "cubes" */
  const char *meaning; /* "how the faces of a cube are tested" */
  const char *kind;    /* the kind of answer that has it; NULL: it is none's */
  size_t n_words;      /* its value is one of so many words; 0: a number */
  int is_real;         /* 1: the number is real, not whole */
  double least, most;  /* of a number, both included */
  double standard;     /* the number, or the number of a word, from 0; -1: a
                          word of the kind, none of which is standard */
};
HSR_API enum hsr_status hsr_get_option(size_t algorithm, size_t k,
                                       struct hsr_option_info *info,
                                       struct hsr_error *err);

/* A word of an option. HSR_E_USAGE also if there is no such option. */
struct hsr_word_info {
  size_t size;
  const char *name;    /* "whole" */
  const char *meaning; /* "the cube, instead of its sides, by its bounding
                          rectangle" */
};
HSR_API enum hsr_status hsr_get_word(size_t algorithm, size_t option, size_t k,
                                     struct hsr_word_info *info,
                                     struct hsr_error *err);

/* A counter of an algorithm. Counters of different algorithms that count the
 * same thing have the same name. */
struct hsr_counter_info {
  size_t size;
  const char *name;     /* "X merge" */
  const char *key;      /* a stable word, "cube-visited"; NULL: none */
  const char *meaning;  /* a clause */
  const char *step;     /* the kind of step: "sort", "compare", "split",
                           "subdivide", "activate", "retire", "span", "sample",
                           "reject" or "accept" */
  const char *a, *b;    /* kinds of the subjects of its steps: struct
                           hsr_subject */
  const char *outcomes; /* of a step, from 0: "farther|nearer"; NULL: a step
                           decides nothing */
  int is_computed;      /* 1: the steps are not performed, as hardware would do,
                           but their number is computed. It has no events */
  int line;             /* of the algorithm's outline, from 1; 0: none */
  const char *line_text; /* that line, in the paper's words; NULL: none */
};
HSR_API enum hsr_status hsr_get_counter(size_t algorithm, size_t k,
                                        struct hsr_counter_info *info,
                                        struct hsr_error *err);

/* --- Scenes --------------------------------------------------------------- */

struct hsr_scene;

/* How a scene is made. NULL: all is standard. */
struct hsr_open_options {
  size_t size;
  int threads;      /* that import it, lay it out and prepare it for
                          algorithms, 1 to 64; 0: 1 */
  int strict;       /* not 0: a file with faces that have no area is
                          refused; 0: they are left out and counted, since they
                          cover no sample */
  int two_sided;    /* not 0: all faces are seen from both sides; 0: those of
                          a closed mesh are seen from outside only */
  double weld;      /* vertices of a mesh file that are no farther apart are
                          joined, in its unit; 0: none are */
  const char *path; /* where the file is, if the name is not its path, but what
                          the scene is called, with the suffix; NULL: it is */
};

/* Opens a scene: a built-in one with its parameters ("house", "soup:1000:7"),
 * or a file (.obj .off .ply .stl .vtp .gltf .glb .scene.json, volumes and height
 * fields), each as the command hsr names it, with words and cameras after it if
 * wanted ("brain.nii@palette=bone"). Standard views are such words, too:
 * "a.obj@look=iso:parallel=fit-4x3" has the isometric view alone, which fits a
 * picture of this shape. The caller frees *scene by hsr_close. HSR_E_USAGE for
 * cameras and palettes that are wrong; HSR_E_INPUT if there is no such scene, or
 * its file is wrong. */
HSR_API enum hsr_status hsr_open(const char *name,
                                 const struct hsr_open_options *options,
                                 struct hsr_scene **scene,
                                 struct hsr_error *err);

/* Polygons with common vertices. All arrays are the caller's and are copied. */
struct hsr_arrays {
  size_t size;
  const char *name;       /* of the scene; NULL: "arrays" */
  const double *xyz;      /* 3 n_vertices, world units */
  size_t n_vertices;      /* below 2^32 - 1, as the other numbers */
  const uint32_t *ring;   /* n_faces: the number of corners of each face, 3 or
                             more; NULL: all are triangles */
  size_t n_faces;         /* 1 or more */
  const uint32_t *vertex; /* n_corners: the vertices of face 0, then of face 1
                             ..., counter-clockwise seen from the front */
  size_t n_corners;       /* the sum of ring[], or 3 n_faces */
  const float *rgb;       /* 3 n_faces: linear, 0 to 1; NULL: all grey */
  /* 12 n_instances: where the faces stand, M by rows, 3 of 4: world = M (x, y,
   * z, 1). NULL, and n_instances 0: as they are. */
  const double *instance;
  size_t n_instances;
  const float *opacity; /* n_faces: 0 to 1; NULL: all are opaque */
};

/* Makes a scene of arrays. Face f of the arrays is face f of the scene; with
 * instances, face f of instance k is face f + k n_faces. Its own cameras are
 * eight around it. options->strict has no effect. The caller frees *scene by
 * hsr_close. HSR_E_USAGE if the lengths do not fit one another; HSR_E_INPUT, with
 * the face, vertex or instance, if a coordinate is not finite or above 1e30 in
 * size, a vertex is out of range or follows itself in a face, a face has no
 * area, or a colour or an opacity is not in 0 to 1. */
HSR_API enum hsr_status hsr_open_arrays(const struct hsr_arrays *arrays,
                                        const struct hsr_open_options *options,
                                        struct hsr_scene **scene,
                                        struct hsr_error *err);

/* Samples of a density at ascending places along x, y and z. A sample with a
 * density of `least` to `most` is kept: it is an opaque box that reaches
 * half-way to its neighbours. All arrays are the caller's and are copied. */
struct hsr_grid_arrays {
  size_t size;
  const char *name;     /* of the scene; NULL: "grid" */
  uint32_t n[3];        /* samples along x, y and z, each 1 to 2^20 */
  const double *at[3];  /* n[k] places along axis k, world units; NULL: 0, 1,
                            2 ... */
  const float *density; /* [(z n[1] + y) n[0] + x]; NaN is never kept */
  double least, most;   /* both included */
  const float *rgb;     /* 3 for each sample: linear, 0 to 1, kept with 8 bits
                            of their square root; NULL: all grey */
};

/* Makes a scene of a grid. Its faces are the sides of the kept boxes, without
 * those between two kept boxes. Their ids ascend from box to box as the samples
 * do in `density`. The sides of one box follow in this order: towards lower x,
 * higher x, lower y, higher y, lower z, higher z. The caller frees *scene by
 * hsr_close. HSR_E_USAGE if n or the bounds are out of range; HSR_E_INPUT if
 * places do not ascend, no sample is kept, or a colour is not in 0 to 1;
 * HSR_E_REFUSED for more than 2^32 - 2 faces. */
HSR_API enum hsr_status hsr_open_grid(const struct hsr_grid_arrays *grid,
                                      const struct hsr_open_options *options,
                                      struct hsr_scene **scene,
                                      struct hsr_error *err);

/* Frees a scene; NULL is allowed. Answers that are drawn of it stay valid: they
 * keep what they need. */
HSR_API void hsr_close(struct hsr_scene *scene);

struct hsr_scene_info {
  size_t size;
  const char *name;
  uint64_t n_faces;
  uint64_t n_vertices; /* laid out, so that edges can be named: those of each
                          instance count. Of a grid 0 until its faces are
                          made */
  uint64_t n_objects, n_instances;
  uint32_t n_views;   /* cameras of its own, at least 1 */
  int is_grid;        /* 1: it is a volume of cells */
  int is_transparent; /* 1: some faces are not opaque. Only answers of the kind
                         "transparent" show that */
  int enlarged;       /* e: the scene is too small to compute with. So all
                         lengths, of cameras and depths too, are 2^e times those
                         of the file. 0: they are those of the file */
  uint64_t n_dropped; /* faces without area that were left out */
  const char *notes;  /* what else was left out of the file, lines; "" */
};
HSR_API enum hsr_status hsr_get_scene(const struct hsr_scene *scene,
                                      struct hsr_scene_info *info,
                                      struct hsr_error *err);

/* The faces of a scene, laid out. The arrays are as those of struct hsr_arrays,
 * and belong to the scene. A scene that hsr_open_arrays makes of them is one
 * object, which is one-sided if it is closed: objects and one_sided do not pass
 * through it. */
struct hsr_geometry {
  size_t size;
  const double *xyz; /* 3 n_vertices, world units; those of one instance follow
                        those of another */
  size_t n_vertices;
  const uint32_t *ring; /* n_faces: the number of corners of each face, by its
                           id */
  size_t n_faces;
  const uint32_t *vertex; /* n_corners: the vertices of face 0, then of face 1
                             ..., counter-clockwise seen from the front */
  size_t n_corners;
  const float *rgb;       /* 3 n_faces: the face's own colour, linear, 0 to 1 */
  const float *opacity;   /* n_faces: 0 to 1 */
  const uint32_t *object; /* n_faces: which object the face is of */
  const char *const *object_name; /* n_objects */
  size_t n_objects;
  const uint8_t *one_sided; /* n_faces: 1 if the face exists only when it is
                               seen from its front, else 0 */
};

/* Lays the scene out, if no algorithm has done so, and sets *geometry to its
 * faces. HSR_E_REFUSED if there are too many faces to be laid out. */
HSR_API enum hsr_status hsr_get_geometry(const struct hsr_scene *scene,
                                         struct hsr_geometry *geometry,
                                         struct hsr_error *err);

/* A camera: see Frame and Camera above. World units, degrees. */
struct hsr_camera {
  size_t size;
  double eye[3], at[3]; /* where it is, and a point that it looks at */
  double up[3];         /* a direction that is upwards in the picture */
  double fov;      /* vertical angle of view, 0 < fov < 180; of no effect in
                      parallel projection */
  double near;     /* points with depth <= near do not exist; 0 or more */
  double parallel; /* above 0: parallel projection, and this is the height of
                      the picture. 0: perspective */
  /* For shadows. x, y, z, 1: a light at this point; x, y, z, 0: a sun in this
   * direction. All 0: a sun above the eye's left shoulder. */
  double light[4];
};

/* Fills *camera with a camera of the scene's own, `view` from 0. View 0 is the
 * command's view 1. HSR_E_USAGE if the scene has no such view. */
HSR_API enum hsr_status hsr_get_camera(const struct hsr_scene *scene,
                                       uint32_t view, struct hsr_camera *camera,
                                       struct hsr_error *err);

/* --- Drawing -------------------------------------------------------------- */

struct hsr_answer;

/* What to draw. */
struct hsr_request {
  size_t size;
  /* With options, as the command takes it: "watkins",
   * "zbuffer-fast:filter=box:jitter=4". */
  const char *algorithm;
  const struct hsr_camera *camera; /* NULL: the scene's own, number `view` */
  uint32_t view; /* from 0; of no effect if there is a camera */
  int m, n;      /* samples, or pixels, a row; rows; 1 to 16384 */
  int window[4]; /* x0, y0, x1, y1: only columns x0 to x1 - 1 of rows y0 to y1 -
                    1 are drawn; the rest is HSR_NO_FACE, or means nothing.
                    All 0: the picture */
  int threads;   /* that draw, 1 to 64; 0: 1. An answer that is made as a whole
                    is drawn by one */
  int counts;    /* not 0: the build that counts draws, for hsr_get_counts. It
                    is slower; its time says nothing */
  /* Called with the share that is drawn, 0 to 1, now and then; at least before
   * and after. If it returns 0 the drawing stops. One thread at a time calls
   * it, not always the caller's. Nothing is told while an algorithm prepares.
   * NULL: nobody is told. */
  int (*progress)(void *context, double share);
  void *context;    /* for progress */
  double offset[2]; /* how far each sample lies to the right of the middle of
                       its place, and below it, in samples: above -1/2 and below
                       1/2. Of kind "ids" */
  int work; /* not 0: also how often each sample is looked at, for hsr_get_work.
               Then the build that counts draws, as with `counts` */
};

/* Draws. The caller frees *answer by hsr_free. HSR_E_USAGE for a text that
 * names no algorithm or option, a view that the scene has not, a size out of
 * range, a window that is empty, not in the picture, or of a kind of answer
 * that has none, or work of an answer that is not drawn sample by sample, in one
 * picture; HSR_E_INPUT for a camera that is impossible; HSR_E_REFUSED if
 * the algorithm does not take the scene, and the text says why; HSR_E_STOPPED
 * if progress() returned 0. */
HSR_API enum hsr_status hsr_draw(const struct hsr_scene *scene,
                                 const struct hsr_request *request,
                                 struct hsr_answer **answer,
                                 struct hsr_error *err);

/* An algorithm that is ready to draw a scene, from any eye. */
struct hsr_drawer;

/* Makes an algorithm ready: what is the same for all pictures is done once. Of
 * the request only `algorithm`, `threads` and `counts` have an effect. The
 * caller frees *drawer by hsr_release. Errors as hsr_draw. */
HSR_API enum hsr_status hsr_prepare(const struct hsr_scene *scene,
                                    const struct hsr_request *request,
                                    struct hsr_drawer **drawer,
                                    struct hsr_error *err);

/* Draws as hsr_draw, by an algorithm that is ready. `algorithm`, `threads` and
 * `counts` of the request have no effect. If *answer is NULL it is made, and
 * the caller frees it by hsr_free. Otherwise it is the last answer of this
 * drawer that had this size, and is drawn over: what was read of it is not
 * valid any more. If that fails once drawing has begun, *answer is freed and
 * becomes NULL. HSR_E_USAGE if *answer is another. Other errors as hsr_draw.
 * Several threads that call with one drawer take turns. An algorithm that keeps
 * something from picture to picture is made ready anew for another size. */
HSR_API enum hsr_status hsr_redraw(struct hsr_drawer *drawer,
                                   const struct hsr_request *request,
                                   struct hsr_answer **answer,
                                   struct hsr_error *err);

/* Frees a drawer; NULL is allowed. Its answers stay valid. */
HSR_API void hsr_release(struct hsr_drawer *drawer);

/* What a step is about, in the scene's ids. */
struct hsr_subject {
  const char *kind; /* "nothing"; "face": face; "piece": face, number; "edge":
                       vertex, vertex, face or HSR_NO_FACE; "implied edge":
                       face, face, part; "vertex": vertex; "volume": number;
                       "cell": of a tree or a pyramid; "window": the step's
                       own */
  uint32_t id[3];
};

/* A step of an algorithm. */
struct hsr_event {
  size_t size;
  uint64_t number;  /* in the run, from 0 */
  size_t counter;   /* of the algorithm: hsr_get_counter. As many events have
                          a counter as it counts, unless it is computed */
  const char *step; /* the counter's kind of step, "compare" */
  struct hsr_subject a, b;
  int window[4]; /* x0, y0, x1, y1 in samples; empty: about no window. An
                    "accept" of an answer of ids writes face a to all of it */
  int outcome;   /* the number of one of the counter's outcomes, or 0 */
};

/* Draws by one thread, with the build that counts, and calls listen(context,
 * event) for each step, in order, in the caller's thread. The event is valid
 * within the call. `threads` and `counts` of the request have no effect.
 * HSR_E_USAGE also if the algorithm has no steps to tell of, as an oracle, or
 * not for this kind of answer. Other errors as hsr_draw. */
HSR_API enum hsr_status
hsr_trace(const struct hsr_scene *scene, const struct hsr_request *request,
          void (*listen)(void *context, const struct hsr_event *event),
          void *context, struct hsr_answer **answer, struct hsr_error *err);

/* Frees an answer; NULL is allowed. */
HSR_API void hsr_free(struct hsr_answer *answer);

/* --- Reading an answer ---------------------------------------------------- */

struct hsr_answer_info {
  size_t size;
  size_t kind;           /* its number: hsr_get_kind */
  const char *kind_name; /* "ids" */
  const char *algorithm; /* the text of the request */
  size_t algorithm_number;
  int m, n, window[4]; /* the window is never all 0 */
  char adapted[200];   /* how the scene was adapted, "triangulate"; "" */
  double adapt_seconds, prepare_seconds, draw_seconds;
};
HSR_API enum hsr_status hsr_get_answer(const struct hsr_answer *answer,
                                       struct hsr_answer_info *info,
                                       struct hsr_error *err);

/* Fills the caller's text of `size` bytes with a line about what is in the answer,
 * without a newline, as hsr render prints it: "82 edges, 150 intervals, 78.7 % of
 * their length visible". 200 bytes are enough. HSR_E_USAGE if it does not fit.
 */
HSR_API enum hsr_status hsr_get_summary(const struct hsr_answer *answer,
                                        char *text, size_t size,
                                        struct hsr_error *err);

/* The functions below give HSR_E_USAGE if the answer is of a kind that has not
 * what they give. An array that they point to belongs to the answer. */

/* m n face ids, or HSR_NO_FACE. Of kinds "ids" and "shadowed". */
#define HSR_NO_FACE UINT32_MAX
HSR_API enum hsr_status hsr_get_ids(const struct hsr_answer *answer,
                                    const uint32_t **ids,
                                    struct hsr_error *err);

/* m n bytes: 1 where light reaches the face that is seen, else 0. Of kind
 * "shadowed". */
HSR_API enum hsr_status hsr_get_lit(const struct hsr_answer *answer,
                                    const unsigned char **lit,
                                    struct hsr_error *err);

/* Fills the caller's array of n = m n floats with the depth of the face that is
 * seen, good to the precision of a float, or +infinity. Of kinds "ids",
 * "shadowed" and "polygons". HSR_E_USAGE also if n is another number. */
HSR_API enum hsr_status hsr_get_depths(const struct hsr_answer *answer,
                                       float *depth, size_t n,
                                       struct hsr_error *err);

/* How the colour of a face is chosen. */
enum hsr_shading_choice {
  HSR_COLOUR_LAMBERT, /* its own, times 1/4 + 3/4 of the cosine to the sun */
  HSR_COLOUR_FLAT,    /* its own */
  HSR_COLOUR_IDS,     /* a colour for its id */
  HSR_COLOUR_GOURAUD  /* Lambert's at its corners, interpolated */
};

/* Fills the caller's array of n = 3 m n floats with linear red, green and blue
 * of each place, 0 to 1, as the command shows them. Of all kinds but "segments"
 * and "voxels". HSR_E_USAGE also if n is another number, there is no such
 * choice, or it is not the first and the kind has colours of its own. */
HSR_API enum hsr_status hsr_get_colours(const struct hsr_answer *answer,
                                        enum hsr_shading_choice shading,
                                        float *rgb, size_t n,
                                        struct hsr_error *err);

/* An interval of an edge that is hidden by one number of faces. The edge is
 * named by its vertices a < b. An implied edge, where two faces penetrate, is
 * named by these faces, and is number `part` of theirs. */
struct hsr_segment {
  unsigned char is_implied, reserved[3]; /* reserved: of no meaning */
  uint32_t a, b, part;
  uint32_t invisibility; /* how many faces hide it; 0: it is visible */
  double t0, t1;         /* in [0, 1], along the edge */
  double from[3], to[3]; /* its ends, world units, rounded */
};

/* The n intervals of a line drawing, edge by edge. Of kind "segments". */
HSR_API enum hsr_status hsr_get_segments(const struct hsr_answer *answer,
                                         const struct hsr_segment **segment,
                                         size_t *n, struct hsr_error *err);

/* The regions of the picture where faces are visible. Region r is of face[r]
 * and has the cycles cycle[r] to cycle[r + 1] - 1: its outer boundary, then
 * holes. Cycle c has the points point[c] to point[c + 1] - 1. Point p is
 * xy[2p], xy[2p + 1]: to the right and down from the corner of the picture, in
 * pixels, rounded with a relative error of 2^-50. The region is to the right of
 * each side. */
struct hsr_polygon_arrays {
  size_t size;
  size_t n_regions, n_cycles, n_points;
  const uint32_t *face;        /* n_regions, ascending */
  const size_t *cycle, *point; /* n_regions + 1; n_cycles + 1 */
  const double *xy;            /* 2 n_points */
};

/* Of kind "polygons". */
HSR_API enum hsr_status hsr_get_polygons(const struct hsr_answer *answer,
                                         struct hsr_polygon_arrays *polygons,
                                         struct hsr_error *err);

/* 6 m n numbers: for red, green and blue of each pixel the ends lo, hi of an
 * interval that holds the exact area integral, linear, 0 to 1. Of kind
 * "area". */
HSR_API enum hsr_status hsr_get_areas(const struct hsr_answer *answer,
                                      const double **bounds,
                                      struct hsr_error *err);

/* 3 m n weighted sums of samples: red, green and blue of each pixel
 * (docs/filtered-picture.md has the weights). Of kind "filtered". */
HSR_API enum hsr_status hsr_get_sums(const struct hsr_answer *answer,
                                     const uint32_t **sum,
                                     struct hsr_error *err);

/* channels m n numbers, linear; 65535 is 1. Of kind "transparent" there are 3
 * channels, red, green and blue. Of kind "composited" there are 4: these,
 * premultiplied, and opacity. */
HSR_API enum hsr_status hsr_get_rgba(const struct hsr_answer *answer,
                                     const uint16_t **rgba, int *channels,
                                     struct hsr_error *err);

/* Cubes of the world, and the solid that each is in. */
struct hsr_voxel_array {
  size_t size;
  double lo[3], side;    /* the lowest corner of the first; world units */
  int n[3];              /* along x, y and z */
  const uint32_t *solid; /* [(z n[1] + y) n[0] + x]: from 1; 0: in none */
};

/* Of kind "voxels". */
HSR_API enum hsr_status hsr_get_voxels(const struct hsr_answer *answer,
                                       struct hsr_voxel_array *voxels,
                                       struct hsr_error *err);

/* The n counts of the answer's algorithm, by the number of the counter. Of an
 * answer that was drawn with request.counts, or traced. */
HSR_API enum hsr_status hsr_get_counts(const struct hsr_answer *answer,
                                       const uint64_t **count, size_t *n,
                                       struct hsr_error *err);

/* m n floats: how often the algorithm looked at each sample. What it does to an
 * area is shared out among the samples of the area. Of an answer that was drawn
 * with request.work. */
HSR_API enum hsr_status hsr_get_work(const struct hsr_answer *answer,
                                     const float **work, struct hsr_error *err);

/* --- Judging -------------------------------------------------------------- */

/* What the judge says. */
struct hsr_verdict {
  size_t size;
  uint64_t compared, differing; /* places, as the kind has them */
  char first[200]; /* the first difference in words: "(3, 4): face 5, not
                      background"; "" if there is none */
  uint32_t *place; /* the caller's array of `room` numbers, or NULL: gets the
                      first places that differ, j m + i, ascending. Kinds that
                      are compared as a whole ("segments", "polygons", "voxels")
                      leave it alone */
  size_t room;
  size_t n_places; /* how many were written */
};

/* Compares an answer with the oracle's, which is drawn for that. Of a window
 * only its places are compared. `size`, `place` and `room` of *verdict are the
 * caller's; the rest is filled in. HSR_OK also if there are differences.
 * HSR_E_REFUSED if no oracle takes the scene, or the algorithm draws nothing.
 * */
HSR_API enum hsr_status hsr_judge(const struct hsr_answer *answer,
                                  struct hsr_verdict *verdict,
                                  struct hsr_error *err);

/* The same for ids that anybody has found: m n of them by rows, for the camera,
 * size and window of the request. Its progress() is told while the oracle draws;
 * all else of it has no effect. Errors as hsr_draw and hsr_judge. */
HSR_API enum hsr_status hsr_judge_ids(const struct hsr_scene *scene,
                                      const struct hsr_request *request,
                                      const uint32_t *ids,
                                      struct hsr_verdict *verdict,
                                      struct hsr_error *err);

/* --- Writing -------------------------------------------------------------- */

/* How hidden lines are drawn. */
enum hsr_hidden_lines {
  HSR_LINES_LEFT_OUT,
  HSR_LINES_DASHED,
  HSR_LINES_THIN, /* thinner and lighter, the more faces hide them */
  HSR_LINES_ALL   /* like the visible ones */
};

/* How an answer is shown in a file. NULL: all is standard. */
struct hsr_style {
  size_t size;
  enum hsr_shading_choice shading; /* as hsr_get_colours */
  enum hsr_hidden_lines hidden;    /* of line drawings */
  double
      crease; /* of line drawings: edges where faces meet at less than so many
                    degrees are left out, unless they are outlines; 0: all are
                    drawn */
  const float *background; /* 3 numbers, linear, 0 to 1; NULL: the standard.
                              Of kinds "ids", "polygons", "composited" */
  const char *style; /* of line drawings: "screen", "iso", "plotter", or a file
                        that ends in .json, of docs/schemas/style.schema.json;
                        NULL: "screen". `hidden` and `crease` overrule it where
                        they are not 0 */
};

/* Writes an answer to a file, as hsr render -o does: .exr .png ... of pictures,
 * .npy of ids and splats, .rgb.npy of colours, .depth.npy and .depth.png of the
 * depths of ids, .svg .pdf .eps .dxf .vtp .json of drawings, .vti of voxels. A
 * failure leaves no partial file. HSR_E_USAGE if such a file cannot hold the answer,
 * the kind takes no account of what the style says, or there is no style of that
 * name; HSR_E_INPUT if the file cannot be written, or that of the style cannot be
 * read. */
HSR_API enum hsr_status hsr_write(const struct hsr_answer *answer,
                                  const char *path,
                                  const struct hsr_style *style,
                                  struct hsr_error *err);

#ifdef __cplusplus
}
#endif
#endif
