/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A visibility map: a two-dimensional BSP tree of the picture, whose lines are
 * the sides of what is visible.
 *
 * Source      B. Naylor, "Partitioning Tree Image Representation and Generation
 *             from 3D Geometric Models", Graphics Interface 1992; as told by N.
 *             Greene, PhD thesis, UC Santa Cruz, 1995, 2.1.6.
 * Region      what is left of the picture on the way down to a node. A leaf's
 *             region shows one face, or is vacant.
 * Line        a side of a piece, as it is on the screen (bsp_frame.h). It
 *             parts the samples exactly: hsr_bsp_frame_inside tells on which
 *             side of it a sample is.
 * Outline     approximate points, homogeneous on the screen, whose hull holds a
 *             region, or what a piece has in one. They tell where a piece need
 *             not be inserted. Where they cannot tell, it is inserted on both
 *             sides of a line: that makes a larger tree and the same picture.
 * Departures  A part of a piece goes to a side of a line only if it may hold a
 *             sample there: the map is as exact as the samples need.
 * Invariants  the face that a leaf shows is in front of all that is inserted
 *             later. A leaf is given a face only below lines that bound its
 *             piece.
 * Asked       what a face covers that is not flat, or that near may cut, is not
 *             bounded by lines. Nor are pieces with a side whose line is not
 *             known well enough to part the picture: such lines would divide
 *             every region, again and again. Leaves keep lists of these pieces,
 *             the first in front; their samples are asked one by one.
 *
 * Outlines. An outline is a rectangle of samples, clipped by lines. As in
 * order.c, its points start with an error of 2^-44 S, S being the size of the
 * largest, and each cut adds less than 2^-50 S. A line through two vertices is
 * the cross product of their images, which have a relative error of some
 * roundings of their terms. A side that a plane cuts is the line where q of both
 * planes is the same: the difference of their depth planes. The margin of a line
 * is above the error of its value at a point: of both, the point and the line.
 * hsr_clip keeps what is within the margin. So if nothing is left on one side,
 * nothing of the region is there.
 */
#ifndef HSR_ALGORITHMS_VISIBILITY_MAP_H
#define HSR_ALGORITHMS_VISIBILITY_MAP_H

#include "algorithms/engines/bsp/bsp_frame.h"

/* What the map counts, besides what bsp_frame.h does. */
extern const struct hsr_part hsr_map_part;
enum {
  HSR_MAP_LINES = HSR_FIRST_OF(HSR_PART_MAP),
  HSR_MAP_HIDDEN,
  HSR_MAP_DIVISIONS,
  HSR_MAP_FILLED,
  HSR_MAP_BOXES,
  HSR_MAP_REGIONS,
  HSR_MAP_ASKED
};

struct hsr_map {
  struct hsr_bsp_frame *frame;
  struct hsr_arena *arena;
  struct hsr_growing node;    /* struct map_node; the first is the root */
  struct hsr_growing waiting; /* parts of a piece, the last first */
  struct hsr_growing spots;   /* rectangles of samples, the last first */
  double (*points)[3];        /* of outlines that wait */
  size_t n_points, room;
  struct hsr_bsp_side *side; /* of the piece at hand */
  bool out_of_memory;
};

/* An empty map of a frame's window. HSR_E_NOMEM. */
enum hsr_status hsr_map_begin(struct hsr_map *map, struct hsr_bsp_frame *frame);

/* Inserts a piece, behind all that has been inserted. `piece` is what
 * hsr_bsp_frame_piece made of `given`; its cuts are copied. */
void hsr_map_insert(struct hsr_map *map, const struct hsr_bsp_piece *given,
                    const struct hsr_piece *piece, int facing);

/* Whether all samples of a rectangle are hidden: they are in one region that
 * shows a face or, if `several`, all in such regions. `subject` is what it is
 * around. */
bool hsr_map_hides(struct hsr_map *map, const struct hsr_bounds *bounds,
                   bool several, struct hsr_subject subject);

/* Writes what the map shows to the job's ids. */
void hsr_map_show(struct hsr_map *map);

#endif
