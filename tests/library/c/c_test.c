/* SPDX-License-Identifier: MIT */
/* The whole interface, from plain C, against brute force. */
#include <boxstream/boxstream.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define CHECK(condition)                                                                           \
  do {                                                                                             \
    if (!(condition)) {                                                                            \
      fprintf(stderr, "%s:%d: %s (%s)\n", __FILE__, __LINE__, #condition, boxstream_error_text()); \
      exit(1);                                                                                     \
    }                                                                                              \
  } while (0)

enum { N = 300 };

static unsigned state = 1;
static double number(double range) {
  state = state * 1664525u + 1013904223u;
  return range * (state >> 8) / (1u << 24);
}

static void fill(double* boxes, size_t count) {
  for (size_t i = 0; i < count; ++i)
    for (int d = 0; d < 3; ++d) {
      boxes[6 * i + d] = floor(number(20));
      boxes[6 * i + 3 + d] = boxes[6 * i + d] + floor(number(4));
    }
}

static bool touch(const double* a, const double* b) {
  for (int d = 0; d < 3; ++d)
    if (a[d] > b[3 + d] || b[d] > a[3 + d]) return false;
  return true;
}

/* The square of the distance of two boxes, whose numbers are whole and small: exact. */
static double square_between(const double* a, const double* b) {
  double sum = 0;
  for (int d = 0; d < 3; ++d) {
    const double gap = fmax(0, fmax(b[d] - a[3 + d], a[d] - b[3 + d]));
    sum += gap * gap;
  }
  return sum;
}

static int compare(const void* a, const void* b) {
  const double x = *(const double*)a, y = *(const double*)b;
  return (x > y) - (x < y);
}

/* A matrix of what touches. */
static bool* matrix(void) {
  bool* all = calloc((size_t)N * N, sizeof(bool));
  CHECK(all != NULL);
  return all;
}

static void mark(bool* all, size_t i, size_t k) {
  CHECK(i < N && k < N && !all[i * N + k]);
  all[i * N + k] = true;
}

static void run_tasks(void* user, size_t count, void (*task)(void* context, size_t i), void* context) {
  for (size_t i = count; i-- > 0;) task(context, i);
  ++*(int*)user;
}
static unsigned two(void* user) {
  (void)user;
  return 2;
}

static uint32_t start_at_once(void* user) {
  (void)user;
  return 0;
}

static bool stop_at_once(void* user, const boxstream_pair* pairs, size_t count) {
  (void)pairs;
  *(size_t*)user += count;
  return false;
}
static bool mark_pairs(void* user, const boxstream_pair* pairs, size_t count) {
  for (size_t i = 0; i < count; ++i) mark(user, pairs[i].a, pairs[i].b);
  return true;
}

static void test_detector(void) {
  double boxes[6 * N];
  float single[6 * N];
  fill(boxes, N);
  for (int i = 0; i < 6 * N; ++i) single[i] = (float)boxes[i];
  int batches = 0;
  const boxstream_executor executor = {sizeof executor, &batches, two, run_tasks, start_at_once};
  boxstream_detector* detector = NULL;
  CHECK(boxstream_detector_create(&executor, &detector) == BOXSTREAM_OK);
  const boxstream_boxes sets[2] = {boxstream_float_boxes(single, N), boxstream_double_boxes(boxes, N)};
  for (int s = 0; s < 2; ++s) {
    const boxstream_pair* pairs;
    size_t count;
    boxstream_stats stats = BOXSTREAM_STATS_INIT;
    CHECK(boxstream_find_pairs(detector, &sets[s], NULL, &pairs, &count, &stats) == BOXSTREAM_OK);
    CHECK(stats.boxes == N && stats.pairs == count && stats.invalid == 0 && stats.tests >= count && count > 0);
    bool *found = matrix(), *streamed = matrix(), *between = matrix();
    for (size_t i = 0; i < count; ++i) mark(found, pairs[i].a, pairs[i].b);
    CHECK(boxstream_stream_pairs(detector, &sets[s], NULL, mark_pairs, streamed, NULL) == BOXSTREAM_OK);
    CHECK(boxstream_stream_pairs(detector, &sets[s], &sets[s], mark_pairs, between, NULL) == BOXSTREAM_OK);
    for (size_t i = 0; i < N; ++i)
      for (size_t k = 0; k < N; ++k) {
        const bool expected = touch(boxes + 6 * i, boxes + 6 * k);
        CHECK(found[i * N + k] == (expected && i < k));
        CHECK(streamed[i * N + k] == found[i * N + k]);
        CHECK(between[i * N + k] == expected);
      }
    size_t seen = 0;
    CHECK(boxstream_stream_pairs(detector, &sets[s], NULL, stop_at_once, &seen, NULL) == BOXSTREAM_OK);
    CHECK(seen > 0);
    free(found), free(streamed), free(between);
  }
  /* Filters: those of group 1 pair with nothing. */
  boxstream_filter filters[N];
  for (int i = 0; i < N; ++i) filters[i] = i % 2 ? (boxstream_filter){1, 0} : (boxstream_filter){1, 1};
  boxstream_boxes filtered = sets[0];
  filtered.filters = filters;
  bool* found = matrix();
  CHECK(boxstream_stream_pairs(detector, &filtered, NULL, mark_pairs, found, NULL) == BOXSTREAM_OK);
  for (size_t i = 0; i < N; ++i)
    for (size_t k = i + 1; k < N; ++k)
      CHECK(found[i * N + k] == (i % 2 == 0 && k % 2 == 0 && touch(boxes + 6 * i, boxes + 6 * k)));
  free(found);
  /* Misuse has a status and a text, and leaves the detector usable. */
  const boxstream_pair* pairs;
  size_t count;
  CHECK(boxstream_find_pairs(detector, &sets[0], &sets[1], &pairs, &count, NULL) == BOXSTREAM_BAD_ARGUMENT);
  CHECK(strcmp(boxstream_error_text(), "two sets of different scalars") == 0);
  CHECK(boxstream_find_pairs(NULL, &sets[0], NULL, &pairs, &count, NULL) == BOXSTREAM_BAD_ARGUMENT);
  CHECK(boxstream_stream_pairs(detector, &sets[0], NULL, NULL, NULL, NULL) == BOXSTREAM_BAD_ARGUMENT);
  boxstream_boxes strange = sets[0];
  strange.scalar = (boxstream_scalar)7;
  CHECK(boxstream_find_pairs(detector, &strange, NULL, &pairs, &count, NULL) == BOXSTREAM_BAD_ARGUMENT);
  strange = boxstream_float_boxes(NULL, 1);
  CHECK(boxstream_find_pairs(detector, &strange, NULL, &pairs, &count, NULL) == BOXSTREAM_BAD_ARGUMENT);
  strange = boxstream_float_boxes(NULL, 0);
  CHECK(boxstream_find_pairs(detector, &strange, NULL, &pairs, &count, NULL) == BOXSTREAM_OK && count == 0);
  boxstream_stats small = {sizeof(size_t) + sizeof(uint64_t), 0, 77, 77, 77};
  CHECK(boxstream_find_pairs(detector, &sets[0], NULL, &pairs, &count, &small) == BOXSTREAM_OK);
  CHECK(small.boxes == N && small.invalid == 77 && small.pairs == 77);

  const float balls[] = {0, 0, 0, 1, 3, 0, 0, 1, 9, 0, 0, 1};
  const boxstream_balls three = {BOXSTREAM_FLOAT, balls, 3};
  CHECK(boxstream_find_near_pairs(detector, &three, 1, &pairs, &count, NULL) == BOXSTREAM_OK);
  CHECK(count == 1 && pairs[0].a == 0 && pairs[0].b == 1);
  CHECK(boxstream_find_near_pairs(detector, &three, -1, &pairs, &count, NULL) == BOXSTREAM_BAD_ARGUMENT);
  CHECK(boxstream_detector_shrink_to_fit(detector) == BOXSTREAM_OK);
  CHECK(boxstream_detector_shrink_to_fit(NULL) == BOXSTREAM_BAD_ARGUMENT);
  CHECK(boxstream_find_near_pairs(detector, &three, 1, &pairs, &count, NULL) == BOXSTREAM_OK && count == 1);
  boxstream_detector_destroy(detector);
  boxstream_detector_destroy(NULL);
}

struct Found {
  const boxstream_id* ids;
  const boxstream_world* world;
  bool seen[N];
  size_t count;
  double nearest;
};

static bool see(void* user, boxstream_id id) {
  struct Found* found = user;
  const size_t index = (size_t)boxstream_world_user(found->world, id) - 1000;
  CHECK(index < N && !found->seen[index]);
  found->seen[index] = true;
  ++found->count;
  return true;
}
static double see_all(void* user, boxstream_id id, double enter, double length) {
  CHECK(enter >= 0 && enter <= length);
  see(user, id);
  return length;
}
static double see_nearest(void* user, boxstream_id id, double distance) {
  struct Found* found = user;
  (void)id;
  if (distance < found->nearest) found->nearest = distance;
  return found->nearest;
}
static const double near_limit = 1.4;
static double count_pairs(void* user, boxstream_id_pair pair, double distance) {
  (void)pair;
  CHECK(distance < near_limit);
  ++*(size_t*)user;
  return near_limit;
}
static bool refuse(void* user, boxstream_id a, boxstream_id b) {
  (void)a, (void)b;
  ++*(size_t*)user;
  return false;
}
static bool add(void* user, const boxstream_id_pair* pairs, size_t count) {
  (void)pairs;
  *(size_t*)user += count;
  return true;
}

/* The paper's tree finds the same. */
static void test_method(void) {
  double boxes[6 * N];
  fill(boxes, N);
  const boxstream_boxes view = boxstream_double_boxes(boxes, N);
  boxstream_id ids[N];
  for (uint32_t cutoff = 0; cutoff < 10; cutoff += 9) {
    boxstream_detector* detector = NULL;
    boxstream_world* world = NULL;
    CHECK(boxstream_detector_create_with(NULL, BOXSTREAM_HYBRID, cutoff, &detector) == BOXSTREAM_OK);
    CHECK(boxstream_world_create_with(BOXSTREAM_DOUBLE, NULL, BOXSTREAM_HYBRID, cutoff, &world) == BOXSTREAM_OK);
    bool* found = matrix();
    CHECK(boxstream_stream_pairs(detector, &view, NULL, mark_pairs, found, NULL) == BOXSTREAM_OK);
    size_t expected = 0;
    for (size_t i = 0; i < N; ++i)
      for (size_t k = i + 1; k < N; ++k) {
        CHECK(found[i * N + k] == touch(boxes + 6 * i, boxes + 6 * k));
        expected += found[i * N + k];
      }
    CHECK(boxstream_world_insert(world, &view, NULL, ids) == BOXSTREAM_OK);
    CHECK(boxstream_world_update(world, NULL, NULL, NULL) == BOXSTREAM_OK);
    CHECK(boxstream_world_pair_count(world) == expected && expected > 0);
    free(found);
    boxstream_detector_destroy(detector);
    boxstream_world_destroy(world);
    detector = NULL;
    world = NULL;
    CHECK(boxstream_detector_create_with(NULL, 7, cutoff, &detector) == BOXSTREAM_BAD_ARGUMENT && detector == NULL);
    CHECK(strcmp(boxstream_error_text(), "a method is BOXSTREAM_PLANNED or BOXSTREAM_HYBRID") == 0);
    CHECK(boxstream_world_create_with(BOXSTREAM_FLOAT, NULL, -1, cutoff, &world) == BOXSTREAM_BAD_ARGUMENT);
  }
}

static void test_world(void) {
  double boxes[6 * N], moved[6 * N];
  uint64_t users[N];
  boxstream_id ids[N];
  fill(boxes, N);
  fill(moved, N);
  for (size_t i = 0; i < N; ++i) users[i] = 1000 + i;
  boxstream_world* world = NULL;
  CHECK(boxstream_world_create(BOXSTREAM_DOUBLE, NULL, &world) == BOXSTREAM_OK);
  boxstream_boxes view = boxstream_double_boxes(boxes, N);
  CHECK(boxstream_world_insert(world, &view, users, ids) == BOXSTREAM_OK);
  CHECK(boxstream_world_size(world) == N && boxstream_world_contains(world, ids[7]));

  size_t asked = 0, count, expected = 0;
  boxstream_world_stats stats = BOXSTREAM_WORLD_STATS_INIT;
  for (size_t i = 0; i < N; ++i)
    for (size_t k = 0; k < i; ++k) expected += touch(boxes + 6 * i, boxes + 6 * k);
  CHECK(boxstream_world_update(world, refuse, &asked, &stats) == BOXSTREAM_OK);
  CHECK(asked == expected && stats.pairs == 0 && stats.proxies == N && expected > 0);

  view = boxstream_double_boxes(moved, N);
  CHECK(boxstream_world_move(world, ids, &view, &count) == BOXSTREAM_OK && count == N);
  CHECK(boxstream_world_update(world, NULL, NULL, &stats) == BOXSTREAM_OK);
  expected = 0;
  for (size_t i = 0; i < N; ++i)
    for (size_t k = 0; k < i; ++k) expected += touch(moved + 6 * i, moved + 6 * k);
  const boxstream_id_pair* pairs = boxstream_world_begun(world, &count);
  CHECK(count == expected && stats.begun == expected && boxstream_world_pair_count(world) == expected);
  for (size_t i = 0; i < count; ++i)
    CHECK(touch(moved + 6 * (boxstream_world_user(world, pairs[i].a) - 1000),
                moved + 6 * (boxstream_world_user(world, pairs[i].b) - 1000)));
  CHECK(boxstream_world_shrink_to_fit(world) == BOXSTREAM_OK);
  CHECK(boxstream_world_shrink_to_fit(NULL) == BOXSTREAM_BAD_ARGUMENT);
  size_t held = 0;
  CHECK(boxstream_world_stream_pairs(world, add, &held) == BOXSTREAM_OK && held == expected);

  const double box[6] = {3, 3, 3, 12, 12, 12}, origin[3] = {-5, 4, 4}, ahead[3] = {1, 0, 0};
  const double point[6] = {1, 2, 3, 1, 2, 3}; /* as a box */
  const double far_box[6] = {100, 0, 0, 101, 1, 1};
  struct Found found = {ids, world, {false}, 0, INFINITY};
  CHECK(boxstream_world_query_box(world, box, see, &found) == BOXSTREAM_OK);
  for (size_t i = 0; i < N; ++i) CHECK(found.seen[i] == touch(box, moved + 6 * i));
  memset(found.seen, 0, sizeof found.seen);
  CHECK(boxstream_world_query_ray(world, origin, ahead, 100, see_all, &found) == BOXSTREAM_OK);
  for (size_t i = 0; i < N; ++i) {
    const double line[6] = {-5, 4, 4, 95, 4, 4};
    CHECK(found.seen[i] == touch(line, moved + 6 * i));
  }
  boxstream_id near_ids[3];
  CHECK(boxstream_world_query_nearest(world, point, near_ids, 3, &count) == BOXSTREAM_OK && count == 3);
  double squares[N];
  for (size_t i = 0; i < N; ++i) squares[i] = square_between(point, moved + 6 * i);
  qsort(squares, N, sizeof *squares, compare);
  for (int i = 0; i < 3; ++i)
    CHECK(square_between(point, moved + 6 * (boxstream_world_user(world, near_ids[i]) - 1000)) == squares[i]);
  CHECK(boxstream_world_query_near(world, far_box, INFINITY, see_nearest, &found) == BOXSTREAM_OK);
  double least = INFINITY;
  for (size_t i = 0; i < N; ++i) least = fmin(least, sqrt(square_between(far_box, moved + 6 * i)));
  CHECK(fabs(found.nearest - least) < 1e-9);
  size_t near_pairs = 0, expected_near = 0;
  for (size_t i = 0; i < N; ++i)
    for (size_t k = 0; k < i; ++k) expected_near += square_between(moved + 6 * i, moved + 6 * k) < 2;
  CHECK(boxstream_world_near_pairs(world, near_limit, count_pairs, &near_pairs) == BOXSTREAM_OK);
  CHECK(near_pairs == expected_near && expected_near > expected);

  CHECK(boxstream_world_set_filter(world, ids[0], (boxstream_filter){0, 0}));
  CHECK(boxstream_world_remove(world, ids, 10, &count) == BOXSTREAM_OK && count == 10);
  CHECK(boxstream_world_remove(world, ids, 10, &count) == BOXSTREAM_OK && count == 0);
  CHECK(!boxstream_world_contains(world, ids[0]) &&
        !boxstream_world_set_filter(world, ids[0], (boxstream_filter){1, 1}));
  CHECK(boxstream_world_user(world, ids[0]) == 0);
  CHECK(boxstream_world_update(world, NULL, NULL, NULL) == BOXSTREAM_OK);
  boxstream_world_ended(world, &count);
  CHECK(boxstream_world_pair_count(world) + count == expected);

  const float single[6] = {0, 0, 0, 1, 1, 1};
  view = boxstream_float_boxes(single, 1);
  CHECK(boxstream_world_insert(world, &view, NULL, ids) == BOXSTREAM_BAD_ARGUMENT);
  CHECK(boxstream_world_size(world) == N - 10);
  boxstream_world_destroy(world);

  size_t none = 7;
  CHECK(boxstream_world_update(NULL, NULL, NULL, NULL) == BOXSTREAM_BAD_ARGUMENT);
  CHECK(boxstream_world_size(NULL) == 0 && boxstream_world_pair_count(NULL) == 0);
  CHECK(!boxstream_world_contains(NULL, ids[0]) && boxstream_world_begun(NULL, &none) == NULL && none == 0);
  boxstream_world_destroy(NULL);
}

int main(void) {
  CHECK(boxstream_version() == BOXSTREAM_EXPECTED_VERSION);
  CHECK(strlen(boxstream_simd_target()) > 0);
  CHECK(strcmp(boxstream_error_text(), "") == 0);
  test_detector();
  test_method();
  test_world();
  puts("passed");
  return 0;
}
