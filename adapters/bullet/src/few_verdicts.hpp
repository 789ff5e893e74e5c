// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <vector>

#include <boxstream/bullet/precision.hpp>

#include "pair_store.hpp"
#include "proxy.hpp"

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {

/// Of few proxies, the boxes in columns, and which pairs are held, a bit for each. A batch compares the boxes that have
/// moved with all others, and says itself which pairs begin and end. The World hears of boxes with the next query, and
/// of pairs when something happens that only it can decide.
///
/// Rooms (see ProxyRooms) take no look at other boxes, but have to be made, and are left where boxes fly about. So now
/// and then some batches in a row are searched all the same, for rooms to be tried: less and less often.
class FewVerdicts {
 public:
  using Proxies = std::vector<Proxy*>;
  using Box = BasicAabb<btScalar>;

  static constexpr std::size_t most = 32;

  /// Until the next search.
  void forget() noexcept { are_known_ = false; }
  bool are_known() const { return are_known_; }
  bool are_held(const Proxy& a, const Proxy& b) const { return are_held(a.position, b.position); }

  /// `box` is that of the World.
  void note_move(const Proxy& proxy, const Box& box) {
    if (!are_known_) return;
    boxes_.set(proxy.position, box);
    moved_ |= bit(proxy.position);
  }
  /// The last one of all, which is held with nothing.
  void note_created(const Proxy& proxy, const Box& box) {
    if (proxy.position >= most) return note_many();
    held_[proxy.position] = 0;
    note_move(proxy, box);
  }
  /// All its pairs have been taken out. Unless it goes, the next batch decides about them.
  void note_alone(const Proxy& proxy);
  /// With all its pairs, and before the last one of `size` takes its place.
  void note_destroyed(const Proxy& proxy, std::size_t size);

  /// After a search that has seen all changes: `pairs` are those that are held.
  void learn(const Proxies& live, PairStore& pairs);

  enum class Answer { nothing, pairs, unknown };

  /// What begins and ends by what has moved since verdicts were learned, or this was last asked and had an answer.
  /// `by_masks`: group and mask refuse pairs, and nothing else does. Calls `visit(proxy)` for what has moved if there
  /// is an answer. If that is `pairs`, `begun` are those that begin.
  template <class Visit>
  Answer ask(const Proxies& live, bool by_masks, std::vector<btBroadphasePair>& begun, Visit&& visit) {
    const Answer answer = are_known_ ? compare(live, by_masks) : Answer::unknown;
    if (answer == Answer::unknown) return answer;
    for (const Proxy* proxy : live)
      if ((moved_ & bit(proxy->position)) != 0) visit(*proxy);
    moved_ = 0;
    if (answer == Answer::pairs)
      note_changes(live, begun);
    else if (live.size() >= least_in_rooms && ++batches_held_ == patience_)
      let_rooms_try();
    return answer;
  }
  /// By the last answer, which was `pairs`; `pair` was held before.
  bool has_any_ended() const { return has_any_ended_; }
  bool has_ended(const btBroadphasePair& pair) const {
    return (changed_[position_of(pair.m_pProxy0)] & bit(position_of(pair.m_pProxy1))) != 0;
  }

  /// For pairs that are settled.
  void validate(const Proxies& live, PairStore& pairs, bool by_masks) const;

 private:
  /// Integers that compare as the numbers do, so that no floating-point environment has to be entered.
  using Key = std::conditional_t<sizeof(btScalar) == 4, std::int32_t, std::int64_t>;
  static Key key(btScalar x) {
    constexpr Key least = std::numeric_limits<Key>::min();
    const Key bits = std::bit_cast<Key>(x);
    return bits == least ? 0 : bits ^ ((bits >> (8 * sizeof(Key) - 1)) & ~least);  // -0 is 0
  }

  struct KeyBox {
    Key lo[3], hi[3];

    bool is_valid() const;
  };

  /// Each bound of all boxes.
  struct Columns {
    void set(std::uint32_t position, const Box& box) {
      for (int d = 0; d < 3; ++d) {
        lo[d][position] = key(box.min[d]);
        hi[d][position] = key(box.max[d]);
      }
    }
    void move(std::uint32_t from, std::uint32_t to) {
      for (int d = 0; d < 3; ++d) {
        lo[d][to] = lo[d][from];
        hi[d][to] = hi[d][from];
      }
    }
    KeyBox get(std::uint32_t position) const {
      return {{lo[0][position], lo[1][position], lo[2][position]}, {hi[0][position], hi[1][position], hi[2][position]}};
    }
    /// A bit for each of the first `size` boxes that touches this one; others are any.
    std::uint32_t touching(const KeyBox& box, std::uint32_t size) const;

    Key lo[3][most], hi[3][most];
  };

  static std::uint32_t position_of(const btBroadphaseProxy* proxy) {
    return static_cast<const Proxy*>(proxy)->position;
  }
  static std::uint32_t bit(std::uint32_t position) { return 1u << position % 32; }
  bool are_held(std::uint32_t a, std::uint32_t b) const { return (held_[a] & bit(b)) != 0; }
  Answer compare(const Proxies& live, bool by_masks);
  void note_changes(const Proxies& live, std::vector<btBroadphasePair>& begun);
  void note_many() noexcept {
    forget();
    searches_left_ = least_searches;
  }
  void let_rooms_try() noexcept {
    forget();
    searches_left_ = least_searches + patience_ / 8;
    patience_ = patience_ < most_patience ? 2 * patience_ : patience_;
    batches_held_ = 0;
  }

  static constexpr std::size_t least_in_rooms = 4;
  /// In these, rooms are made where boxes only tremble, and memory that many proxies took goes back.
  static constexpr unsigned least_searches = 12;
  static constexpr unsigned least_patience = 16, most_patience = 1024;

  bool are_known_ = true;  // at first there are none
  std::uint32_t moved_ = 0;
  Columns boxes_{};
  std::uint32_t held_[most];
  std::uint32_t changed_[most];  // by the last answer
  bool has_any_ended_ = false;
  unsigned batches_held_ = 0, patience_ = least_patience;  // in which all were still, since rooms were last let try
  unsigned searches_left_ = 0;                             // before this may take part
};

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
