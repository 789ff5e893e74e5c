// SPDX-License-Identifier: MIT
#include "simulation/query/contestant.hpp"

#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include <algorithm>
#include <chrono>

namespace boxstream::query {
namespace {

using Clock = std::chrono::steady_clock;
using FclObject = ::fcl::CollisionObject<double>;

double ms_since(Clock::time_point begun) {
  return std::chrono::duration<double, std::milli>(Clock::now() - begun).count();
}

/// What the callbacks of one query share.
struct Asking {
  const Query& query;
  const ObjectMotion& motion;
  Answer& answer;
};

/// The two objects in an order that does not depend on the manager: FCL's solvers give other last digits for (b, a).
struct Oriented {
  const FclObject* first;
  const FclObject* second;
  Hit hit;

  Oriented(const FclObject* x, const FclObject* y) : first(x), second(y) {
    auto i = WideObject::of(x).index(), j = WideObject::of(y).index();
    if (j < i) std::swap(i, j), std::swap(first, second);
    hit.a = static_cast<std::uint32_t>(i);
    hit.b = static_cast<std::uint32_t>(j);
  }
};

/// Counts the callback; false if the pair is to be skipped.
bool admit(Asking& asking, const Oriented& pair) {
  ++asking.answer.callbacks;
  if (pair.hit.a != pair.hit.b &&
      !belong_together(asking.motion.objects()[pair.hit.a], asking.motion.objects()[pair.hit.b]))
    return true;
  ++asking.answer.skipped;
  return false;
}

/// Runs `solve`, timed; false if it threw.
template <class Solve>
bool narrow(Answer& answer, Solve&& solve) {
  const Clock::time_point begun = Clock::now();
  bool solved = true;
  try {
    solve();
  } catch (const std::exception&) {
    ++answer.failures;
    solved = false;
  }
  answer.narrow_ms += ms_since(begun);
  return solved;
}

/// Never below the distance of the boxes, which FCL's result is now and then: pairs that a manager leaves out because
/// of their boxes could have changed the answer otherwise.
double shape_distance(Answer& answer, const Oriented& pair, double box_distance) {
  const ::fcl::DistanceRequest<double> request;
  ::fcl::DistanceResult<double> result;
  double distance = 0;
  if (!narrow(answer, [&] { distance = ::fcl::distance(pair.first, pair.second, request, result); })) distance = 0;
  return std::max(distance, box_distance);
}

bool on_touch(FclObject* x, FclObject* y, void* data) {
  Asking& asking = *static_cast<Asking*>(data);
  Oriented pair(x, y);
  if (!admit(asking, pair)) return false;
  const bool first = asking.query.kind == Kind::first;
  ::fcl::CollisionRequest<double> request(first ? 1 : static_cast<std::size_t>(asking.query.contacts), !first);
  ::fcl::CollisionResult<double> result;
  const bool solved = narrow(asking.answer, [&] { ::fcl::collide(pair.first, pair.second, request, result); });
  if (solved && !result.isCollision()) return false;
  asking.answer.touching = true;
  if (first) return true;
  pair.hit.contacts = static_cast<std::uint32_t>(result.numContacts());
  asking.answer.hits.push_back(pair.hit);
  return false;
}

bool on_near(FclObject* x, FclObject* y, void* data) {
  Asking& asking = *static_cast<Asking*>(data);
  Oriented pair(x, y);
  // The boxes are wide: theirs is no bound here.
  if (!admit(asking, pair)) return false;
  pair.hit.distance = shape_distance(asking.answer, pair, 0);
  if (!(pair.hit.distance <= asking.query.limit)) return false;
  asking.answer.distance = std::min(asking.answer.distance, pair.hit.distance);
  asking.answer.touching |= pair.hit.distance <= 0;
  asking.answer.hits.push_back(pair.hit);
  return false;
}

bool on_distance(FclObject* x, FclObject* y, void* data, double& least) {
  Asking& asking = *static_cast<Asking*>(data);
  const Oriented pair(x, y);
  if (!admit(asking, pair)) return false;
  const double distance = shape_distance(asking.answer, pair, pair.first->getAABB().distance(pair.second->getAABB()));
  asking.answer.distance = std::min(asking.answer.distance, distance);
  asking.answer.touching |= distance <= 0;
  least = asking.answer.distance;
  return least <= 0;
}

void sort_hits(Answer& answer) {
  const auto pair_of = [](const Hit& h) { return std::pair(h.a, h.b); };
  std::sort(answer.hits.begin(), answer.hits.end(),
            [&](const Hit& x, const Hit& y) { return pair_of(x) < pair_of(y); });
  // FCL's interval tree calls back twice for a pair of two managers.
  const auto end = std::unique(answer.hits.begin(), answer.hits.end(),
                               [&](const Hit& x, const Hit& y) { return pair_of(x) == pair_of(y); });
  answer.hits.erase(end, answer.hits.end());
  for (const Hit& hit : answer.hits) answer.contacts += hit.contacts;
}

}  // namespace

Contestant::Contestant(const std::string& name, const QueryScene& scene, const ObjectMotion& motion,
                       const Objects& objects)
    : name_(name), motion_(motion), objects_(objects) {
  const Clock::time_point begun = Clock::now();
  for (std::size_t group = 0; group < scene.groups.size(); ++group) {
    managers_.push_back(make_manager(name, objects.extent_of(group)));
    managers_.back()->registerObjects(objects.all_of(group));
    managers_.back()->setup();
  }
  register_ms_ = ms_since(begun);
}

double Contestant::update() {
  const Clock::time_point begun = Clock::now();
  for (std::size_t group = 0; group < managers_.size(); ++group) {
    const Objects::Pointers& moving = objects_.moving_of(group);
    if (moving.empty()) continue;
    if (moving.size() == objects_.all_of(group).size() || !updates_lists(name_)) {
      managers_[group]->update();
    } else {
      managers_[group]->update(moving);
    }
  }
  return ms_since(begun);
}

Answer Contestant::ask(const Query& query) const {
  Answer answer;
  Asking asking{query, motion_, answer};
  const Manager& a = *managers_[query.a];
  Manager* const b = query.b ? managers_[*query.b].get() : nullptr;
  const auto on_pair = query.kind == Kind::within ? on_near : on_touch;
  const bool distance = query.kind == Kind::distance;
  const Clock::time_point begun = Clock::now();
  if (query.each_object) {
    for (FclObject* const object : objects_.all_of(query.a)) {
      if (distance) {
        b->distance(object, &asking, on_distance);
        if (answer.distance <= 0) break;
      } else {
        b->collide(object, &asking, on_pair);
        if (query.kind == Kind::first && answer.touching) break;
      }
    }
  } else if (distance) {
    a.distance(b, &asking, on_distance);
  } else if (b) {
    a.collide(b, &asking, on_pair);
  } else {
    a.collide(&asking, on_pair);
  }
  answer.broad_ms = ms_since(begun) - answer.narrow_ms;
  sort_hits(answer);
  return answer;
}

}  // namespace boxstream::query
