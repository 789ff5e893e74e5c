// SPDX-License-Identifier: MIT
#include "world/core.hpp"

#include <stdexcept>
#include <utility>

namespace boxstream {

using namespace detail;

template <class S>
BasicWorld<S>::BasicWorld(WorldOptions options) : impl_(std::make_unique<Impl>(options, SearchMode::cheapest)) {}
template <class S>
BasicWorld<S>::BasicWorld(std::unique_ptr<Impl> impl) noexcept : impl_(std::move(impl)) {}
template <class S>
BasicWorld<S>::~BasicWorld() = default;
template <class S>
BasicWorld<S>::BasicWorld(BasicWorld&&) noexcept = default;
template <class S>
BasicWorld<S>& BasicWorld<S>::operator=(BasicWorld&&) noexcept = default;

template <class S>
ProxyId BasicWorld<S>::create(const Box& box, Filter filter, std::uint64_t user) {
  const InUse::Change change(impl_->in_use_);
  impl_->make_room(1);
  const ProxyId id = impl_->proxies_.create(box, filter, user);
  impl_->index_.mark(id.slot);
  return id;
}

template <class S>
void BasicWorld<S>::create(Span<const Box> boxes, Span<const Filter> filters, Span<ProxyId> out,
                           Span<const std::uint64_t> users) {
  const InUse::Change change(impl_->in_use_);
  const auto fits = [&](std::size_t size) { return size == 0 || size == boxes.size(); };
  if (!fits(filters.size()) || !fits(users.size()) || out.size() != boxes.size())
    throw std::invalid_argument("boxstream: filters, user words and ids must be as many as boxes");
  impl_->make_room(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    out[i] = impl_->proxies_.create(boxes[i], filters.empty() ? Filter() : filters[i], users.empty() ? 0 : users[i]);
    impl_->index_.mark(out[i].slot);
  }
}

template <class S>
bool BasicWorld<S>::destroy(ProxyId id) {
  return impl_->change(id, [&](std::uint32_t rank) {
    impl_->proxies_.destroy(rank);
    impl_->index_.mark(id.slot);
  });
}

template <class S>
std::size_t BasicWorld<S>::destroy(Span<const ProxyId> ids) {
  std::size_t live = 0;
  for (const ProxyId id : ids) live += destroy(id);
  return live;
}

template <class S>
void BasicWorld<S>::clear() {
  const InUse::Change change(impl_->in_use_);
  impl_->proxies_.clear();
  impl_->pairs_.clear();
  impl_->search_.fat_boxes().clear();
  impl_->search_.choice() = SearchChoice();
  impl_->index_.release();
  impl_->rooms_ = Rooms<S>();
  impl_->forget_changes();
  impl_->most_begun_ = ~std::uint64_t{0};
  impl_->holds_much_ = true;  // perhaps
}

template <class S>
bool BasicWorld<S>::move(ProxyId id, const Box& box) {
  return impl_->change(id, [&](std::uint32_t rank) {
    if (impl_->proxies_.move(rank, box)) impl_->index_.mark(id.slot);
  });
}

template <class S>
std::size_t BasicWorld<S>::move(Span<const ProxyId> ids, Span<const Box> boxes) {
  const InUse::Change change(impl_->in_use_);
  if (ids.size() != boxes.size()) throw std::invalid_argument("boxstream: there must be as many boxes as ids");
  return impl_->proxies_.move(ids, boxes, [this](std::uint32_t slot) { impl_->index_.mark(slot); });
}

template <class S>
bool BasicWorld<S>::set_filter(ProxyId id, Filter filter) {
  return impl_->change(id, [&](std::uint32_t rank) { impl_->proxies_.set_filter(rank, filter); });
}

template <class S>
bool BasicWorld<S>::refilter(ProxyId id) {
  return impl_->change(id, [&](std::uint32_t rank) { impl_->proxies_.refilter(rank); });
}

template <class S>
void BasicWorld<S>::refilter() {
  const InUse::Change change(impl_->in_use_);
  for (std::uint32_t rank = 0; rank < impl_->proxies_.ranks(); ++rank) impl_->proxies_.refilter(rank);
}

template <class S>
bool BasicWorld<S>::set_user(ProxyId id, std::uint64_t user) {
  return impl_->change(id, [&](std::uint32_t rank) { impl_->proxies_.set_user(rank, user); });
}

template <class S>
bool BasicWorld<S>::contains(ProxyId id) const {
  return impl_->proxies_.rank(id) != ProxyTable<S>::none;
}

template <class S>
std::size_t BasicWorld<S>::size() const {
  return impl_->proxies_.live();
}

template <class S>
typename BasicWorld<S>::Box BasicWorld<S>::box(ProxyId id) const {
  const std::uint32_t rank = impl_->proxies_.rank(id);
  return rank == ProxyTable<S>::none ? ProxyTable<S>::inert_box() : impl_->proxies_.box(rank);
}

template <class S>
Filter BasicWorld<S>::filter(ProxyId id) const {
  const std::uint32_t rank = impl_->proxies_.rank(id);
  return rank == ProxyTable<S>::none ? Filter{0, 0} : impl_->proxies_.filter(rank);
}

template <class S>
std::uint64_t BasicWorld<S>::user(ProxyId id) const {
  const std::uint32_t rank = impl_->proxies_.rank(id);
  return rank == ProxyTable<S>::none ? 0 : impl_->proxies_.user(rank);
}

/// For `more` proxies.
template <class S>
void WorldParts<S>::make_room(std::size_t more) {
  if (proxies_.needs_compaction() || proxies_.crowds_few(more)) drop_tombstones();
  proxies_.reserve(more);
  index_.reserve_slots(proxies_.slots_after(more));
}

/// For worlds that create and destroy proxies between updates. Tombstones with held pairs stay until the pairs end.
template <class S>
void WorldParts<S>::drop_tombstones() {
  is_referenced_.assign(proxies_.ranks(), false);
  proxies_.reserve_to_compact();
  pairs_.for_each([this](PairKey key) {
    is_referenced_[first_of(key)] = is_referenced_[second_of(key)] = true;
    return true;
  });
  pairs_.fold();
  const auto new_rank = proxies_.compact([this](std::uint32_t rank) { return is_referenced_[rank] != 0; });
  pairs_.remap(new_rank);
  search_.fat_boxes().remap(new_rank);
  rooms_.forget();
}

// What is defined here. Other members are instantiated one by one, because their definitions are spread over several
// files.
template class BasicWorld<float>;
template class BasicWorld<double>;
template void WorldParts<float>::drop_tombstones();
template void WorldParts<double>::drop_tombstones();

}  // namespace boxstream
