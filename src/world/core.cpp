// SPDX-License-Identifier: MIT
#include "world/core.hpp"

#include <stdexcept>

namespace boxstream::detail {

template <class S>
WorldCore<S>::WorldCore(WorldOptions options, SearchMode mode)
    : options_(options), forced_mode_(mode), search_(options.executor) {}

template <class S>
ProxyId WorldCore<S>::create(const Box& box, Filter filter, std::uint64_t user) {
  const InUse::Change change(in_use_);
  make_room(1);
  const ProxyId id = proxies_.create(box, filter, user);
  index_.mark(id.slot);
  return id;
}

template <class S>
void WorldCore<S>::create(Span<const Box> boxes, Span<const Filter> filters, Span<ProxyId> out,
                          Span<const std::uint64_t> users) {
  const InUse::Change change(in_use_);
  const auto fits = [&](std::size_t size) { return size == 0 || size == boxes.size(); };
  if (!fits(filters.size()) || !fits(users.size()) || out.size() != boxes.size())
    throw std::invalid_argument("boxstream: filters, user words and ids must be as many as boxes");
  make_room(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    out[i] = proxies_.create(boxes[i], filters.empty() ? Filter() : filters[i], users.empty() ? 0 : users[i]);
    index_.mark(out[i].slot);
  }
}

template <class S>
bool WorldCore<S>::destroy(ProxyId id) {
  const InUse::Change change(in_use_);
  const std::uint32_t rank = proxies_.rank(id);
  if (rank == Proxies::none) return false;
  proxies_.destroy(rank);
  index_.mark(id.slot);
  return true;
}

template <class S>
std::size_t WorldCore<S>::destroy(Span<const ProxyId> ids) {
  std::size_t live = 0;
  for (const ProxyId id : ids) live += destroy(id);
  return live;
}

template <class S>
void WorldCore<S>::clear() {
  const InUse::Change change(in_use_);
  proxies_.clear();
  pairs_.clear();
  search_.fences().clear();
  index_.clear();
  begun_.clear();
  ended_.clear();
}

template <class S>
bool WorldCore<S>::move(ProxyId id, const Box& box) {
  const InUse::Change change(in_use_);
  const std::uint32_t rank = proxies_.rank(id);
  if (rank == Proxies::none) return false;
  if (proxies_.move(rank, box)) index_.mark(id.slot);
  return true;
}

template <class S>
std::size_t WorldCore<S>::move(Span<const ProxyId> ids, Span<const Box> boxes) {
  const InUse::Change change(in_use_);
  if (ids.size() != boxes.size()) throw std::invalid_argument("boxstream: there must be as many boxes as ids");
  return proxies_.move(ids, boxes, [this](std::uint32_t slot) { index_.mark(slot); });
}

template <class S>
bool WorldCore<S>::set_filter(ProxyId id, Filter filter) {
  const InUse::Change change(in_use_);
  const std::uint32_t rank = proxies_.rank(id);
  if (rank == Proxies::none) return false;
  proxies_.set_filter(rank, filter);
  return true;
}

template <class S>
bool WorldCore<S>::ask_again(ProxyId id) {
  const InUse::Change change(in_use_);
  const std::uint32_t rank = proxies_.rank(id);
  if (rank == Proxies::none) return false;
  proxies_.ask_again(rank);
  return true;
}

template <class S>
void WorldCore<S>::ask_again() {
  const InUse::Change change(in_use_);
  for (std::uint32_t rank = 0; rank < proxies_.ranks(); ++rank) proxies_.ask_again(rank);
}

template <class S>
bool WorldCore<S>::set_user(ProxyId id, std::uint64_t user) {
  const InUse::Change change(in_use_);
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

/// For so many more proxies.
template <class S>
void WorldCore<S>::make_room(std::size_t more) {
  if (proxies_.needs_compaction()) drop_tombstones();
  proxies_.reserve(more);
  index_.reserve_slots(proxies_.slots_after(more));
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
  const auto new_rank = proxies_.compact([this](std::uint32_t rank) { return is_referenced_[rank] != 0; });
  pairs_.remap(new_rank);
  search_.fences().remap(new_rank);
}

// Members are instantiated one by one, because their definitions are spread over several files.
#define INSTANTIATE(S)                                                                                               \
  template WorldCore<S>::WorldCore(WorldOptions, SearchMode);                                                        \
  template ProxyId WorldCore<S>::create(const Box&, Filter, std::uint64_t);                                          \
  template void WorldCore<S>::create(Span<const Box>, Span<const Filter>, Span<ProxyId>, Span<const std::uint64_t>); \
  template bool WorldCore<S>::destroy(ProxyId);                                                                      \
  template std::size_t WorldCore<S>::destroy(Span<const ProxyId>);                                                   \
  template void WorldCore<S>::clear();                                                                               \
  template bool WorldCore<S>::move(ProxyId, const Box&);                                                             \
  template std::size_t WorldCore<S>::move(Span<const ProxyId>, Span<const Box>);                                     \
  template bool WorldCore<S>::set_filter(ProxyId, Filter);                                                           \
  template bool WorldCore<S>::ask_again(ProxyId);                                                                    \
  template void WorldCore<S>::ask_again();                                                                           \
  template bool WorldCore<S>::set_user(ProxyId, std::uint64_t);                                                      \
  template WorldCore<S>::Box WorldCore<S>::box(ProxyId) const;                                                       \
  template Filter WorldCore<S>::filter(ProxyId) const;                                                               \
  template std::uint64_t WorldCore<S>::user(ProxyId) const
INSTANTIATE(float);
INSTANTIATE(double);
#undef INSTANTIATE

}  // namespace boxstream::detail
