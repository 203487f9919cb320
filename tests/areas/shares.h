/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Exact shares of faces in pixels, for the tests; and scenes whose images are
 * known, because they are given by the image.
 *
 * The eye is the origin, with F = (0, 0, -1), R = (1, 0, 0), U = (0, 1, 0) and
 * m = n. So x = X/w and y = Y/w with w = -Z, or x = X and y = Y in parallel. */
#ifndef HSR_TESTS_AREAS_SHARES_H
#define HSR_TESTS_AREAS_SHARES_H

#include "bench/judge/areas/areas.h"
#include "scenes/scenes.h"
#include "common/answers/kinds/area.h"
#include "tests/tap.h"

#include <gmpxx.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <vector>

using shares = std::map<uint32_t, mpq_class>; /* by face */

inline enum hsr_status keep_shares(void *to, int, int, const area_part *part,
                                   size_t n) {
  shares pixel;
  for (size_t k = 0; k < n; k++)
    pixel[part[k].face] = mpq_class(part[k].share);
  static_cast<std::vector<shares> *>(to)->push_back(pixel);
  return HSR_OK;
}

/* Of the pixels in the view's window, row by row. */
inline std::vector<shares>
shares_of(const hsr_world &world, const hsr_view &view,
          enum hsr_area_filter filter = HSR_AREA_BOX) {
  std::vector<shares> all;
  hsr_error err;
  if (visit_areas(&world, &view, filter, keep_shares, &all, &err))
    bail("%s", err.text);
  return all;
}

/* The share of a face; 0 if there is none. */
inline mpq_class share(const shares &pixel, uint32_t face) {
  const auto found = pixel.find(face);
  return found == pixel.end() ? mpq_class(0) : found->second;
}

/* A corner by its image in pixels, and its depth. */
struct corner {
  double sx, sy, w;
};

/* Faces by their images in a view of n x n pixels. */
class drawn {
public:
  drawn(int n, bool parallel, double near = 0) : n_(n), parallel_(parallel) {
    scene_ = hsr_scene_new("drawn");
    camera_ = {};
    camera_.at[2] = -1;
    camera_.up[1] = 1;
    camera_.fov = 90;
    camera_.near = near;
    camera_.parallel = parallel ? 2 : 0;
    if (hsr_scene_view(scene_, &camera_))
      bail("no view");
  }
  ~drawn() {
    if (opened_)
      hsr_world_free(&world_);
    hsr_scene_delete(scene_);
  }
  drawn(const drawn &) = delete;
  drawn &operator=(const drawn &) = delete;

  /* Appends a face by corners in the world, in an object of its own. */
  drawn &face_at(const std::vector<std::array<double, 3>> &at,
                 bool one_sided = false) {
    hsr_object *object = hsr_scene_object(scene_, "face");
    object->one_sided = one_sided;
    std::vector<uint32_t> number;
    for (const auto &p : at) {
      number.push_back(0);
      if (hsr_object_vertex(object, p[0], p[1], p[2], &number.back()))
        bail("no vertex");
    }
    const float rgb[3] = {.25f + .125f * float(scene_->n_objects % 5), .7f,
                          .3f};
    if (hsr_object_face(object, number.data(), number.size(), rgb))
      bail("no face");
    return *this;
  }

  /* And by their images. */
  drawn &face(const std::vector<corner> &corners, bool one_sided = false) {
    std::vector<std::array<double, 3>> at;
    for (const corner &c : corners) {
      const double x = 2 * c.sx / n_ - 1, y = 1 - 2 * c.sy / n_,
                   scale = parallel_ ? 1 : c.w;
      at.push_back({x * scale, y * scale, -c.w});
    }
    return face_at(at, one_sided);
  }

  const hsr_world &world() {
    hsr_error err;
    if (!opened_ && (hsr_scene_finish(scene_, &err) ||
                     hsr_world_init(&world_, scene_, &err)))
      bail("%s", err.text);
    opened_ = true;
    return world_;
  }
  hsr_view view(int times = 1) const {
    hsr_view v;
    hsr_error err;
    if (hsr_view_init(&v, &camera_, times * n_, times * n_, &err))
      bail("%s", err.text);
    return v;
  }

  /* Of pixel (i, j), the share of a face. */
  mpq_class share_of(int i, int j, uint32_t face) {
    hsr_view v = view();
    v.window = {i, j, i + 1, j + 1};
    return share(shares_of(world(), v).front(), face);
  }

private:
  int n_;
  bool parallel_;
  hsr_camera camera_;
  hsr_scene *scene_;
  hsr_world world_;
  bool opened_ = false;
};

#endif
