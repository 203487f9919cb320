/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A ray put to Embree: version 3 takes a context, version 4 takes arguments. */
#ifndef HSR_BENCH_PEERS_SURFACES_EMBREE_QUERY_H
#define HSR_BENCH_PEERS_SURFACES_EMBREE_QUERY_H

#include "config.h"

#if HSR_EMBREE == 4

#include <embree4/rtcore.h>

typedef struct RTCIntersectArguments embree_query;

/* The flag of a scene whose hits a query's filter may refuse. */
#define EMBREE_FILTERED RTC_SCENE_FLAG_FILTER_FUNCTION_IN_ARGUMENTS

/* A query for rays that run side by side. The filter may be NULL. */
static inline void embree_query_init(embree_query *query,
                                     RTCFilterFunctionN filter) {
  rtcInitIntersectArguments(query);
  query->flags = (enum RTCRayQueryFlags)(
      RTC_RAY_QUERY_FLAG_COHERENT |
      (filter ? RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER : 0));
  query->filter = filter;
}

static inline void embree_one(RTCScene scene, embree_query *query,
                              struct RTCRayHit *ray) {
  rtcIntersect1(scene, ray, query);
}

static inline void embree_sixteen(const int *valid, RTCScene scene,
                                  embree_query *query,
                                  struct RTCRayHit16 *packet) {
  rtcIntersect16(valid, scene, packet, query);
}

#else

#include <embree3/rtcore.h>

typedef struct RTCIntersectContext embree_query;

#define EMBREE_FILTERED RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION

static inline void embree_query_init(embree_query *query,
                                     RTCFilterFunctionN filter) {
  rtcInitIntersectContext(query);
  query->flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  query->filter = filter;
}

static inline void embree_one(RTCScene scene, embree_query *query,
                              struct RTCRayHit *ray) {
  rtcIntersect1(scene, query, ray);
}

static inline void embree_sixteen(const int *valid, RTCScene scene,
                                  embree_query *query,
                                  struct RTCRayHit16 *packet) {
  rtcIntersect16(valid, scene, query, packet);
}

#endif

#endif
