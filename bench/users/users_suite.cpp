// SPDX-License-Identifier: MIT
#include "users/users.hpp"

#include <algorithm>
#include <vector>

namespace boxstream::bench {

namespace {

struct Half {
  void (*run)(const Options& options, Report& report, Progress& progress);
  bool (*has_case)(const std::string& name);
  std::string (*describe)();
};

// One half may be missing, or both.
const std::vector<Half> halves = {
#ifdef BOXSTREAM_BENCH_FCL
    {run_fcl_users, is_fcl_user, describe_fcl_users},
#endif
#ifdef BOXSTREAM_BENCH_BULLET_USERS
    {run_bullet_users, is_bullet_user, describe_bullet_users},
#endif
};

}  // namespace

void run_users_suite(const Options& options, Report& report, Progress& progress) {
  for (const Half& half : halves) {
    Options own = options;
    std::erase_if(own.cases, [&](const std::string& name) { return !half.has_case(name); });
    if (options.cases.empty() || !own.cases.empty()) half.run(own, report, progress);
  }
}

bool is_users_case(const std::string& name) {
  return std::any_of(halves.begin(), halves.end(), [&](const Half& half) { return half.has_case(name); });
}

std::string describe_users() {
  std::string text;
  for (const Half& half : halves) text += half.describe();
  return text;
}

}  // namespace boxstream::bench
