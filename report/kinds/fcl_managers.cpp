// SPDX-License-Identifier: MIT
// FCL's narrow phase behind each manager: the same pairs and the same least distance as behind none at all.
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <deque>
#include <limits>

#include "accuracy/stopwatch.hpp"
#include "accuracy/turns.hpp"
#include "all.hpp"
#include "batches/random.hpp"
#include "boxes/pair_difference.hpp"
#include "fcl_managers.hpp"
#include "understood.hpp"

namespace boxstream::report {
namespace {

using nlohmann::json;
using Object = ::fcl::CollisionObject<double>;

std::uint32_t index_of(const Object* object) {
  return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(object->getUserData()));
}

struct Answer {
  std::vector<Pair> touching;
  double least = std::numeric_limits<double>::max();
};

// Both go by the order of indices, because which object comes first may change the last digits of what FCL finds.

bool on_pair(Object* a, Object* b, void* data) {
  if (index_of(b) < index_of(a)) std::swap(a, b);
  ::fcl::CollisionResult<double> result;
  if (::fcl::collide(a, b, ::fcl::CollisionRequest<double>(), result) > 0)
    static_cast<Answer*>(data)->touching.push_back({index_of(a), index_of(b)});
  return false;
}

bool on_distance(Object* a, Object* b, void* data, double& limit) {
  if (index_of(b) < index_of(a)) std::swap(a, b);
  ::fcl::DistanceResult<double> result;
  double& least = static_cast<Answer*>(data)->least;
  least = std::min(least, ::fcl::distance(a, b, ::fcl::DistanceRequest<double>(), result));
  limit = least;
  return least <= 0;
}

struct Objects {
  std::deque<Object> all;
  std::vector<Object*> pointers;
  Answer truth;
};

/// Spheres, boxes and capsules of about the same size, turned at random. `apart`: near the points of a lattice, so that
/// none touches another if they are 2.2 apart; of two that overlap FCL's distance is -1 or a depth, depending on their
/// shapes, and which pair comes first then decides the answer.
std::unique_ptr<Objects> make_objects(std::size_t n, double spacing, bool apart) {
  auto objects = std::make_unique<Objects>();
  batches::Random random(1);
  const double edge = spacing * std::cbrt(static_cast<double>(n));
  for (std::uint32_t i = 0; i < n; ++i) {
    std::shared_ptr<::fcl::CollisionGeometry<double>> geometry;
    if (i % 3 == 0)
      geometry = std::make_shared<::fcl::Sphere<double>>(random.real(0.3, 0.6));
    else if (i % 3 == 1)
      geometry = std::make_shared<::fcl::Box<double>>(random.real(0.5, 1), random.real(0.5, 1), random.real(0.5, 1));
    else
      geometry = std::make_shared<::fcl::Capsule<double>>(random.real(0.2, 0.4), random.real(0.4, 0.8));
    objects->all.emplace_back(geometry);
    Object& object = objects->all.back();
    ::fcl::Transform3<double> pose = ::fcl::Transform3<double>::Identity();
    pose.linear() =
        ::fcl::Quaternion<double>(random.real(0.1, 1), random.real(-1, 1), random.real(-1, 1), random.real(-1, 1))
            .normalized()
            .toRotationMatrix();
    const ::fcl::Vector3<double> place(random.unit(), random.unit(), random.unit());
    if (apart)
      pose.translation() = spacing * ::fcl::Vector3<double>(i % 10, i / 10 % 10, i / 100) + 0.2 * place;
    else
      pose.translation() = edge * place;
    object.setTransform(pose);
    object.computeAABB();
    object.setUserData(reinterpret_cast<void*>(std::uintptr_t{i}));
    objects->pointers.push_back(&object);
  }
  return objects;
}

void find_truth(Objects& objects, bool distance) {
  double limit = 0;
  for (std::size_t a = 0; a < objects.pointers.size(); ++a)
    for (std::size_t b = a + 1; b < objects.pointers.size(); ++b)
      if (distance)
        on_distance(objects.pointers[a], objects.pointers[b], &objects.truth, limit);
      else
        on_pair(objects.pointers[a], objects.pointers[b], &objects.truth);
}

/// How many doubles lie between two that are not negative.
double ulps(double a, double b) {
  const auto x = std::bit_cast<std::int64_t>(a), y = std::bit_cast<std::int64_t>(b);
  return static_cast<double>(x > y ? x - y : y - x);
}

struct Candidate {
  const bench::FclManagerKind* kind;
  std::unique_ptr<bench::FclManager> manager;
  PairDifference difference;
  double ulps = NAN;
  std::string failure;
};

void compare(Candidate& candidate, const Answer& answer, const Answer& truth, bool distance) {
  if (distance) {
    candidate.ulps = ulps(answer.least, truth.least);
    if (candidate.ulps != 0)
      candidate.failure = fmt::format("least distance {} where there is {}", answer.least, truth.least);
  } else {
    candidate.difference = compare_pairs(truth.touching, answer.touching);
    candidate.failure = candidate.difference.complaint(false);
  }
  if (!candidate.failure.empty() && *candidate.kind->known_difference != 0)
    candidate.failure += std::string("; known: it ") + candidate.kind->known_difference;
}

void run_panel(const json& input, const json& settings, const RunOptions& options, const Progress& progress,
               Results& results) {
  const std::string panel = input.at("name").get<std::string>();
  const bool distance = input.at("query").get<std::string>() == "distance";
  const auto n = settings.at("objects").get<std::size_t>();
  progress(fmt::format("{}: all against all", panel));
  const std::unique_ptr<Objects> objects = make_objects(n, input.at("spacing").get<double>(), distance);
  find_truth(*objects, distance);
  const std::vector<bench::FclManagerKind> kinds = bench::fcl_manager_kinds();
  std::vector<Candidate> candidates;
  for (const bench::FclManagerKind& kind : kinds) {
    // It differs from another in how it is told of motion only, and here nothing moves.
    if (kind.lists_all || (distance && !kind.distances)) continue;
    candidates.push_back({&kind, nullptr, {}, NAN, {}});
    std::vector<Aabb> boxes;
    for (const Object* object : objects->pointers) {
      Aabb box{};
      for (int d = 0; d < 3; ++d) {
        box.min[d] = static_cast<float>(object->getAABB().min_[d]);
        box.max[d] = static_cast<float>(object->getAABB().max_[d]);
      }
      boxes.push_back(box);
    }
    candidates.back().manager = kind.make(boxes);
    candidates.back().manager->registerObjects(objects->pointers);
    candidates.back().manager->setup();
  }
  const accuracy::Turns turns = accuracy::take_turns(candidates.size(), options.repeats, [&](std::size_t i) {
    Candidate& candidate = candidates[i];
    progress(fmt::format("{}: {}", panel, candidate.kind->name));
    Answer answer;
    const double ms = accuracy::stopwatch([&] {
      if (distance)
        candidate.manager->distance(&answer, on_distance);
      else
        candidate.manager->collide(&answer, on_pair);
    });
    compare(candidate, answer, objects->truth, distance);
    return ms;
  });
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const Candidate& candidate = candidates[i];
    const auto count = [&](std::uint64_t value) { return distance ? NAN : static_cast<double>(value); };
    results.points.push_back({.panel = panel,
                              .series = candidate.kind->name,
                              .setting = fmt::format("{}", n),
                              .x = static_cast<double>(n),
                              .cost = turns.costs[i],
                              .values = {count(candidate.difference.missed), count(candidate.difference.extra),
                                         count(candidate.difference.duplicates), candidate.ulps},
                              .failure = candidate.failure});
  }
  results.twins.push_back({panel, turns.twin_spread});
}

}  // namespace

Results fcl_managers_kind(const Experiment& experiment, const RunOptions& options, const Progress& progress) {
  return with_settings_of(experiment, [&](const json& settings) {
    Results results;
    results.cost_unit = "ms per query";
    results.metrics = {"missed", "extra", "duplicates", "distance_ulp"};
    for (const json& input : settings.at("inputs")) run_panel(input, settings, options, progress, results);
    return results;
  });
}

}  // namespace boxstream::report
