// SPDX-License-Identifier: MIT
#include <boxstream/boxstream.h>

#include <cstdio>

int main() {
  const float crates[] = {0, 0, 0, 1, 1, 1, 1, 0, 0, 2, 1, 1};
  const boxstream_boxes boxes = boxstream_float_boxes(crates, 2);
  boxstream_detector* detector = nullptr;
  const boxstream_pair* pairs = nullptr;
  std::size_t count = 0;
  if (boxstream_detector_create(nullptr, &detector) == BOXSTREAM_OK &&
      boxstream_find_pairs(detector, &boxes, nullptr, &pairs, &count, nullptr) == BOXSTREAM_OK && count == 1) {
    boxstream_detector_destroy(detector);
    return 0;
  }
  std::printf("wrong: %zu pairs, %s\n", count, boxstream_error_text());
  return 1;
}
