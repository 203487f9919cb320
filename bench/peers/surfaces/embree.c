/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Embree: one ray for each sample, alone or in coherent packets of sixteen.
 *
 * Packets     4 x 4 samples. On our meshes these take the least time of
 *             all shapes tried; 16 x 1 takes a third more. A build of high
 *             quality changes nothing.
 * Robust      RTC_SCENE_FLAG_ROBUST: tests of boxes and triangles that are meant
 *             to let no ray through a shared edge.
 * Sides       Rays hit both sides of every face. If a closed solid lies in
 *             front of the eye, no ray meets a back first. In parallel
 *             projection rays begin on a plane, which may cut solids all over
 *             the picture. If it cuts the scene, a filter lets rays pass the
 *             backs of one-sided faces, which takes time.
 * Outlines    Embree's two levels: a hierarchy of boxes for each object, and
 *             one of the instances.
 * Threads     OpenMP's; each takes a band of rows at a time. */
#include "bench/peers/shared/peers.h"
#include "bench/peers/shared/projection.h"
#include "bench/peers/surfaces/embree_query.h"

#include "common/base/vector.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifdef __SSE2__
#include <immintrin.h>
#endif

enum { SIDE = 4, LANES = SIDE * SIDE };

struct embree {
  RTCDevice device;
  RTCScene scene;
  bool packets, robust;
  int threads;
  const struct hsr_world *triangles, *outline; /* as in peer_canvas */
  uint32_t *ids;
};

struct flavour {
  bool packets, robust;
};

/* A scene, or one of its objects: each becomes a geometry. */
struct part {
  uint32_t first_vertex, n_vertices;
  uint32_t first_face, n_faces;
};

static enum hsr_status embree_fail(const struct embree *embree,
                                   const char *what, struct hsr_error *err) {
  enum RTCError code = rtcGetDeviceError(embree->device);
  if (code == RTC_ERROR_OUT_OF_MEMORY)
    return hsr_fail_nomem(err);
  return hsr_fail(err, HSR_E_INTERNAL, "embree: %s failed, error %d", what,
                  (int)code);
}

static enum hsr_status fill_geometry(const struct embree *embree,
                                     RTCGeometry geometry,
                                     const struct part *part,
                                     struct hsr_error *err) {
  const struct hsr_world *world = embree->triangles;
  float *xyz = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                       RTC_FORMAT_FLOAT3, 3 * sizeof *xyz,
                                       part->n_vertices);
  uint32_t *corner = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0,
                                             RTC_FORMAT_UINT3,
                                             3 * sizeof *corner, part->n_faces);
  if (!xyz || !corner)
    return embree_fail(embree, "making buffers", err);
  for (size_t k = 0; k < part->n_vertices; k++) {
    size_t v = part->first_vertex + k;
    xyz[3 * k] = (float)world->mesh.x[v];
    xyz[3 * k + 1] = (float)world->mesh.y[v];
    xyz[3 * k + 2] = (float)world->mesh.z[v];
  }
  const uint32_t *vertex =
      world->mesh.vertex + world->mesh.start[part->first_face];
  for (size_t c = 0; c < 3 * (size_t)part->n_faces; c++)
    corner[c] = vertex[c] - part->first_vertex;
  return HSR_OK;
}

static enum hsr_status attach_triangles(const struct embree *embree,
                                        const struct part *part, RTCScene scene,
                                        struct hsr_error *err) {
  RTCGeometry geometry =
      rtcNewGeometry(embree->device, RTC_GEOMETRY_TYPE_TRIANGLE);
  if (!geometry)
    return embree_fail(embree, "making triangles", err);
  enum hsr_status status = fill_geometry(embree, geometry, part, err);
  if (!status) {
    rtcSetGeometryUserData(geometry, embree->triangles->mesh.one_sided +
                                         part->first_face);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
  }
  rtcReleaseGeometry(geometry);
  return status;
}

/* Makes an empty scene, whose hits a filter may refuse; NULL if that fails. */
static RTCScene make_scene(const struct embree *embree) {
  RTCScene scene = rtcNewScene(embree->device);
  if (scene)
    rtcSetSceneFlags(scene, EMBREE_FILTERED |
                                (embree->robust ? RTC_SCENE_FLAG_ROBUST : 0));
  return scene;
}

/* Builds the hierarchy of triangles. The caller releases *scene, which may be
 * NULL. */
static enum hsr_status build_part(const struct embree *embree,
                                  const struct part *part, RTCScene *scene,
                                  struct hsr_error *err) {
  *scene = make_scene(embree);
  if (!*scene)
    return embree_fail(embree, "making a scene", err);
  enum hsr_status status = HSR_OK;
  if (part->n_faces)
    status = attach_triangles(embree, part, *scene, err);
  if (!status)
    rtcCommitScene(*scene);
  return status;
}

static enum hsr_status build_objects(const struct embree *embree,
                                     RTCScene *object, struct hsr_error *err) {
  const struct hsr_scene *scene = embree->outline->roster.scene;
  const uint32_t *first = embree->triangles->roster.first;
  uint32_t first_vertex = 0;
  enum hsr_status status = HSR_OK;
  for (uint32_t o = 0; o < scene->n_objects && !status; o++) {
    struct part part = {.first_vertex = first_vertex,
                        .n_vertices = scene->objects[o].n_vertices,
                        .first_face = first[o],
                        .n_faces = first[o + 1] - first[o]};
    first_vertex += part.n_vertices;
    status = build_part(embree, &part, &object[o], err);
  }
  return status;
}

/* Builds the hierarchy of instances. A hit names an instance by its number. */
static enum hsr_status place_objects(struct embree *embree,
                                     const RTCScene *object,
                                     struct hsr_error *err) {
  const struct hsr_scene *scene = embree->outline->roster.scene;
  embree->scene = make_scene(embree);
  if (!embree->scene)
    return embree_fail(embree, "making a scene", err);
  for (uint32_t i = 0; i < scene->n_instances; i++) {
    const struct hsr_instance *instance = &scene->instances[i];
    RTCGeometry geometry =
        rtcNewGeometry(embree->device, RTC_GEOMETRY_TYPE_INSTANCE);
    if (!geometry)
      return embree_fail(embree, "making an instance", err);
    float m[12];
    for (int k = 0; k < 12; k++)
      m[k] = (float)instance->m[k];
    rtcSetGeometryInstancedScene(geometry, object[instance->object]);
    rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT3X4_ROW_MAJOR, m);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(embree->scene, geometry, i);
    rtcReleaseGeometry(geometry);
  }
  rtcCommitScene(embree->scene);
  return HSR_OK;
}

/* Instances keep the scenes of their objects. */
static enum hsr_status build_levels(struct embree *embree,
                                    struct hsr_error *err) {
  uint32_t n = embree->outline->roster.scene->n_objects;
  RTCScene *object = calloc(n, sizeof *object);
  if (!object)
    return hsr_fail_nomem(err);
  enum hsr_status status = build_objects(embree, object, err);
  if (!status)
    status = place_objects(embree, object, err);
  for (uint32_t o = 0; o < n; o++)
    if (object[o])
      rtcReleaseScene(object[o]);
  free(object);
  return status;
}

static enum hsr_status build(struct embree *embree, struct hsr_error *err) {
  struct part all = {.n_vertices = embree->triangles->mesh.n_vertices,
                     .n_faces = embree->triangles->n_faces};
  enum hsr_status status = embree->outline
                               ? build_levels(embree, err)
                               : build_part(embree, &all, &embree->scene, err);
  if (!status && rtcGetDeviceError(embree->device) != RTC_ERROR_NONE)
    status = hsr_fail(err, HSR_E_INTERNAL, "embree: the build failed");
  return status;
}

static enum hsr_status embree_setup(const struct peer *peer,
                                    const struct peer_canvas *canvas,
                                    void **state, struct hsr_error *err) {
  struct embree *embree = calloc(1, sizeof *embree);
  *state = embree;
  if (!embree)
    return hsr_fail_nomem(err);
  const struct flavour *flavour = peer->flavour;
  embree->packets = flavour->packets;
  embree->robust = flavour->robust;
  embree->threads = (int)canvas->threads;
  embree->triangles = canvas->setup->world;
  embree->outline = canvas->outline;
  embree->ids = canvas->ids;
  char config[32];
  snprintf(config, sizeof config, "threads=%d", embree->threads);
  embree->device = rtcNewDevice(config);
  if (!embree->device)
    return embree_fail(embree, "making a device", err);
  return build(embree, err);
}

/* --- Backs ---------------------------------------------------------------- */

/* Embree hands over the fields of n rays, and then of n hits, as arrays of n,
 * one after the other. It names the places only in C++. They are the same in
 * versions 3 and 4. */
enum { RAY_DIRECTION = 4, HIT_NORMAL = 0, HIT_TRIANGLE = 5 };

/* Refuses hits on the backs of one-sided faces. */
static void pass_backs(const struct RTCFilterFunctionNArguments *found) {
  const bool *one_sided = found->geometryUserPtr;
  size_t n = found->N;
  const float *direction = (const float *)(const void *)found->ray;
  const float *normal = (const float *)(const void *)found->hit;
  const uint32_t *triangle = (const uint32_t *)(const void *)found->hit;
  direction += RAY_DIRECTION * n;
  normal += HIT_NORMAL * n;
  triangle += HIT_TRIANGLE * n;
  for (size_t k = 0; k < n; k++) {
    if (!found->valid[k] || !one_sided[triangle[k]])
      continue;
    float along = 0;
    for (size_t axis = 0; axis < 3; axis++)
      along += normal[axis * n + k] * direction[axis * n + k];
    if (along > 0)
      found->valid[k] = 0;
  }
}

/* Whether parallel rays begin behind the nearest part of the scene's box. */
static bool begins_within(const struct embree *embree,
                          const struct hsr_view *view) {
  if (!view->parallel)
    return false;
  struct RTCBounds of;
  rtcGetSceneBounds(embree->scene, &of);
  const struct box box = {{of.lower_x, of.lower_y, of.lower_z},
                          {of.upper_x, of.upper_y, of.upper_z}};
  return box_nearest(&box, view) < view->near;
}

/* --- What is hit ---------------------------------------------------------- */

/* The face of the scene to which triangle k of an instance belongs. */
static uint32_t name_in_instance(const struct embree *embree, uint32_t k,
                                 uint32_t instance) {
  const struct hsr_world *triangles = embree->triangles;
  const struct hsr_world *faces =
      triangles->pieces ? triangles->pieces->whole : triangles;
  uint32_t object = embree->outline->roster.scene->instances[instance].object;
  uint32_t face =
      hsr_world_parent(triangles, triangles->roster.first[object] + k);
  return embree->outline->roster.first[instance] +
         (face - faces->roster.first[object]);
}

/* The face for Embree's numbers of a hit. The triangle's number is still
 * HSR_BACKGROUND if nothing was hit. */
static uint32_t name_hit(const struct embree *embree, uint32_t triangle,
                         uint32_t instance) {
  if (triangle == HSR_BACKGROUND)
    return HSR_BACKGROUND;
  return embree->outline ? name_in_instance(embree, triangle, instance)
                         : hsr_world_parent(embree->triangles, triangle);
}

/* --- Single rays ---------------------------------------------------------- */

static uint32_t trace_ray(const struct embree *embree, embree_query *query,
                          const struct hsr_view *view, int x, int y) {
  double sx = hsr_sample_x(view, x), sy = hsr_sample_y(view, y), P[3], D[3];
  for (int k = 0; k < 3; k++) {
    double across =
        view->ray[0][k] + sx * view->ray[1][k] + sy * view->ray[2][k];
    P[k] = view->parallel ? view->E[k] + across : view->E[k];
    D[k] = view->parallel ? view->F[k] : across;
  }
  struct RTCRayHit one = {
      .ray = {.org_x = (float)P[0],
              .org_y = (float)P[1],
              .org_z = (float)P[2],
              .tnear = (float)view->near,
              .dir_x = (float)D[0],
              .dir_y = (float)D[1],
              .dir_z = (float)D[2],
              .tfar = INFINITY,
              .mask = UINT32_MAX},
      .hit = {.geomID = RTC_INVALID_GEOMETRY_ID, .primID = HSR_BACKGROUND}};
  embree_one(embree->scene, query, &one);
  return name_hit(embree, one.hit.primID, one.hit.instID[0]);
}

/* --- Packets -------------------------------------------------------------- */

/* The rays of the packet whose first sample is (x, y). */
HSR_VECTOR static void aim_parallel(struct RTCRayHit16 *packet,
                                    const struct hsr_view *view, int x, int y) {
  double left = hsr_sample_x(view, x), top = hsr_sample_y(view, y);
  const double *E = view->E, *F = view->F;
  for (int k = 0; k < LANES; k++) {
    double sx = left + k % SIDE, sy = top + k / SIDE;
    packet->ray.org_x[k] =
        (float)(E[0] + (view->ray[0][0] + sx * view->ray[1][0] +
                        sy * view->ray[2][0]));
    packet->ray.org_y[k] =
        (float)(E[1] + (view->ray[0][1] + sx * view->ray[1][1] +
                        sy * view->ray[2][1]));
    packet->ray.org_z[k] =
        (float)(E[2] + (view->ray[0][2] + sx * view->ray[1][2] +
                        sy * view->ray[2][2]));
    packet->ray.dir_x[k] = (float)F[0];
    packet->ray.dir_y[k] = (float)F[1];
    packet->ray.dir_z[k] = (float)F[2];
    packet->ray.tfar[k] = INFINITY;
    packet->hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
    packet->hit.primID[k] = HSR_BACKGROUND;
  }
}

HSR_VECTOR static void aim(struct RTCRayHit16 *packet,
                           const struct hsr_view *view, int x, int y) {
  double left = hsr_sample_x(view, x), top = hsr_sample_y(view, y);
  for (int k = 0; k < LANES; k++) {
    double sx = left + k % SIDE, sy = top + k / SIDE;
    packet->ray.dir_x[k] =
        (float)(view->ray[0][0] + sx * view->ray[1][0] + sy * view->ray[2][0]);
    packet->ray.dir_y[k] =
        (float)(view->ray[0][1] + sx * view->ray[1][1] + sy * view->ray[2][1]);
    packet->ray.dir_z[k] =
        (float)(view->ray[0][2] + sx * view->ray[1][2] + sy * view->ray[2][2]);
    packet->ray.tfar[k] = INFINITY;
    packet->hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
    packet->hit.primID[k] = HSR_BACKGROUND; /* kept if nothing is hit */
  }
}

/* Sets what all rays have in common. Embree does not change it. */
static void start_from_eye(struct RTCRayHit16 *packet,
                           const struct hsr_view *view) {
  memset(packet, 0, sizeof *packet);
  for (int k = 0; k < LANES; k++) {
    packet->ray.org_x[k] = (float)view->E[0];
    packet->ray.org_y[k] = (float)view->E[1];
    packet->ray.org_z[k] = (float)view->E[2];
    packet->ray.tnear[k] = (float)view->near;
    packet->ray.mask[k] = UINT32_MAX;
  }
}

static void trace_packet(const struct embree *embree, embree_query *query,
                         struct RTCRayHit16 *packet,
                         const struct hsr_view *view, int x, int y) {
  _Alignas(64) int valid[LANES];
  int width = view->m - x < SIDE ? view->m - x : SIDE;
  int height = view->n - y < SIDE ? view->n - y : SIDE;
  for (int k = 0; k < LANES; k++)
    valid[k] = k % SIDE < width && k / SIDE < height ? -1 : 0;
  (view->parallel ? aim_parallel : aim)(packet, view, x, y);
  embree_sixteen(valid, embree->scene, query, packet);
  for (int k = 0; k < height; k++)
    for (int i = 0; i < width; i++)
      embree->ids[(size_t)(y + k) * (size_t)view->m + (size_t)(x + i)] =
          name_hit(embree, packet->hit.primID[SIDE * k + i],
                   packet->hit.instID[0][SIDE * k + i]);
}

/* --- A frame -------------------------------------------------------------- */

/* Traces those of the rows [y, y + SIDE) that are in the picture. `filter` may
 * be NULL. */
static void trace_band(const struct embree *embree, const struct hsr_view *view,
                       RTCFilterFunctionN filter, int y) {
  embree_query query;
  embree_query_init(&query, filter);
  if (embree->packets) {
    struct RTCRayHit16 packet;
    start_from_eye(&packet, view);
    for (int x = 0; x < view->m; x += SIDE)
      trace_packet(embree, &query, &packet, view, x, y);
    return;
  }
  for (int j = y; j < y + SIDE && j < view->n; j++)
    for (int i = 0; i < view->m; i++)
      embree->ids[(size_t)j * (size_t)view->m + (size_t)i] =
          trace_ray(embree, &query, view, i, j);
}

/* The same with denormals taken as zero, as Embree's manual advises. */
static void trace_band_fast(const struct embree *embree,
                            const struct hsr_view *view,
                            RTCFilterFunctionN filter, int y) {
#ifdef __SSE2__
  unsigned mode = _mm_getcsr();
  _mm_setcsr(mode | 0x8040);
#endif
  trace_band(embree, view, filter, y);
#ifdef __SSE2__
  _mm_setcsr(mode);
#endif
}

static enum hsr_status embree_draw(void *state, const struct hsr_view *view,
                                   struct hsr_error *err) {
  struct embree *embree = state;
  RTCFilterFunctionN filter = begins_within(embree, view) ? pass_backs : NULL;
#ifdef _OPENMP
#pragma omp parallel for schedule(dynamic) num_threads(embree->threads)
#endif
  for (int y = 0; y < view->n; y += SIDE)
    trace_band_fast(embree, view, filter, y);
  return rtcGetDeviceError(embree->device) == RTC_ERROR_NONE
             ? HSR_OK
             : hsr_fail(err, HSR_E_INTERNAL, "embree: tracing failed");
}

static void embree_release(void *state) {
  struct embree *embree = state;
  if (!embree)
    return;
  if (embree->scene)
    rtcReleaseScene(embree->scene);
  if (embree->device)
    rtcReleaseDevice(embree->device);
  free(embree);
}

/* --- The peers ------------------------------------------------------------ */

static void embree_version(char *text) {
  RTCDevice device = rtcNewDevice("threads=1");
  if (!device)
    return;
  snprintf(
      text, PEER_VERSION, "%d.%d.%d",
      (int)rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_VERSION_MAJOR),
      (int)rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_VERSION_MINOR),
      (int)rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_VERSION_PATCH));
  rtcReleaseDevice(device);
}

#ifdef _OPENMP
#define MANY_THREADS true
#else
#define MANY_THREADS false
#endif

static const struct flavour singly = {false, false}, in_packets = {true, false},
                            robust = {false, true},
                            robust_packets = {true, true};

#define EMBREE(name_, title_, flavour_, outlines_, what_)                      \
  {                                                                            \
    .name = name_, .title = title_,                                            \
    .source = "I. Wald, S. Woop, C. Benthin, G. S. Johnson and M. Ernst, "     \
              "\"Embree: A Kernel Framework for Efficient CPU Ray Tracing\", " \
              "ACM Transactions on Graphics 33(4), 2014",                      \
    .what = what_                                                              \
        " A frame aims and traces a ray a sample and writes the ids. Set-up, " \
        "which is not part of a frame, copies the vertices as floats and "     \
        "builds the hierarchy of boxes.",                                      \
    .kind = "ids", .many_threads = MANY_THREADS, .flavour = flavour_,          \
    .demands = &takes_triangles, .outlines = outlines_,                        \
    .version = embree_version, .setup = embree_setup, .draw = embree_draw,     \
    .release = embree_release                                                  \
  }
const struct peer peer_embree =
    EMBREE("embree", "Embree, single rays", &singly, OUTLINES_TAKEN,
           "Ray tracing, one ray at a time.");
const struct peer peer_embree_packets = EMBREE(
    "embree-packets", "Embree, packets of 16 rays", &in_packets, OUTLINES_TAKEN,
    "Ray tracing, sixteen rays of 4 x 4 samples at a time.");
const struct peer peer_embree_instances =
    EMBREE("embree-instances", "Embree, packets of 16 rays, on two levels",
           &in_packets, OUTLINES_ONLY,
           "As embree-packets, with a hierarchy of boxes for each object and "
           "one of the instances, whose faces are never laid out.");
const struct peer peer_embree_robust = EMBREE(
    "embree-robust", "Embree, single rays, robust", &robust, OUTLINES_TAKEN,
    "As embree, in Embree's robust mode (RTC_SCENE_FLAG_ROBUST).");
const struct peer peer_embree_robust_packets =
    EMBREE("embree-robust-packets", "Embree, packets of 16 rays, robust",
           &robust_packets, OUTLINES_TAKEN,
           "As embree-packets, in Embree's robust mode "
           "(RTC_SCENE_FLAG_ROBUST).");
