// SPDX-License-Identifier: MIT
#include <boxstream/boxstream.hpp>
#include <boxstream/tbb.hpp>

#include <cstdio>
#include <vector>

int main() {
  const int n = 40000;
  std::vector<boxstream::Aabb> boxes;
  for (int i = 0; i < n; ++i) boxes.push_back({{float(i), 0, 0}, {float(i + 1), 1, 1}});
  boxstream::TbbExecutor executor;
  std::vector<boxstream::Pair> alone, together;
  boxstream::Detector().find_pairs(boxes, alone);
  boxstream::Detector({&executor}).find_pairs(boxes, together);
  if (together.size() == n - 1 && together == alone) return 0;
  std::printf("wrong: %zu pairs on %u threads, %zu on one\n", together.size(), executor.concurrency(), alone.size());
  return 1;
}
