/* SPDX-License-Identifier: GPL-3.0-or-later */
/* hsr-peers: other people's renderers, for hsr bench. See shared/peers.h. */
#include "config.h"

#include "bench/options/command.h"
#include "bench/options/words.h"
#include "bench/peers/shared/peers.h"

#include "bench/results/json.h"
#include "bench/run/serve.h"
#include "bench/run/stage.h"
#include "bench/run/terminate.h"
#include "common/answers/kinds/ids.h"
#include "common/base/clock.h"
#include "common/files/json/json.h"

#include <fcntl.h>
#include <malloc.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

static const struct peer *const peers[] = {
#if HSR_HAVE_EMBREE
    &peer_embree,
    &peer_embree_packets,
    &peer_embree_instances,
    &peer_embree_robust,
    &peer_embree_robust_packets,
#endif
#if HSR_HAVE_TINYBVH
    &peer_tinybvh,
#endif
#if HSR_HAVE_MASKED_CULLING
    &peer_masked_culling,
#endif
#if HSR_HAVE_OFFSCREEN
    &peer_llvmpipe,
    &peer_llvmpipe_arrays,
#endif
#if HSR_HAVE_VTK_RENDERER
    &peer_vtk,
    &peer_vtk_painter,
    &peer_vtk_lines,
    &peer_vtk_volume,
    &peer_vtk_volume_fine,
#endif
#if HSR_HAVE_GL2PS
    &peer_gl2ps,
#endif
#if HSR_HAVE_OCCT
    &peer_occt_exact,
    &peer_occt_polygonal,
#endif
#if HSR_HAVE_SKETCH
    &peer_sketch,
    &peer_sketch_bsp,
#endif
    &peer_zbuffer_inexact,
    &peer_memset,
};
enum { N_PEERS = sizeof peers / sizeof *peers };

const struct hsr_algorithm takes_triangles = {.name = "triangles",
                                              .subjects = 1 << HSR_FACES,
                                              .makes = {{HSR_IDS}},
                                              .restrictions = HSR_TR};

static enum hsr_status choose_peer(const char *name, const struct peer **chosen,
                                   struct hsr_error *err) {
  char names[512] = "";
  for (int k = 0; k < N_PEERS; k++) {
    *chosen = peers[k];
    if (!strcmp(peers[k]->name, name))
      return HSR_OK;
    size_t used = strlen(names);
    snprintf(names + used, sizeof names - used, "%s%s", used ? ", " : "",
             peers[k]->name);
  }
  return hsr_fail(err, HSR_E_USAGE, "no peer '%.100s'; there are %s", name,
                  names);
}

/* --- hsr-peers list ------------------------------------------------------- */

static json_t *peer_json(const struct peer *peer) {
  char version[PEER_VERSION] = "";
  peer->version(version);
  return json_pack("{ss ss ss so ss sb ss}", "name", peer->name, "title",
                   peer->title, "source", peer->source, "version",
                   *version ? json_string(version) : json_null(), "kind",
                   peer->kind, "threads", peer->many_threads, "what",
                   peer->what);
}

static enum hsr_status command_peers(int argc, char **argv,
                                     struct hsr_error *err) {
  (void)argv;
  if (argc > 1)
    return hsr_fail(err, HSR_E_USAGE, "list: takes no arguments");
  json_t *all = json_array();
  for (int k = 0; k < N_PEERS; k++)
    hsr_json_append(&all, peer_json(peers[k]));
  return json_print(all, err);
}

/* --- One peer, one view --------------------------------------------------- */

/* What is asked for: of the job of docs/programs.md, what a peer needs. */
struct request {
  char scene[1024];
  long view, threads, cameras;
  int m, n;
  const char *file; /* for hsr-peers ids; else NULL */
};

/* Everything that one run uses. */
struct run {
  const struct peer *peer;
  const struct request *request;
  const char *folder; /* of the job */
  struct stage stage;
  struct hsr_scene once;    /* of a roster: its objects, which are borrowed, */
  struct hsr_world objects; /* laid out once each */
  struct hsr_setup setup;
  struct peer_canvas canvas;
  bool is_mapped; /* its ids are the file */
  long before_kb;
  double prepare_seconds;
  void *state; /* the peer's */
};

static enum hsr_status draw_frame(void *state, struct hsr_error *err) {
  struct run *run = state;
  return run->peer->draw(run->state, &run->stage.view, err);
}

static enum hsr_status answer_bytes(struct run *run, struct hsr_error *err) {
  enum hsr_status status = HSR_OK;
  while (!status && getchar() != EOF) {
    status = draw_frame(run, err);
    puts("{}");
    if (fflush(stdout))
      return hsr_fail(err, HSR_E_INPUT, "nobody reads the output");
  }
  return status;
}

static enum hsr_status serve_run(struct run *run, struct hsr_error *err) {
  printf("{\"import\": %.9g, \"adapt\": %.9g, \"prepare\": %.9g, "
         "\"before_kb\": %ld}\n",
         run->stage.import_seconds, run->setup.adapt_seconds,
         run->prepare_seconds, run->before_kb);
  if (fflush(stdout))
    return hsr_fail(err, HSR_E_INPUT, "nobody reads the output");
  return answer_bytes(run, err);
}

static enum hsr_status judge_run(struct run *run, struct hsr_error *err) {
  json_t *verdict = NULL;
  enum hsr_status status = draw_frame(run, err);
  if (!status)
    status = run->peer->judge(run->state, &run->stage.view, &verdict, err);
  return status ? status : json_print(verdict, err);
}

/* Writes what a peer draws. */
static enum hsr_status write_run(struct run *run, struct hsr_error *err) {
  const struct peer_canvas *canvas = &run->canvas;
  struct hsr_answer answer =
      hsr_answer_of_ids(canvas->ids, canvas->m, canvas->n);
  enum hsr_status status = draw_frame(run, err);
  return status ? status
                : hsr_answer_write_ids(&answer, run->request->file, err);
}

/* Lays out every object once, in its own coordinates. */
static enum hsr_status lay_out_objects(struct run *run, struct hsr_error *err) {
  const struct hsr_scene *scene = run->stage.scene;
  double begin = hsr_seconds_now();
  run->once = (struct hsr_scene){
      .name = scene->name,
      .objects = scene->objects,
      .instances = calloc(scene->n_objects, sizeof *run->once.instances),
      .n_objects = scene->n_objects,
      .n_instances = scene->n_objects};
  if (!run->once.instances)
    return hsr_fail_nomem(err);
  for (uint32_t o = 0; o < scene->n_objects; o++)
    run->once.instances[o] = (struct hsr_instance){
        .object = o, .m = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}};
  enum hsr_status status = hsr_world_init(&run->objects, &run->once, err);
  run->stage.import_seconds += hsr_seconds_now() - begin;
  return status;
}

static bool is_drawn_by_objects(const struct run *run) {
  return run->peer->outlines != OUTLINES_REFUSED &&
         hsr_is_roster(&run->stage.world);
}

static size_t size_of_ids(const struct run *run) {
  const struct request *r = run->request;
  return (size_t)r->m * (size_t)r->n * sizeof *run->canvas.ids;
}

/* The file of the ids, mapped; NULL if there is none. */
static uint32_t *map_ids(const struct run *run) {
  char path[1100];
  snprintf(path, sizeof path, "%s/ids", run->folder);
  int file = run->folder ? open(path, O_RDWR | O_CLOEXEC) : -1;
  if (file < 0)
    return NULL;
  void *ids =
      mmap(NULL, size_of_ids(run), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  close(file);
  return ids == MAP_FAILED ? NULL : ids;
}

static void free_ids(const struct run *run) {
  if (run->is_mapped)
    munmap(run->canvas.ids, size_of_ids(run));
  else
    free(run->canvas.ids);
}

/* Until they are drawn, the ids are those of no face. */
static enum hsr_status make_canvas(struct run *run, struct hsr_error *err) {
  const struct request *request = run->request;
  uint32_t *mapped = map_ids(run);
  run->is_mapped = mapped;
  run->canvas = (struct peer_canvas){
      .setup = &run->setup,
      .outline = is_drawn_by_objects(run) ? &run->stage.world : NULL,
      .m = request->m,
      .n = request->n,
      .threads = request->threads,
      .ids = mapped ? mapped : malloc(size_of_ids(run))};
  if (!run->canvas.ids)
    return hsr_fail_nomem(err);
  memset(run->canvas.ids, 0xfe, size_of_ids(run));
  return HSR_OK;
}

static enum hsr_status set_up(struct run *run, struct hsr_error *err) {
  const struct hsr_world *world =
      is_drawn_by_objects(run) ? &run->objects : &run->stage.world;
  enum hsr_status status =
      hsr_setup_init(&run->setup, run->peer->demands, NULL, world, err);
  if (!status)
    status = make_canvas(run, err);
  double begin = hsr_seconds_now();
  if (!status)
    status = run->peer->setup(run->peer, &run->canvas, &run->state, err);
  run->prepare_seconds = run->setup.prepare_seconds + hsr_seconds_now() - begin;
  return status;
}

static enum hsr_status
run_peer(const struct peer *peer, const struct request *request,
         const char *folder,
         enum hsr_status (*use)(struct run *run, struct hsr_error *err),
         struct hsr_error *err) {
  if (request->threads > 1 && !peer->many_threads)
    return hsr_fail(err, HSR_E_REFUSED, "%s draws on one thread", peer->name);
  if (request->cameras > 1)
    return hsr_fail(err, HSR_E_REFUSED, "%s draws no walks", peer->name);
  struct run run = {.peer = peer, .request = request, .folder = folder};
  enum hsr_status status =
      stage_open(&run.stage, request->scene,
                 peer->outlines != OUTLINES_ONLY ? HSR_MOST_LAID_OUT : 0,
                 request->view, request->m, request->n, request->threads, err);
  if (!status && is_drawn_by_objects(&run))
    status = lay_out_objects(&run, err);
  if (!status) {
    run.before_kb = memory_kb();
    status = set_up(&run, err);
    if (!status)
      status = use(&run, err);
    peer->release(run.state);
    free_ids(&run);
    hsr_setup_free(&run.setup);
  }
  hsr_world_free(&run.objects);
  free(run.once.instances);
  stage_close(&run.stage);
  return status;
}

/* --- hsr-peers NAME FOLDER, judge, ids ------------------------------------ */

/* Takes what it knows from a line of a job. */
static void read_line(struct request *r, const char *line) {
  sscanf(line, "size %d %d", &r->m, &r->n);
  sscanf(line, "threads %ld", &r->threads);
  sscanf(line, "cameras %ld", &r->cameras);
  sscanf(line, "view %ld", &r->view);
  sscanf(line, "scene %1023[^\n]", r->scene);
}

static enum hsr_status read_job(const char *folder, struct request *r,
                                struct hsr_error *err) {
  char path[1100], line[1100];
  *r = (struct request){.view = 0};
  snprintf(path, sizeof path, "%s/job", folder);
  FILE *file = fopen(path, "re");
  while (file && fgets(line, sizeof line, file))
    read_line(r, line);
  if (file)
    fclose(file);
  return r->m > 0 && r->n > 0 && r->threads > 0 && r->view > 0 && r->scene[0]
             ? HSR_OK
             : hsr_fail(err, HSR_E_INPUT, "%s: no job of a view", path);
}

static enum hsr_status serve_peer(const char *name, const char *folder,
                                  struct hsr_error *err) {
  struct request request;
  const struct peer *peer;
  enum hsr_status status = choose_peer(name, &peer, err);
  if (!status)
    status = read_job(folder, &request, err);
  return status ? status : run_peer(peer, &request, folder, serve_run, err);
}

/* NAME SCENE VIEW WxH. */
static enum hsr_status parse_request(char **argv, struct request *request,
                                     const struct peer **peer,
                                     struct hsr_error *err) {
  *request = (struct request){.threads = 1};
  if (!parse_count(argv[3], 1, 1000, &request->view) ||
      !parse_size(argv[4], &request->m, &request->n))
    return hsr_fail(err, HSR_E_USAGE, "%s: NAME SCENE VIEW WxH", argv[0]);
  snprintf(request->scene, sizeof request->scene, "%s", argv[2]);
  return choose_peer(argv[1], peer, err);
}

static enum hsr_status judge_command(int argc, char **argv,
                                     struct hsr_error *err) {
  struct request request;
  const struct peer *peer;
  if (argc != 5)
    return hsr_fail(err, HSR_E_USAGE, "judge: NAME SCENE VIEW WxH");
  enum hsr_status status = parse_request(argv, &request, &peer, err);
  if (!status && !peer->judge)
    status = hsr_fail(err, HSR_E_USAGE,
                      "judge: what %s draws is judged by its ids", peer->name);
  return status ? status : run_peer(peer, &request, NULL, judge_run, err);
}

static enum hsr_status command_ids(int argc, char **argv,
                                   struct hsr_error *err) {
  struct request request;
  const struct peer *peer;
  if (argc != 6)
    return hsr_fail(err, HSR_E_USAGE, "ids: NAME SCENE VIEW WxH FILE.npy");
  enum hsr_status status = parse_request(argv, &request, &peer, err);
  if (!status && strcmp(peer->kind, "ids") != 0)
    status = hsr_fail(err, HSR_E_USAGE, "ids: %s draws %s", peer->name,
                      strcmp(peer->kind, "none") ? peer->kind : "nothing");
  request.file = argv[5];
  return status ? status : run_peer(peer, &request, NULL, write_run, err);
}

/* --- The program ---------------------------------------------------------- */

static const struct hsr_command commands[] = {{"list", NULL, command_peers},
                                              {"judge", NULL, judge_command},
                                              {"ids", NULL, command_ids},
                                              {NULL, NULL, NULL}};

static enum hsr_status run_command(int argc, char **argv,
                                   struct hsr_error *err) {
  for (const struct hsr_command *c = commands; argc > 1 && c->name; c++)
    if (!strcmp(argv[1], c->name))
      return c->run(argc - 1, argv + 1, err);
  if (argc == 3)
    return serve_peer(argv[1], argv[2], err);
  return hsr_fail(err, HSR_E_USAGE,
                  "hsr-peers: list, or NAME FOLDER, or judge NAME SCENE VIEW "
                  "WxH, or ids NAME SCENE VIEW WxH FILE.npy");
}

/* Makes the process keep the memory that it has once taken. llvmpipe allocates
 * in every frame; otherwise page faults take nearly half of its time. */
static void keep_memory(void) {
  mallopt(M_MMAP_THRESHOLD, 32 << 20);
  mallopt(M_TRIM_THRESHOLD, INT32_MAX);
}

int main(int argc, char **argv) {
  keep_memory();
  end_in_one_line();
  struct hsr_error err = {.text = "unexplained failure"};
  enum hsr_status status = run_command(argc, argv, &err);
  if ((fflush(stdout) || ferror(stdout)) && !status)
    status = hsr_fail(&err, HSR_E_INPUT, "standard output: cannot be written");
  if (status)
    fprintf(stderr, "hsr: %s\n", err.text);
  if (status == HSR_E_NOMEM)
    end_process((int)status);
  return (int)status;
}
