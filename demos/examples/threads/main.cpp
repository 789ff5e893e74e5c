// SPDX-License-Identifier: MIT
// The library owns no threads: an Executor lends it yours. The pairs and their order are the same with any number.
#include <boxstream/boxstream.hpp>

#include <atomic>
#include <cstdio>
#include <thread>
#include <vector>

namespace {

/// Starts threads for each call; a program with a pool of its own would hand the tasks to that.
class Threads final : public boxstream::Executor {
 public:
  explicit Threads(unsigned count) : count_(count) {}

  unsigned concurrency() const override { return count_; }

  void parallel_for(std::size_t count, boxstream::FunctionRef<void(std::size_t)> task) override {
    std::atomic<std::size_t> next = 0;
    const auto work = [&] {
      for (std::size_t i = next++; i < count; i = next++) task(i);
    };
    std::vector<std::thread> others;
    for (unsigned i = 1; i < count_; ++i) others.emplace_back(work);
    work();
    for (std::thread& other : others) other.join();
  }

 private:
  unsigned count_;
};

}  // namespace

int main() {
  std::vector<boxstream::Aabb> boxes;
  for (int i = 0; i < 100'000; ++i) {
    const float x = float(i % 100), y = float(i / 100 % 100), z = float(i / 10'000);
    boxes.push_back({{x, y, z}, {x + 1, y + 1, z + 1}});
  }
  std::vector<boxstream::Pair> alone, together;
  boxstream::Detector().find_pairs(boxes, alone);
  Threads threads(4);
  boxstream::Detector({&threads}).find_pairs(boxes, together);
  std::printf("%zu pairs, the same on one thread and on four: %s\n", together.size(), together == alone ? "yes" : "no");
}
