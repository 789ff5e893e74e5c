// SPDX-License-Identifier: MIT
#include <boxstream/world.hpp>

#include "world/core.hpp"

namespace boxstream {

template <class S>
struct BasicWorld<S>::Impl : detail::WorldCore<S> {
  using detail::WorldCore<S>::WorldCore;
};

template <class S>
BasicWorld<S>::BasicWorld(WorldOptions options) : impl_(std::make_unique<Impl>(options)) {}
template <class S>
BasicWorld<S>::~BasicWorld() = default;
template <class S>
BasicWorld<S>::BasicWorld(BasicWorld&&) noexcept = default;
template <class S>
BasicWorld<S>& BasicWorld<S>::operator=(BasicWorld&&) noexcept = default;

template <class S>
ProxyId BasicWorld<S>::create(const Box& box, Filter filter, std::uint64_t user) {
  return impl_->create(box, filter, user);
}
template <class S>
void BasicWorld<S>::create(Span<const Box> boxes, Span<const Filter> filters, Span<ProxyId> out,
                           Span<const std::uint64_t> users) {
  impl_->create(boxes, filters, out, users);
}
template <class S>
bool BasicWorld<S>::destroy(ProxyId id) {
  return impl_->destroy(id);
}
template <class S>
std::size_t BasicWorld<S>::destroy(Span<const ProxyId> ids) {
  return impl_->destroy(ids);
}
template <class S>
void BasicWorld<S>::clear() {
  impl_->clear();
}
template <class S>
bool BasicWorld<S>::move(ProxyId id, const Box& box) {
  return impl_->move(id, box);
}
template <class S>
std::size_t BasicWorld<S>::move(Span<const ProxyId> ids, Span<const Box> boxes) {
  return impl_->move(ids, boxes);
}
template <class S>
bool BasicWorld<S>::set_filter(ProxyId id, Filter filter) {
  return impl_->set_filter(id, filter);
}
template <class S>
bool BasicWorld<S>::ask_again(ProxyId id) {
  return impl_->ask_again(id);
}
template <class S>
void BasicWorld<S>::ask_again() {
  impl_->ask_again();
}
template <class S>
bool BasicWorld<S>::set_user(ProxyId id, std::uint64_t user) {
  return impl_->set_user(id, user);
}
template <class S>
bool BasicWorld<S>::contains(ProxyId id) const {
  return impl_->contains(id);
}
template <class S>
std::size_t BasicWorld<S>::size() const {
  return impl_->size();
}
template <class S>
typename BasicWorld<S>::Box BasicWorld<S>::box(ProxyId id) const {
  return impl_->box(id);
}
template <class S>
Filter BasicWorld<S>::filter(ProxyId id) const {
  return impl_->filter(id);
}
template <class S>
std::uint64_t BasicWorld<S>::user(ProxyId id) const {
  return impl_->user(id);
}
template <class S>
WorldStats BasicWorld<S>::update() {
  return impl_->update();
}
template <class S>
WorldStats BasicWorld<S>::update(ProxyPairFilter accept) {
  return impl_->update(accept);
}
template <class S>
void BasicWorld<S>::limit_begun(std::uint64_t most) {
  impl_->limit_begun(most);
}
template <class S>
Span<const ProxyPair> BasicWorld<S>::begun() const {
  return impl_->begun();
}
template <class S>
Span<const ProxyPair> BasicWorld<S>::ended() const {
  return impl_->ended();
}
template <class S>
std::uint64_t BasicWorld<S>::pair_count() const {
  return impl_->pair_count();
}
template <class S>
void BasicWorld<S>::for_each_pair(FunctionRef<bool(ProxyPair)> visit) const {
  impl_->for_each_pair(visit);
}
template <class S>
void BasicWorld<S>::stream_pairs(ProxyPairSink sink) const {
  impl_->stream_pairs(sink);
}
template <class S>
void BasicWorld<S>::begin_pairs_of(ProxyId id, ProxyPairFilter accept, FunctionRef<void(ProxyPair)> begin,
                                   bool accept_alone) {
  impl_->begin_pairs_of(id, accept, begin, accept_alone);
}
template <class S>
bool BasicWorld<S>::release(ProxyId a, ProxyId b) {
  return impl_->release(a, b);
}
template <class S>
void BasicWorld<S>::query_box(const Box& box, ProxyVisitor visit) const {
  impl_->query_box(box, visit);
}
template <class S>
void BasicWorld<S>::query_planes(Span<const BasicPlane<S>> planes, ProxyVisitor visit) const {
  impl_->query_planes(planes, visit);
}
template <class S>
void BasicWorld<S>::query_ray(const BasicRay<S>& ray, RayVisitor<S> visit) const {
  impl_->query_ray(ray, visit);
}
template <class S>
std::size_t BasicWorld<S>::query_nearest(const S (&point)[3], Span<ProxyId> out) const {
  return impl_->query_nearest(point, out);
}
template <class S>
void BasicWorld<S>::query_nearest_box(const Box& box, S limit, NearVisitor<S> visit) const {
  impl_->query_nearest_box(box, limit, visit);
}
template <class S>
void BasicWorld<S>::nearest_pairs(S limit, NearPairVisitor<S> visit) const {
  impl_->nearest_pairs(*impl_, limit, visit);
}
template <class S>
void BasicWorld<S>::nearest_pairs(const BasicWorld& other, S limit, NearPairVisitor<S> visit) const {
  impl_->nearest_pairs(*other.impl_, limit, visit);
}
template <class S>
typename BasicWorld<S>::Box BasicWorld<S>::bounds() const {
  return impl_->bounds();
}
template <class S>
void BasicWorld<S>::validate() const {
  impl_->validate();
}

template class BasicWorld<float>;
template class BasicWorld<double>;

}  // namespace boxstream
