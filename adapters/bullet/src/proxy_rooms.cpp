// SPDX-License-Identifier: MIT
#include "proxy_rooms.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include <boxstream/detail/float_environment.hpp>

#include "usual_margin.hpp"

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {
namespace {

using Box = ProxyRooms::Box;

btScalar between(btScalar low, btScalar high) {
  return std::min(std::max((low + high) / 2, low), high);
}

bool contains(const Box& outer, const Box& inner) {
  bool in = true;
  for (int d = 0; d < 3; ++d) in = in && outer.min[d] <= inner.min[d] && inner.max[d] <= outer.max[d];
  return in;
}

/// How far two boxes may move towards the other verdict.
btScalar clearance(const Box& a, const Box& b, bool touch) {
  btScalar least = std::numeric_limits<btScalar>::max(), widest = -1;
  for (int d = 0; d < 3; ++d) {
    least = std::min({least, b.max[d] - a.min[d], a.max[d] - b.min[d]});
    widest = std::max({widest, b.min[d] - a.max[d], a.min[d] - b.max[d]});
  }
  return touch ? least : widest;
}

}  // namespace

/// Of valid boxes. Without branches: of watched ones the outcome is hard to predict.
bool ProxyRooms::touch(const Proxy& a, const Proxy& b, bool has_margin) {
  if (has_margin) return overlaps(box_in_world(a), box_in_world(b));
  bool touch = true;
  for (int d = 0; d < 3; ++d)
    touch = touch & (a.m_aabbMin.m_floats[d] <= b.m_aabbMax.m_floats[d]) &
            (b.m_aabbMin.m_floats[d] <= a.m_aabbMax.m_floats[d]);
  return touch;
}

/// `went` is how far it came since the last one.
Box ProxyRooms::fat_box(const Box& box, btScalar went) {
  if (!is_moderate(box)) return box;
  const btScalar usual = usual_margin(box);
  return expanded(box, std::max(usual, std::min(2 * went, 4 * usual)));
}

ProxyRooms::Room& ProxyRooms::add_room(Proxy& proxy) {
  proxy.room = std::uint32_t(rooms_.size());
  Room& room = rooms_.emplace_back();
  room.shape = proxy.sized_shape;
  room.margin = proxy.margin;
  room.differs = false;
  return room;
}

/// As wide as the fat box, but on one side of zero. Boxes too far out to compute with have no more than their place.
void ProxyRooms::start_room(const Proxy& proxy, const Box& box) {
  Room& room = rooms_[proxy.room];
  const Box& fat = fat_boxes_[proxy.position];
  const bool is_near = is_moderate(box);
  for (int d = 0; d < 3; ++d) {
    const btScalar low = proxy.m_aabbMin.m_floats[d], high = proxy.m_aabbMax.m_floats[d];
    if (!is_near) {
      room.min[d] = {std::bit_cast<Bits>(low), 0};
      room.max[d] = {std::bit_cast<Bits>(high), 0};
      continue;
    }
    room.min[d].start(low);
    room.max[d].start(high);
    const btScalar center = between(box.min[d], box.max[d]);
    room.raise_min(d, fat.min[d], proxy);
    room.lower_min(d, center, proxy);
    room.raise_max(d, center, proxy);
    room.lower_max(d, fat.max[d], proxy);
  }
}

/// Shares what keeps the verdict about two boxes between their rooms. False if that is too little.
bool ProxyRooms::part(const Proxy& a, const Box& box_a, const Proxy& b, const Box& box_b, bool touch) {
  const btScalar least = least_clearance(box_a, box_b);
  Room &room_a = rooms_[a.room], &room_b = rooms_[b.room];
  if (touch) {
    if (clearance(box_a, box_b, touch) < least) return false;
    for (int d = 0; d < 3; ++d) {
      const btScalar one = between(box_a.min[d], box_b.max[d]), other = between(box_b.min[d], box_a.max[d]);
      room_a.lower_min(d, one, a);
      room_b.raise_max(d, one, b);
      room_a.raise_max(d, other, a);
      room_b.lower_min(d, other, b);
    }
    return true;
  }
  int axis = 0;
  btScalar widest = -1;
  bool a_is_below = true;
  for (int d = 0; d < 3; ++d) {
    const btScalar up = box_b.min[d] - box_a.max[d], down = box_a.min[d] - box_b.max[d];
    if (std::max(up, down) <= widest) continue;
    widest = std::max(up, down);
    axis = d;
    a_is_below = up > down;
  }
  if (widest < least) return false;
  const btScalar low = a_is_below ? box_a.max[axis] : box_b.max[axis];
  const btScalar high = a_is_below ? box_b.min[axis] : box_a.min[axis];
  btScalar end = between(low, high);
  if (!(end < high)) end = low;
  const btScalar begin = number(key(end) + 1);
  (a_is_below ? room_a : room_b).lower_max(axis, end, a_is_below ? a : b);
  (a_is_below ? room_b : room_a).raise_min(axis, begin, a_is_below ? b : a);
  return true;
}

/// Of pairs with less some are watched in each batch, so that boxes leave their rooms less often; in stacks, where all
/// pairs have little, only those with half of it.
btScalar ProxyRooms::least_clearance(const Box& a, const Box& b) const {
  return std::min(usual_margin(a), usual_margin(b)) / (has_close_pairs_ ? 8 : 4);
}

void ProxyRooms::watch(Proxy& a, Proxy& b, bool is_held) {
  const auto put_first = [&](const Proxy& of, const Proxy& other) {
    Candidate* const candidate = find(of.position, other.position);
    candidate->is_watched = 1;
    Row& row = rows_[of.position];
    std::swap(*candidate, candidates_[row.first + row.watched++]);
  };
  put_first(a, b);
  put_first(b, a);
  a.is_watched = b.is_watched = true;
  watched_.push_back({&a, &b, is_held, a.margin != 0 || b.margin != 0});
}

void ProxyRooms::flip(const Proxy& a, const Proxy& b, bool is_held) {
  find(a.position, b.position)->is_held = find(b.position, a.position)->is_held = is_held ? 1 : 0;
  (is_held ? begun_ : ended_).push_back({a.id, b.id});
}

ProxyRooms::Candidate* ProxyRooms::find(std::uint32_t of, std::uint32_t other) {
  const Row& row = rows_[of];
  Candidate* const first = candidates_.data() + row.first;
  Candidate* const found = std::find_if(first, first + row.size, [&](Candidate c) { return c.other == other; });
  return found == first + row.size ? nullptr : found;
}

void ProxyRooms::add(std::uint32_t of, std::uint32_t other, bool held) {
  Row& row = rows_[of];
  if (row.size == row.room) {  // goes behind all others
    const std::size_t first = candidates_.size(), room = 2 * std::size_t(row.room) + 4;
    candidates_.resize(first + room);
    std::copy_n(candidates_.begin() + row.first, row.size, candidates_.begin() + std::ptrdiff_t(first));
    row.first = std::uint32_t(first);
    row.room = std::uint32_t(room);
  }
  candidates_[row.first + row.size++] = {other, 0, held ? 1u : 0u};
}

void ProxyRooms::drop(std::uint32_t of, std::uint32_t other) {
  Candidate* const place = find(of, other);
  Row& row = rows_[of];
  *place = candidates_[row.first + row.size - 1];
  --row.size;
}

bool ProxyRooms::open(const Proxies& live, PairStore& pairs) {
  const boxstream::detail::DefaultFloatEnvironment environment;
  const std::size_t count = live.size();
  if (count >= std::size_t{1} << 30) return false;
  fat_boxes_.resize(count);
  rows_.assign(count, Row());
  for (std::size_t i = 0; i < count; ++i) fat_boxes_[i] = fat_box(box_in_world(*live[i]), 0);
  detector().find_pairs(fat_boxes_, found_, filters_);
  for (const Pair& pair : found_) {
    ++rows_[pair.a].room;
    ++rows_[pair.b].room;
  }
  std::uint32_t size = 0;
  for (Row& row : rows_) {
    row.first = size;
    size += row.room += 2;
  }
  candidates_.assign(size, Candidate());
  for (const Pair& pair : found_) {
    add(pair.a, pair.b, false);
    add(pair.b, pair.a, false);
  }
  for (std::uint32_t i = 0; i < pairs.size(); ++i) {
    const std::uint32_t a = static_cast<const Proxy*>(pairs[i].m_pProxy0)->position;
    const std::uint32_t b = static_cast<const Proxy*>(pairs[i].m_pProxy1)->position;
    const bool is_first = rows_[a].size <= rows_[b].size;
    Candidate* const candidate = is_first ? find(a, b) : find(b, a);
    if (candidate == nullptr) return false;
    candidate->is_held = 1;  // the other one below
  }
  exited_.clear();
  strayed_.clear();
  watched_.clear();
  exited_.reserve(count);
  strayed_.reserve(count);
  rooms_.reserve(count);
  boxes_.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    add_room(*live[i]);
    start_room(*live[i], boxes_[i] = box_in_world(*live[i]));
  }
  has_close_pairs_ = false;
  const auto is_close = [this](const Pair& pair) {
    const Box &a = boxes_[pair.a], &b = boxes_[pair.b];
    return clearance(a, b, overlaps(a, b)) < least_clearance(a, b);
  };
  has_close_pairs_ = std::size_t(std::count_if(found_.begin(), found_.end(), is_close)) > count;
  for (const Pair& pair : found_) {
    const bool touch = overlaps(boxes_[pair.a], boxes_[pair.b]);
    Candidate *const one = find(pair.a, pair.b), *const other = find(pair.b, pair.a);
    if (touch != ((one->is_held | other->is_held) != 0)) {
      close(live);
      return false;
    }
    one->is_held = other->is_held = touch ? 1 : 0;
    Proxy &a = *live[pair.a], &b = *live[pair.b];
    if (!part(a, boxes_[pair.a], b, boxes_[pair.b], touch)) watch(a, b, touch);
  }
  any_moved_ = false;
  refits_ = 0;
  return true;
}

/// A new fat box. Candidates that it does not touch go, but for those that are held: these may have to end.
bool ProxyRooms::refit(const Proxy& proxy) {
  const std::uint32_t position = proxy.position;
  const Box box = box_in_world(proxy), last = fat_boxes_[position];
  if (!is_moderate(box) || !is_moderate(last)) return false;
  btScalar went = 0;
  for (int d = 0; d < 3; ++d)
    went = std::max(went, std::abs((box.min[d] - last.min[d]) / 2 + (box.max[d] - last.max[d]) / 2));
  const Box fat = fat_boxes_[position] = fat_box(box, went);
  Row& row = rows_[position];
  std::uint32_t kept = 0;
  for (std::uint32_t i = 0; i < row.size; ++i) {
    const Candidate candidate = candidates_[row.first + i];
    if (candidate.is_held || candidate.is_watched || overlaps(fat, fat_boxes_[candidate.other]))
      candidates_[row.first + kept++] = candidate;
    else
      drop(candidate.other, position);
  }
  row.size = kept;
  return true;
}

/// Where their fat boxes touch and they are not known as candidates yet.
void ProxyRooms::add_candidates(std::uint32_t position, std::uint32_t other) {
  if (other == position || find(position, other) != nullptr) return;
  add(position, other, false);
  add(other, position, false);
}

/// False if one is too far out to follow, or there are too many candidates.
bool ProxyRooms::refit_strayed(const Proxies& live) {
  std::size_t count = 0;
  for (const std::uint32_t position : strayed_) {
    Proxy& proxy = *live[position];
    proxy.has_strayed = false;
    if (is_near(proxy)) continue;
    if (!refit(proxy)) return false;
    strayed_[count++] = position;
  }
  strayed_.resize(count);
  refits_ += count;
  constexpr std::size_t few = 2;
  if (count <= few) {  // a look at all is less than a batch
    for (const std::uint32_t position : strayed_)
      for (std::uint32_t other = 0; other < fat_boxes_.size(); ++other)
        if (overlaps(fat_boxes_[position], fat_boxes_[other]) && is_valid(fat_boxes_[other]) &&
            accepts(filters_[position], filters_[other]))
          add_candidates(position, other);
  } else {
    boxes_.clear();
    asked_.clear();
    for (const std::uint32_t position : strayed_) {
      boxes_.push_back(fat_boxes_[position]);
      asked_.push_back(filters_[position]);
    }
    detector().find_pairs(boxes_, fat_boxes_, found_, asked_, filters_);
    for (const Pair& pair : found_) add_candidates(strayed_[pair.a], pair.b);
  }
  strayed_.clear();
  return candidates_.size() < 64 * live.size() + (std::size_t{1} << 16);
}

bool ProxyRooms::come_near(const Proxies& live) {
  if (strayed_.empty()) return true;
  const boxstream::detail::DefaultFloatEnvironment environment;
  return refit_strayed(live);
}

bool ProxyRooms::open_few(World& world, Span<const ProxyId> moved) {
  const boxstream::detail::DefaultFloatEnvironment environment;
  for (const ProxyId id : moved) {
    Box outer, inner;
    Proxy* const proxy = live_proxy_of(world, id);
    if (proxy == nullptr || !world.room(id, outer, inner)) {
      close(few_);
      return false;
    }
    Room& room = add_room(*proxy);
    few_.push_back(proxy);
    for (int d = 0; d < 3; ++d) {
      room.min[d].start(proxy->m_aabbMin.m_floats[d]);
      room.max[d].start(proxy->m_aabbMax.m_floats[d]);
      room.raise_min(d, outer.min[d], *proxy);
      room.lower_min(d, inner.min[d], *proxy);
      room.raise_max(d, inner.max[d], *proxy);
      room.lower_max(d, outer.max[d], *proxy);
    }
  }
  return are_open();
}

bool ProxyRooms::settle(const Proxies& live, RoomsChoice& choice, RoomsChoice::Price search) {
  begun_.clear();
  ended_.clear();
  if (!std::exchange(any_moved_, false) || are_few()) return true;
  const boxstream::detail::DefaultFloatEnvironment environment;
  const std::size_t strays = std::exchange(refits_, 0) + strayed_.size();
  if (!choice.go_on(watched_.size(), exited_.size(), strays, search) || !refit_strayed(live)) return false;
  refits_ = 0;
  for (const std::uint32_t position : exited_) {
    Proxy& proxy = *live[position];
    const Box box = box_in_room(proxy);
    proxy.has_left_room = false;
    start_room(proxy, box);
    const Row& row = rows_[position];
    for (std::uint32_t i = 0; i < row.size; ++i) {
      const Candidate candidate = candidates_[row.first + i];
      if (candidate.is_watched) continue;
      Proxy& other = *live[candidate.other];
      const Box beside = box_in_room(other);
      const bool touch = overlaps(box, beside);
      if (touch != (candidate.is_held != 0)) flip(proxy, other, touch);
      if (!part(proxy, box, other, beside, touch)) watch(proxy, other, touch);
    }
  }
  exited_.clear();
  for (Watched& watched : watched_) {
    const bool do_touch = touch(*watched.a, *watched.b, watched.has_margin);
    if (do_touch == watched.is_held) continue;
    flip(*watched.a, *watched.b, do_touch);
    watched.is_held = do_touch;
  }
  return true;
}

bool ProxyRooms::is_near(const Proxy& proxy) const {
  const boxstream::detail::DefaultFloatEnvironment environment;
  const Box box = box_in_room(proxy);
  return is_valid(box) && contains(fat_boxes_[proxy.position], box);
}

void ProxyRooms::note_begun(const Proxy& a, const Proxy& b) {
  Candidate& candidate = *find(a.position, b.position);
  candidate.is_held = find(b.position, a.position)->is_held = 1;
  if (!candidate.is_watched) return;
  for (Watched& watched : watched_)
    if ((watched.a == &a && watched.b == &b) || (watched.a == &b && watched.b == &a)) watched.is_held = true;
}

void ProxyRooms::close(const Proxies& live) noexcept {
  for (Proxy* proxy : are_few() ? few_ : live) {
    proxy->room = no_link;
    proxy->has_left_room = proxy->has_strayed = proxy->is_watched = false;
  }
  rooms_.clear();
  few_.clear();
  exited_.clear();
  strayed_.clear();
  watched_.clear();
}

void ProxyRooms::give_back() noexcept {
  const auto drop = [](auto&... vectors) { (std::remove_reference_t<decltype(vectors)>().swap(vectors), ...); };
  detector_.reset();
  drop(found_, rooms_, few_, fat_boxes_, filters_, rows_, candidates_, watched_, exited_, strayed_, begun_, ended_,
       boxes_, asked_);
}

void ProxyRooms::validate(const Proxies& live, const World& world, bool refuses) const {
  const auto check = [](bool holds, const char* what) {
    if (!holds) throw std::logic_error(what);
  };
  if (!are_open()) return;
  const boxstream::detail::DefaultFloatEnvironment environment;
  check(rooms_.size() == (are_few() ? few_ : live).size(), "rooms: not one for each proxy");
  for (const Proxy* proxy : live) {
    const Box box = world.box(proxy->id), given = box_in_world(*proxy);
    check(differs(*proxy) || box == given || !is_valid(given), "rooms: a box that the World does not have");
    check(are_few() || hold(*proxy, proxy->m_aabbMin, proxy->m_aabbMax) || proxy->has_left_room ||
              !is_moderate(given) || !differs(*proxy),
          "rooms: a box that has left is not noted");
  }
  if (any_moved_) return;  // until it is settled
  for (const Proxy* a : live)
    for (const Proxy* b : live) {
      if (a->position >= b->position || !(are_few() || accepts(filters_[a->position], filters_[b->position]))) continue;
      if (are_few() && !accepts(world.filter(a->id), world.filter(b->id))) continue;
      const Box x = box_in_world(*a), y = box_in_world(*b);
      const bool touch = is_valid(x) && is_valid(y) && overlaps(x, y);
      const bool is_held = world.pair_place(a->id, b->id).has_value();
      check(touch == is_held || (touch && are_few() && refuses),
            "rooms: a pair that the World should hold, or should not");
    }
}

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
