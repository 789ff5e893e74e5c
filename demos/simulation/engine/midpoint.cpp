// SPDX-License-Identifier: MIT
#include "simulation/engine/midpoint.hpp"

#include <algorithm>
#include <cmath>

#include "simulation/engine/convert.hpp"

namespace boxstream::scenes {

Midpoint::Midpoint(btMultiBody& multibody)
    : multibody_(multibody), size_(static_cast<std::size_t>(multibody.getNumDofs() + 6)), search_(size_) {}

void Midpoint::read(Place& place) const {
  place.base = multibody_.getBasePos();
  place.turn = multibody_.getWorldToBaseRot();
  place.joints.clear();
  for (int i = 0; i < multibody_.getNumLinks(); ++i) {
    const btMultibodyLink& link = multibody_.getLink(i);
    place.joints.insert(place.joints.end(), link.m_jointPos, link.m_jointPos + link.m_posVarCount);
  }
}

void Midpoint::go_to(const Place& place) {
  multibody_.setBasePos(place.base);
  multibody_.setWorldToBaseRot(place.turn);
  auto from = place.joints.begin();
  for (int i = 0; i < multibody_.getNumLinks(); ++i) {
    btMultibodyLink& link = multibody_.getLink(i);
    std::copy_n(from, link.m_posVarCount, link.m_jointPos);
    from += link.m_posVarCount;
    link.updateCacheMultiDof();
  }
}

void Midpoint::set_velocity(const Values& values) {
  // As Bullet itself does; what sets a base or a joint is slower and does the same.
  auto* const velocity = const_cast<btScalar*>(multibody_.getVelocityVector());
  for (std::size_t i = 0; i < size_; ++i) velocity[i] = real(values[i]);
}

void Midpoint::read_velocity(Values& values) const {
  values.resize(size_);
  for (std::size_t i = 0; i < size_; ++i) values[i] = double{multibody_.getVelocityVector()[i]};
}

void Midpoint::answer(const Values& middle, Values& out) {
  go_to(at_start_);
  set_velocity(middle);
  multibody_.stepPositionsMultiDof(real(half_));
  multibody_.computeAccelerationsArticulatedBodyAlgorithmMultiDof(0, scalars_, vectors_, matrices_, false, false,
                                                                  false);
  const btScalar* const acceleration = &scalars_[multibody_.getNumDofs()];
  out.resize(size_);
  for (std::size_t i = 0; i < size_; ++i) out[i] = start_[i] + half_ * double{acceleration[i]};
}

/// So that no joint turns by more than about six degrees in one.
int Midpoint::parts_for(double dt) const {
  constexpr double most_turn = 0.1;  // radians
  constexpr int most = 32;
  double rate = std::max({std::abs(first_[0]), std::abs(first_[1]), std::abs(first_[2])});
  for (int i = 0; i < multibody_.getNumLinks(); ++i) {
    const btMultibodyLink& link = multibody_.getLink(i);
    if (link.m_jointType != btMultibodyLink::eRevolute && link.m_jointType != btMultibodyLink::eSpherical) continue;
    for (int k = 0; k < link.m_dofCount; ++k)
      rate = std::max(rate, std::abs(first_[static_cast<std::size_t>(6 + link.m_dofOffset + k)]));
  }
  return static_cast<int>(std::clamp(std::ceil(rate * dt / most_turn), 1.0, double{most}));
}

bool Midpoint::find_in(int parts) {
  constexpr std::size_t most_calls = 30;
  const double part = step_ / parts;
  half_ = part / 2;
  at_start_ = at_first_;
  start_ = first_;
  mean_.assign(size_, 0);
  for (int k = 0; k < parts; ++k) {
    middle_ = start_;
    if (!search_.find(
            middle_, [&](const Values& x, Values& image) { answer(x, image); },
            [](const Values& x, double error) { return error <= 1e-5 * std::max(largest(x), 0.1); }, most_calls))
      return false;
    go_to(at_start_);
    set_velocity(middle_);
    multibody_.stepPositionsMultiDof(real(part));
    read(at_start_);
    for (std::size_t i = 0; i < size_; ++i) {
      mean_[i] += middle_[i] / parts;
      start_[i] = 2 * middle_[i] - start_[i];
    }
  }
  final_ = start_;
  at_end_ = at_start_;
  return true;
}

void Midpoint::find(double dt) {
  constexpr int most_parts = 64;
  runs_ = true;
  step_ = dt;
  read(at_first_);
  read_velocity(first_);
  found_ = false;
  for (int parts = parts_for(dt); !found_ && parts <= most_parts; parts *= 2) found_ = find_in(parts);
  go_to(at_first_);
  set_velocity(first_);
}

void Midpoint::begin() {
  if (!runs_ || !found_) return;
  set_velocity(final_);
  read_velocity(given_);
}

void Midpoint::move(bool rests) {
  // One that was woken up since moves as Bullet has it.
  if (!runs_) return;
  read_velocity(now_);
  jumps_ = found_ && !rests && now_ == given_;
  if (!found_ || rests) return;
  if (jumps_) {
    multibody_.clearVelocities();
    return;
  }
  for (std::size_t i = 0; i < size_; ++i) mean_[i] += (now_[i] - given_[i]) / 2;
  set_velocity(mean_);
}

bool Midpoint::end() {
  if (!runs_) return false;
  runs_ = false;
  if (jumps_) go_to(at_end_);
  set_velocity(now_);
  return jumps_;
}

}  // namespace boxstream::scenes
