// SPDX-License-Identifier: MIT
// CollisionManager: a test whether another manager is of the same type, for programs built without RTTI, in part or in
// all. It calls getObjects, the one call of FCL's interface with an out parameter, with a list that begins with a mark.
// Managers of this type recognise the mark and answer; all others replace the list by their objects.
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

/// False if `objects` does not begin with the mark.
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
