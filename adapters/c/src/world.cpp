// SPDX-License-Identifier: MIT
#include <boxstream/world.hpp>

#include <memory>

#include "c_executor.hpp"
#include "numbers.hpp"
#include "views.hpp"

struct boxstream_world {
  boxstream_world(boxstream_scalar scalar, const boxstream_executor* functions, boxstream_method method,
                  std::uint32_t cutoff)
      : executor(boxstream::c::make_executor(functions)) {
    boxstream::c::check_scalar(scalar);
    boxstream::WorldOptions options;
    options.executor = executor.get();
    options.method = boxstream::c::method_of(method);
    options.cutoff = cutoff;
    if (scalar == BOXSTREAM_FLOAT)
      single_world = std::make_unique<boxstream::World>(options);
    else
      double_world = std::make_unique<boxstream::World64>(options);
  }

  std::unique_ptr<boxstream::Executor> executor;
  // One of the two; std::variant would export its exception.
  std::unique_ptr<boxstream::World> single_world;
  std::unique_ptr<boxstream::World64> double_world;
};

namespace boxstream::c {
namespace {

/// Calls `work(world, S{})`.
template <class Handle, class Work>
auto with_world(Handle* handle, Work work) {
  need(handle, "no world");
  if (handle->single_world != nullptr) return work(*handle->single_world, float{});
  return work(*handle->double_world, double{});
}

/// The same for functions without a status: `otherwise` without a world.
template <class Handle, class Result, class Work>
Result with_world_or(Handle* handle, Result otherwise, Work work) {
  return handle == nullptr ? otherwise : static_cast<Result>(with_world(handle, work));
}

void give_live(std::size_t* out, std::size_t live) {
  if (out != nullptr) *out = live;
}

template <class Pairs>
const boxstream_id_pair* give_pairs(const boxstream_world* world, std::size_t* count, Pairs pairs_of) {
  const auto pairs = with_world_or(world, Span<const ProxyPair>{}, pairs_of);
  if (count != nullptr) *count = pairs.size();
  return to_c(pairs);
}

}  // namespace
}  // namespace boxstream::c

using namespace boxstream::c;

boxstream_status boxstream_world_create(boxstream_scalar scalar, const boxstream_executor* executor,
                                        boxstream_world** out) {
  return boxstream_world_create_with(scalar, executor, BOXSTREAM_PLANNED, 0, out);
}

boxstream_status boxstream_world_create_with(boxstream_scalar scalar, const boxstream_executor* executor,
                                             boxstream_method method, uint32_t cutoff, boxstream_world** out) {
  return guarded([&] {
    boxstream_world*& place = need(out, "no place for the world");
    place = new boxstream_world(scalar, executor, method, cutoff);
  });
}

void boxstream_world_destroy(boxstream_world* world) {
  delete world;
}

boxstream_status boxstream_world_insert(boxstream_world* world, const boxstream_boxes* boxes, const uint64_t* users,
                                        boxstream_id* out) {
  return guarded([&] {
    const boxstream_boxes& all = need(boxes, "no boxes");
    const auto ids = view<boxstream::ProxyId>(out, all.count, "no place for ids");
    const auto user_data = view<const std::uint64_t>(users, users == nullptr ? 0 : all.count, "no users");
    with_world(world, [&](auto& w, auto scalar) {
      w.create(boxes_of<decltype(scalar)>(all), filters_of(all), ids, user_data);
    });
  });
}

boxstream_status boxstream_world_remove(boxstream_world* world, const boxstream_id* ids, size_t count, size_t* live) {
  return guarded([&] {
    const auto gone = view<const boxstream::ProxyId>(ids, count, "no ids");
    give_live(live, with_world(world, [&](auto& w, auto) { return w.destroy(gone); }));
  });
}

boxstream_status boxstream_world_move(boxstream_world* world, const boxstream_id* ids, const boxstream_boxes* boxes,
                                      size_t* live) {
  return guarded([&] {
    const boxstream_boxes& all = need(boxes, "no boxes");
    const auto moved = view<const boxstream::ProxyId>(ids, all.count, "no ids");
    give_live(live,
              with_world(world, [&](auto& w, auto scalar) { return w.move(moved, boxes_of<decltype(scalar)>(all)); }));
  });
}

bool boxstream_world_set_filter(boxstream_world* world, boxstream_id id, boxstream_filter filter) {
  return with_world_or(world, false, [&](auto& w, auto) {
    return w.set_filter(from_c(id), {filter.group, filter.mask});
  });
}

bool boxstream_world_contains(const boxstream_world* world, boxstream_id id) {
  return with_world_or(world, false, [&](const auto& w, auto) { return w.contains(from_c(id)); });
}

uint64_t boxstream_world_user(const boxstream_world* world, boxstream_id id) {
  return with_world_or(world, std::uint64_t{0},
                       [&](const auto& w, auto) { return w.contains(from_c(id)) ? w.user(from_c(id)) : 0; });
}

size_t boxstream_world_size(const boxstream_world* world) {
  return with_world_or(world, std::size_t{0}, [](const auto& w, auto) { return w.size(); });
}

boxstream_status boxstream_world_update(boxstream_world* world, boxstream_pair_filter accept, void* user,
                                        boxstream_world_stats* stats) {
  return guarded([&] {
    check_size(stats);
    const auto ask = [&](boxstream::ProxyId a, boxstream::ProxyId b) { return accept(user, to_c(a), to_c(b)); };
    const boxstream::WorldStats did =
        with_world(world, [&](auto& w, auto) { return accept == nullptr ? w.update() : w.update(ask); });
    give(stats, boxstream_world_stats{sizeof(boxstream_world_stats), did.proxies, did.invalid, did.moved, did.pairs,
                                      did.begun, did.ended});
  });
}

const boxstream_id_pair* boxstream_world_begun(const boxstream_world* world, size_t* count) {
  return give_pairs(world, count, [](const auto& w, auto) { return w.begun(); });
}

const boxstream_id_pair* boxstream_world_ended(const boxstream_world* world, size_t* count) {
  return give_pairs(world, count, [](const auto& w, auto) { return w.ended(); });
}

boxstream_status boxstream_world_shrink_to_fit(boxstream_world* world) {
  return guarded([&] { with_world(world, [](auto& w, auto) { w.shrink_to_fit(); }); });
}

uint64_t boxstream_world_pair_count(const boxstream_world* world) {
  return with_world_or(world, std::uint64_t{0}, [](const auto& w, auto) { return w.pair_count(); });
}

boxstream_status boxstream_world_stream_pairs(const boxstream_world* world,
                                              bool (*sink)(void* user, const boxstream_id_pair* pairs, size_t count),
                                              void* user) {
  return guarded([&] {
    need(sink, "no sink");
    const auto pass_on = [&](boxstream::Span<const boxstream::ProxyPair> pairs) {
      return sink(user, to_c(pairs), pairs.size());
    };
    with_world(world, [&](const auto& w, auto) { w.stream_pairs(pass_on); });
  });
}

boxstream_status boxstream_world_query_box(const boxstream_world* world, const double box[6], boxstream_visitor visit,
                                           void* user) {
  return guarded([&] {
    need(visit, "no visitor");
    with_world(world, [&](const auto& w, auto scalar) {
      const AskedBox<decltype(scalar)> asked(box);
      w.query_box(asked.around(),
                  [&](boxstream::ProxyId id) { return !asked.touches(w.box(id)) || visit(user, to_c(id)); });
    });
  });
}

boxstream_status boxstream_world_query_ray(const boxstream_world* world, const double origin[3],
                                           const double direction[3], double length, boxstream_ray_visitor visit,
                                           void* user) {
  return guarded([&] {
    need(visit, "no visitor");
    with_world(world, [&](const auto& w, auto scalar) {
      using S = decltype(scalar);
      w.query_ray(ray_of<S>(origin, direction, length), [&](boxstream::ProxyId id, S enter, S rest) {
        return limit_of<S>(visit(user, to_c(id), in_double(enter), in_double(rest)));
      });
    });
  });
}

boxstream_status boxstream_world_query_nearest(const boxstream_world* world, const double point[3], boxstream_id* out,
                                               size_t room, size_t* found) {
  return guarded([&] {
    const auto ids = view<boxstream::ProxyId>(out, room, "no place for ids");
    give_live(found, with_world(world, [&](const auto& w, auto scalar) {
                return w.query_nearest(Point<decltype(scalar)>(point).at, ids);
              }));
  });
}

boxstream_status boxstream_world_query_near(const boxstream_world* world, const double box[6], double limit,
                                            boxstream_near_visitor visit, void* user) {
  return guarded([&] {
    need(visit, "no visitor");
    with_world(world, [&](const auto& w, auto scalar) {
      using S = decltype(scalar);
      const AskedBox<S> asked(box);
      w.query_nearest_box(asked.around(), limit_of<S>(limit), [&](boxstream::ProxyId id, S distance) {
        return limit_of<S>(visit(user, to_c(id), in_double(distance)));
      });
    });
  });
}

boxstream_status boxstream_world_near_pairs(const boxstream_world* world, double limit,
                                            boxstream_near_pair_visitor visit, void* user) {
  return guarded([&] {
    need(visit, "no visitor");
    with_world(world, [&](const auto& w, auto scalar) {
      using S = decltype(scalar);
      w.nearest_pairs(limit_of<S>(limit), [&](boxstream::ProxyPair pair, S distance) {
        return limit_of<S>(visit(user, {to_c(pair.a), to_c(pair.b)}, in_double(distance)));
      });
    });
  });
}
