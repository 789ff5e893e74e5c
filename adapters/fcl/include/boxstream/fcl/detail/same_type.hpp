// SPDX-License-Identifier: MIT
// CollisionManager: a test whether another manager is of the same type, for programs built without RTTI, in part or in
// all. It asks for the size, which all managers tell: those of this type see that the question is about them.
#pragma once

#include <boxstream/fcl.hpp>

namespace boxstream::fcl {

/// Null if `other` is of another type.
template <class S>
const CollisionManager<S>* CollisionManager<S>::as_same_type(const Base& other) {
  asked_ = &other;
  static_cast<void>(other.size());
  const bool is_answered = asked_ == nullptr;
  asked_ = nullptr;
  return is_answered ? static_cast<const CollisionManager*>(&other) : nullptr;
}

}  // namespace boxstream::fcl
