// SPDX-License-Identifier: MIT
#pragma once
#include <boxstream/fcl.hpp>
namespace boxstream::fcl {
template <class S>
void CollisionManager<S>::distance(Object*, void*, DistanceCallBack) const {}
template <class S>
void CollisionManager<S>::distance(void*, DistanceCallBack) const {}
template <class S>
void CollisionManager<S>::distance(Base*, void*, DistanceCallBack) const {}
}  // namespace boxstream::fcl
