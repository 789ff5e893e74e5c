// SPDX-License-Identifier: MIT
// CollisionManager: whether another manager is of its type. Programs may be built without RTTI, in part too, so the
// other is asked, by the one call of FCL's interface that takes something to fill in: getObjects. A list with a mark in
// front is a question, which ours answer; all others replace it by their objects, as they would any list.
#pragma once

#include <vector>

#include <boxstream/fcl.hpp>

namespace boxstream::fcl {

/// Passed on as if it were an object, hence the alignment.
template <class S>
struct alignas(typename CollisionManager<S>::Object) CollisionManager<S>::Question {
  const CollisionManager* same = nullptr;
};

/// The address of no object.
template <class S>
typename CollisionManager<S>::Object* CollisionManager<S>::mark_of_question() {
  static Question mark;
  return reinterpret_cast<Object*>(&mark);
}

/// False if `objects` is no question.
template <class S>
bool CollisionManager<S>::answer(const CollisionManager& self, const std::vector<Object*>& objects) {
  if (objects.size() != 2 || objects[0] != mark_of_question()) return false;
  reinterpret_cast<Question*>(objects[1])->same = &self;
  return true;
}

/// Null if `other` is of another type: then `objects` are its own.
template <class S>
const CollisionManager<S>* CollisionManager<S>::as_same_type(const Base& other, std::vector<Object*>& objects) {
  Question question;
  objects = {mark_of_question(), reinterpret_cast<Object*>(&question)};
  other.getObjects(objects);
  // For managers that add to what is there.
  if (question.same == nullptr && objects.size() >= 2 && objects[0] == mark_of_question())
    objects.erase(objects.begin(), objects.begin() + 2);
  return question.same;
}

}  // namespace boxstream::fcl
