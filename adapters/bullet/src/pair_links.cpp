// SPDX-License-Identifier: MIT
#include "pair_links.hpp"

#include <utility>

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {
namespace {

Proxy& side(const btBroadphasePair& pair, std::uint32_t s) {
  return static_cast<Proxy&>(s == 0 ? *pair.m_pProxy0 : *pair.m_pProxy1);
}

}  // namespace

void PairLinks::build(btBroadphasePairArray& pairs, Span<const std::uint32_t> order) {
  if (std::exchange(built_, true)) return;
  ++epoch_;
  const auto count = std::uint32_t(pairs.size());
  nodes_.resize(2 * std::size_t(count));
  const auto push_both = [&](std::uint32_t i) {
    for (std::uint32_t s = 0; s < 2; ++s) push(side(pairs[int(i)], s), 2 * i + s);
  };
  if (order.empty())
    for (std::uint32_t i = 0; i < count; ++i) push_both(i);
  for (const std::uint32_t i : order)
    if (i != no_link) push_both(i);
}

void PairLinks::add(const btBroadphasePair& pair, std::uint32_t index) {
  if (nodes_.size() < 2 * (std::size_t(index) + 1)) nodes_.resize(2 * (std::size_t(index) + 1));
  for (std::uint32_t s = 0; s < 2; ++s) push(side(pair, s), 2 * index + s);
}

void PairLinks::remove(const btBroadphasePair& pair, std::uint32_t index) {
  for (std::uint32_t s = 0; s < 2; ++s) cut(side(pair, s), 2 * index + s);
}

void PairLinks::move(const btBroadphasePair& pair, std::uint32_t from, std::uint32_t to) {
  for (std::uint32_t s = 0; s < 2; ++s) {
    const Node node = nodes_[2 * from + s];
    const std::uint32_t link = 2 * to + s;
    nodes_[link] = node;
    (node.previous == no_link ? side(pair, s).first_link : nodes_[node.previous].next) = link;
    if (node.next != no_link) nodes_[node.next].previous = link;
  }
}

void PairLinks::push(Proxy& proxy, std::uint32_t link) {
  if (!has_list(proxy)) {
    proxy.links_epoch = epoch_;
    proxy.first_link = no_link;
    proxy.degree = 0;
  }
  nodes_[link] = {no_link, proxy.first_link};
  if (proxy.first_link != no_link) nodes_[proxy.first_link].previous = link;
  proxy.first_link = link;
  ++proxy.degree;
}

void PairLinks::cut(Proxy& proxy, std::uint32_t link) {
  const Node node = nodes_[link];
  (node.previous == no_link ? proxy.first_link : nodes_[node.previous].next) = node.next;
  if (node.next != no_link) nodes_[node.next].previous = node.previous;
  --proxy.degree;
}

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
