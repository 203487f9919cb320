// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/files/gltf/gltf_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <unordered_map>

namespace hsr {
namespace {

enum Mode { POINTS, LINES, LINE_LOOP, LINE_STRIP, TRIANGLES, STRIP, FAN };

using Place = std::array<double, 3>;
struct Place_hash {
  size_t operator()(const Place &place) const {
    uint64_t hash = 0;
    for (const double x : place) {
      uint64_t bits;
      std::memcpy(&bits, &x, sizeof bits);
      hash = (hash ^ bits ^ bits >> 32) * 0x9e3779b97f4a7c15;
    }
    return static_cast<size_t>(hash ^ hash >> 29);
  }
};

float share(double x) {
  return static_cast<float>(std::min(std::max(x, 0.0), 1.0));
}

} // namespace

/* ---- A mesh ---- */

/* Reads a part of a mesh into a builder. */
class Gltf_mesh_reader {
public:
  Gltf_mesh_reader(Gltf_meshes &meshes, Gltf_part part, Mesh_builder &builder)
      : meshes_(meshes), part_(part), builder_(builder) {}
  void read(const Gltf_value &mesh, size_t number);

private:
  struct Face {
    uint32_t number, first, n; /* corners_[first ... first + n - 1] */
    float rgba[4];
  };
  /* What is known of a primitive while it is read. */
  struct Primitive {
    const Gltf_value &value;
    const Gltf_material &material;
    const Gltf_accessor *position, *colour, *indices, *face;
    Mode mode;
    size_t n; /* elements: indices or vertices */
  };

  void read_primitive(const Gltf_value &value);
  const Gltf_accessor *attribute(const Gltf_value &attributes,
                                 const char *name);
  void check(const Primitive &p) const;
  size_t vertex_of(const Primitive &p, size_t i) const;
  uint32_t corner(const Primitive &p, size_t vertex);
  uint32_t face_number(const Primitive &p, size_t vertex) const;
  void begin_face(const Primitive &p, uint32_t number);
  void end_face(const Primitive &p, const std::vector<size_t> &vertices);
  void triangle(const Primitive &p, size_t a, size_t b, size_t c);
  void triangles(const Primitive &p);
  void written_faces(const Primitive &p);
  bool is_ring(const Primitive &p, size_t from, size_t to, size_t first_index,
               size_t n_indices);
  void give();

  Gltf_meshes &meshes_;
  const Gltf_part part_;
  Mesh_builder &builder_;
  double offset_[3] = {0, 0, 0};
  uint32_t n_vertices_ = 0;
  std::unordered_map<Place, uint32_t, Place_hash> vertices_;
  std::vector<Face> faces_;
  std::vector<uint32_t> corners_;
  std::vector<size_t> three_ = {0, 0, 0};
  std::vector<std::array<uint32_t, 2>> edges_; /* of is_ring */
};

/* ---- Corners and faces ---- */

/* The vertex of element i. */
size_t Gltf_mesh_reader::vertex_of(const Primitive &p, size_t i) const {
  if (!p.indices)
    return i;
  double index;
  p.indices->read(i, &index);
  if (index >= static_cast<double>(p.position->n()))
    p.value["indices"].refuse("index %zu is %.0f, of %zu vertices", i, index,
                              p.position->n());
  return static_cast<size_t>(index);
}

/* The object's vertex at the place of a vertex of the file. */
uint32_t Gltf_mesh_reader::corner(const Primitive &p, size_t vertex) {
  Place place;
  p.position->read(vertex, place.data());
  for (size_t k = 0; k < 3; k++) {
    if (!std::isfinite(place[k]))
      p.value.refuse("POSITION %zu is not finite, and a face uses it", vertex);
    place[k] = place[k] + offset_[k] + 0.0; /* -0 is 0 */
  }
  const auto made = vertices_.emplace(place, n_vertices_);
  if (made.second) {
    builder_.vertex(place[0], place[1], place[2]);
    n_vertices_++;
  }
  return made.first->second;
}

/* Appends a face with these corners, and its colour. */
void Gltf_mesh_reader::end_face(const Primitive &p,
                                const std::vector<size_t> &vertices) {
  const Gltf_material &material = p.material;
  double sum[4] = {0, 0, 0, 0};
  Face face{static_cast<uint32_t>(faces_.size()),
            static_cast<uint32_t>(corners_.size()),
            static_cast<uint32_t>(vertices.size()),
            {}};
  if (corners_.size() + vertices.size() >= UINT32_MAX)
    p.value.refuse("has more corners than can be held");
  for (const size_t vertex : vertices) {
    double rgba[4] = {1, 1, 1, 1};
    if (p.colour)
      p.colour->read(vertex, rgba);
    for (size_t k = 0; k < 4; k++)
      sum[k] += rgba[k];
    corners_.push_back(corner(p, vertex));
  }
  if (p.face)
    face.number = face_number(p, vertices[0]);
  if (part_.is_mirrored)
    std::reverse(corners_.begin() + face.first + 1, corners_.end());
  for (size_t k = 0; k < 4; k++)
    face.rgba[k] = share(material.factor[k] * sum[k] /
                         static_cast<double>(vertices.size()));
  if (material.alpha == Gltf_material::IS_MASKED &&
      static_cast<double>(face.rgba[3]) < material.cutoff) {
    meshes_.left_out_.masked++;
    corners_.resize(face.first);
    return;
  }
  if (material.alpha != Gltf_material::IS_BLENDED)
    face.rgba[3] = 1;
  faces_.push_back(face);
}

void Gltf_mesh_reader::triangle(const Primitive &p, size_t a, size_t b,
                                size_t c) {
  three_[0] = vertex_of(p, a);
  three_[1] = vertex_of(p, b);
  three_[2] = vertex_of(p, c);
  end_face(p, three_);
}

/* 3.7.2.1. */
void Gltf_mesh_reader::triangles(const Primitive &p) {
  const size_t spare = p.mode == TRIANGLES ? p.n % 3 : p.n < 3 ? p.n : 0;
  meshes_.left_out_.incomplete += spare;
  if (spare && builder_.strict())
    p.value.refuse("has %zu corners, which make no whole triangles", p.n);
  if (p.mode == TRIANGLES)
    for (size_t k = 0; k + 2 < p.n; k += 3)
      triangle(p, k, k + 1, k + 2);
  else if (p.mode == STRIP)
    for (size_t k = 0; k + 2 < p.n; k++)
      triangle(p, k, k + 1 + k % 2, k + 2 - k % 2);
  else
    for (size_t k = 1; k + 1 < p.n; k++)
      triangle(p, k, k + 1, 0);
}

/* ---- Faces of hsr ---- */

uint32_t Gltf_mesh_reader::face_number(const Primitive &p,
                                       size_t vertex) const {
  double number;
  p.face->read(vertex, &number);
  return number >= 0 && number < double{UINT32_MAX}
             ? static_cast<uint32_t>(number)
             : UINT32_MAX;
}

/* Whether triangles, all of vertices from ... to - 1, have together the edges of
 * the ring of these: an edge in both directions counts for nothing. */
bool Gltf_mesh_reader::is_ring(const Primitive &p, size_t from, size_t to,
                               size_t first_index, size_t n_indices) {
  edges_.clear();
  const auto add = [&](size_t a, size_t b, bool is_ring) {
    const std::array<uint32_t, 2> edge = {corner(p, a), corner(p, b)};
    edges_.push_back(is_ring ? edge
                             : std::array<uint32_t, 2>{edge[1], edge[0]});
  };
  for (size_t v = from; v < to; v++)
    add(v, v + 1 < to ? v + 1 : from, true);
  for (size_t k = 0; k < n_indices; k++) {
    const size_t a = vertex_of(p, first_index + k);
    const size_t b = vertex_of(p, first_index + (k % 3 == 2 ? k - 2 : k + 1));
    if (a < from || a >= to || b < from || b >= to)
      return false;
    add(a, b, false);
  }
  /* Each edge must be there as often as the same in the other direction. */
  std::vector<std::array<uint32_t, 2>> turned;
  for (const auto &edge : edges_)
    turned.push_back({edge[1], edge[0]});
  std::sort(edges_.begin(), edges_.end());
  std::sort(turned.begin(), turned.end());
  return edges_ == turned;
}

/* Runs of vertices with the same number, and of the triangles of each. */
void Gltf_mesh_reader::written_faces(const Primitive &p) {
  std::vector<size_t> ring;
  for (size_t index = 0, vertex = 0; index + 2 < p.n;) {
    const size_t from = std::max(vertex, vertex_of(p, index));
    const uint32_t number = face_number(p, from);
    size_t to = from, end = index;
    while (to < p.position->n() && face_number(p, to) == number)
      to++;
    while (end + 2 < p.n && vertex_of(p, end) >= from && vertex_of(p, end) < to)
      end += 3;
    if (end > index && is_ring(p, from, to, index, end - index)) {
      ring.clear();
      for (size_t v = from; v < to; v++)
        ring.push_back(v);
      end_face(p, ring);
    } else {
      end = std::max(end, index + 3);
      for (size_t k = index; k < end; k += 3)
        triangle(p, k, k + 1, k + 2);
    }
    index = end;
    vertex = to;
  }
}

/* ---- Primitives ---- */

const Gltf_accessor *Gltf_mesh_reader::attribute(const Gltf_value &attributes,
                                                 const char *name) {
  const Gltf_value value = attributes[name];
  return value.is_there() ? &meshes_.accessors_[value] : nullptr;
}

void Gltf_mesh_reader::check(const Primitive &p) const {
  const Gltf_accessor &position = *p.position;
  if (position.n_numbers() != 3)
    p.value.refuse("POSITION must have three numbers");
  if (!position.is_float() && !meshes_.file_.uses("KHR_mesh_quantization"))
    p.value.refuse("POSITION must be of floats, without KHR_mesh_quantization");
  if (p.colour && (p.colour->n_numbers() < 3 ||
                   !(p.colour->is_float() || p.colour->is_normalized())))
    p.value.refuse("COLOR_0 must be three or four floats or normalized "
                   "numbers");
  if (p.colour && p.colour->n() < position.n())
    p.value.refuse("COLOR_0 has %zu elements for %zu vertices", p.colour->n(),
                   position.n());
  if (p.indices && (p.indices->n_numbers() != 1 || !p.indices->is_unsigned() ||
                    p.indices->is_normalized()))
    p.value["indices"].refuse("must be unsigned whole numbers");
}

void Gltf_mesh_reader::read_primitive(const Gltf_value &value) {
  const Gltf_material &material = meshes_.material_of(value);
  const auto mode = static_cast<Mode>(value["mode"].whole(TRIANGLES, FAN));
  if (material.is_double_sided != part_.is_double_sided)
    return;
  const Gltf_value attributes = value["attributes"];
  if (mode < TRIANGLES || !attributes["POSITION"].is_there()) {
    (mode == POINTS     ? meshes_.left_out_.points
     : mode < TRIANGLES ? meshes_.left_out_.lines
                        : meshes_.left_out_.placeless)++;
    return;
  }
  meshes_.left_out_.morphs += value["targets"].size() > 0;
  const Gltf_value indices = value["indices"];
  Primitive p{value,
              material,
              attribute(attributes, "POSITION"),
              attribute(attributes, "COLOR_0"),
              indices.is_there() ? &meshes_.accessors_[indices] : nullptr,
              meshes_.as_written_ ? attribute(attributes, "_FACE") : nullptr,
              mode,
              0};
  p.n = p.indices ? p.indices->n() : p.position->n();
  check(p);
  if (p.face && (p.face->n_numbers() != 1 || p.face->n() != p.position->n()))
    p.face = nullptr;
  meshes_.file_.spend(p.face ? p.n + p.face->n() : p.n, value);
  if (p.face && p.indices && p.mode == TRIANGLES)
    written_faces(p);
  else
    triangles(p);
}

/* In the order of their numbers. What all have in common is the object's. */
void Gltf_mesh_reader::give() {
  if (meshes_.as_written_)
    std::stable_sort(
        faces_.begin(), faces_.end(),
        [](const Face &a, const Face &b) { return a.number < b.number; });
  bool same_rgb = true, same_opacity = true;
  for (const Face &face : faces_) {
    same_rgb &= !std::memcmp(face.rgba, faces_[0].rgba, 3 * sizeof(float));
    same_opacity &= face.rgba[3] == faces_[0].rgba[3];
  }
  if (!faces_.empty()) {
    const float grey[3] = {0.6f, 0.6f, 0.6f};
    builder_.set_look(same_rgb ? faces_[0].rgba : grey,
                      same_opacity ? faces_[0].rgba[3] : 1);
  }
  for (const Face &face : faces_) {
    builder_.face(corners_.data() + face.first, face.n,
                  same_rgb ? nullptr : face.rgba);
    if (!same_opacity)
      builder_.opacity(face.rgba[3]);
  }
}

void Gltf_mesh_reader::read(const Gltf_value &mesh, size_t number) {
  if (meshes_.as_written_)
    meshes_.file_.root()["extras"]["offsets"][number].numbers(offset_, 3);
  const Gltf_value primitives = mesh["primitives"];
  builder_.set_one_sided(!part_.is_double_sided);
  for (size_t k = 0; k < primitives.size(); k++)
    read_primitive(primitives[k]);
  give();
}

/* ---- Meshes and materials ---- */

/* What hsr does not draw. */
void Gltf_meshes::find_textures(const Gltf_value &material) {
  const Gltf_value metallic = material["pbrMetallicRoughness"];
  for (const Gltf_value &texture :
       {metallic["baseColorTexture"], metallic["metallicRoughnessTexture"],
        material["normalTexture"], material["occlusionTexture"],
        material["emissiveTexture"]})
    if (texture.is_there()) {
      left_out_.textured++;
      return;
    }
}

const Gltf_material &Gltf_meshes::material(const Gltf_value &reference) {
  const size_t index = reference.index(file_.count(GLTF_MATERIALS), "material");
  const auto found = materials_.find(index);
  if (found != materials_.end())
    return found->second;
  const Gltf_element element = file_.element(GLTF_MATERIALS, index);
  Gltf_material &material = materials_[index];
  element["pbrMetallicRoughness"]["baseColorFactor"].numbers(material.factor,
                                                             4);
  element["extensions"]["KHR_materials_pbrSpecularGlossiness"]["diffuseFactor"]
      .numbers(material.factor, 4);
  const Gltf_value alpha = element["alphaMode"];
  const std::string mode = alpha.text("OPAQUE");
  if (mode == "MASK")
    material.alpha = Gltf_material::IS_MASKED;
  else if (mode == "BLEND")
    material.alpha = Gltf_material::IS_BLENDED;
  else if (mode != "OPAQUE")
    alpha.refuse("'%s' is not OPAQUE, MASK or BLEND", shown_word(mode).c_str());
  material.cutoff = element["alphaCutoff"].number(material.cutoff);
  material.is_double_sided = element["doubleSided"].truth(false);
  find_textures(element.value);
  return material;
}

const Gltf_material &Gltf_meshes::material_of(const Gltf_value &primitive) {
  const Gltf_value reference = primitive["material"];
  return reference.is_there() ? material(reference) : plain_;
}

void Gltf_meshes::find_sides(size_t mesh, bool sides[2]) {
  const Gltf_element element = file_.element(GLTF_MESHES, mesh);
  const Gltf_value primitives = element["primitives"];
  if (!primitives.size())
    primitives.refuse_kind("an array that is not empty");
  for (size_t k = 0; k < primitives.size(); k++)
    sides[material_of(primitives[k]).is_double_sided] = true;
}

uint32_t Gltf_meshes::object(size_t mesh, Gltf_part part,
                             const std::string &name) {
  const Gltf_element element = file_.element(GLTF_MESHES, mesh);
  return scene_.object(
      element["name"].text(name.c_str()), [&](Mesh_builder &builder) {
        Gltf_mesh_reader(*this, part, builder).read(element.value, mesh);
      });
}

void Gltf_meshes::add_notes() {
  const auto add = [&](size_t n, const char *one, const char *many,
                       const char *rest) {
    if (n)
      scene_.note(std::to_string(n) + " " + (n == 1 ? one : many) + rest);
  };
  add(left_out_.lines, "primitive", "primitives",
      " of lines passed over: lines are not read");
  add(left_out_.points, "primitive", "primitives",
      " of points passed over: points are not read");
  add(left_out_.placeless, "primitive", "primitives",
      " without positions passed over");
  add(left_out_.incomplete, "corner", "corners",
      " passed over: they make no whole triangle");
  add(left_out_.masked, "face", "faces",
      " left out: their opacity is below the material's cutoff");
  add(left_out_.morphs, "primitive", "primitives",
      " with morph targets: drawn without them");
  add(left_out_.textured, "material", "materials",
      " with textures: drawn in the plain colour");
}

} // namespace hsr
