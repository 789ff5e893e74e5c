// SPDX-License-Identifier: MIT
#include "fcl_check.hpp"

#include <algorithm>
#include <cstdio>
#include <functional>
#include <string>

namespace boxstream::preload {
namespace {

std::string text_of(const Object* object) {
  const auto& box = object->getAABB();
  char text[256];
  std::snprintf(text, sizeof text, "[%.17g %.17g %.17g, %.17g %.17g %.17g]", box.min_[0], box.min_[1], box.min_[2],
                box.max_[0], box.max_[1], box.max_[2]);
  return text;
}

void note_difference(const Front& front, const std::string& text) {
  front.tally->differing_queries.fetch_add(1);
  char* const first = front.tally->first_difference;
  if (!first[0]) std::snprintf(first, sizeof front.tally->first_difference, "%s", text.c_str());
}

/// The pairs whose boxes touch, as a set. FCL's own managers differ in which object of a pair comes first; one of them
/// reports pairs twice, and one all objects, whether they touch or not.
Pairs as_set(Pairs pairs) {
  std::erase_if(pairs, [](const auto& pair) { return !pair.first->getAABB().overlap(pair.second->getAABB()); });
  for (auto& pair : pairs) {
    if (std::less<>()(pair.second, pair.first)) std::swap(pair.first, pair.second);
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

}  // namespace

bool Found::note(Object* a, Object* b, void* to) {
  if (a != b) static_cast<Found*>(to)->pairs.emplace_back(a, b);
  return false;
}

bool Nearest::note(Object* a, Object* b, void* to, double& distance) {
  auto& nearest = *static_cast<Nearest*>(to);
  const double found = a->getAABB().distance(b->getAABB());
  if (a != b && found < nearest.distance) nearest = {found, a, b};
  distance = nearest.distance;
  return false;
}

Pairs check_pairs(const Front& front, FunctionRef<void(Found&)> ask_own, FunctionRef<void(Found&)> ask_ours) {
  Found own, ours;
  ask_own(own);
  ask_ours(ours);
  front.tally->checked_queries.fetch_add(1);
  front.tally->checked_pairs.fetch_add(own.pairs.size());
  const Pairs a = as_set(own.pairs);
  const Pairs b = as_set(ours.pairs);
  if (b.size() < ours.pairs.size()) note_difference(front, "boxstream reports pairs that do not touch, or one twice");
  if (a == b) return own.pairs;
  const auto [in_a, in_b] = std::mismatch(a.begin(), a.end(), b.begin(), b.end());
  const bool lacks = in_b == b.end() || (in_a != a.end() && *in_a < *in_b);
  const auto& pair = lacks ? *in_a : *in_b;
  note_difference(front, std::string(lacks ? "boxstream lacks the pair " : "boxstream has the pair ") +
                             text_of(pair.first) + ", " + text_of(pair.second));
  return own.pairs;
}

void check_distance(const Front& front, FunctionRef<void(Nearest&)> ask_own, FunctionRef<void(Nearest&)> ask_ours) {
  Nearest own, ours;
  ask_own(own);
  ask_ours(ours);
  front.tally->checked_queries.fetch_add(1);
  if (own.distance == ours.distance) return;
  const auto text = [](const Nearest& nearest) {
    return std::to_string(nearest.distance) +
           (nearest.a ? " between " + text_of(nearest.a) + " and " + text_of(nearest.b) : std::string());
  };
  note_difference(front, "least distance of boxes: FCL's " + text(own) + ", boxstream's " + text(ours));
}

}  // namespace boxstream::preload
