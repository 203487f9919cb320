// SPDX-License-Identifier: GPL-3.0-or-later
// What pieces of divided faces look like.
import { above } from "./run.js";

// Of piece p of a face at event k: its outline, null if that is all of the face or
// not known; its face; the outlines of the pieces that its division made; and the
// line of that.
export const piecesOf = (run) => ({
  outline: (k, p, face) => pieceAt(run, k, p, face)?.at(-1) ?? null,
  pieceFace: (k, p, face) => pieceAt(run, k, p, face)?.[0] ?? null,
  children: (k, p) => childrenOf(run, k, p),
  cut: (k, p, face) => cutOf(childrenOf(run, k, p).filter(Boolean),
    pieceAt(run, k, p, face)?.at(-1) ?? run.header.faces[face][4]),
});

// The list that was at hand at event k.
function listAt(run, k) {
  const { lists } = run.trace;
  run.begins ??= Uint32Array.from(lists, (l) => l.from);
  return lists[above(run.begins, k + 1) - 1] ?? null;
}

// The place of piece p of a face in the list of all pieces of all trees.
export function placeOfPiece(run, p, face) {
  const { bases } = run.trace.structure;
  run.treesBegin ??= Int32Array.from(bases, ([first]) => first);
  return (bases[above(run.treesBegin, face + 1) - 1]?.[1] ?? 0) + p;
}

const pieceAt = (run, k, p, face) => run.trace.structure.pieces
  ? run.trace.structure.pieces[placeOfPiece(run, p, face)]
  : listAt(run, k)?.pieces[p];

function childrenOf(run, k, p) {
  const pieces = listAt(run, k)?.pieces ?? [];
  return pieces.filter(([, parent]) => parent === p).map((piece) => piece.at(-1));
}

// Two points on the line along which a piece was divided, beyond its ends: the line
// through the corners that the halves have in common, or, of a single half, that
// the piece did not have. null: not known.
function cutOf([half, other], whole) {
  if (!half) return null;
  const isOf = (points, [x, y]) =>
    points.some(([u, v]) => Math.hypot(x - u, y - v) < 0.1);
  const ends = half.filter((p) => other ? isOf(other, p) : !isOf(whole, p));
  const [p, q] = [ends[0], ends.at(-1)];
  if (!p || p === q) return null;
  const beyond = (from, to) => to.map((x, c) => x + 0.7 * (x - from[c]));
  return [beyond(q, p), beyond(p, q)];
}
