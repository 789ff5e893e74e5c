// SPDX-License-Identifier: MIT
// What a World has: proxies by their ids, and pairs.
#include <algorithm>

#include "world.hpp"

namespace boxstream::javascript {
namespace {

/// The ids of live proxies. Answers with the index of the first which is not, or with how many there are.
template <class S>
std::vector<ProxyId> live_ids(const WorldHandle& handle, const BasicWorld<S>& world, Span<const double> numbers) {
  std::vector<ProxyId> ids = handle.known.ids(numbers);
  const auto stale = std::find_if(ids.begin(), ids.end(), [&](ProxyId id) { return !world.contains(id); });
  answer_with(static_cast<double>(stale - ids.begin()));
  ids.erase(stale, ids.end());
  return ids;
}

std::vector<double> numbers_of(Span<const ProxyPair> pairs) {
  std::vector<double> numbers;
  numbers.reserve(2 * pairs.size());
  for (const ProxyPair& pair : pairs) {
    numbers.push_back(Ids::number(pair.a));
    numbers.push_back(Ids::number(pair.b));
  }
  return numbers;
}

}  // namespace
}  // namespace boxstream::javascript

using namespace boxstream::javascript;

BOXSTREAM_EXPORT(size) Status boxstream_size(WorldHandle* handle) {
  return with_world(handle, [](auto& world) { answer_with(static_cast<double>(world.size())); });
}

/// Answers with a byte for each id.
BOXSTREAM_EXPORT(contains) Status boxstream_contains(WorldHandle* handle, const double* ids, std::size_t count) {
  return with_world(handle, [&](auto& world) {
    auto& out = give(0, std::vector<std::uint8_t>(count));
    for (std::size_t i = 0; i < count; ++i) out[i] = world.contains(handle->known.id(ids[i]));
  });
}

/// This and the next answer for ids before the first that is not live.
BOXSTREAM_EXPORT(boxes) Status boxstream_boxes(WorldHandle* handle, const double* ids, std::size_t count) {
  return with_world(handle, [&]<class S>(const boxstream::BasicWorld<S>& world) {
    std::vector<boxstream::BasicAabb<S>> found;
    found.reserve(count);
    for (const auto id : live_ids(*handle, world, {ids, count})) found.push_back(world.box(id));
    give(0, std::move(found));
  });
}

BOXSTREAM_EXPORT(users) Status boxstream_users(WorldHandle* handle, const double* ids, std::size_t count) {
  return with_world(handle, [&](const auto& world) {
    std::vector<std::uint32_t> found;
    found.reserve(count);
    for (const auto id : live_ids(*handle, world, {ids, count}))
      found.push_back(static_cast<std::uint32_t>(world.user(id)));
    give(0, std::move(found));
  });
}

BOXSTREAM_EXPORT(bounds) Status boxstream_bounds(WorldHandle* handle) {
  return with_world(handle, [](auto& world) { give(0, std::vector{world.bounds()}); });
}

/// Each answers with two ids a pair.
BOXSTREAM_EXPORT(begun) Status boxstream_begun(WorldHandle* handle) {
  return with_world(handle, [](auto& world) { give(0, numbers_of(world.begun())); });
}

BOXSTREAM_EXPORT(ended) Status boxstream_ended(WorldHandle* handle) {
  return with_world(handle, [](auto& world) { give(0, numbers_of(world.ended())); });
}

BOXSTREAM_EXPORT(pairs) Status boxstream_pairs(WorldHandle* handle) {
  return with_world(handle, [](auto& world) {
    std::vector<double> all;
    all.reserve(2 * world.pair_count());
    world.stream_pairs([&](boxstream::Span<const boxstream::ProxyPair> pairs) {
      const auto numbers = numbers_of(pairs);
      all.insert(all.end(), numbers.begin(), numbers.end());
      return true;
    });
    give(0, std::move(all));
  });
}
