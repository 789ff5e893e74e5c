// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <chrono>
#include <cstddef>

#include <LinearMath/btQuickprof.h>

#include "measure/stopwatch.hpp"

namespace boxstream::scenes {

/// Times four of Bullet's own profile zones, in the unmodified library, for as long as it lives: it takes the place of
/// Bullet's profiler, which it puts back at the end. One at a time in a process. Zones entered on other threads are
/// not seen.
class ProfileZones {
 public:
  enum Zone : std::size_t { update_aabbs, overlapping_pairs, dispatch, solve, zone_count };

  explicit ProfileZones(measure::Clock clock);
  ~ProfileZones();
  ProfileZones(const ProfileZones&) = delete;
  ProfileZones& operator=(const ProfileZones&) = delete;

  /// Time inside the zone so far.
  std::chrono::nanoseconds time(Zone zone) const { return time_[zone]; }

 private:
  static void enter(const char* name);
  static void leave();

  std::array<std::chrono::nanoseconds, zone_count> time_{};
  int depth_ = 0;
  int timed_depth_ = 0;  // 0: in none of the four; they are never nested
  Zone timed_ = zone_count;
  measure::Clock clock_;
  std::chrono::nanoseconds start_{};
  btEnterProfileZoneFunc* former_enter_;
  btLeaveProfileZoneFunc* former_leave_;
};

}  // namespace boxstream::scenes
