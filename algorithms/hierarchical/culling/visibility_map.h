/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A visibility map: a two-dimensional BSP tree of the picture, whose lines are
 * the sides of what is visible.
 *
 * Source      B. Naylor, "Partitioning Tree Image Representation and Generation
 *             from 3D Geometric Models", Graphics Interface 1992; as told by N.
 *             Greene, PhD thesis, UC Santa Cruz, 1995, 2.1.6.
 * Region      The part of the picture that belongs to a node: what the lines
 *             above it leave. A leaf's region shows one face, or is vacant.
 * Line        A side of a piece on the screen (bsp_frame.h). It parts the
 *             samples exactly: hsr_bsp_frame_inside decides on which side a
 *             sample is.
 * Outline     Approximate points, in homogeneous coordinates of the screen,
 *             whose hull holds a region, or what of a piece is in a region.
 *             They show where a piece need not be inserted. If they leave it
 *             open, the piece is inserted on both sides of a line: the tree
 *             becomes larger, the picture is the same.
 * Departures  A part of a piece is inserted on a side of a line only if it may
 *             hold a sample there: the map is as exact as the samples need.
 * Invariants  The face that a leaf shows is in front of all that is inserted
 *             later. A leaf gets a face only if all sides of the face's piece
 *             are lines above it.
 * Asked       Some pieces are not bounded by lines: those of a face that is not
 *             flat, or that the near plane may cut; and those with a side whose
 *             line is not known well enough to part the picture, since it would
 *             divide region after region. A leaf keeps a list of such pieces,
 *             the first in front. Their samples are asked about one by one.
 *
 * Outlines. An outline is a rectangle of samples, clipped by lines. As in
 * order.c, its points start with an error of 2^-44 S, S being the size of the
 * largest, and each cut adds less than 2^-50 S. A line through two vertices is
 * the cross product of their images, which have a relative error of some
 * roundings of their terms. A side that a plane cuts is the line where q of
 * both planes is the same: the difference of their depth planes. The margin of
 * a line is above the error of its value at a point: of both, the point and the
 * line. hsr_clip keeps what is within the margin. So if nothing is left on one
 * side, nothing of the region is there.
 */
#ifndef HSR_ALGORITHMS_VISIBILITY_MAP_H
#define HSR_ALGORITHMS_VISIBILITY_MAP_H

#include "algorithms/engines/bsp/bsp_frame.h"

/* The part, besides hsr_bsp_part, and its counters. */
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
  struct hsr_growing waiting; /* a stack: parts of a piece to be inserted */
  struct hsr_growing spots;   /* a stack: rectangles of samples to be tested */
  double (*points)[3];        /* of the outlines of these parts */
  size_t n_points, room;
  struct hsr_bsp_side *side; /* of the piece that is being inserted */
  bool out_of_memory;
};

/* Makes an empty map of a frame's window. The frame is borrowed as long as
 * *map; memory is taken from the job's scratch. HSR_E_NOMEM. */
enum hsr_status hsr_map_begin(struct hsr_map *map, struct hsr_bsp_frame *frame);

/* Inserts a piece behind all that has been inserted before. `piece` is what
 * hsr_bsp_frame_piece made of `given`; its cuts are copied. facing: the side of
 * its face on which the eye is, +1 in front, -1 behind. Sets map->out_of_memory
 * if memory runs out. */
void hsr_map_insert(struct hsr_map *map, const struct hsr_bsp_piece *given,
                    const struct hsr_piece *piece, int facing);

/* Are all samples of a rectangle certainly hidden from what is inserted next?
 * So they are if they lie in one region that shows a face, or if `several`, in
 * several such regions. `subject`, for the steps, is what the rectangle is
 * around. */
bool hsr_map_hides(struct hsr_map *map, const struct hsr_bounds *bounds,
                   bool several, struct hsr_subject subject);

/* Writes the faces that the map shows to the job's ids. */
void hsr_map_show(struct hsr_map *map);

#endif
