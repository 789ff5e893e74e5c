// SPDX-License-Identifier: MIT
#include "simulation/run/profile_zones.hpp"

#include <cstring>

namespace boxstream::scenes {
namespace {

thread_local ProfileZones* active = nullptr;

constexpr const char* zone_names[] = {"updateAabbs", "calculateOverlappingPairs", "dispatchAllCollisionPairs",
                                      "solveConstraints"};

}  // namespace

ProfileZones::ProfileZones(measure::Clock clock)
    : clock_(clock),
      former_enter_(btGetCurrentEnterProfileZoneFunc()),
      former_leave_(btGetCurrentLeaveProfileZoneFunc()) {
  active = this;
  btSetCustomEnterProfileZoneFunc(&ProfileZones::enter);
  btSetCustomLeaveProfileZoneFunc(&ProfileZones::leave);
}

ProfileZones::~ProfileZones() {
  btSetCustomEnterProfileZoneFunc(former_enter_);
  btSetCustomLeaveProfileZoneFunc(former_leave_);
  active = nullptr;
}

void ProfileZones::enter(const char* name) {
  ProfileZones* const self = active;
  if (self == nullptr) return;
  ++self->depth_;
  if (self->timed_depth_ != 0) return;
  for (std::size_t zone = 0; zone < zone_count; ++zone) {
    if (std::strcmp(name, zone_names[zone]) != 0) continue;
    self->timed_ = static_cast<Zone>(zone);
    self->timed_depth_ = self->depth_;
    self->start_ = measure::now(self->clock_);
    return;
  }
}

void ProfileZones::leave() {
  ProfileZones* const self = active;
  if (self == nullptr) return;
  if (self->timed_depth_ == self->depth_) {
    self->time_[self->timed_] += measure::now(self->clock_) - self->start_;
    self->timed_depth_ = 0;
  }
  --self->depth_;
}

}  // namespace boxstream::scenes
