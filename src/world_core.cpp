// SPDX-License-Identifier: MIT
#include "world_core.hpp"

namespace boxstream::detail {

template <class S>
WorldCore<S>::WorldCore(WorldOptions options, SearchMode mode)
    : options_(options), forced_mode_(mode), search_({options.executor}) {}

template <class S>
ProxyId WorldCore<S>::create(const Box& box, Filter filter, std::uint64_t user) {
  if (proxies_.needs_compaction()) drop_tombstones();
  index_.reserve_slot(proxies_.next_slot());
  const ProxyId id = proxies_.create(box, filter, user);
  index_.mark(id.slot);
  return id;
}

template <class S>
bool WorldCore<S>::destroy(ProxyId id) {
  const std::uint32_t rank = proxies_.rank(id);
  if (rank == Proxies::none) return false;
  proxies_.destroy(rank);
  index_.mark(id.slot);
  return true;
}

template <class S>
void WorldCore<S>::clear() {
  proxies_.clear();
  pairs_.clear();
  index_.clear();
  begun_.clear();
  ended_.clear();
}

template <class S>
bool WorldCore<S>::move(ProxyId id, const Box& box) {
  const std::uint32_t rank = proxies_.rank(id);
  if (rank == Proxies::none) return false;
  if (proxies_.move(rank, box)) index_.mark(id.slot);
  return true;
}

template <class S>
bool WorldCore<S>::set_filter(ProxyId id, Filter filter) {
  const std::uint32_t rank = proxies_.rank(id);
  if (rank == Proxies::none) return false;
  proxies_.set_filter(rank, filter);
  return true;
}

template <class S>
bool WorldCore<S>::set_user(ProxyId id, std::uint64_t user) {
  const std::uint32_t rank = proxies_.rank(id);
  if (rank == Proxies::none) return false;
  proxies_.set_user(rank, user);
  return true;
}

template <class S>
typename WorldCore<S>::Box WorldCore<S>::box(ProxyId id) const {
  const std::uint32_t rank = proxies_.rank(id);
  return rank == Proxies::none ? Proxies::inert_box() : proxies_.box(rank);
}

template <class S>
Filter WorldCore<S>::filter(ProxyId id) const {
  const std::uint32_t rank = proxies_.rank(id);
  return rank == Proxies::none ? Filter{0, 0} : proxies_.filter(rank);
}

template <class S>
std::uint64_t WorldCore<S>::user(ProxyId id) const {
  const std::uint32_t rank = proxies_.rank(id);
  return rank == Proxies::none ? 0 : proxies_.user(rank);
}

/// For worlds in which proxies come and go between updates. Tombstones with held pairs stay until the pairs have ended.
template <class S>
void WorldCore<S>::drop_tombstones() {
  is_referenced_.assign(proxies_.ranks(), false);
  pairs_.for_each([this](PairKey key) {
    is_referenced_[first_of(key)] = is_referenced_[second_of(key)] = true;
    return true;
  });
  pairs_.fold();
  pairs_.remap(proxies_.compact([this](std::uint32_t rank) { return is_referenced_[rank] != 0; }));
}

// Members are instantiated one by one, because their definitions are spread over several files.
#define INSTANTIATE(S)                                                      \
  template WorldCore<S>::WorldCore(WorldOptions, SearchMode);               \
  template ProxyId WorldCore<S>::create(const Box&, Filter, std::uint64_t); \
  template bool WorldCore<S>::destroy(ProxyId);                             \
  template void WorldCore<S>::clear();                                      \
  template bool WorldCore<S>::move(ProxyId, const Box&);                    \
  template bool WorldCore<S>::set_filter(ProxyId, Filter);                  \
  template bool WorldCore<S>::set_user(ProxyId, std::uint64_t);             \
  template WorldCore<S>::Box WorldCore<S>::box(ProxyId) const;              \
  template Filter WorldCore<S>::filter(ProxyId) const;                      \
  template std::uint64_t WorldCore<S>::user(ProxyId) const
INSTANTIATE(float);
INSTANTIATE(double);
#undef INSTANTIATE

}  // namespace boxstream::detail
