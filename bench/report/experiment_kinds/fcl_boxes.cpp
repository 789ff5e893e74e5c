// SPDX-License-Identifier: MIT
// Randomly rotated rods in FCL: the whole query with loose and tight boxes. Expected pairs: FCL's narrow phase, all
// against all.
#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/geometry/shape/box.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>

#include <boxstream/fcl.hpp>
#include <boxstream/fcl/tight_box.hpp>

#include "boxes/pair_difference.hpp"
#include "experiment_kinds/fcl_touch.hpp"
#include "experiment_kinds/kinds.hpp"
#include "inputs/random.hpp"
#include "peers/pair_hash.hpp"

namespace boxstream::report {
namespace {

using nlohmann::json;
using FclBase = ::fcl::CollisionObject<double>;
using Manager = ::fcl::BroadPhaseCollisionManager<double>;
using Pose = ::fcl::Transform3<double>;

/// With FCL's (loose) box or the tight one, whichever is computed.
class Rod final : public FclBase {
 public:
  Rod(const std::shared_ptr<::fcl::CollisionGeometry<double>>& geometry, std::uint32_t index) : FclBase(geometry) {
    setUserData(reinterpret_cast<void*>(std::uintptr_t{index}));
  }
  void compute_tight_box() { aabb = boxstream::fcl::tightBox<double>(*this); }
};

struct Answer {
  std::vector<Pair> touching;
  std::uint64_t asked = 0;
};

bool on_pair(FclBase* a, FclBase* b, void* data) {
  Answer& answer = *static_cast<Answer*>(data);
  ++answer.asked;
  const std::uint32_t i = bench::fcl_index<double>(a), j = bench::fcl_index<double>(b);
  if (fcl_touch(a, b)) answer.touching.push_back({std::min(i, j), std::max(i, j)});
  return false;
}

/// Rods of volume 1 in a cube, and two sets of poses, between which they go back and forth: a frame's motion apart, for
/// which trees that are refitted are made. Between poses at random FCL's becomes slower with each update.
struct Heap {
  std::deque<Rod> rods;
  std::vector<FclBase*> pointers;
  std::vector<Pose> poses[2];
  std::vector<Pair> touching[2];  ///< expected, sorted
};

Pose random_pose(batches::Random& random, double edge) {
  ::fcl::Quaternion<double> rotation;
  // A point in the ball of four dimensions, brought to its surface.
  do rotation = {random.real(-1, 1), random.real(-1, 1), random.real(-1, 1), random.real(-1, 1)};
  while (rotation.norm() > 1 || rotation.norm() < 0.1);
  Pose pose = Pose::Identity();
  pose.linear() = rotation.normalized().toRotationMatrix();
  pose.translation() = ::fcl::Vector3<double>(random.real(0, edge), random.real(0, edge), random.real(0, edge));
  return pose;
}

/// Moved on by up to 0.1 along each axis and turned by up to 0.1 about each.
Pose moved(Pose pose, batches::Random& random) {
  for (int axis = 0; axis < 3; ++axis) {
    pose.translation()[axis] += random.real(-0.1, 0.1);
    pose.rotate(Eigen::AngleAxisd(random.real(-0.1, 0.1), ::fcl::Vector3<double>::Unit(axis)));
  }
  return pose;
}

std::vector<Pair> touching_pairs(const Heap& heap) {
  std::vector<Pair> pairs;
  for (std::uint32_t a = 0; a < heap.pointers.size(); ++a)
    for (std::uint32_t b = a + 1; b < heap.pointers.size(); ++b)
      if (fcl_touch(heap.pointers[a], heap.pointers[b])) pairs.push_back({a, b});
  return pairs;
}

void lie(Heap& heap, int which) {
  for (std::size_t i = 0; i < heap.rods.size(); ++i) heap.rods[i].setTransform(heap.poses[which][i]);
}

std::unique_ptr<Heap> make_heap(std::size_t n, double aspect, double spacing) {
  auto heap = std::make_unique<Heap>();
  const double thickness = std::cbrt(1 / aspect);
  const auto geometry = std::make_shared<::fcl::Box<double>>(thickness, thickness, thickness * aspect);
  batches::Random random(1);
  const double edge = spacing * std::cbrt(static_cast<double>(n));
  for (std::uint32_t i = 0; i < n; ++i) {
    heap->rods.emplace_back(geometry, i);
    heap->poses[0].push_back(random_pose(random, edge));
    heap->poses[1].push_back(moved(heap->poses[0].back(), random));
  }
  for (Rod& rod : heap->rods) heap->pointers.push_back(&rod);
  for (const int which : {0, 1}) {
    lie(*heap, which);
    heap->touching[which] = touching_pairs(*heap);
  }
  return heap;
}

struct Candidate {
  std::string series;
  bool ours, tight;
  double aspect;
  Heap* heap;
  std::unique_ptr<Manager> manager{};
  PairDifference difference{};
  std::uint64_t asked = 0;
  std::size_t touching = 0;
  std::string failure{};
};

void fill(Candidate& candidate) {
  if (candidate.ours) {
    auto manager = std::make_unique<boxstream::fcl::CollisionManager<double>>();
    if (candidate.tight) manager->setBoxSource(boxstream::fcl::tightBox<double>);
    candidate.manager = std::move(manager);
  } else {
    candidate.manager = std::make_unique<::fcl::DynamicAABBTreeCollisionManager<double>>();
  }
  lie(*candidate.heap, 0);
  for (Rod& rod : candidate.heap->rods) rod.computeAABB();
  candidate.manager->registerObjects(candidate.heap->pointers);
  candidate.manager->setup();
}

/// Boxes, update, all pairs, narrow phase: from poses to the pairs that touch.
Answer ask(Candidate& candidate) {
  for (Rod& rod : candidate.heap->rods) {
    if (!candidate.tight)
      rod.computeAABB();
    else if (!candidate.ours)  // ours makes its own
      rod.compute_tight_box();
  }
  candidate.manager->update();
  Answer answer;
  candidate.manager->collide(&answer, on_pair);
  return answer;
}

void check(Candidate& candidate) {
  fill(candidate);
  for (const int which : {1, 0}) {
    lie(*candidate.heap, which);
    const Answer answer = ask(candidate);
    candidate.difference.add(compare_pairs(candidate.heap->touching[which], answer.touching));
    candidate.asked += answer.asked;
    candidate.touching += candidate.heap->touching[which].size();
  }
  candidate.failure = candidate.difference.complaint(false);
}

/// Rods go over to their other poses and back; the way back is timed.
double timed(Candidate& candidate) {
  double ms = 0;
  for (const int which : {1, 0}) {
    lie(*candidate.heap, which);
    Answer answer;
    const auto work = [&] { answer = ask(candidate); };
    if (which == 0)
      ms = measure::time_once(work);
    else
      work();
    if (bench::summarize(answer.touching) != bench::summarize(candidate.heap->touching[which]) &&
        candidate.failure.empty())
      candidate.failure = "wrong pairs in a timed run";
  }
  return ms;
}

}  // namespace

void measure_fcl_boxes(Measurement& measurement) {
  const json& settings = measurement.settings();
  std::vector<std::unique_ptr<Heap>> heaps;
  std::vector<Candidate> candidates;  // whose managers are destroyed before the objects in them
  for (const auto aspect : settings.at("aspects").get<std::vector<double>>()) {
    measurement.progress(fmt::format("rods of {:g} : 1, all against all", aspect));
    heaps.push_back(make_heap(settings.at("rods").get<std::size_t>(), aspect, settings.value("spacing", 3.0)));
    for (const bool ours : {true, false})
      for (const bool tight : {false, true})
        candidates.push_back({fmt::format("{}, {}", ours ? "boxstream" : "FCL's tree", tight ? "tight" : "loose"), ours,
                              tight, aspect, heaps.back().get()});
  }
  for (Candidate& candidate : candidates) check(candidate);
  const auto timed_one = [&](Candidate& candidate) {
    measurement.progress(fmt::format("{}, {:g} : 1", candidate.series, candidate.aspect));
    return timed(candidate);
  };
  const std::string panel = settings.at("name").get<std::string>();
  measurement.add_points(panel, candidates, timed_one, [&](const Candidate& candidate, const auto&) {
    const auto asked = static_cast<double>(candidate.asked), touching = static_cast<double>(candidate.touching);
    return Point{
        .series = candidate.series,
        .setting = fmt::format("{:g} : 1", candidate.aspect),
        .x = candidate.aspect,
        .values = {static_cast<double>(candidate.difference.missed), asked / 2, touching / 2, 1 - touching / asked},
        .failure = candidate.failure};
  });
}

}  // namespace boxstream::report
