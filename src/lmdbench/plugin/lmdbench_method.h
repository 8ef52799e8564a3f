/* SPDX-FileCopyrightText: The lmdbench authors
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * The one header that a proximity method from outside needs: C99, no dependency. A method is a
 * shared object with one exported constant, `lmdbench_method_entry`. `lmdbench plugin new FOLDER`
 * writes a project, `plugin check FILE.so` checks it, `run ... --plugin FILE.so` measures it.
 *
 * A method gets two meshes, A and B, and a pose of A in B's frame, and returns contacts: pairs of
 * points, one on each mesh. Lengths are metres. B stands, A moves. lmdbench computes forces from
 * the contacts, unless the method has its own (LMDBENCH_EXTENSION_FORCE).
 *
 * Who may call what, and when:
 *  - one thread at a time uses an instance; several threads may use several instances at once;
 *  - memory belongs to its maker: meshes and options live until `create` returns, so copy them;
 *  - functions throw nothing; one that fails returns a number other than 0;
 *  - rounding mode and flush-to-zero must stay unchanged (beware of -ffast-math when linking);
 *  - the same calls must give the same contacts, in every process.
 *
 * Versions: a structure only grows at its end, and contains its size. A host takes every plugin of
 * its own ABI_MAJOR. Later additions that fit no structure are extensions, found by name. */
#ifndef LMDBENCH_METHOD_H
#define LMDBENCH_METHOD_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* NOLINTBEGIN(modernize-use-using,readability-identifier-naming): C, with names of C */

#define LMDBENCH_METHOD_ABI_MAJOR 1
#define LMDBENCH_METHOD_ABI_MINOR 1 /* 1: LMDBENCH_PROMISE_FORCE_ONLY, LMDBENCH_EXTENSION_FORCE */

/* What the contacts of a pose should be, and so how they are judged. A method that promises the
 * complete set and misses a pair loses that promise, is shown so, and still is timed. */
enum {
  LMDBENCH_PROMISE_COMPLETE_SET = 0,  /* all local minimum distance pairs in the cutoff, no other */
  LMDBENCH_PROMISE_APPROXIMATION = 1, /* may miss some and report others: its error is reported */
  LMDBENCH_PROMISE_NEAREST_PAIR = 2,  /* the one nearest pair, with its true distance */
  LMDBENCH_PROMISE_FORCE_ONLY =
      3 /* no set: a force of its own (LMDBENCH_EXTENSION_FORCE); contacts are ignored */
};

/* Flags of a method. */
enum {
  LMDBENCH_KEEPS_FRAMES = 1 /* remembers earlier poses: each pair of bodies needs an instance */
};

/* The lowest-dimensional part of a triangle with a point. Edge k: corners k and (k + 1) % 3. */
enum {
  LMDBENCH_CORNER_0 = 0,
  LMDBENCH_CORNER_1 = 1,
  LMDBENCH_CORNER_2 = 2,
  LMDBENCH_EDGE_0 = 3,
  LMDBENCH_EDGE_1 = 4,
  LMDBENCH_EDGE_2 = 5,
  LMDBENCH_FACE = 6,
  LMDBENCH_PART_UNKNOWN = -1 /* the host finds the part */
};

typedef struct lmdbench_mesh {
  const double* vertices;   /* vertex_count rows x, y, z, in the mesh's own frame [m] */
  const int32_t* triangles; /* triangle_count rows of vertices, counter-clockwise from outside */
  uint64_t vertex_count;
  uint64_t triangle_count;
} lmdbench_mesh;

/* Two points that face each other, in B's frame [m]. The host computes distance, direction and
 * force; points must lie on the named triangles to 1e-6 of the mesh's diagonal. */
typedef struct lmdbench_contact {
  double point_a[3];
  double point_b[3];
  int32_t triangle_a; /* one that carries point_a */
  int32_t triangle_b;
  int32_t part_a; /* LMDBENCH_CORNER_0 ... LMDBENCH_FACE, or LMDBENCH_PART_UNKNOWN */
  int32_t part_b;
} lmdbench_contact;

typedef struct lmdbench_method {
  uint64_t struct_size; /* sizeof(lmdbench_method) */
  const char* name;     /* in experiment files: letters, digits, '-' and '_' */
  const char* version;  /* of the method */
  const char* summary;  /* one sentence without a full stop */
  int32_t promise;
  uint32_t flags;

  /* Options: the "properties" of a JSON Schema (draft 7) object, each with "type" or "enum",
   * "description", "default": {"voxel_m": {"type": "number", ...}}. NULL for none. */
  const char* options_schema;

  /* Prepares for two meshes.
   * cutoff:  contacts farther apart than this are not asked for [m]
   * options: a JSON object that holds every option
   * instance: receives what the other functions get
   * message: receives a text of up to message_size bytes, ended by 0, where this fails
   * returns 0, or something else for failure */
  int32_t (*create)(const lmdbench_mesh* a, const lmdbench_mesh* b, double cutoff, const char* options,
                    void** instance, char* message, uint64_t message_size);

  /* The contacts at a pose.
   * X_BA:     rows of (R | t), p_B = R p_A + t: r00 r01 r02 tx  r10 r11 r12 ty  r20 r21 r22 tz
   * contacts: receives up to `capacity` contacts, nearest first
   * needed:   receives how many there are; if more than `capacity`, the host calls again at the
   *           same pose with more room, and the answer must be the same
   * returns 0, or something else for failure */
  int32_t (*search)(void* instance, const double X_BA[12], lmdbench_contact* contacts, uint64_t capacity,
                    uint64_t* needed);

  void (*destroy)(void* instance);

  /* A structure of functions by name, or NULL; the pointer itself may be NULL. */
  const void* (*extension)(const char* id);
} lmdbench_method;

/* Extension: deterministic counts of work, each a row in results beside the times. */
#define LMDBENCH_EXTENSION_COUNTERS "lmdbench.counters/1"
#define LMDBENCH_MOST_COUNTERS 4
typedef struct lmdbench_counters {
  uint32_t count;           /* up to LMDBENCH_MOST_COUNTERS */
  const char* const* names; /* snake_case */
  const char* const* summaries;
  /* What the last search counted. */
  void (*read)(void* instance, uint64_t* values);
} lmdbench_counters;

/* Extension: a force and torque of the method's own, instead of the experiment's law over its
 * contacts (the option "own_force" switches back). It is judged as any force is. */
#define LMDBENCH_EXTENSION_FORCE "lmdbench.force/1"
typedef struct lmdbench_force {
  uint64_t struct_size; /* sizeof(lmdbench_force) */
  /* What B exerts on A at the pose of the last search, which succeeded. Its time is the search's.
   * wrench: receives force x y z [N] and torque x y z [N m] about A's origin, in B's axes
   * returns 0, or something else for no force: then, and where a number is not finite, A feels
   * nothing in this frame, which is counted */
  int32_t (*read)(void* instance, double wrench[6]);
} lmdbench_force;

typedef struct lmdbench_method_entry_type {
  uint32_t abi_major; /* LMDBENCH_METHOD_ABI_MAJOR */
  uint32_t abi_minor;
  uint64_t struct_size; /* sizeof(lmdbench_method_entry_type) */
  /* The plugin's methods from 0 on, at most 64; NULL beyond the last. */
  const lmdbench_method* (*get)(uint32_t index);
} lmdbench_method_entry_type;

#if defined(__GNUC__)
#define LMDBENCH_METHOD_EXPORT __attribute__((visibility("default")))
#else
#define LMDBENCH_METHOD_EXPORT
#endif

/* What a plugin exports. */
extern LMDBENCH_METHOD_EXPORT const lmdbench_method_entry_type lmdbench_method_entry;

/* NOLINTEND(modernize-use-using,readability-identifier-naming) */

#ifdef __cplusplus
}
#endif

#endif
