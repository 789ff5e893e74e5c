// SPDX-License-Identifier: MIT
// FCL's narrow phase behind each manager: the same pairs and the same least distance as all against all.
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/distance.h>
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <deque>
#include <limits>

#include "boxes/pair_difference.hpp"
#include "experiment_kinds/fcl_touch.hpp"
#include "experiment_kinds/kinds.hpp"
#include "inputs/random.hpp"
#include "peers/fcl_managers.hpp"

namespace boxstream::report {
namespace {

using nlohmann::json;
using Object = ::fcl::CollisionObject<double>;

struct Answer {
  std::vector<Pair> touching;
  double least = std::numeric_limits<double>::max();
};

bool on_pair(Object* a, Object* b, void* data) {
  const std::uint32_t i = bench::fcl_index<double>(a), j = bench::fcl_index<double>(b);
  if (fcl_touch(a, b)) static_cast<Answer*>(data)->touching.push_back({std::min(i, j), std::max(i, j)});
  return false;
}

bool on_distance(Object* x, Object* y, void* data, double& limit) {
  const Object *a = x, *b = y;
  order_by_index(a, b);
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
      candidate.failure = fmt::format("least distance {} instead of {}", answer.least, truth.least);
  } else {
    candidate.difference = compare_pairs(truth.touching, answer.touching);
    candidate.failure = candidate.difference.complaint(false);
  }
  if (!candidate.failure.empty() && *candidate.kind->known_difference != 0)
    candidate.failure += std::string("; known: it ") + candidate.kind->known_difference;
}

/// Managers of all kinds, filled. Nothing moves, so those that differ only in how they are updated are left out.
std::vector<Candidate> candidates_of(const std::vector<bench::FclManagerKind>& kinds, const Objects& objects) {
  std::vector<Aabb> boxes;
  for (const Object* object : objects.pointers) {
    Aabb box{};
    for (int d = 0; d < 3; ++d) {
      box.min[d] = static_cast<float>(object->getAABB().min_[d]);
      box.max[d] = static_cast<float>(object->getAABB().max_[d]);
    }
    boxes.push_back(box);
  }
  std::vector<Candidate> candidates;
  for (const bench::FclManagerKind& kind : kinds) {
    if (kind.lists_all) continue;
    candidates.push_back({&kind, kind.make(boxes), {}, NAN, {}});
    candidates.back().manager->registerObjects(objects.pointers);
    candidates.back().manager->setup();
  }
  return candidates;
}

void measure_panel(const json& input, Measurement& measurement) {
  const std::string panel = input.at("name").get<std::string>();
  const bool distance = input.at("query").get<std::string>() == "distance";
  const auto n = measurement.settings().at("objects").get<std::size_t>();
  measurement.progress(fmt::format("{}: all against all", panel));
  const std::unique_ptr<Objects> objects = make_objects(n, input.at("spacing").get<double>(), distance);
  find_truth(*objects, distance);
  const std::vector<bench::FclManagerKind> kinds = bench::fcl_manager_kinds();
  std::vector<Candidate> candidates = candidates_of(kinds, *objects);
  const auto timed = [&](Candidate& candidate) {
    measurement.progress(fmt::format("{}: {}", panel, candidate.kind->name));
    Answer answer;
    const double ms = measure::time_once([&] {
      if (distance)
        candidate.manager->distance(&answer, on_distance);
      else
        candidate.manager->collide(&answer, on_pair);
    });
    compare(candidate, answer, objects->truth, distance);
    return ms;
  };
  measurement.add_points(panel, candidates, timed, [&](const Candidate& candidate, const auto&) {
    const auto count = [&](std::uint64_t value) { return distance ? NAN : static_cast<double>(value); };
    return Point{.series = candidate.kind->name,
                 .setting = fmt::format("{}", n),
                 .x = static_cast<double>(n),
                 .values = {count(candidate.difference.missed), count(candidate.difference.extra),
                            count(candidate.difference.duplicates), candidate.ulps},
                 .failure = candidate.failure};
  });
}

}  // namespace

void measure_fcl_managers(Measurement& measurement) {
  for (const json& input : measurement.settings().at("inputs")) measure_panel(input, measurement);
}

}  // namespace boxstream::report
