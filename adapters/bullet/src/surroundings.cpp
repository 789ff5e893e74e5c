// SPDX-License-Identifier: MIT
#include "surroundings.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "usual_margin.hpp"

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {
namespace {

using Box = Surroundings::Box;

constexpr unsigned most_failures = 8;

/// Wider on all sides by an eighth of its least side, and on those to which it goes by up to half of it: `went` is how
/// far it came since the last one.
Box fat_box(const Box& box, const btScalar (&went)[3]) {
  const btScalar usual = usual_margin(box);
  Box fat = expanded(box, usual);
  for (int d = 0; d < 3; ++d) {
    const btScalar lead = 2 * went[d];
    if (std::abs(lead) > 32 * usual) continue;  // a jump
    (lead < 0 ? fat.min : fat.max)[d] += std::clamp(lead, -4 * usual, 4 * usual);
  }
  return fat;
}

}  // namespace

bool Surroundings::note_search(std::size_t proxies) {
  constexpr std::size_t few = 8;
  return ++searches_ >= (proxies / 4 + few) << failures_;
}

void Surroundings::begin(std::size_t proxies) {
  index_.emplace();
  rows_.reserve(proxies);
  bounds_.reserve(proxies);
  searches_ = questions_ = refits_ = links_ = longest_ = 0;
  idle_batches_ = 0;
}

void Surroundings::note_created(Proxy& proxy, const Box& box) {
  const boxstream::detail::DefaultFloatEnvironment environment;
  if (free_rows_.empty()) {
    rows_.emplace_back();
    bounds_.resize(rows_.size());
    free_rows_.reserve(rows_.capacity());
    strayed_.reserve(rows_.capacity());
    free_rows_.push_back(std::uint32_t(rows_.size() - 1));
  }
  proxy.row = free_rows_.back();
  free_rows_.pop_back();
  rows_[proxy.row].fat = no_box;
  rows_[proxy.row].proxy = &proxy;
  rows_[proxy.row].has_moved = false;
  bounds_[proxy.row] = bounds_of(box);
  note_strayed(proxy.row);
}

void Surroundings::note_destroyed(Proxy& proxy) noexcept {
  Row& row = rows_[proxy.row];
  for (const std::uint32_t other : row.near) unlink(other, proxy.row);
  links_ -= row.near.size();
  row.near.clear();
  row.held = 0;
  index_->destroy(std::exchange(row.in_index, ProxyId()));
  asking_ -= std::exchange(row.asks, false) ? 1 : 0;
  if (row.has_strayed()) {  // the last one takes its place
    rows_[strayed_.back()].strayed_at = row.strayed_at;
    strayed_[row.strayed_at] = strayed_.back();
    strayed_.pop_back();
    row.strayed_at = none;
  }
  row.proxy = nullptr;
  free_rows_.push_back(proxy.row);
}

/// The last one takes its place.
void Surroundings::unlink(std::uint32_t at, std::uint32_t other) noexcept {
  Row& row = rows_[at];
  note_not_held(row, other);
  *std::find(row.near.begin() + row.held, row.near.end(), other) = row.near.back();
  row.near.pop_back();
  --links_;
}

void Surroundings::note_not_held(Row& row, std::uint32_t other) noexcept {
  const auto end = row.near.begin() + row.held, place = std::find(row.near.begin(), end, other);
  if (place != end) std::swap(*place, row.near[--row.held]);
}

void Surroundings::note_ended(const Proxy& a, const Proxy& b) noexcept {
  note_not_held(rows_[a.row], b.row);
  note_not_held(rows_[b.row], a.row);
}

std::size_t Surroundings::find_touching(const Row& row, const Bounds& box, const Box& settled) {
  if (found_.size() < row.near.size()) found_.resize(row.near.size());
  const boxstream::detail::DefaultFloatEnvironment environment;
  const Bounds apart = is_valid(settled) ? Bounds(settled) : Bounds::nowhere();
  std::size_t count = 0;
  for (std::uint32_t i = row.held; i < row.near.size(); ++i) {
    const Bounds& beside = bounds_[row.near[i]];
    found_[count] = i;
    count += unsigned{touch(box, beside)} & unsigned{!touch(apart, beside)};
  }
  return count;
}

void Surroundings::settle(Proxy& proxy) {
  ++questions_;
  idle_batches_ = 0;
  for (const std::uint32_t strayed : strayed_) {
    rows_[strayed].strayed_at = none;
    refit(strayed);
  }
  strayed_.clear();
  Row& row = rows_[proxy.row];
  if (row.asks) return;
  row.asks = true;
  ++asking_;
  find_neighbours(proxy.row);
}

/// Unless the box has come back.
void Surroundings::refit(std::uint32_t at) {
  Row& row = rows_[at];
  const Box box = bounds_[at].box();
  const bool is_first = !row.in_index;
  {
    const boxstream::detail::DefaultFloatEnvironment environment;
    if (holds(row.fat, box)) return;
    btScalar went[3] = {0, 0, 0};
    if (is_moderate(box))
      for (int d = 0; d < 3; ++d) {
        const btScalar center = box.min[d] / 2 + box.max[d] / 2;
        went[d] = center - std::exchange(row.center[d], center);
      }
    row.fat = !is_valid(box) ? no_box : is_first || !is_moderate(box) ? box : fat_box(box, went);
  }
  if (is_first) {
    row.in_index = index_->create(row.fat, Filter{}, at);
  } else {
    refits_ += std::exchange(row.has_moved, true) ? 1 : 0;
    index_->move(row.in_index, row.fat);
  }
  if (asking_ > 0) find_neighbours(at);
}

/// Those whose fat boxes it does not touch any more go, others come.
void Surroundings::find_neighbours(std::uint32_t at) {
  Row& row = rows_[at];
  const std::uint64_t known = stamp_ += 2, stays = known + 1;
  for (const std::uint32_t other : row.near) rows_[other].stamp = known;
  found_.clear();
  index_->query_box(row.fat, [&](ProxyId id) {
    const auto other = std::uint32_t(index_->user(id));
    Row& beside = rows_[other];
    if (beside.stamp == known)
      beside.stamp = stays;
    else if ((row.asks || beside.asks) && other != at)
      found_.push_back(other);
    return true;
  });
  std::uint32_t kept = 0, kept_held = 0;
  for (std::uint32_t i = 0; i < row.near.size(); ++i) {
    const std::uint32_t other = row.near[i];
    if (rows_[other].stamp != stays) {
      unlink(other, at);
      continue;
    }
    row.near[kept++] = other;
    kept_held += i < row.held ? 1 : 0;
  }
  links_ -= row.near.size() - kept;
  row.near.resize(kept);
  row.held = kept_held;
  links_ += 2 * found_.size();
  for (const std::uint32_t other : found_) {
    row.near.push_back(other);
    rows_[other].near.push_back(at);
    longest_ = std::max(longest_, rows_[other].near.size());
  }
  longest_ = std::max(longest_, row.near.size());
}

/// At one place, refused pairs would take memory. Around one proxy, each link is looked for among the others.
void Surroundings::give_up_crowd() noexcept {
  constexpr std::size_t most_in_mean = 256, most_of_one = 16384;
  if (!are_kept() || (links_ <= most_in_mean * rows_.size() && longest_ <= most_of_one)) return;
  failures_ = most_failures;
  forget();
}

void Surroundings::note_batch() {
  if (!are_kept()) return;
  constexpr unsigned most_idle = 64;
  if (++idle_batches_ > most_idle) return forget();
  give_up_crowd();
  if (!are_kept()) return;
  if (questions_ + refits_ < rows_.size() + 64) return;
  if (4 * refits_ > 3 * questions_) {
    failures_ = std::min(failures_ + 1, most_failures);
    return forget();
  }
  failures_ = 0;
  questions_ = refits_ = 0;
}

void Surroundings::forget() noexcept {
  index_.reset();
  asking_ = 0;
  const auto drop = [](auto&... vectors) { (std::remove_reference_t<decltype(vectors)>().swap(vectors), ...); };
  drop(rows_, bounds_, free_rows_, strayed_, found_);
}

void Surroundings::validate(const std::vector<Proxy*>& live, const BasicWorld<btScalar>& world) const {
  const auto check = [](bool holds, const char* what) {
    if (!holds) throw std::logic_error(what);
  };
  if (!are_kept()) return;
  const boxstream::detail::DefaultFloatEnvironment environment;
  check(live.size() + free_rows_.size() == rows_.size(), "surroundings: not a row for each proxy");
  std::size_t all_links = 0;
  for (const Row& row : rows_) {
    all_links += row.near.size();
    check(row.near.size() <= longest_, "surroundings: the longest row is longer");
  }
  check(all_links == links_, "surroundings: links are not counted");
  for (const Proxy* proxy : live) {
    const Row& row = rows_[proxy->row];
    check(row.proxy == proxy, "surroundings: the row of another");
    for (std::uint32_t i = 0; row.epoch == epoch_ && i < row.held; ++i)
      check(world.pair_place(proxy->id, rows_[row.near[i]].proxy->id).has_value(), "surroundings: a pair is not held");
    if (row.has_strayed()) continue;
    const Box box = bounds_[proxy->row].box();
    check(is_valid(box) ? holds(row.fat, box) : !is_valid(row.fat),
          "surroundings: a box that has left its fat box is not noted");
    check(index_->box(row.in_index) == row.fat || !is_valid(row.fat), "surroundings: the index has another box");
    for (const Proxy* other : live) {
      const Row& beside = rows_[other->row];
      const auto links = std::count(row.near.begin(), row.near.end(), other->row);
      check(links == std::count(beside.near.begin(), beside.near.end(), proxy->row), "surroundings: of one side only");
      const bool are_neighbours = other != proxy && (row.asks || beside.asks) && is_valid(row.fat) &&
                                  is_valid(beside.fat) && overlaps(row.fat, beside.fat);
      check(links == (are_neighbours ? 1 : 0) || beside.has_strayed(), "surroundings: wrong neighbours");
    }
  }
}

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
