// SPDX-License-Identifier: MIT
// Exceptions of the library reach the program, those of the program pass through the library, and it calls an executor
// of the program.
#include <boxstream/boxstream.hpp>

#include <cstdio>
#include <stdexcept>
#include <typeinfo>
#include <vector>

namespace {

struct Stop {};

class Counting : public boxstream::Executor {
 public:
  unsigned concurrency() const override { return 4; }
  void parallel_for(std::size_t count, boxstream::FunctionRef<void(std::size_t)> task) override {
    ++calls;
    for (std::size_t i = 0; i < count; ++i) task(i);
  }
  int calls = 0;
};

template <class Exception, class Work>
bool throws(Work&& work, const char* what) {
  try {
    work();
  } catch (const Exception&) {
    return true;
  }
  std::printf("wrong: %s\n", what);
  return false;
}

}  // namespace

int main() {
  std::vector<boxstream::Aabb> boxes;
  for (int i = 0; i < 200000; ++i) boxes.push_back({{float(i), 0, 0}, {float(i + 1), 1, 1}});
  Counting executor;
  boxstream::Detector detector({&executor});
  std::vector<boxstream::Pair> pairs;
  const boxstream::Filter filter[] = {{}};
  bool good = throws<std::invalid_argument>([&] { detector.find_pairs(boxes, pairs, filter); }, "one filter for all");
  good &= throws<Stop>(
      [&] { detector.stream_pairs(boxes, [](boxstream::Span<const boxstream::Pair>) -> bool { throw Stop(); }); },
      "a sink that throws");
  detector.find_pairs(boxes, pairs);
  boxstream::Executor& base = executor;
  good &= pairs.size() == 199999 && executor.calls > 0 && typeid(base) == typeid(Counting);
  return good ? 0 : 1;
}
