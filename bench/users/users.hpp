// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "suites/suites.hpp"

namespace boxstream::bench {

// The worlds that users of FCL and of Bullet have, written as they write them. Each half is present only where its
// engine is.

/// Our FCL manager against FCL's.
void run_fcl_users(const Options& options, Report& report, Progress& progress);
bool is_fcl_user(const std::string& name);
/// A line for each case.
std::string describe_fcl_users();

/// Our broad-phase in Bullet's worlds against Bullet's.
void run_bullet_users(const Options& options, Report& report, Progress& progress);
bool is_bullet_user(const std::string& name);
std::string describe_bullet_users();

}  // namespace boxstream::bench
