// SPDX-License-Identifier: MIT
#include "judge.hpp"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <vector>

#include "sizes.hpp"

namespace worlds_tests {
namespace {

/// A criterion that Bullet does not meet, whatever finds the pairs.
struct KnownFailure {
  const char* world;
  const char* criterion;
  const char* precision;  ///< null: both
  const char* reason;
  bool only_whole = false;      ///< a run that is cut short does not come to it
  std::vector<Kind> only_on{};  ///< none: all
};

const std::vector<KnownFailure> known_failures{};

bool is_known(const std::string& world, const std::string& criterion, Kind kind) {
  return std::any_of(known_failures.begin(), known_failures.end(), [&](const KnownFailure& known) {
    return world == known.world && criterion == known.criterion &&
           (known.precision == nullptr || std::strcmp(known.precision, precision()) == 0) &&
           (!known.only_whole || whole_runs()) &&
           (known.only_on.empty() ||
            std::find(known.only_on.begin(), known.only_on.end(), kind) != known.only_on.end());
  });
}

}  // namespace

void judge(const std::string& world, const std::string& criterion, Kind kind, double value, bool passed, Asked asked) {
  std::printf("RESULT\t%s\t%s\t%s\t%s\t%.4g\t%s\n", world.c_str(), criterion.c_str(), precision(), name_of(kind), value,
              passed ? "passed" : "failed");
  if (asked == Asked::of_boxstream && kind != Kind::subject) return;
  EXPECT_EQ(passed, !is_known(world, criterion, kind))
      << world << ": " << criterion << ", " << precision() << ", " << name_of(kind) << ": " << value;
}

std::string test_name(Kind kind) {
  std::string name = name_of(kind);
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

}  // namespace worlds_tests
