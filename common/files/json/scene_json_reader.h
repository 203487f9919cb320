/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the parts of the reader of scene files share; only for scene_json*.c. */
#ifndef HSR_COMMON_FILES_SCENE_JSON_READER_H
#define HSR_COMMON_FILES_SCENE_JSON_READER_H

#include "common/files/json/json_members.h"
#include "common/files/json/scene_json.h"
#include "common/scene/motion.h"

/* What is read an element at a time: of the file, and of an object. */
enum { OBJECTS, INSTANCES, VIEWS, SCENE_LISTS };
enum { VERTICES, FACES, FACE_COLOURS, OBJECT_LISTS };
enum { OF_FILE, OF_OBJECT, OF_LEAF };
extern const hsr_json_levels hsr_scene_levels[];

struct reader {
  struct hsr_scene *scene;
  struct hsr_json_input input;
  struct hsr_import import; /* n_dropped: so far */
  struct hsr_json_part lists[SCENE_LISTS];
  struct hsr_json_part of_object[OBJECT_LISTS]; /* of the current one */
  json_t *colour;                               /* of the current face */
  uint32_t *corners;                            /* of the same */
  size_t cap_corners;
  struct mesh *mesh;   /* the latest that was read */
  struct entry *entry; /* of "objects", in order */
  uint32_t n_entries, cap_entries;
  json_t *numbers;       /* of entries, by their names */
  struct placed *placed; /* of "instances", in order */
  size_t n_placed;
  long frame;       /* the scene is this frame of the file */
  bool frame_given; /* by who reads it; else the file says it, or it is 0 */
};

/* A mesh file that has been read, so that it is read once however many entries
 * are made of it. Kept are what a scene file may change in the objects. */
struct mesh {
  struct mesh *before;
  char *path;
  uint32_t first, n;             /* its objects in the scene */
  struct hsr_object *as_read;    /* of them, the names, colours and so on */
  struct hsr_instance *instance; /* of the file; `object` counts from 0 */
  uint32_t n_instances;
  uint64_t n_dropped;
};

/* An element of "objects": one object, or those of a mesh file. */
struct entry {
  char *name;
  uint32_t first, n;       /* its objects in the scene */
  const struct mesh *mesh; /* NULL: it has no file */
};

static inline struct reader *reader_of(const struct hsr_json_node *at) {
  return at->input->reader;
}

static inline struct entry *latest_entry(const struct hsr_json_node *at) {
  struct reader *reader = reader_of(at);
  return &reader->entry[reader->n_entries - 1];
}

/* The last object. */
static inline struct hsr_object *latest(const struct hsr_json_node *at) {
  struct hsr_scene *scene = reader_of(at)->scene;
  return &scene->objects[scene->n_objects - 1];
}

/* Replaces a malloc'ed text by a string. to: char * */
hsr_json_take hsr_scene_take_name;

/* A whole number below n, which counts things called `what`. */
enum hsr_status hsr_scene_read_index(const struct hsr_json_node *at,
                                     const char *what, uint32_t n,
                                     uint32_t *to);

/* Reads a mesh file, "file" of the latest entry, and adds its objects. */
hsr_json_take hsr_scene_take_mesh;
void hsr_scene_forget_meshes(struct reader *reader);

/* Reads "instances"; and, when all is read, appends them to the scene. */
hsr_json_take hsr_scene_take_instances;
enum hsr_status hsr_scene_append_instances(const struct hsr_json_node *root);
void hsr_scene_forget_instances(struct reader *reader);

#endif
