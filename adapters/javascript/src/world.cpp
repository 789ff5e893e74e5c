// SPDX-License-Identifier: MIT
// Changes of a World.
#include "world.hpp"

namespace boxstream::javascript {
namespace {

std::variant<World, World64> make_world(Scalar scalar, const WorldOptions& options) {
  check(scalar);
  if (scalar == float32) return World(options);
  return World64(options);
}

/// 0 where there are none: a World takes them in 64 bits.
std::vector<std::uint64_t> users_of(const std::uint32_t* users, std::size_t count) {
  if (users == nullptr) return {};
  return {users, users + count};
}

}  // namespace

WorldHandle::WorldHandle(Scalar scalar, const WorldOptions& options) : world(make_world(scalar, options)) {}

}  // namespace boxstream::javascript

using namespace boxstream::javascript;

/// Answers with the address.
BOXSTREAM_EXPORT(createWorld)
Status boxstream_create_world(Scalar scalar, bool sticky_filters, bool is_hybrid, std::uint32_t cutoff) {
  using boxstream::Method;
  const boxstream::WorldOptions options{nullptr, sticky_filters, is_hybrid ? Method::hybrid : Method::planned, cutoff};
  return guarded([&] { answer.parts[0] = {new WorldHandle(scalar, options)}; });
}

BOXSTREAM_EXPORT(destroyWorld) void boxstream_destroy_world(WorldHandle* handle) {
  delete handle;
}

/// Filters and users are null, or one for each box. Answers with ids.
BOXSTREAM_EXPORT(create)
Status boxstream_create(WorldHandle* handle, const void* boxes, std::size_t count, const void* filters,
                        const std::uint32_t* users) {
  return with_world(handle, [&]<class S>(boxstream::BasicWorld<S>& world) {
    const auto numbers = users_of(users, count);
    std::vector<boxstream::ProxyId> ids(count);
    std::vector<double>& out = give(0, std::vector<double>(count));
    handle->known.reserve(count);
    world.create(view<boxstream::BasicAabb<S>>(boxes, count), view_or_none<boxstream::Filter>(filters, count), ids,
                 numbers);
    for (std::size_t i = 0; i < count; ++i) {
      handle->known.note(ids[i]);
      out[i] = Ids::number(ids[i]);
    }
  });
}

/// Answers, as the next two, with how many ids were live.
BOXSTREAM_EXPORT(move)
Status boxstream_move(WorldHandle* handle, const double* ids, std::size_t count, const void* boxes) {
  return with_world(handle, [&]<class S>(boxstream::BasicWorld<S>& world) {
    const auto live = world.move(handle->known.ids({ids, count}), view<boxstream::BasicAabb<S>>(boxes, count));
    answer_with(static_cast<double>(live));
  });
}

BOXSTREAM_EXPORT(destroy) Status boxstream_destroy(WorldHandle* handle, const double* ids, std::size_t count) {
  return with_world(handle, [&](auto& world) {
    answer_with(static_cast<double>(world.destroy(handle->known.ids({ids, count}))));
  });
}

/// Filters as of `create`; null sets the defaults.
BOXSTREAM_EXPORT(setFilters)
Status boxstream_set_filters(WorldHandle* handle, const double* ids, std::size_t count,
                             const boxstream::Filter* filters) {
  return with_world(handle, [&](auto& world) {
    std::size_t live = 0;
    for (std::size_t i = 0; i < count; ++i)
      live += world.set_filter(handle->known.id(ids[i]), filters == nullptr ? boxstream::Filter{} : filters[i]);
    answer_with(static_cast<double>(live));
  });
}

BOXSTREAM_EXPORT(clear) Status boxstream_clear(WorldHandle* handle) {
  return with_world(handle, [&](auto& world) {
    world.clear();
    handle->known.clear();
  });
}

/// Answers with numbers: proxies, invalid, moved, pairs, begun, ended.
BOXSTREAM_EXPORT(update) Status boxstream_update(WorldHandle* handle) {
  return with_world(handle, [](auto& world) {
    const auto did = world.update();
    const std::uint64_t numbers[] = {did.proxies, did.invalid, did.moved, did.pairs, did.begun, did.ended};
    for (std::size_t i = 0; i < 6; ++i) answer.numbers[i] = static_cast<double>(numbers[i]);
  });
}
