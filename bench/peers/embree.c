/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Embree: a ray a sample, in coherent packets of sixteen.
 *
 * Measured on the meshes at hand, packets of 4 x 4 samples take the least
 * time, 16 x 1 a third more, and a build of high quality changes nothing. */
#include "bench/peers/peers.h"

#include "common/vector.h"

#include <embree3/rtcore.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#ifdef __SSE2__
#include <immintrin.h>
#endif

enum { SIDE = 4, LANES = SIDE * SIDE };

struct embree {
  RTCDevice device;
  RTCScene scene;
  uint32_t *ids;
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
                                     const struct hsr_world *world,
                                     struct hsr_error *err) {
  float *xyz = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                       RTC_FORMAT_FLOAT3, 3 * sizeof *xyz,
                                       world->n_vertices);
  uint32_t *corner = rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof *corner,
      world->n_faces);
  if (!xyz || !corner)
    return embree_fail(embree, "making buffers", err);
  for (size_t v = 0; v < world->n_vertices; v++) {
    xyz[3 * v] = (float)world->x[v];
    xyz[3 * v + 1] = (float)world->y[v];
    xyz[3 * v + 2] = (float)world->z[v];
  }
  memcpy(corner, world->vertex, (size_t)world->n_corners * sizeof *corner);
  return HSR_OK;
}

static enum hsr_status build(struct embree *embree,
                             const struct hsr_world *world,
                             struct hsr_error *err) {
  embree->scene = rtcNewScene(embree->device);
  RTCGeometry geometry =
      rtcNewGeometry(embree->device, RTC_GEOMETRY_TYPE_TRIANGLE);
  if (!embree->scene || !geometry)
    return embree_fail(embree, "making a scene", err);
  rtcSetSceneFlags(embree->scene, RTC_SCENE_FLAG_NONE);
  enum hsr_status status = fill_geometry(embree, geometry, world, err);
  if (!status) {
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(embree->scene, geometry);
    rtcCommitScene(embree->scene);
  }
  rtcReleaseGeometry(geometry);
  if (!status && rtcGetDeviceError(embree->device) != RTC_ERROR_NONE)
    status = hsr_fail(err, HSR_E_INTERNAL, "embree: the build failed");
  return status;
}

static enum hsr_status embree_setup(const struct peer *peer,
                                    const struct hsr_world *world, int m, int n,
                                    uint32_t *ids, void **state,
                                    struct hsr_error *err) {
  (void)peer, (void)m, (void)n;
  struct embree *embree = calloc(1, sizeof *embree);
  *state = embree;
  if (!embree)
    return hsr_fail_nomem(err);
  embree->ids = ids;
  embree->device = rtcNewDevice("threads=1");
  if (!embree->device)
    return embree_fail(embree, "making a device", err);
  return build(embree, world, err);
}

/* The rays of the packet whose first sample is (x, y). */
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
    packet->hit.primID[k] = HSR_BACKGROUND; /* stays if nothing is hit */
  }
}

/* What all rays have in common; Embree does not write it. */
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

static void trace_packet(const struct embree *embree,
                         struct RTCIntersectContext *context,
                         struct RTCRayHit16 *packet,
                         const struct hsr_view *view, int x, int y) {
  _Alignas(64) int valid[LANES];
  int width = view->m - x < SIDE ? view->m - x : SIDE;
  int height = view->n - y < SIDE ? view->n - y : SIDE;
  for (int k = 0; k < LANES; k++)
    valid[k] = k % SIDE < width && k / SIDE < height ? -1 : 0;
  aim(packet, view, x, y);
  rtcIntersect16(valid, embree->scene, context, packet);
  for (int k = 0; k < height; k++)
    memcpy(embree->ids + (size_t)(y + k) * (size_t)view->m + (size_t)x,
           packet->hit.primID + SIDE * k, (size_t)width * sizeof *embree->ids);
}

static enum hsr_status embree_draw(void *state, const struct hsr_view *view,
                                   struct hsr_error *err) {
  struct embree *embree = state;
  struct RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  struct RTCRayHit16 packet;
  start_from_eye(&packet, view);
#ifdef __SSE2__
  /* Denormals to zero, as Embree's manual advises. */
  unsigned mode = _mm_getcsr();
  _mm_setcsr(mode | 0x8040);
#endif
  for (int y = 0; y < view->n; y += SIDE)
    for (int x = 0; x < view->m; x += SIDE)
      trace_packet(embree, &context, &packet, view, x, y);
#ifdef __SSE2__
  _mm_setcsr(mode);
#endif
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

const struct peer peer_embree = {.name = "embree",
                                 .draws = true,
                                 .setup = embree_setup,
                                 .draw = embree_draw,
                                 .release = embree_release};
