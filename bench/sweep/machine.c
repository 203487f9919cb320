/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The header of a run: what was run, and on which machine. */
#include "config.h"

#include "bench/sweep/commit.h"
#include "bench/sweep/sweep.h"
#include "common/files/json/json.h"

#include <hwloc.h>
#include <stdlib.h>
#include <string.h>
#include <sys/utsname.h>
#include <time.h>

/* --- Hashes --------------------------------------------------------------- */

/* FNV-1a, 64 bits: G. Fowler, L. C. Noll and K.-P. Vo, RFC 9923. */
#define HASH_EMPTY 0xcbf29ce484222325u

static uint64_t hash_bytes(uint64_t hash, const void *bytes, size_t n) {
  const unsigned char *byte = bytes;
  for (size_t k = 0; k < n; k++)
    hash = (hash ^ byte[k]) * 0x100000001b3u;
  return hash;
}

static void print_hash(uint64_t hash, char text[17]) {
  snprintf(text, 17, "%016llx", (unsigned long long)hash);
}

void hash_program(char hash[17]) {
  static const char self[] = "/proc/self/exe";
  uint64_t sum = HASH_EMPTY;
  unsigned char block[1 << 14];
  FILE *file = fopen(self, "rb");
  size_t n;
  while (file && (n = fread(block, 1, sizeof block, file)) > 0)
    sum = hash_bytes(sum, block, n);
  if (file)
    fclose(file);
  print_hash(sum, hash);
}

void hash_scene(const struct hsr_scene *scene, char hash[17]) {
  uint64_t sum = HASH_EMPTY;
  for (uint32_t o = 0; o < scene->n_objects; o++) {
    const struct hsr_object *object = &scene->objects[o];
    sum = hash_bytes(sum, object->xyz,
                     3 * (size_t)object->n_vertices * sizeof *object->xyz);
    sum = hash_bytes(sum, object->start,
                     ((size_t)object->n_faces + 1) * sizeof *object->start);
    sum = hash_bytes(sum, object->vertex,
                     object->start[object->n_faces] * sizeof *object->vertex);
  }
  for (uint32_t i = 0; i < scene->n_instances; i++) {
    const struct hsr_instance *instance = &scene->instances[i];
    sum = hash_bytes(sum, &instance->object, sizeof instance->object);
    sum = hash_bytes(sum, instance->m, sizeof instance->m);
  }
  print_hash(sum, hash);
}

/* --- The machine ---------------------------------------------------------- */

static json_t *caches_json(hwloc_topology_t topology) {
  static const hwloc_obj_type_t level[] = {HWLOC_OBJ_L1CACHE, HWLOC_OBJ_L2CACHE,
                                           HWLOC_OBJ_L3CACHE};
  json_t *caches = json_array();
  for (int k = 0; k < 3; k++) {
    hwloc_obj_t cache = hwloc_get_obj_by_type(topology, level[k], 0);
    if (cache)
      hsr_json_append(&caches,
                      json_pack("{si sI}", "level", k + 1, "kb",
                                (json_int_t)(cache->attr->cache.size / 1024)));
  }
  return caches;
}

/* NULL if there is no such file, or no line in it. */
static const char *first_line(const char *path, char *line, int size) {
  FILE *file = fopen(path, "r");
  if (!file)
    return NULL;
  bool good = fgets(line, size, file) != NULL;
  fclose(file);
  line[strcspn(line, "\n")] = '\0';
  return good ? line : NULL;
}

static json_t *load_json(void) {
  double load[3];
  json_t *loads = json_array();
  int n = getloadavg(load, 3);
  for (int k = 0; k < n; k++)
    hsr_json_append(&loads, json_real(load[k]));
  return loads;
}

static json_t *topology_json(hwloc_topology_t topology) {
  hwloc_obj_t root = hwloc_get_root_obj(topology);
  hwloc_obj_t package = hwloc_get_obj_by_type(topology, HWLOC_OBJ_PACKAGE, 0);
  const char *cpu =
      package ? hwloc_obj_get_info_by_name(package, "CPUModel") : NULL;
  char os[200] = "", governor[64];
  struct utsname name;
  if (!uname(&name))
    snprintf(os, sizeof os, "%.60s %.60s %.60s", name.sysname, name.release,
             name.machine);
  return json_pack(
      "{ss? si si sI so ss ss? so}", "cpu", cpu, "cores",
      hwloc_get_nbobjs_by_type(topology, HWLOC_OBJ_CORE), "threads",
      hwloc_get_nbobjs_by_type(topology, HWLOC_OBJ_PU), "memory_kb",
      (json_int_t)(root->total_memory / 1024), "caches", caches_json(topology),
      "os", os, "governor",
      first_line("/sys/devices/system/cpu/cpu0/cpufreq/scaling_governor",
                 governor, sizeof governor),
      "load", load_json());
}

static json_t *machine_json(void) {
  hwloc_topology_t topology;
  setenv("HWLOC_HIDE_ERRORS", "2", 0); /* where there is no /sys */
  if (hwloc_topology_init(&topology))
    return NULL;
  json_t *machine =
      hwloc_topology_load(topology) ? NULL : topology_json(topology);
  hwloc_topology_destroy(topology);
  return machine;
}

/* --- The header ----------------------------------------------------------- */

/* A word of the command line. If it is not UTF-8, the bytes that are not ASCII
 * are replaced. */
static json_t *word_json(char *word) {
  json_t *text = json_string(word);
  if (text)
    return text;
  for (char *c = word; *c; c++)
    if (*c & 0x80)
      *c = '?';
  return json_string(word);
}

static json_t *command_json(int argc, char **argv) {
  json_t *command = json_array();
  hsr_json_append(&command, json_string("hsr"));
  for (int k = 0; k < argc; k++)
    hsr_json_append(&command, word_json(argv[k]));
  return command;
}

json_t *sweep_header(const struct sweep_options *o, const char *run,
                     const char *code, int argc, char **argv) {
  time_t now = time(NULL);
  struct tm utc;
  char date[32] = "";
  if (gmtime_r(&now, &utc))
    strftime(date, sizeof date, "%Y-%m-%dT%H:%M:%SZ", &utc);
  return json_pack(
      "{ss ss ss ss so ss ss? ss ss ss so sI sI sI sI sI}", "schema",
      "hsr-bench/1", "record", "header", "run", run, "date", date, "command",
      command_json(argc, argv), "version", PACKAGE_VERSION, "commit",
      HSR_COMMIT[0] ? HSR_COMMIT : NULL, "code", code, "compiler", HSR_COMPILER,
      "flags", HSR_FLAGS, "machine", machine_json(), "seed",
      (json_int_t)o->seed, "starts", (json_int_t)o->starts, "repetitions",
      (json_int_t)o->repetitions, "timeout", (json_int_t)o->timeout,
      "memory_mb", (json_int_t)o->memory_mb);
}
