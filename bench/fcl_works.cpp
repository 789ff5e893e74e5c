// SPDX-License-Identifier: MIT
#include "fcl_works.hpp"

#include <algorithm>
#include <bit>
#include <limits>

namespace boxstream::bench {

namespace {

using Object = ::fcl::CollisionObject<double>;

constexpr FclWork works[] = {
    {"register", "a new manager, registerObjects and setup", FclChange::made, FclQuery::none},
    {"fill", "the same, and all pairs once", FclChange::made, FclQuery::self},
    {"small", "update() after every box moved up to 10 % of its side on each axis, and all pairs", FclChange::all_moved,
     FclQuery::self, Motion::brown},
    {"teleport", "update() after every box took the place of another, and all pairs", FclChange::all_moved,
     FclQuery::self, Motion::teleport},
    {"few", "update(list) of the same 1 % of the boxes, which moved a little, and all pairs", FclChange::some_moved,
     FclQuery::self, Motion::brown, 100},
    {"self", "all pairs, when nothing has changed since the last time", FclChange::none, FclQuery::self},
    {"object", "500 objects, one after another", FclChange::none, FclQuery::object},
    {"cross", "all pairs with a second manager of 10 large objects", FclChange::none, FclQuery::cross},
    {"first", "the first pair, when nothing has changed", FclChange::none, FclQuery::first},
    {"hurry", "update() after small motion, and the first pair", FclChange::all_moved, FclQuery::first, Motion::brown},
    {"near", "the least distance between two objects; few boxes touch", FclChange::none, FclQuery::nearest,
     Motion::asleep, 1, true},
    {"near-obj", "the least distance to the managed ones, of 500 objects", FclChange::none, FclQuery::nearest_object,
     Motion::asleep, 1, true},
    {"near-cross", "the least distance to 10 objects of a second manager", FclChange::none, FclQuery::nearest_cross,
     Motion::asleep, 1, true},
    {"near-hit", "the least distance where many boxes touch and it is soon found to be 0", FclChange::none,
     FclQuery::nearest},
};

std::uint32_t index_of(const Object* object) {
  return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(object->getUserData()));
}

/// What callbacks get.
struct Tally {
  FclAnswer* answer;
  bool candidates;
  bool stops;
  double least = std::numeric_limits<double>::max();
};

bool count(Object* x, Object* y, void* data) {
  Tally& tally = *static_cast<Tally*>(data);
  ++tally.answer->calls;
  if (tally.candidates && !x->getAABB().overlap(y->getAABB())) return false;
  ++tally.answer->hits;
  return tally.stops;
}

bool count_and_tell(Object* x, Object* y, void* data) {
  Tally& tally = *static_cast<Tally*>(data);
  const std::uint64_t hits = tally.answer->hits;
  const bool stop = count(x, y, data);
  if (tally.answer->hits != hits) tally.answer->pairs.add(index_of(x), index_of(y));
  return stop;
}

/// The distance of the spheres inside the boxes: cheap, no less than that of the boxes, and mostly more, as shapes have
/// it.
bool measure(Object* x, Object* y, void* data, double& limit) {
  Tally& tally = *static_cast<Tally*>(data);
  ++tally.answer->calls;
  const ::fcl::AABB<double>& a = x->getAABB();
  const ::fcl::AABB<double>& b = y->getAABB();
  const double radii = ((a.max_ - a.min_).minCoeff() + (b.max_ - b.min_).minCoeff()) / 2;
  const double distance = std::max(0.0, (a.center() - b.center()).norm() - radii);
  tally.least = std::min(tally.least, distance);
  limit = tally.least;
  return tally.least <= 0;
}

}  // namespace

Span<const FclWork> fcl_works() {
  return works;
}

void FclWorker::fill() {
  manager_ = kind_->make(cast_->moving.boxes());
  manager_->registerObjects(cast_->pointers);
  manager_->setup();
}

void FclWorker::prepare() {
  if (work_->change != FclChange::made) fill();
  if (work_->query != FclQuery::cross && work_->query != FclQuery::nearest_cross) return;
  other_ = kind_->make(cast_->moving.boxes());
  other_->registerObjects(cast_->other_pointers);
  other_->setup();
}

void FclWorker::work(FclAnswer& answer) {
  switch (work_->change) {
    case FclChange::none:
      break;
    case FclChange::made:
      fill();
      break;
    case FclChange::all_moved:
      if (kind_->lists_all)
        manager_->update(cast_->pointers);
      else
        manager_->update();
      break;
    case FclChange::some_moved:
      if (kind_->partial_update)
        manager_->update(cast_->moved);
      else
        manager_->update();
      break;
  }
  if (is_distance(work_->query))
    ask_distance(answer);
  else
    ask(answer, count);
}

void FclWorker::check(FclAnswer& answer) const {
  if (is_distance(work_->query))
    ask_distance(answer);
  else
    ask(answer, count_and_tell);
  // Which pair comes first is up to the manager.
  if (work_->query == FclQuery::first) answer.pairs = {answer.hits, 0};
}

void FclWorker::ask(FclAnswer& answer, ::fcl::CollisionCallBack<double> on_pair) const {
  Tally tally{&answer, kind_->candidates, work_->query == FclQuery::first};
  switch (work_->query) {
    case FclQuery::object:
      for (FclObject<double>& query : cast_->queries) manager_->collide(&query, &tally, on_pair);
      break;
    case FclQuery::cross:
      manager_->collide(other_.get(), &tally, on_pair);
      break;
    case FclQuery::none:
      break;
    default:
      manager_->collide(&tally, on_pair);
  }
}

void FclWorker::ask_distance(FclAnswer& answer) const {
  Tally tally{&answer, false, false};
  const auto note = [&] {
    ++answer.hits;
    answer.nearest = (answer.nearest + std::bit_cast<std::uint64_t>(tally.least)) * 0x9e3779b97f4a7c15u;
    tally.least = std::numeric_limits<double>::max();
  };
  switch (work_->query) {
    case FclQuery::nearest_object:
      for (FclObject<double>& query : cast_->queries) {
        manager_->distance(&query, &tally, measure);
        note();
      }
      break;
    case FclQuery::nearest_cross:
      manager_->distance(other_.get(), &tally, measure);
      note();
      break;
    default:
      manager_->distance(&tally, measure);
      note();
  }
}

void FclWorker::release() {
  if (work_->change == FclChange::made) manager_.reset();
}

}  // namespace boxstream::bench
