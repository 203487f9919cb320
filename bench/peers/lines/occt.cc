/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Open CASCADE's hidden-line removal: exact, on the boundary representation,
 * and polygonal, on its triangulation.
 *
 * Input       Faces that exist, each on its plane, as a compound without
 *             shells. They share vertices and edges as the world's faces do.
 *             So both algorithms take all of them for two-sided, as they are
 *             then.
 * Exact       HLRBRep_Algo, in Open CASCADE's own perspective.
 * Polygonal   HLRBRep_PolyAlgo has no perspective. So it gets the scene after
 *             the perspective transform: pixels, and a depth linear on the
 *             screen. Then BRepMesh_IncrementalMesh divides the faces.
 * Edges       Of the exact algorithm, VCompound and HCompound are taken in
 *             space (CompoundOfEdges). Each part in them lies on the line
 *             object of its edge, which names it; its range, over the edge's
 *             length, is t. The polygonal algorithm tells the edge, and parts
 *             of it on the screen; weights of perspective turn these into t.
 * Clipping    neither algorithm clips. So faces are cut, by us, at the plane
 *             that is nearest to the eye. */
#include "bench/peers/lines/clipped.h"
#include "bench/peers/lines/lines.h"
#include "bench/peers/shared/peers.h"
#include "common/answers/kinds/segments.h"

#include <BRepMesh_IncrementalMesh.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Geom_Line.hxx>
#include <Geom_Plane.hxx>
#include <HLRAlgo_EdgeIterator.hxx>
#include <HLRAlgo_EdgeStatus.hxx>
#include <HLRAlgo_Projector.hxx>
#include <HLRBRep_Algo.hxx>
#include <HLRBRep_HLRToShape.hxx>
#include <HLRBRep_PolyAlgo.hxx>
#include <Precision.hxx>
#include <Standard_Failure.hxx>
#include <Standard_Version.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_DataMapOfShapeInteger.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Vertex.hxx>
#include <TopoDS_Wire.hxx>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <new>
#include <unordered_map>
#include <vector>

namespace {

/* A side of a face, or what lies of it beyond the nearest plane. */
struct Line {
  TopoDS_Edge shape;   /* null if it has no length */
  uint32_t corner[2];  /* from, to */
  uint32_t edge;       /* UINT32_MAX: none of the world's */
  double t[2], length; /* of `from` and `to` on that edge; in Open CASCADE */
};

/* The scene as Open CASCADE has it, in one view. */
struct Model {
  Clipped clipped;
  std::vector<gp_Pnt> point;         /* of each corner */
  std::vector<TopoDS_Vertex> vertex; /* the same, once it is used */
  std::vector<Line> line;
  std::unordered_map<uint64_t, uint32_t> side; /* lines, by their corners */
  TopoDS_Compound faces;
};

struct State {
  bool polygonal;
  const struct hsr_world *world; /* the scene's own faces, or those that flat
                                    ones are pieces of */
  const struct hsr_world *flat;  /* the faces that are drawn */
  struct hsr_edges edges = {};
  Model model;
  std::vector<drawn_part> part;
  ~State() { hsr_edges_free(&edges); }
};

/* The status for whatever was thrown. */
enum hsr_status occt_fail(struct hsr_error *err) {
  try {
    throw;
  } catch (const std::bad_alloc &) {
    return hsr_fail_nomem(err);
  } catch (const Standard_Failure &failure) {
    return hsr_fail(err, HSR_E_INTERNAL, "occt: %.60s",
                    failure.DynamicType()->Name());
  } catch (...) {
    return hsr_fail(err, HSR_E_INTERNAL, "occt: an exception");
  }
}

/* --- Shapes --------------------------------------------------------------- */

const TopoDS_Vertex &vertex_of(Model &model, uint32_t corner) {
  TopoDS_Vertex &vertex = model.vertex[corner];
  if (vertex.IsNull())
    BRep_Builder().MakeVertex(vertex, model.point[corner],
                              Precision::Confusion());
  return vertex;
}

void make_shape(Model &model, Line &line) {
  const gp_Pnt &from = model.point[line.corner[0]];
  const gp_Pnt &to = model.point[line.corner[1]];
  line.length = from.Distance(to);
  if (line.length <= gp::Resolution())
    return;
  BRep_Builder builder;
  builder.MakeEdge(line.shape, new Geom_Line(from, gp_Dir(gp_Vec(from, to))),
                   Precision::Confusion());
  builder.Add(line.shape,
              vertex_of(model, line.corner[0]).Oriented(TopAbs_FORWARD));
  builder.Add(line.shape,
              vertex_of(model, line.corner[1]).Oriented(TopAbs_REVERSED));
  builder.Range(line.shape, 0, line.length);
}

/* Finds which of the world's edges a line is on. */
void name_line(State *state, Line &line) {
  const Corner &from = state->model.clipped.corner[line.corner[0]];
  const Corner &to = state->model.clipped.corner[line.corner[1]];
  bool cut_from = from.a != UINT32_MAX, cut_to = to.a != UINT32_MAX;
  uint32_t a = cut_from ? from.a : cut_to ? to.a : line.corner[0];
  uint32_t b = cut_from ? from.b : cut_to ? to.b : line.corner[1];
  uint32_t whole = line.corner[cut_from ? 1 : 0];
  line.edge = UINT32_MAX;
  if ((cut_from && cut_to) || (whole != a && whole != b))
    return; /* it is in the nearest plane */
  struct hsr_edge_name name = {false, std::min(a, b), std::max(a, b), 0};
  line.edge = lines_find(&state->edges, &name);
  line.t[0] = cut_from ? from.t : line.corner[0] == name.b;
  line.t[1] = cut_to ? to.t : line.corner[1] == name.b;
}

const Line &line_of(State *state, uint32_t from, uint32_t to) {
  Model &model = state->model;
  auto found = model.side.emplace(pair_of(from, to), model.line.size());
  if (found.second) {
    Line line = {};
    line.corner[0] = std::min(from, to);
    line.corner[1] = std::max(from, to);
    name_line(state, line);
    make_shape(model, line);
    model.line.push_back(line);
  }
  return model.line[found.first->second];
}

/* Newell's normal of a face. */
gp_Vec normal_of(const Model &model, const std::vector<uint32_t> &face) {
  gp_XYZ sum(0, 0, 0), first = model.point[face[0]].XYZ();
  for (size_t k = 0; k < face.size(); k++)
    sum += (model.point[face[k]].XYZ() - first) ^
           (model.point[face[(k + 1) % face.size()]].XYZ() - first);
  return gp_Vec(sum);
}

void add_face(State *state, const std::vector<uint32_t> &corner) {
  gp_Vec normal = normal_of(state->model, corner);
  if (normal.Magnitude() <= gp::Resolution())
    return; /* it has no image */
  BRep_Builder builder;
  TopoDS_Wire wire;
  TopoDS_Face face;
  builder.MakeWire(wire);
  for (size_t k = 0; k < corner.size(); k++) {
    uint32_t from = corner[k], to = corner[(k + 1) % corner.size()];
    const Line &line = line_of(state, from, to);
    if (!line.shape.IsNull())
      builder.Add(wire, line.shape.Oriented(from < to ? TopAbs_FORWARD
                                                      : TopAbs_REVERSED));
  }
  wire.Closed(true);
  builder.MakeFace(
      face, new Geom_Plane(state->model.point[corner[0]], gp_Dir(normal)),
      Precision::Confusion());
  builder.Add(face, wire);
  builder.Add(state->model.faces, face);
}

void make_model(State *state, const struct hsr_view *view) {
  Model &model = state->model;
  model = Model();
  model.clipped = clip_world(state->flat, view);
  model.vertex.resize(model.clipped.corner.size());
  for (const Corner &c : model.clipped.corner) {
    const double *at = state->polygonal ? c.point : c.place;
    model.point.push_back(gp_Pnt(at[0], at[1], at[2]));
  }
  BRep_Builder().MakeCompound(model.faces);
  for (const ClippedFace &face : model.clipped.face)
    add_face(state, face.corner);
}

/* The stretch of a line between two parts of it, 0 to 1 from end to end. */
void take_stretch(State *state, const Line &line, bool visible, double from,
                  double to) {
  double t[2];
  for (int end = 0; end < 2; end++)
    t[end] = line.t[0] + (end ? to : from) * (line.t[1] - line.t[0]);
  state->part.push_back(
      {line.edge, visible, std::min(t[0], t[1]), std::max(t[0], t[1])});
}

/* --- Exact ---------------------------------------------------------------- */

HLRAlgo_Projector projector_of(const struct hsr_view *view) {
  const double *E = view->E, *F = view->F, *R = view->R;
  const double *at = view->camera.at;
  double focus = 0;
  for (int k = 0; k < 3; k++)
    focus += (at[k] - E[k]) * F[k];
  gp_Pnt centre(E[0] + focus * F[0], E[1] + focus * F[1], E[2] + focus * F[2]);
  gp_Ax2 axes(centre, gp_Dir(-F[0], -F[1], -F[2]), gp_Dir(R[0], R[1], R[2]));
  return view->parallel ? HLRAlgo_Projector(axes)
                        : HLRAlgo_Projector(axes, focus);
}

using Lines = std::unordered_map<const Geom_Curve *, const Line *>;

/* Takes the parts of one compound, which may be null. */
void take_compound(State *state, const Lines &lines,
                   const TopoDS_Shape &compound, bool visible) {
  if (compound.IsNull())
    return;
  for (TopExp_Explorer it(compound, TopAbs_EDGE); it.More(); it.Next()) {
    double from, to;
    const Handle(Geom_Curve) curve =
        BRep_Tool::Curve(TopoDS::Edge(it.Current()), from, to);
    auto found = lines.find(curve.get());
    if (found != lines.end())
      take_stretch(state, *found->second, visible, from / found->second->length,
                   to / found->second->length);
  }
}

void draw_exact(State *state, const struct hsr_view *view) {
  Handle(HLRBRep_Algo) algorithm = new HLRBRep_Algo;
  algorithm->Add(state->model.faces);
  algorithm->Projector(projector_of(view));
  algorithm->Update();
  algorithm->Hide();
  Lines lines;
  for (const Line &line : state->model.line) {
    double first, last;
    if (!line.shape.IsNull() && line.edge != UINT32_MAX)
      lines[BRep_Tool::Curve(line.shape, first, last).get()] = &line;
  }
  HLRBRep_HLRToShape shapes(algorithm);
  for (HLRBRep_TypeOfResultingEdge type :
       {HLRBRep_Sharp, HLRBRep_Rg1Line, HLRBRep_RgNLine})
    for (bool visible : {true, false})
      take_compound(state, lines, shapes.CompoundOfEdges(type, visible, true),
                    visible);
}

/* --- Polygonal ------------------------------------------------------------ */

/* Where on the line the point is that is seen at (x, y) of its image. */
double lift(const Clipped &clipped, const Line &line, double x, double y) {
  const Corner &a = clipped.corner[line.corner[0]];
  const Corner &b = clipped.corner[line.corner[1]];
  double dx = b.point[0] - a.point[0], dy = b.point[1] - a.point[1];
  double square = dx * dx + dy * dy;
  double u =
      square > 0 ? ((x - a.point[0]) * dx + (y - a.point[1]) * dy) / square : 0;
  u = std::min(1., std::max(0., u));
  return u * a.weight / ((1 - u) * b.weight + u * a.weight);
}

/* A segment from p to q, of which `status` tells the parts. */
void take_segment(State *state, const Line &line, HLRAlgo_EdgeStatus &status,
                  const HLRAlgo_BiPoint::PointsT &points) {
  auto take = [&](bool visible, double from, double to) {
    gp_XYZ p = points.Pnt1 + from * (points.Pnt2 - points.Pnt1);
    gp_XYZ q = points.Pnt1 + to * (points.Pnt2 - points.Pnt1);
    take_stretch(state, line, visible,
                 lift(state->model.clipped, line, p.X(), p.Y()),
                 lift(state->model.clipped, line, q.X(), q.Y()));
  };
  HLRAlgo_EdgeIterator it;
  double from, to;
  float from_tolerance, to_tolerance;
  for (it.InitVisible(status); it.MoreVisible(); it.NextVisible()) {
    it.Visible(from, from_tolerance, to, to_tolerance);
    take(true, from, to);
  }
  for (it.InitHidden(status); it.MoreHidden(); it.NextHidden()) {
    it.Hidden(from, from_tolerance, to, to_tolerance);
    take(false, from, to);
  }
}

void draw_polygonal(State *state, const struct hsr_view *view) {
  BRepMesh_IncrementalMesh mesher(state->model.faces, view->m);
  TopTools_DataMapOfShapeInteger number;
  for (size_t k = 0; k < state->model.line.size(); k++)
    if (!state->model.line[k].shape.IsNull())
      number.Bind(state->model.line[k].shape, int(k));
  Handle(HLRBRep_PolyAlgo) algorithm = new HLRBRep_PolyAlgo(state->model.faces);
  algorithm->Projector(HLRAlgo_Projector(
      gp_Ax2(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1), gp_Dir(1, 0, 0))));
  algorithm->Update();
  for (algorithm->InitHide(); algorithm->MoreHide(); algorithm->NextHide()) {
    HLRAlgo_EdgeStatus status;
    TopoDS_Shape shape;
    bool smooth, smoother, outline, inner;
    HLRAlgo_BiPoint::PointsT &points =
        algorithm->Hide(status, shape, smooth, smoother, outline, inner);
    const int *k = number.Seek(shape);
    if (k && state->model.line[size_t(*k)].edge != UINT32_MAX)
      take_segment(state, state->model.line[size_t(*k)], status, points);
  }
}

/* --- The peers' functions ------------------------------------------------- */

enum hsr_status occt_setup(const struct peer *peer,
                           const struct peer_canvas *canvas, void **out,
                           struct hsr_error *err) try {
  State *state = new (std::nothrow) State;
  *out = state;
  if (!state)
    return hsr_fail_nomem(err);
  state->polygonal = peer == &peer_occt_polygonal;
  state->flat = canvas->setup->world;
  state->world = state->flat->pieces ? state->flat->pieces->whole : state->flat;
  return hsr_edges_init(&state->edges, state->world, err);
} catch (...) {
  return occt_fail(err);
}

enum hsr_status occt_draw(void *opaque, const struct hsr_view *view,
                          struct hsr_error *err) try {
  State *state = static_cast<State *>(opaque);
  state->part.clear();
  make_model(state, view);
  if (state->polygonal)
    draw_polygonal(state, view);
  else
    draw_exact(state, view);
  return HSR_OK;
} catch (...) {
  return occt_fail(err);
}

/* Both drawings as plain files: every part of each, and every interval. */
json_t *plain_json(const State *state, const struct hsr_view *view,
                   const struct hsr_drawing *right) {
  struct lines_plain own = {}, exact = {};
  for (const struct drawn_part &part : state->part) {
    double from[3], to[3];
    hsr_edge_point(&state->edges, part.edge, part.t0, from);
    hsr_edge_point(&state->edges, part.edge, part.t1, to);
    lines_plain_add(&own, view, from, to);
  }
  for (size_t k = 0; k < right->n; k++)
    lines_plain_add(&exact, view, right->segment[k].from, right->segment[k].to);
  return json_pack("{so so}", "peer", lines_plain_json(&own), "right",
                   lines_plain_json(&exact));
}

enum hsr_status occt_judge(void *opaque, const struct hsr_view *view,
                           json_t **answer, struct hsr_error *err) {
  State *state = static_cast<State *>(opaque);
  struct hsr_drawing right = {};
  struct lines_verdict verdict;
  json_t *plain = nullptr;
  enum hsr_status status = lines_draw_right(state->world, view, &right, err);
  if (!status) /* before the parts are sorted */
    plain = plain_json(state, view, &right);
  if (!status)
    status = lines_compare(&state->edges, view, state->part.data(),
                           state->part.size(), &right, &verdict, err);
  if (!status) {
    *answer = lines_verdict_json(&verdict);
    json_object_set(*answer, "plain", plain);
  }
  json_decref(plain);
  hsr_drawing_free(&right);
  return status;
}

void occt_release(void *opaque) {
  delete static_cast<State *>(opaque);
}

/* --- The peers ------------------------------------------------------------ */

void occt_version(char *text) {
  snprintf(text, PEER_VERSION, "%s", OCC_VERSION_COMPLETE);
}

/* Faces must be flat. */
struct hsr_algorithm flat_faces() {
  struct hsr_algorithm demands = {};
  demands.name = "flat-faces";
  demands.subjects = 1 << HSR_FACES;
  demands.makes[0].kind = HSR_SEGMENTS;
  demands.restrictions = HSR_PF;
  return demands;
}
const struct hsr_algorithm takes_flat_faces = flat_faces();

struct peer occt_peer(const char *name, const char *title, const char *what) {
  struct peer peer = {};
  peer.name = name;
  peer.title = title;
  peer.source = "Open CASCADE Technology, Modeling Algorithms: HLR";
  peer.what = what;
  peer.kind = "segments";
  peer.demands = &takes_flat_faces;
  peer.version = occt_version;
  peer.setup = occt_setup;
  peer.draw = occt_draw;
  peer.judge = occt_judge;
  peer.release = occt_release;
  return peer;
}

} // namespace

const struct peer peer_occt_exact = occt_peer(
    "occt-exact", "Open CASCADE, exact hidden-line removal",
    "HLRBRep_Algo in its own perspective. A frame makes a compound of all "
    "faces "
    "that exist, hides lines, and takes the visible and the hidden parts of "
    "every edge. Set-up, which is not part of a frame, finds the edges. "
    "Mismatches are edges of which more than a hundredth of a pixel is wrongly "
    "visible, wrongly hidden or missing. Lines in which faces penetrate are "
    "not looked for, and not judged.");
const struct peer peer_occt_polygonal = occt_peer(
    "occt-polygonal", "Open CASCADE, polygonal hidden-line removal",
    "HLRBRep_PolyAlgo, which has no perspective, after our perspective "
    "transform. A frame transforms the vertices, makes a compound of all faces "
    "that exist, divides them into triangles, hides lines, and takes the "
    "visible and the hidden parts of every edge. Set-up and mismatches are "
    "those of occt-exact.");
