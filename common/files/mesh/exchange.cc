// SPDX-License-Identifier: GPL-3.0-or-later
// Mesh files: .off, .ply, plain .obj and .stl through our own readers; other .obj and
// texts of .stl through CGAL's; .vtp through common/files/vtk/exchange_vtk.cc.
//
// Safety      see common/files/mesh/mesh_file.h: CGAL sees only what a scan has
//             passed, and must find in it what the scan found.
// Memory      our own readers: the file and the object at once; of plain .obj also
//             4 bytes a corner and 1 a face; of .stl also 8 bytes a corner, and of
//             its texts 72 a facet. CGAL's: first the file and what CGAL makes of
//             it, 24 bytes a vertex and 4 a face and a corner, and of .stl a search
//             tree of about 80 a vertex; then that and the object, without the
//             file. Colours: 12 bytes a face or vertex.
#include "common/files/mesh/exchange.h"
#include "common/files/mesh/mesh_file.h"
#include "common/files/mesh/mesh_obj.h"

#include <CGAL/IO/OBJ.h>
#include <CGAL/IO/STL.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <exception>
#include <istream>
#include <new>
#include <utility>

namespace {

using hsr::Mesh_builder;
using hsr::Mesh_extent;
using hsr::Mesh_file;
using hsr::Refused;

using Point = CGAL::Simple_cartesian<double>::Point_3;
using Triangle = std::array<uint32_t, 3>;

/* Polygons as CGAL's readers fill them, one after the other, in two arrays. */
class Polygons {
public:
  class Polygon {
  public:
    explicit Polygon(std::vector<uint32_t> &corners) : corners_(corners) {}
    void start() { start_ = corners_.size(); }
    size_t size() const { return corners_.size() - start_; }
    void resize(size_t n) { corners_.resize(start_ + n); }
    uint32_t &operator[](size_t k) { return corners_[start_ + k]; }

  private:
    std::vector<uint32_t> &corners_;
    size_t start_ = 0;
  };
  using value_type = Polygon;
  using iterator = Polygon *;
  using const_iterator = const Polygon *;

  Polygons() : last_(corners_) {}
  Polygons(const Polygons &) = delete;
  Polygons &operator=(const Polygons &) = delete;

  void reserve(const Mesh_extent &extent) {
    starts_.reserve(extent.n_faces);
    corners_.reserve(extent.n_corners);
  }
  bool empty() const { return starts_.empty(); }
  size_t size() const { return starts_.size(); }
  void resize(size_t) {} /* the polygons come when they are filled */
  void emplace_back() {
    starts_.push_back(static_cast<uint32_t>(corners_.size()));
    last_.start();
  }
  Polygon &back() { return last_; }
  /* The last polygon, or the one after it, which is the last then. */
  Polygon &operator[](size_t f) {
    if (f == starts_.size())
      emplace_back();
    return last_;
  }

  const uint32_t *corners(size_t f) const {
    return corners_.data() + starts_[f];
  }
  size_t n_corners(size_t f) const {
    return (f + 1 < size() ? starts_[f + 1] : corners_.size()) - starts_[f];
  }

private:
  std::vector<uint32_t> starts_, corners_;
  Polygon last_;
};

/* What CGAL made of a file. */
struct Soup {
  std::vector<Point> points;
  Polygons polygons;               /* except of STL */
  std::vector<Triangle> triangles; /* of STL */
};

/* After the scan of a file and before CGAL has it. */
void prepare(Soup &soup, const Mesh_extent &extent, const Mesh_file &file) {
  if (!extent.n_faces)
    file.refuse(0, "holds no face");
  if (extent.n_corners >= UINT32_MAX)
    file.refuse(0, "its faces have %zu corners in all, more than can be held",
                extent.n_corners);
  soup.points.reserve(extent.n_vertices);
  soup.polygons.reserve(extent);
}

void check_read(const Mesh_file &file, bool read, size_t n_faces,
                const Mesh_extent &extent) {
  if (read && n_faces == extent.n_faces)
    return;
  if (errno == ENOMEM)
    throw std::bad_alloc();
  file.refuse(0, "CGAL reads only %zu of its %zu faces", n_faces,
              extent.n_faces);
}

void read_obj(Mesh_file &file, bool drop, Soup &soup, Mesh_extent &extent) {
  extent = hsr::scan_obj(file, drop);
  prepare(soup, extent, file);
  hsr::Memory_buffer buffer(file.begin, file.end);
  std::istream stream(&buffer);
  errno = 0; /* where lack of memory shows */
  const bool read = CGAL::IO::read_OBJ(stream, soup.points, soup.polygons,
                                       CGAL::parameters::verbose(false));
  check_read(file, read, soup.polygons.size(), extent);
}

void read_stl(Mesh_file &file, bool, Soup &soup, Mesh_extent &extent) {
  extent = hsr::scan_stl(file);
  prepare(soup, extent, file);
  soup.triangles.reserve(extent.n_faces);
  hsr::Memory_buffer buffer(file.begin, file.end);
  std::istream stream(&buffer);
  errno = 0; /* where lack of memory shows */
  const bool read = CGAL::IO::read_STL(stream, soup.points, soup.triangles,
                                       CGAL::parameters::verbose(false));
  check_read(file, read, soup.triangles.size(), extent);
}

/* The colour of a face: its own, or else the mean of its corners', in rgb.
 * NULL: it has none. */
const float *face_colour(const Mesh_extent &extent, size_t f,
                         const uint32_t *corners, size_t n, float rgb[3]) {
  if (!extent.rgb.empty() && extent.rgb[3 * f] != Mesh_extent::NO_COLOUR)
    return &extent.rgb[3 * f];
  return hsr::mean_colour(extent.vertex_rgb, corners, n, rgb);
}

void build(const Soup &soup, const Mesh_extent &extent, Mesh_builder &builder) {
  for (const Point &point : soup.points)
    builder.vertex(point.x(), point.y(), point.z());
  for (size_t f = 0; f < extent.n_faces; f++) {
    const bool is_triangle = !soup.triangles.empty();
    const uint32_t *corners =
        is_triangle ? soup.triangles[f].data() : soup.polygons.corners(f);
    const size_t n = is_triangle ? 3 : soup.polygons.n_corners(f);
    float rgb[3];
    builder.face(corners, n, face_colour(extent, f, corners, n, rgb));
  }
}

/* ---- By suffix ---- */

/* The faces that a reader of CGAL's makes. */
template <void (*read)(Mesh_file &, bool, Soup &, Mesh_extent &)>
void read_soup(Mesh_file &file, bool drop, Mesh_builder &builder) {
  Soup soup;
  Mesh_extent extent;
  read(file, drop, soup, extent);
  for (const std::string &note : extent.notes)
    builder.note(note);
  file.memory.reset();
  build(soup, extent, builder);
}

void read_any_obj(Mesh_file &file, bool drop, Mesh_builder &builder) {
  if (!hsr::obj_read_plain(file, builder))
    read_soup<read_obj>(file, drop, builder);
}

void read_any_stl(Mesh_file &file, bool drop, Mesh_builder &builder) {
  if (!hsr::binary_stl_read(file, builder) &&
      !hsr::text_stl_read_plain(file, builder))
    read_soup<read_stl>(file, drop, builder);
}

void read_vtp(Mesh_file &file, bool, Mesh_builder &builder) {
  hsr::vtp_read(file, builder);
}

using Reader = void (*)(Mesh_file &, bool, Mesh_builder &);

struct Suffix {
  const char *text;
  Reader reader;
};

constexpr Suffix SUFFIXES[] = {{".off", hsr::off_read},
                               {".obj", read_any_obj},
                               {".ply", hsr::ply_read},
                               {".stl", read_any_stl},
                               {".vtp", read_vtp}};

const char *file_name(const char *path) {
  const char *slash = std::strrchr(path, '/');
  return slash ? slash + 1 : path;
}

/* Where the suffix of a file name starts: its last dot, or its end. */
const char *suffix_of(const char *name) {
  const char *dot = std::strrchr(name, '.');
  return dot ? dot : name + std::strlen(name);
}

const Suffix &find_suffix(const Mesh_file &file) {
  std::string text = suffix_of(file_name(file.path));
  for (char &c : text)
    c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const Suffix &suffix : SUFFIXES)
    if (text == suffix.text)
      return suffix;
  file.refuse(0,
              "'%s' is not the suffix of a mesh file (.off .obj .ply .stl "
              ".vtp)",
              hsr::shown_word(text).c_str());
}

/* ---- The new object ---- */

/* A scene of one object, which is made here and then moved, so that a failure
 * leaves the caller's scene as it was. */
class Workshop {
public:
  explicit Workshop(const std::string &name) : scene_(hsr_scene_new("")) {
    object = scene_ ? hsr_scene_object(scene_, name.c_str()) : nullptr;
    if (!object) {
      hsr_scene_delete(scene_);
      throw std::bad_alloc();
    }
  }
  ~Workshop() { hsr_scene_delete(scene_); }
  Workshop(const Workshop &) = delete;
  Workshop &operator=(const Workshop &) = delete;

  void deliver(struct hsr_scene *scene) {
    struct hsr_object *place = hsr_scene_object(scene, "");
    if (!place)
      throw std::bad_alloc();
    std::swap(*place, *object);
  }

  struct hsr_object *object;

private:
  struct hsr_scene *scene_;
};

void add_note(struct hsr_import *import, const std::string &line) {
  const size_t used = std::strlen(import->notes);
  if (used + line.size() < sizeof import->notes)
    std::memcpy(import->notes + used, line.c_str(), line.size() + 1);
}

void mesh_read(struct hsr_scene *scene, const char *path,
               struct hsr_import *import) {
  const bool drop = import && import->drop_degenerate;
  const Suffix &suffix = find_suffix({path, nullptr, nullptr, nullptr});
  Mesh_file file = hsr::load_mesh_file(path);
  const char *name = file_name(path);
  Workshop workshop(std::string(name, suffix_of(name)));
  Mesh_builder builder(workshop.object, path, drop,
                       import ? import->threads : 1);
  suffix.reader(file, drop, builder);
  file.memory.reset();
  if (!builder.n_given())
    file.refuse(0, "holds no face");
  if (!workshop.object->n_faces)
    file.refuse(0, "all of its %llu faces are degenerate",
                static_cast<unsigned long long>(builder.n_given()));
  bool solid = false;
  if (hsr_object_is_solid(workshop.object, builder.threads(), &solid))
    throw std::bad_alloc();
  workshop.object->one_sided = solid && !(import && import->two_sided);
  workshop.deliver(scene);
  if (!import)
    return;
  import->n_dropped = builder.n_dropped();
  for (const std::string &note : builder.notes())
    add_note(import, std::string(hsr::shown_path(path)) + ": " + note + "\n");
}

/* Runs `body`; what it throws becomes a status. */
template <class Body>
enum hsr_status guarded(const char *path, struct hsr_error *err,
                        const Body &body) noexcept {
  try {
    body();
    return HSR_OK;
  } catch (const Refused &refused) {
    if (err)
      *err = refused.error;
    return refused.error.status;
  } catch (const std::bad_alloc &) {
    return hsr_fail_nomem(err);
  } catch (const std::exception &fault) {
    return hsr_fail(err, HSR_E_INTERNAL, "%s: %.150s", hsr::shown_path(path),
                    fault.what());
  } catch (...) {
    return hsr_fail(err, HSR_E_INTERNAL, "%s: a reader failed",
                    hsr::shown_path(path));
  }
}

} // namespace

enum hsr_status hsr_mesh_read(struct hsr_scene *scene, const char *path,
                              struct hsr_import *import,
                              struct hsr_error *err) {
  if (import)
    import->n_dropped = 0;
  return guarded(path, err, [&] { mesh_read(scene, path, import); });
}
