// SPDX-License-Identifier: GPL-3.0-or-later
// Reads .gltf and .glb files: the nodes of a scene, what they place, and where
// they look from.
//
// Source      The Khronos Group, "glTF 2.0 Specification", 2021
// Objects     a mesh that nodes place is an object, with an instance for each
//             node (see gltf_mesh.h). Objects are in the order of the meshes.
// Places      the product of the matrices from the root to the node, in doubles
// Axes        those of the file: y is up, as in hsr's own views, and lengths
//             are metres. A file that is still as hsr wrote it has its scene's
//             own axes and lengths again.
// Views       a view for each node with a camera. There is no far plane.
// Left out    with a note each: skins, morph targets, animations, lights,
//             textures, lines and points
#include "common/files/gltf/glb_frame.h"
#include "common/files/gltf/gltf_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace hsr {
namespace {

using Matrix = std::array<double, 12>; /* of an instance, by rows */
constexpr Matrix IDENTITY = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
constexpr double PI = 3.14159265358979323846;

class Gltf_reader {
public:
  Gltf_reader(Mesh_file &file, Mesh_scene &scene)
      : gltf_(file), scene_(scene) {}
  void read();

private:
  struct Placed {
    size_t mesh, node;
    Matrix m;
  };
  struct Waiting {
    size_t node;
    Matrix parent;
  };

  std::vector<size_t> roots();
  std::vector<size_t> parentless() const;
  void visit(const std::vector<size_t> &roots);
  Matrix local(const Gltf_element &node) const;
  Matrix place(const Gltf_element &node, const Matrix &parent) const;
  void add_view(const Gltf_element &node, const Matrix &m);
  bool read_camera(const Gltf_element &node, const Matrix &m,
                   struct hsr_camera *camera);
  bool is_as_written(const std::vector<size_t> &nodes);
  size_t mesh_of(const Gltf_value &reference) const;
  bool written_place(const Gltf_element &node, Matrix &m) const;
  bool written_view(const Gltf_element &node, struct hsr_camera *camera) const;
  bool is_written_mesh(const Gltf_element &node) const;
  bool is_written_view(const Gltf_element &node) const;
  void add_objects();
  void add_object(Gltf_meshes &meshes, const Placed *from, const Placed *to,
                  Gltf_part part);
  void add_notes(size_t n_unplaced);

  Gltf_file gltf_;
  Mesh_scene &scene_;
  bool as_written_ = false;
  struct hsr_glb_frame frame_ = {1, false, false};
  std::vector<Placed> placed_;
  size_t n_skinned_ = 0, n_far_ = 0;
};

/* ---- Which nodes ---- */

/* The nodes that are no others' children. */
std::vector<size_t> Gltf_reader::parentless() const {
  const size_t n = gltf_.count(GLTF_NODES);
  std::vector<bool> is_child(n);
  std::vector<size_t> roots;
  for (size_t k = 0; k < n; k++) {
    const Gltf_element node = gltf_.element(GLTF_NODES, k);
    const Gltf_value children = node["children"];
    for (size_t c = 0; c < children.size(); c++)
      is_child[children[c].index(n, "node")] = true;
  }
  for (size_t k = 0; k < n; k++)
    if (!is_child[k])
      roots.push_back(k);
  return roots;
}

/* Those of the standard scene; 3.5.1. */
std::vector<size_t> Gltf_reader::roots() {
  const size_t n_scenes = gltf_.count(GLTF_SCENES);
  const Gltf_value standard = gltf_.root()["scene"];
  if (!n_scenes && !standard.is_there()) {
    scene_.note("it has no scene: all its nodes are drawn");
    return parentless();
  }
  if (n_scenes > 1)
    scene_.note(std::to_string(n_scenes - 1) +
                (n_scenes > 2 ? " scenes" : " scene") + " left out: only the " +
                (standard.is_there() ? "standard" : "first") + " one is read");
  const Gltf_element scene = standard.is_there()
                                 ? gltf_.element(GLTF_SCENES, standard)
                                 : gltf_.element(GLTF_SCENES, size_t{0});
  const Gltf_value nodes = scene["nodes"];
  std::vector<size_t> roots;
  for (size_t k = 0; k < nodes.size(); k++)
    roots.push_back(nodes[k].index(gltf_.count(GLTF_NODES), "node"));
  return roots;
}

/* ---- Where they are ---- */

/* The matrix that a node has, or that its translation, rotation and scale
 * make; 3.5.3. A rotation by quarters of a turn is exact. */
Matrix Gltf_reader::local(const Gltf_element &node) const {
  double column[16], t[3] = {0, 0, 0}, q[4] = {0, 0, 0, 1}, s[3] = {1, 1, 1};
  Matrix m;
  const Gltf_value matrix = node["matrix"];
  if (matrix.numbers(column, 16)) {
    for (size_t k = 0; k < 12; k++)
      m[k] = column[4 * (k % 4) + k / 4];
    if (column[3] != 0 || column[7] != 0 || column[11] != 0 || column[15] != 1)
      matrix.refuse("its last row is not 0, 0, 0, 1");
    return m;
  }
  node["translation"].numbers(t, 3);
  node["rotation"].numbers(q, 4);
  node["scale"].numbers(s, 3);
  const double n = (q[0] * q[0] + q[1] * q[1]) + (q[2] * q[2] + q[3] * q[3]);
  if (!(n > 0) || !std::isfinite(n))
    node["rotation"].refuse("is no rotation");
  for (size_t row = 0; row < 3; row++) {
    const size_t a = (row + 1) % 3, b = (row + 2) % 3;
    m[5 * row] = (1 - 2 * (q[a] * q[a] + q[b] * q[b]) / n) * s[row];
    m[4 * row + a] = 2 * (q[row] * q[a] - q[b] * q[3]) / n * s[a];
    m[4 * row + b] = 2 * (q[row] * q[b] + q[a] * q[3]) / n * s[b];
  }
  for (size_t k = 0; k < 3; k++)
    m[4 * k + 3] = t[k];
  return m;
}

Matrix Gltf_reader::place(const Gltf_element &node,
                          const Matrix &parent) const {
  Matrix m;
  if (as_written_ && written_place(node, m))
    return m;
  hsr_instance_compose(parent.data(), local(node).data(), m.data());
  return m;
}

/* Which mesh a node has. hsr writes some twice, wound the other way round. */
size_t Gltf_reader::mesh_of(const Gltf_value &reference) const {
  const size_t n = gltf_.count(GLTF_MESHES);
  const size_t mesh = reference.index(n, "mesh");
  const Gltf_value same = gltf_.root()["extras"]["same_mesh"];
  return as_written_ && mesh < same.size() ? same[mesh].index(n, "mesh") : mesh;
}

/* Finds what the nodes below the roots place. No node may be there twice. */
void Gltf_reader::visit(const std::vector<size_t> &roots) {
  const size_t n = gltf_.count(GLTF_NODES);
  std::vector<bool> is_seen(n);
  std::vector<Waiting> waiting;
  const auto wait = [&](size_t node, const Matrix &parent) {
    if (is_seen[node])
      gltf_.element(GLTF_NODES, node)
          .value.refuse("is below two nodes, or below itself");
    is_seen[node] = true;
    waiting.push_back({node, parent});
  };
  for (size_t k = roots.size(); k-- > 0;)
    wait(roots[k], IDENTITY);
  while (!waiting.empty()) {
    const Waiting next = waiting.back();
    waiting.pop_back();
    const Gltf_element node = gltf_.element(GLTF_NODES, next.node);
    const Matrix m = place(node, next.parent);
    const Gltf_value mesh = node["mesh"], children = node["children"];
    if (mesh.is_there())
      placed_.push_back({mesh_of(mesh), next.node, m});
    n_skinned_ += mesh.is_there() && node["skin"].is_there();
    if (node["camera"].is_there())
      add_view(node, m);
    for (size_t k = children.size(); k-- > 0;)
      wait(children[k].index(n, "node"), m);
  }
}

/* ---- Views ---- */

/* A camera looks along its -z, with y up; 3.10. */
bool Gltf_reader::read_camera(const Gltf_element &node, const Matrix &m,
                              struct hsr_camera *camera) {
  const Gltf_element element = gltf_.element(GLTF_CAMERAS, node["camera"]);
  const std::string type = element["type"].text("");
  const bool is_parallel = type == "orthographic";
  if (!is_parallel && type != "perspective")
    element["type"].refuse("'%s' is no kind of camera",
                           shown_word(type).c_str());
  const Gltf_value optics = element[type.c_str()];
  if (is_parallel)
    camera->parallel = 2 * optics["ymag"].number(0);
  else
    camera->fov = optics["yfov"].number(0) * 180 / PI;
  camera->near = optics["znear"].number(0);
  n_far_ += optics["zfar"].is_there();
  for (size_t k = 0; k < 3; k++) {
    camera->eye[k] = m[4 * k + 3];
    camera->at[k] = m[4 * k + 3] - m[4 * k + 2];
    camera->up[k] = m[4 * k + 1];
  }
  return !is_parallel || camera->parallel > 0;
}

void Gltf_reader::add_view(const Gltf_element &node, const Matrix &m) {
  struct hsr_camera camera = {};
  struct hsr_error why = {HSR_OK, "it shows nothing"};
  camera.fov = 45;
  if (as_written_)
    written_view(node, &camera);
  else if (!read_camera(node, m, &camera))
    camera.up[0] = camera.up[1] = camera.up[2] = 0;
  if (!scene_.view(camera, &why))
    scene_.note(node.value.place() + ": camera left out: " + why.text);
}

/* ---- Files of hsr ---- */

/* Whether the matrix of a node is that of the numbers that hsr kept. */
bool is_matrix(const Gltf_element &node, const double wanted[16]) {
  double matrix[16];
  return node["matrix"].numbers(matrix, 16) &&
         std::equal(matrix, matrix + 16, wanted);
}

/* The place of the instance that a node is. False: it is none. */
bool Gltf_reader::written_place(const Gltf_element &node, Matrix &m) const {
  const Gltf_value places = gltf_.root()["extras"]["instances"];
  const Gltf_value instance = node["extras"]["instance"];
  return instance.is_number() && node["mesh"].is_there() &&
         places[instance.index(places.size(), "instance")].numbers(m.data(),
                                                                   12);
}

/* The view that a node's camera is. False: it is none. */
bool Gltf_reader::written_view(const Gltf_element &node,
                               struct hsr_camera *camera) const {
  const Gltf_value views = gltf_.root()["extras"]["views"];
  const size_t index =
      node["camera"].index(gltf_.count(GLTF_CAMERAS), "camera");
  double all[HSR_GLB_VIEW];
  *camera = {};
  if (!views[index].numbers(all, HSR_GLB_VIEW))
    return false;
  std::copy_n(all, 3, camera->eye);
  std::copy_n(all + 3, 3, camera->at);
  std::copy_n(all + 6, 3, camera->up);
  camera->fov = all[9];
  camera->near = all[10];
  camera->parallel = all[11];
  std::copy_n(all + 12, 4, camera->light);
  return true;
}

bool Gltf_reader::is_written_mesh(const Gltf_element &node) const {
  const size_t mesh = node["mesh"].index(gltf_.count(GLTF_MESHES), "mesh");
  Matrix m;
  double offset[3] = {0, 0, 0}, matrix[16];
  if (!written_place(node, m))
    return false;
  gltf_.root()["extras"]["offsets"][mesh].numbers(offset, 3);
  hsr_glb_place(&frame_, m.data(), offset, matrix);
  return is_matrix(node, matrix);
}

bool Gltf_reader::is_written_view(const Gltf_element &node) const {
  struct hsr_camera camera;
  struct hsr_glb_camera wanted;
  if (!written_view(node, &camera) ||
      !hsr_glb_find_camera(&frame_, &camera, &wanted) ||
      !is_matrix(node, wanted.matrix))
    return false;
  const Gltf_element element = gltf_.element(GLTF_CAMERAS, node["camera"]);
  const Gltf_value optics =
      element[wanted.is_parallel ? "orthographic" : "perspective"];
  const char *size = wanted.is_parallel ? "ymag" : "yfov";
  return optics[size].number(0) == wanted.size &&
         optics["znear"].number(0) == wanted.near;
}

/* Whether the nodes are still as hsr wrote them. Then what hsr wrote beside
 * them, for itself, holds. */
bool Gltf_reader::is_as_written(const std::vector<size_t> &nodes) {
  const Gltf_value frame = gltf_.root()["extras"];
  if (gltf_.root()["asset"]["generator"].text("") != HSR_GLB_GENERATOR ||
      !frame.is_there())
    return false;
  frame_.metres = frame["metres"].number(1);
  frame_.z_up = frame["z_up"].truth(false);
  for (const size_t k : nodes) {
    const Gltf_element node = gltf_.element(GLTF_NODES, k);
    const bool is_view = node["camera"].is_there();
    if (node["children"].size() || is_view == node["mesh"].is_there() ||
        !(is_view ? is_written_view(node) : is_written_mesh(node)))
      return false;
  }
  return true;
}

/* ---- Objects ---- */

/* One object, and an instance of it for each node that places it. */
void Gltf_reader::add_object(Gltf_meshes &meshes, const Placed *from,
                             const Placed *to, Gltf_part part) {
  const auto is_of_part = [&](const Placed &placed) {
    return as_written_ || part.is_double_sided ||
           hsr_glb_mirrors(placed.m.data()) == part.is_mirrored;
  };
  if (std::none_of(from, to, is_of_part))
    return;
  const Gltf_element node = gltf_.element(GLTF_NODES, from->node);
  const std::string number = std::to_string(from->mesh);
  const uint32_t object = meshes.object(
      from->mesh, part, node["name"].text(("mesh " + number).c_str()));
  for (; from < to && object != Mesh_scene::NONE; from++)
    if (is_of_part(*from))
      scene_.instance(object, from->m.data());
}

/* Mesh by mesh. */
void Gltf_reader::add_objects() {
  Gltf_meshes meshes(gltf_, scene_, as_written_);
  size_t n_placed = 0;
  std::stable_sort(
      placed_.begin(), placed_.end(),
      [](const Placed &a, const Placed &b) { return a.mesh < b.mesh; });
  const Placed *const end = placed_.data() + placed_.size();
  for (const Placed *from = placed_.data(), *to = from; from < end; from = to) {
    while (to < end && to->mesh == from->mesh)
      to++;
    bool sides[2] = {false, false};
    meshes.find_sides(from->mesh, sides);
    if (sides[0]) {
      add_object(meshes, from, to, {false, false});
      if (!as_written_)
        add_object(meshes, from, to, {false, true});
    }
    if (sides[1])
      add_object(meshes, from, to, {true, false});
    n_placed++;
  }
  meshes.add_notes();
  add_notes(as_written_ ? 0 : gltf_.count(GLTF_MESHES) - n_placed);
}

void Gltf_reader::add_notes(size_t n_unplaced) {
  const auto add = [&](size_t n, const char *one, const char *many,
                       const char *rest) {
    if (n)
      scene_.note(std::to_string(n) + " " + (n == 1 ? one : many) + rest);
  };
  const Gltf_value lights =
      gltf_.root()["extensions"]["KHR_lights_punctual"]["lights"];
  add(n_unplaced, "mesh", "meshes", " left out: no node of the scene has it");
  add(n_skinned_, "skinned mesh", "skinned meshes", " drawn as stored");
  add(gltf_.count(GLTF_ANIMATIONS), "animation", "animations",
      " left out: all is drawn at rest");
  add(lights.size(), "light", "lights", " left out");
  add(n_far_, "camera", "cameras",
      " with a far plane: what is beyond it is drawn");
  for (const std::string &note : gltf_.notes())
    scene_.note(note);
}

void Gltf_reader::read() {
  const std::vector<size_t> nodes = roots();
  as_written_ = is_as_written(nodes);
  visit(nodes);
  if (placed_.empty())
    gltf_.file().refuse(0, "holds no face: no node of its scene has a mesh");
  add_objects();
}

} // namespace

void gltf_read(Mesh_file &file, Mesh_scene &scene) {
  Gltf_reader(file, scene).read();
}

} // namespace hsr
