// SPDX-License-Identifier: MIT
#include <boxstream/boxstream.hpp>

#include <cstdio>
#include <vector>

namespace {

template <class S>
std::vector<boxstream::BasicAabb<S>> row_of_boxes(int n) {
  std::vector<boxstream::BasicAabb<S>> boxes;
  for (int i = 0; i < n; ++i) boxes.push_back({{S(i), 0, 0}, {S(i + 1), 1, 1}});
  return boxes;
}

bool check(bool good, const char* what) {
  if (!good) std::printf("wrong: %s\n", what);
  return good;
}

}  // namespace

int main() {
  const auto boxes = row_of_boxes<float>(1000);
  const auto boxes64 = row_of_boxes<double>(1000);
  bool good = check(boxstream::find_pairs(boxes).size() == 999, "float pairs");
  good &= check(boxstream::find_pairs(boxes64).size() == 999, "double pairs");

  boxstream::World world;
  const auto a = world.create(boxes[0]);
  const auto b = world.create(boxes[5]);
  good &= check(world.update().begun == 0, "no pair at first");
  world.move(b, boxes[1]);
  good &= check(world.update().begun == 1, "a pair after the move");
  good &= check(world.destroy(a) && world.update().ended == 1, "no pair after the end of one");
  return good ? 0 : 1;
}
