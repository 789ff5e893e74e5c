// SPDX-License-Identifier: MIT
// Prints how much is compared for each hard family: bounds [SIZE ...] [double] [two] [hybrid] [steps]
// [of=PART_OF_A_NAME]
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "hard_boxes.hpp"

namespace boxstream::tests {
namespace {

struct Wanted {
  std::vector<std::size_t> sizes;
  bool in_double = false, two_sets = false, steps = false, hybrid = false;
  std::string part;
};

template <class S>
void print(const Wanted& wanted, const std::string& name, Boxes<S> boxes, Detector& detector, Pairs& pairs) {
  if (wanted.steps) move_by_one_step(boxes, 1);
  const auto first = every_other(boxes, 0), second = every_other(boxes, 1);
  const auto start = std::chrono::steady_clock::now();
  const Stats stats = wanted.two_sets ? detector.find_pairs(first, second, pairs) : detector.find_pairs(boxes, pairs);
  const double ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  const auto n = static_cast<double>(boxes.size());
  std::printf("%8.4f %8zu %9.1f %7.2f %8.2f %9.2f %5llu %5llu  %s\n", work_by_bound(stats), boxes.size(),
              static_cast<double>(stats.tests) / n, static_cast<double>(stats.records) / n,
              static_cast<double>(stats.pairs) / n, ms, static_cast<unsigned long long>(stats.nodes),
              static_cast<unsigned long long>(stats.over_budget), name.c_str());
  std::fflush(stdout);
}

template <class S>
void print_all(const Wanted& wanted) {
  DetectorOptions options;
  if (wanted.hybrid) options.method = Method::hybrid;
  Detector detector(options);
  Pairs pairs;
  std::printf("of bound        n tests/box rec/box pairs/box      ms nodes  over  family\n");
  for (const std::size_t n : wanted.sizes)
    for (const batches::HardFamily& family : batches::hard_families())
      if (family.name.find(wanted.part) != std::string::npos)
        print(wanted, family.name, hard_boxes<S>(family, n, 1), detector, pairs);
}

}  // namespace
}  // namespace boxstream::tests

int main(int argc, char** argv) {
  boxstream::tests::Wanted wanted;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "double")
      wanted.in_double = true;
    else if (word == "two")
      wanted.two_sets = true;
    else if (word == "hybrid")
      wanted.hybrid = true;
    else if (word == "steps")
      wanted.steps = true;
    else if (word.rfind("of=", 0) == 0)
      wanted.part = word.substr(3);
    else
      wanted.sizes.push_back(std::strtoull(argv[i], nullptr, 10));
  }
  if (wanted.sizes.empty()) wanted.sizes = {1000, 10000, 100000};
  if (wanted.in_double)
    boxstream::tests::print_all<double>(wanted);
  else
    boxstream::tests::print_all<float>(wanted);
}
