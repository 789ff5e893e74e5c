// SPDX-License-Identifier: MIT
#include "suites/fcl_works.hpp"

#include <algorithm>

#include "inputs/batches.hpp"

namespace boxstream::bench {

namespace {

constexpr std::size_t enough_objects = 1000;

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
    {"first", "the first pair, when nothing has changed", FclChange::none, FclQuery::first},
    {"hurry", "update() after small motion, and the first pair", FclChange::all_moved, FclQuery::first, Motion::brown},
};

/// What callbacks get.
struct Tally {
  FclAnswer* answer;
  bool candidates;
  bool stops;
};

bool count(Object* x, Object* y, void* data) {
  Tally& tally = *static_cast<Tally*>(data);
  ++tally.answer->calls;
  if (tally.candidates && !x->getAABB().overlap(y->getAABB())) return false;
  ++tally.answer->hits;
  return tally.stops;
}

bool count_and_record(Object* x, Object* y, void* data) {
  Tally& tally = *static_cast<Tally*>(data);
  const std::uint64_t hits = tally.answer->hits;
  const bool stop = count(x, y, data);
  if (tally.answer->hits != hits) tally.answer->pairs.add(fcl_index(x), fcl_index(y));
  return stop;
}

}  // namespace

std::size_t FclScene::casts_of(std::size_t n) {
  return std::max<std::size_t>(1, enough_objects / n);
}

FclScene::FclScene(const std::string& batch, std::size_t n, std::uint64_t seed, Motion motion, std::size_t one_in)
    : one_in_(one_in) {
  const auto geometry = std::make_shared<::fcl::Sphere<double>>(1.0);
  const std::size_t count = casts_of(n);
  casts_.reserve(count);
  for (std::size_t c = 0; c < count; ++c) {
    const std::uint64_t own_seed = seed + 1000 * c;
    const std::vector<Aabb> boxes = scaled_to_unit_sides(batches::make(batch, n, own_seed));
    casts_.push_back({{}, {}, {}, MovingBoxes(boxes, motion, own_seed)});
    FclCast& cast = casts_.back();
    cast.objects.reserve(n);
    for (std::uint32_t i = 0; i < n; ++i) cast.objects.emplace_back(geometry, i, boxes[i]);
    for (FclObject<double>& object : cast.objects) cast.pointers.push_back(&object);
    for (std::size_t i = 0; i < n; i += one_in) cast.moved.push_back(&cast.objects[i]);
  }
}

void FclScene::next_frame() {
  for (FclCast& cast : casts_) {
    cast.moving.next_frame();
    for (std::size_t i = 0; i < cast.objects.size(); i += one_in_) cast.objects[i].set(cast.moving.boxes()[i]);
  }
}

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
  ask(answer, count);
}

void FclWorker::check(FclAnswer& answer) const {
  ask(answer, count_and_record);
  // Which pair comes first is up to the manager.
  if (work_->query == FclQuery::first) answer.pairs = {answer.hits, 0};
}

void FclWorker::ask(FclAnswer& answer, ::fcl::CollisionCallBack<double> on_pair) const {
  Tally tally{&answer, kind_->candidates, work_->query == FclQuery::first};
  if (work_->query != FclQuery::none) manager_->collide(&tally, on_pair);
}

void FclWorker::release() {
  if (work_->change == FclChange::made) manager_.reset();
}

}  // namespace boxstream::bench
