// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <boxstream/bullet/precision.hpp>

#include "pair_store.hpp"
#include "proxy.hpp"
#include "verdict_table.hpp"

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {

/// Of few proxies, the boxes in columns, and which pairs are held, a bit for each. A batch compares the boxes that have
/// moved with all others, and says itself which pairs begin and end. The World hears of boxes with the next query, and
/// of pairs when something happens that only it can decide.
///
/// Very few are compared so however many move. Of more, up to `most`, only few may move, or the World takes less time;
/// verdicts about them are learned once few have moved for some batches.
///
/// Rooms (see ProxyRooms) take no look at other boxes, but have to be made, and are left where boxes fly about. So now
/// and then some batches in a row are searched all the same, for rooms to be tried: less and less often.
class FewVerdicts {
  using VeryFew = VerdictTable<32>;
  using Some = VerdictTable<128>;
  using Many = VerdictTable<320>;

  template <class With>
  decltype(auto) with_table(With&& with) {
    return room_ == VeryFew::most ? with(very_few_) : room_ == Some::most ? with(*some_) : with(*many_);
  }
  template <class With>
  decltype(auto) with_table(With&& with) const {
    return room_ == VeryFew::most ? with(very_few_) : room_ == Some::most ? with(*some_) : with(*many_);
  }

 public:
  using Proxies = std::vector<Proxy*>;
  using Box = BasicAabb<btScalar>;

  static constexpr std::size_t most = Many::most;

  /// Until the next search.
  void forget() noexcept { are_known_ = false; }
  bool are_known() const { return are_known_; }

  /// `box` is that of the World.
  void note_move(const Proxy& proxy, const Box& box) {
    if (!are_known_) return;
    with_table([&](auto& table) { table.move(proxy.position, box); });
  }
  /// The last one of all, which is held with nothing.
  void note_created(const Proxy& proxy, const Box& box) {
    if (proxy.position >= most || (are_known_ && proxy.position >= room_)) return note_many();
    if (!are_known_) return;
    with_table([&](auto& table) { table.add(proxy.position); });
    note_move(proxy, box);
  }
  /// All its pairs have been taken out, of the World as well. Unless it goes, the next batch decides about them.
  void note_alone(const Proxy& proxy);
  /// With all its pairs, and before the last one of `size` takes its place.
  void note_destroyed(const Proxy& proxy, std::size_t size);
  /// The World has been told of all pairs.
  void note_told(std::size_t size) noexcept;
  /// Calls `begun(a, b)` for each pair that is held and not in the World, and `ended(a, b)` the other way round.
  template <class Begun, class Ended>
  void for_each_untold(const Proxies& live, Begun&& begun, Ended&& ended) const {
    with_table([&](const auto& table) {
      for (std::uint32_t a = 0; a < live.size(); ++a)
        table.untold(a).for_each([&](std::uint32_t b) {
          if (b > a) table.held(a).has(b) ? begun(*live[a], *live[b]) : ended(*live[a], *live[b]);
        });
    });
  }

  /// Whether this one is held with others.
  bool hold_any(const Proxy& proxy) const {
    return with_table([&](const auto& table) { return !table.held(proxy.position).is_empty(); });
  }
  /// Calls `visit(proxy)` for each proxy with which the World holds a pair of this one.
  template <class Visit>
  void for_each_in_world(const Proxies& live, const Proxy& proxy, Visit&& visit) const {
    with_table([&](const auto& table) {
      table.in_world(proxy.position).for_each([&](std::uint32_t other) { visit(*live[other]); });
    });
  }

  /// After a search that has seen all changes: `pairs` are those that are held, and `moved` boxes were searched for.
  /// `may_answer` is false if questions would be in vain as things are.
  void learn(const Proxies& live, PairStore& pairs, std::size_t moved, bool may_answer);

  /// `still`: nothing begins or ends, though boxes have moved.
  enum class Answer { nothing, still, pairs, unknown };

  /// What begins and ends by what has moved since verdicts were learned, or this was last asked and had an answer.
  /// `by_masks`: group and mask refuse pairs, and nothing else does. Calls `visit(proxy)` for what has moved if there
  /// is an answer. If that is `pairs`, `begun` are those that begin.
  template <class Visit>
  Answer ask(const Proxies& live, bool by_masks, std::vector<btBroadphasePair>& begun, Visit&& visit) {
    if (!are_known_) return Answer::unknown;
    const Answer answer = with_table([&](auto& table) { return ask_of(table, live, by_masks, begun, visit); });
    note_answer(answer);
    if (answer == Answer::still && live.size() >= least_in_rooms && ++batches_held_ == patience_) let_rooms_try();
    return answer;
  }
  /// By the last answer, which was `pairs`; `pair` was held before.
  bool has_any_ended() const { return has_any_ended_; }
  bool has_ended(const btBroadphasePair& pair) const {
    const std::uint32_t a = position_of(pair.m_pProxy0), b = position_of(pair.m_pProxy1);
    return with_table([&](const auto& table) { return table.changes(a, b); });
  }

  /// Gives memory back. Nothing is known then.
  void give_back() noexcept;

  /// For pairs that are settled.
  void validate(const Proxies& live, PairStore& pairs, const BasicWorld<btScalar>& world, bool by_masks) const;

 private:
  static std::uint32_t position_of(const btBroadphaseProxy* proxy) {
    return static_cast<const Proxy*>(proxy)->position;
  }
  template <class Table, class Visit>
  Answer ask_of(Table& table, const Proxies& live, bool by_masks, std::vector<btBroadphasePair>& begun,
                const Visit& visit) {
    if (table.moved.is_empty()) return Answer::nothing;
    const Answer answer = compare(table, live, by_masks);
    if (answer == Answer::unknown) return answer;
    table.moved.for_each([&](std::uint32_t position) { visit(*live[position]); });
    table.moved = {};
    if (answer == Answer::pairs) apply(table, live, begun);
    return answer;
  }
  template <class Table>
  Answer compare(Table& table, const Proxies& live, bool by_masks);
  template <class Table>
  void apply(Table& table, const Proxies& live, std::vector<btBroadphasePair>& begun);
  std::uint32_t room_for(std::size_t size) const;
  bool is_worth_learning(std::size_t size, std::size_t moved, bool may_answer);
  bool make_room(std::uint32_t room) noexcept;
  void note_many() noexcept {
    if (are_known_) outgrown_ = room_;
    forget();
    searches_left_ = least_searches;
  }
  /// Of more than very few, verdicts that say nothing are learned less and less often.
  void note_answer(Answer answer) noexcept {
    if (answer == Answer::still || answer == Answer::pairs) searches_in_vain_ = 1;
    if (answer != Answer::unknown || room_ == VeryFew::most) return;
    searches_left_ = searches_in_vain_;
    searches_in_vain_ = searches_in_vain_ < most_patience ? 2 * searches_in_vain_ : searches_in_vain_;
  }
  void let_rooms_try() noexcept {
    forget();
    searches_left_ = least_searches + patience_ / 8;
    patience_ = patience_ < most_patience ? 2 * patience_ : patience_;
    batches_held_ = 0;
  }

  static constexpr std::size_t least_in_rooms = 4;
  /// Of more than very few, so many may move in a batch, and for so many batches before verdicts are learned.
  static std::uint32_t most_moved(std::size_t size) { return 1024 / std::uint32_t(size); }
  static constexpr unsigned least_calm = 2;
  /// In these, rooms are made where boxes only tremble, and memory that many proxies took goes back.
  static constexpr unsigned least_searches = 12;
  static constexpr unsigned least_patience = 16, most_patience = 1024;

  bool are_known_ = true;               // at first there are none
  std::uint32_t room_ = VeryFew::most;  // of the table in use
  std::uint32_t outgrown_ = 0;          // a table with so much room, of late
  VeryFew very_few_;
  std::unique_ptr<Some> some_;
  std::unique_ptr<Many> many_;
  bool has_any_ended_ = false;
  unsigned batches_held_ = 0, patience_ = least_patience;  // in which all were still, since rooms were last let try
  unsigned searches_left_ = 0;                             // before this may take part
  unsigned searches_in_vain_ = 1;                          // as those, after an answer that was none
  unsigned calm_ = 0;                                      // searches for few boxes, in a row
};

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
