// SPDX-License-Identifier: MIT
#include "pictures/viewer/kept.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <btBulletDynamicsCommon.h>

#include "measure/interleave.hpp"
#include "pictures/viewer/snapshot.hpp"
#include "simulation/engine/convert.hpp"

namespace boxstream::view {
namespace {

// Of what is this many times as large as most, each is a landmark.
constexpr double large = 4;
// So many that their own pairs can be seen, and few enough that they do not look like a heap in a cloud.
constexpr std::size_t nearest_one_in = 4;

using Numbers = std::vector<std::uint32_t>;

/// The bits of `x`, well mixed: objects that were created one after the other lie beside each other.
std::uint32_t hash(std::uint32_t x) {
  x = (x ^ (x >> 16)) * 0x7feb352dU;
  x = (x ^ (x >> 15)) * 0x846ca68bU;
  return x ^ (x >> 16);
}

bool moves_freely(const btCollisionObject& object) {
  return btRigidBody::upcast(&object) != nullptr && !object.isStaticOrKinematicObject();
}

/// The boxes of shapes, and not those that a broad-phase was given, which may be larger.
Snapshot boxes_of(const scenes::Simulation& simulation) {
  Snapshot snapshot;
  for (const btCollisionObject* const object : simulation.objects()) {
    btVector3 min, max;
    object->getCollisionShape()->getAabb(object->getWorldTransform(), min, max);
    snapshot.boxes.push_back({scenes::plain(min), scenes::plain(max)});
    snapshot.moods.push_back(moves_freely(*object) ? Mood::moving : Mood::fixed);
  }
  return snapshot;
}

/// Infinite where there is a coordinate that is no number.
double size_of(const Snapshot::Box& box) {
  double sum = 0;
  for (std::size_t d = 0; d < 3; ++d) sum += std::pow(static_cast<double>(box.max[d]) - box.min[d], 2);
  return sum >= 0 ? std::sqrt(sum) : HUGE_VAL;
}

double distance2(const Snapshot::Box& box, const Point& point) {
  double sum = 0;
  for (std::size_t d = 0; d < 3; ++d)
    sum += std::pow((static_cast<double>(box.min[d]) + box.max[d]) / 2 - double{point[d]}, 2);
  return sum;
}

/// Moves the `count` of `from` that have the least `of` to the end of `to`; of equals, those created first.
template <class Of>
void take_least(Numbers& from, std::size_t count, Numbers& to, Of of) {
  if (count > from.size()) count = from.size();
  const auto end = from.begin() + static_cast<std::ptrdiff_t>(count);
  std::nth_element(from.begin(), end, from.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return std::pair(of(a), a) < std::pair(of(b), b); });
  to.insert(to.end(), from.begin(), end);
  from.erase(from.begin(), end);
}

}  // namespace

std::uint32_t Kept::place_of(std::uint32_t object) const {
  if (is_all()) return object;
  const auto at = std::lower_bound(objects.begin(), objects.end(), object);
  return at != objects.end() && *at == object ? static_cast<std::uint32_t>(at - objects.begin()) : none;
}

void Kept::places_of(const std::vector<Pair>& pairs, std::vector<Pair>& out) const {
  if (is_all()) {
    out = pairs;
    return;
  }
  out.clear();
  for (const Pair& pair : pairs) {
    const std::uint32_t a = place_of(pair.a);
    const std::uint32_t b = a == none ? none : place_of(pair.b);
    if (b != none) out.push_back({a, b});
  }
}

Kept keep_all(const scenes::Simulation& simulation) {
  Kept kept;
  kept.in_world = simulation.objects().size();
  kept.objects.resize(kept.in_world);
  std::iota(kept.objects.begin(), kept.objects.end(), 0);
  return kept;
}

Kept choose_kept(const scenes::Simulation& simulation, std::size_t most) {
  Kept kept = keep_all(simulation);
  if (kept.in_world <= most) return kept;
  const Snapshot snapshot = boxes_of(simulation);
  const std::vector<Snapshot::Box>& boxes = snapshot.boxes;
  std::vector<double> sizes(boxes.size());
  std::transform(boxes.begin(), boxes.end(), sizes.begin(), size_of);
  const double usual = measure::median(sizes);
  const std::size_t named = simulation.scene().bodies.size();

  Numbers others = std::exchange(kept.objects, {});
  const auto is_landmark = [&](std::uint32_t i) {
    return i < named || snapshot.moods[i] == Mood::fixed || !(sizes[i] < large * usual);
  };
  const auto begin = std::stable_partition(others.begin(), others.end(), [&](auto i) { return !is_landmark(i); });
  Numbers landmarks(begin, others.end());
  others.erase(begin, others.end());

  take_least(landmarks, most / 2, kept.objects, [&](auto i) { return -sizes[i]; });
  kept.landmarks = kept.objects.size();
  const Point eye = first_eye(crowd_of(snapshot));
  take_least(others, (most - kept.landmarks) / nearest_one_in, kept.objects,
             [&](auto i) { return distance2(boxes[i], eye); });
  kept.nearest = kept.objects.size() - kept.landmarks;
  take_least(others, most - kept.objects.size(), kept.objects, hash);
  std::sort(kept.objects.begin(), kept.objects.end());
  return kept;
}

}  // namespace boxstream::view
