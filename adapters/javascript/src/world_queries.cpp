// SPDX-License-Identifier: MIT
// A loop over queries, with the results of all of them in flat arrays.
#include <algorithm>
#include <limits>

#include <boxstream/detail/rounded_up.hpp>

#include "world.hpp"

namespace boxstream::javascript {
namespace {

/// What several queries found: the index of the query and the id, for each hit.
struct Hits {
  std::vector<std::uint32_t> queries;
  std::vector<double> ids;

  void add(std::size_t query, ProxyId id) {
    queries.push_back(static_cast<std::uint32_t>(query));
    ids.push_back(Ids::number(id));
  }
  void give_all() {
    give(0, std::move(queries));
    give(1, std::move(ids));
  }
};

/// Rays as JavaScript gave them: one length for all where `lengths` is null, rounded so that no ray is shorter.
struct Rays {
  const void* origins;
  const void* directions;
  const void* lengths;
  double length;

  template <class S>
  BasicRay<S> ray(std::size_t i) const {
    const S* const o = static_cast<const S*>(origins) + 3 * i;
    const S* const d = static_cast<const S*>(directions) + 3 * i;
    const S end = lengths == nullptr ? boxstream::detail::limit_of<S>(length) : static_cast<const S*>(lengths)[i];
    return BasicRay<S>::along({o[0], o[1], o[2]}, {d[0], d[1], d[2]}, end);
  }
};

template <class S>
void query_rays(const BasicWorld<S>& world, const Rays& rays, std::size_t count) {
  Hits hits;
  std::vector<S> enters;
  for (std::size_t i = 0; i < count; ++i)
    world.query_ray(rays.ray<S>(i), [&](ProxyId id, S enter, S length) {
      hits.add(i, id);
      enters.push_back(enter);
      return length;
    });
  hits.give_all();
  give(2, std::move(enters));
}

/// The first proxy on a ray, and of several at one place that of the lowest slot.
template <class S>
struct First {
  ProxyId id;
  S enter = std::numeric_limits<S>::infinity();

  void see(ProxyId other, S at) {
    if (id && (at > enter || (at == enter && other.slot >= id.slot))) return;
    id = other;
    enter = at;
  }
};

template <class S>
void cast_rays(const BasicWorld<S>& world, const Rays& rays, std::size_t count) {
  std::vector<double> ids(count);
  std::vector<S> enters(count);
  for (std::size_t i = 0; i < count; ++i) {
    First<S> first;
    world.query_ray(rays.ray<S>(i), [&](ProxyId id, S enter, S) {
      first.see(id, enter);
      return enter;
    });
    ids[i] = Ids::number(first.id);
    enters[i] = first.enter;
  }
  give(0, std::move(ids));
  give(1, std::move(enters));
}

}  // namespace
}  // namespace boxstream::javascript

using namespace boxstream::javascript;

BOXSTREAM_EXPORT(queryBoxes) Status boxstream_query_boxes(WorldHandle* handle, const void* boxes, std::size_t count) {
  return with_world(handle, [&]<class S>(const boxstream::BasicWorld<S>& world) {
    const auto asked = view<boxstream::BasicAabb<S>>(boxes, count);
    Hits hits;
    for (std::size_t i = 0; i < count; ++i)
      world.query_box(asked[i], [&](boxstream::ProxyId id) {
        hits.add(i, id);
        return true;
      });
    hits.give_all();
  });
}

BOXSTREAM_EXPORT(queryRays)
Status boxstream_query_rays(WorldHandle* handle, const void* origins, const void* directions, std::size_t count,
                            const void* lengths, double length) {
  return with_world(handle, [&](const auto& world) {
    query_rays(world, {origins, directions, lengths, length}, count);
  });
}

BOXSTREAM_EXPORT(castRays)
Status boxstream_cast_rays(WorldHandle* handle, const void* origins, const void* directions, std::size_t count,
                           const void* lengths, double length) {
  return with_world(handle, [&](const auto& world) {
    cast_rays(world, {origins, directions, lengths, length}, count);
  });
}

/// Answers with `each` ids a point, 0 where there are no more.
BOXSTREAM_EXPORT(queryNearest)
Status boxstream_query_nearest(WorldHandle* handle, const void* points, std::size_t count, std::size_t each) {
  return with_world(handle, [&]<class S>(const boxstream::BasicWorld<S>& world) {
    std::vector<boxstream::ProxyId> nearest(std::min(each, world.size()));
    std::vector<double>& out = give(0, std::vector<double>(count * each));
    for (std::size_t i = 0; i < count; ++i) {
      const S* const p = static_cast<const S*>(points) + 3 * i;
      const std::size_t found = world.query_nearest({p[0], p[1], p[2]}, nearest);
      for (std::size_t k = 0; k < found; ++k) out[i * each + k] = Ids::number(nearest[k]);
    }
  });
}
