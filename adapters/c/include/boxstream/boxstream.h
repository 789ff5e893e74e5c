/* SPDX-License-Identifier: MIT */
/* boxstream for C (C99 or later), and for languages that call C. Link with libboxstream_c: it has all of boxstream in
   it and exports nothing but what is declared here.

   Handles are opaque; each is made by a `_create` and given back by a `_destroy`, which takes NULL. Use one handle by
   one thread at a time, but for queries of a world (const handles). Functions that can fail return a status and then
   leave handles as they were; boxstream_error_text() says more in one line. All arguments are checked before anything
   happens and before anything is written: pointers that must not be NULL, scalars, sizes, distances, counts beyond what
   memory holds, data that are not aligned as their type. Structs that may grow begin with their size: set it to sizeof,
   or use the initializers. Callbacks get the `user` that was passed beside them, must not throw or jump out, and must
   not change the handle that calls them.

   Floating point: results do not depend on rounding modes, flushing of denormals or traps. No call traps or changes
   flags. Callbacks run in the environment of their caller.

   Worlds of floats take doubles as well. Boxes that are asked about count as they are given, exactly. Where distances
   are reported, they are those of the smallest box of floats around it, so rounded down; limits, and lengths of rays,
   are rounded up: nothing within them is lost. Origins and directions of rays, and points, are rounded to the nearest
   floats, which moves a ray, or a point, by at most 2^-24 of its coordinates; beyond the range of floats they are
   infinite, and a direction below it is 0. */
#ifndef BOXSTREAM_H
#define BOXSTREAM_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#if defined(_WIN32)
#if defined(BOXSTREAM_C_BUILD)
#define BOXSTREAM_C_API __declspec(dllexport)
#else
#define BOXSTREAM_C_API __declspec(dllimport)
#endif
#else
#define BOXSTREAM_C_API __attribute__((visibility("default")))
#endif

#ifdef __cplusplus
extern "C" {
#endif

typedef enum boxstream_status {
  BOXSTREAM_OK = 0,
  BOXSTREAM_NO_MEMORY = 1,
  BOXSTREAM_TOO_MANY = 2,     /* boxes, proxies or pairs: beyond what indices of 32 bits tell apart */
  BOXSTREAM_BAD_ARGUMENT = 3, /* a null pointer, a size, a scalar, a distance, alignment */
  BOXSTREAM_FAILED = 4        /* anything else, as an executor that failed */
} boxstream_status;

/* Of the last call in this thread that did not return BOXSTREAM_OK; "" if there was none. Valid until the next such
 * call. */
BOXSTREAM_C_API const char* boxstream_error_text(void);

/* 10000 major + 100 minor + patch, of the library that runs. */
BOXSTREAM_C_API uint32_t boxstream_version(void);

/* The SIMD instructions that searches use here: "AVX3", "AVX2", "SSE4", "NEON", "EMU128", ... */
BOXSTREAM_C_API const char* boxstream_simd_target(void);

/* A number and no enum: any value may come from outside, and is refused if it is neither. */
typedef int32_t boxstream_scalar;
enum { BOXSTREAM_FLOAT = 0, BOXSTREAM_DOUBLE = 1 };

/* Two boxes may pair where the group of each meets the mask of the other. */
typedef struct boxstream_filter {
  uint32_t group, mask;
} boxstream_filter;

/* A view of `count` boxes, 6 numbers each: min x, y, z, max x, y, z. Boxes are closed: touching counts. One with a NaN
   or with min > max pairs with nothing. */
typedef struct boxstream_boxes {
  boxstream_scalar scalar;
  const void* data;
  size_t count;
  const boxstream_filter* filters; /* one for each box, or NULL */
} boxstream_boxes;

static inline boxstream_boxes boxstream_float_boxes(const float* data, size_t count) {
  boxstream_boxes boxes = {BOXSTREAM_FLOAT, data, count, NULL};
  return boxes;
}

static inline boxstream_boxes boxstream_double_boxes(const double* data, size_t count) {
  boxstream_boxes boxes = {BOXSTREAM_DOUBLE, data, count, NULL};
  return boxes;
}

/* A view of `count` balls, 4 numbers each: centre x, y, z, radius >= 0. */
typedef struct boxstream_balls {
  boxstream_scalar scalar;
  const void* data;
  size_t count;
} boxstream_balls;

/* Indices of two boxes: a < b within one set; of two sets, `a` is of the first. */
typedef struct boxstream_pair {
  uint32_t a, b;
} boxstream_pair;

/* Gets pairs in batches, which are valid during the call. False stops the search. */
typedef bool (*boxstream_pair_sink)(void* user, const boxstream_pair* pairs, size_t count);

/* What a search did. Only what `size` has room for is written. */
typedef struct boxstream_stats {
  size_t size;
  uint64_t boxes, invalid, pairs;
  uint64_t tests; /* box against box */
} boxstream_stats;
#define BOXSTREAM_STATS_INIT \
  { sizeof(boxstream_stats), 0, 0, 0, 0 }

/* The caller's threads. `parallel_for` calls task(context, i) once for each i < count, on any threads and in any order,
   and returns when all calls have returned. `concurrency` says how many tasks may usefully run at once.
   `start_nanoseconds` says about how long it takes until a task starts on another thread: fewer boxes are then left to
   the calling one; NULL: 50000, as of threads that sleep. Results do not depend on it. */
typedef struct boxstream_executor {
  size_t size;
  void* user;
  unsigned (*concurrency)(void* user);
  void (*parallel_for)(void* user, size_t count, void (*task)(void* context, size_t i), void* context);
  uint32_t (*start_nanoseconds)(void* user);
} boxstream_executor;

/* Searches in batches. */

typedef struct boxstream_detector boxstream_detector;

/* `executor` is copied; NULL: everything runs on the calling thread. */
BOXSTREAM_C_API boxstream_status boxstream_detector_create(const boxstream_executor* executor,
                                                           boxstream_detector** out);
BOXSTREAM_C_API void boxstream_detector_destroy(boxstream_detector* detector);
/* Gives back the memory that it keeps for searches and for the pairs of the last one, which are gone then. */
BOXSTREAM_C_API boxstream_status boxstream_detector_shrink_to_fit(boxstream_detector* detector);

/* How pairs are found; which ones they are does not depend on it. BOXSTREAM_HYBRID is the streamed segment tree with
   scans of Zomorodian and Edelsbrunner, "Fast software for box intersections", alone: several times slower than
   BOXSTREAM_PLANNED, and worth comparing with. Its `cutoff` is the number of intervals or points of a node below which
   it scans; 0: samples tell when. */
typedef int32_t boxstream_method;
enum { BOXSTREAM_PLANNED = 0, BOXSTREAM_HYBRID = 1 };
BOXSTREAM_C_API boxstream_status boxstream_detector_create_with(const boxstream_executor* executor,
                                                                boxstream_method method, uint32_t cutoff,
                                                                boxstream_detector** out);

/* All pairs within `a`, or between `a` and `b` if that is not NULL (of the same scalar), each once, in an order that
   the boxes alone decide. `*pairs` belongs to the detector and is valid until its next call that is not refused as a
   bad argument. `stats` may be NULL. */
BOXSTREAM_C_API boxstream_status boxstream_find_pairs(boxstream_detector* detector, const boxstream_boxes* a,
                                                      const boxstream_boxes* b, const boxstream_pair** pairs,
                                                      size_t* count, boxstream_stats* stats);
/* The same in O(n) memory. */
BOXSTREAM_C_API boxstream_status boxstream_stream_pairs(boxstream_detector* detector, const boxstream_boxes* a,
                                                        const boxstream_boxes* b, boxstream_pair_sink sink, void* user,
                                                        boxstream_stats* stats);

/* All pairs of balls with |a - b| <= a.radius + b.radius + distance, decided exactly for the numbers as they are given:
   balls of floats that are 0.1f apart are not within 0.1, which is less. `distance` is finite and >= 0, for floats too
   up to the largest double. Balls with a number that is not finite, or a radius < 0, are near nothing. */
BOXSTREAM_C_API boxstream_status boxstream_find_near_pairs(boxstream_detector* detector, const boxstream_balls* balls,
                                                           double distance, const boxstream_pair** pairs, size_t* count,
                                                           boxstream_stats* stats);

/* Boxes that live from frame to frame. */

typedef struct boxstream_world boxstream_world;

/* Names a proxy; {0, 0} names none. That of a removed proxy stays stale: functions find nothing by it. */
typedef struct boxstream_id {
  uint32_t slot, generation;
} boxstream_id;

/* `a` was inserted before `b`. */
typedef struct boxstream_id_pair {
  boxstream_id a, b;
} boxstream_id_pair;

/* False refuses the pair until one of the two changes. */
typedef bool (*boxstream_pair_filter)(void* user, boxstream_id a, boxstream_id b);
/* False stops the query. */
typedef bool (*boxstream_visitor)(void* user, boxstream_id id);
/* `enter` is where the ray comes in, in lengths of its direction. Returns the new length of the ray: `length` to see
   all hits, `enter` for the nearest, a negative number to stop. */
typedef double (*boxstream_ray_visitor)(void* user, boxstream_id id, double enter, double length);
/* `distance` is between boxes, rounded down. Returns the new limit: boxes that are farther are left out. Zero, a
   negative number or a NaN stops. */
typedef double (*boxstream_near_visitor)(void* user, boxstream_id id, double distance);
typedef double (*boxstream_near_pair_visitor)(void* user, boxstream_id_pair pair, double distance);

typedef struct boxstream_world_stats {
  size_t size;
  uint64_t proxies, invalid, moved, pairs, begun, ended;
} boxstream_world_stats;
#define BOXSTREAM_WORLD_STATS_INIT \
  { sizeof(boxstream_world_stats), 0, 0, 0, 0, 0, 0 }

/* All boxes of a world are of one scalar. `executor` as for a detector. */
BOXSTREAM_C_API boxstream_status boxstream_world_create(boxstream_scalar scalar, const boxstream_executor* executor,
                                                        boxstream_world** out);
/* With BOXSTREAM_HYBRID each update in which a box has changed is one search of all. */
BOXSTREAM_C_API boxstream_status boxstream_world_create_with(boxstream_scalar scalar,
                                                             const boxstream_executor* executor,
                                                             boxstream_method method, uint32_t cutoff,
                                                             boxstream_world** out);
BOXSTREAM_C_API void boxstream_world_destroy(boxstream_world* world);

/* `out` has room for an id of each box. `users` is user data of each, or NULL. Pairs begin at the next update. */
BOXSTREAM_C_API boxstream_status boxstream_world_insert(boxstream_world* world, const boxstream_boxes* boxes,
                                                        const uint64_t* users, boxstream_id* out);
/* Ids that are not live are passed over; `live` (may be NULL) is how many were. */
BOXSTREAM_C_API boxstream_status boxstream_world_remove(boxstream_world* world, const boxstream_id* ids, size_t count,
                                                        size_t* live);
/* New boxes for `boxes->count` ids; filters of `boxes` are not used. */
BOXSTREAM_C_API boxstream_status boxstream_world_move(boxstream_world* world, const boxstream_id* ids,
                                                      const boxstream_boxes* boxes, size_t* live);
/* False: no live id. */
BOXSTREAM_C_API bool boxstream_world_set_filter(boxstream_world* world, boxstream_id id, boxstream_filter filter);
BOXSTREAM_C_API bool boxstream_world_contains(const boxstream_world* world, boxstream_id id);
/* 0 without a live id. */
BOXSTREAM_C_API uint64_t boxstream_world_user(const boxstream_world* world, boxstream_id id);
BOXSTREAM_C_API size_t boxstream_world_size(const boxstream_world* world);

/* Brings pairs up to date. `accept` may be NULL: groups and masks decide alone. */
BOXSTREAM_C_API boxstream_status boxstream_world_update(boxstream_world* world, boxstream_pair_filter accept,
                                                        void* user, boxstream_world_stats* stats);
/* Pairs that began, and ended, in the last update; valid until the next call that changes the world. */
BOXSTREAM_C_API const boxstream_id_pair* boxstream_world_begun(const boxstream_world* world, size_t* count);
BOXSTREAM_C_API const boxstream_id_pair* boxstream_world_ended(const boxstream_world* world, size_t* count);
BOXSTREAM_C_API uint64_t boxstream_world_pair_count(const boxstream_world* world);
/* Gives back what memory its boxes and pairs do not need. */
BOXSTREAM_C_API boxstream_status boxstream_world_shrink_to_fit(boxstream_world* world);
/* All pairs held, in batches. False stops. */
BOXSTREAM_C_API boxstream_status boxstream_world_stream_pairs(
    const boxstream_world* world, bool (*sink)(void* user, const boxstream_id_pair* pairs, size_t count), void* user);

/* Proxies that touch a box of 6 numbers, exactly. */
BOXSTREAM_C_API boxstream_status boxstream_world_query_box(const boxstream_world* world, const double box[6],
                                                           boxstream_visitor visit, void* user);
/* Proxies on the segment from `origin` to origin + length * direction. */
BOXSTREAM_C_API boxstream_status boxstream_world_query_ray(const boxstream_world* world, const double origin[3],
                                                           const double direction[3], double length,
                                                           boxstream_ray_visitor visit, void* user);
/* Fills `out` with the `room` proxies nearest to a point, nearest first; `*found` (may be NULL) is fewer if there are
   no more. */
BOXSTREAM_C_API boxstream_status boxstream_world_query_nearest(const boxstream_world* world, const double point[3],
                                                               boxstream_id* out, size_t room, size_t* found);
/* Proxies nearer to a box than `limit` (which may be INFINITY), roughly nearest first; none is left out. */
BOXSTREAM_C_API boxstream_status boxstream_world_query_near(const boxstream_world* world, const double box[6],
                                                            double limit, boxstream_near_visitor visit, void* user);
/* Pairs of proxies nearer than `limit`. */
BOXSTREAM_C_API boxstream_status boxstream_world_near_pairs(const boxstream_world* world, double limit,
                                                            boxstream_near_pair_visitor visit, void* user);

#ifdef __cplusplus
}
#endif

#endif
