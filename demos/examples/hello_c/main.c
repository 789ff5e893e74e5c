/* SPDX-License-Identifier: MIT */
/* All pairs of boxes that touch, and pairs that begin and end while boxes move. */
#include <boxstream/boxstream.h>

#include <stdio.h>

int main(void) {
  /* min x, y, z, max x, y, z */
  float crates[] = {
      0, 0, 0, 1, 1, 1,
      1, 0, 0, 2, 1, 1, /* shares a face with the first: touching counts */
      5, 5, 5, 6, 6, 6,
  };
  const boxstream_boxes boxes = boxstream_float_boxes(crates, 3);

  boxstream_detector* detector;
  if (boxstream_detector_create(NULL, &detector) != BOXSTREAM_OK) return 1;
  const boxstream_pair* pairs;
  size_t count;
  if (boxstream_find_pairs(detector, &boxes, NULL, &pairs, &count, NULL) != BOXSTREAM_OK) {
    fprintf(stderr, "%s\n", boxstream_error_text());
    return 1;
  }
  for (size_t i = 0; i < count; ++i) printf("crates %u and %u touch\n", pairs[i].a, pairs[i].b);
  boxstream_detector_destroy(detector);

  boxstream_world* world;
  boxstream_id ids[3];
  if (boxstream_world_create(BOXSTREAM_FLOAT, NULL, &world) != BOXSTREAM_OK) return 1;
  boxstream_world_insert(world, &boxes, NULL, ids);
  boxstream_world_update(world, NULL, NULL, NULL);
  crates[6] += 4, crates[9] += 4; /* the second goes 4 along x */
  boxstream_world_move(world, ids, &boxes, NULL);
  boxstream_world_update(world, NULL, NULL, NULL);
  boxstream_world_ended(world, &count);
  printf("it moves: %zu pair ended\n", count);
  boxstream_world_destroy(world);
  return 0;
}
