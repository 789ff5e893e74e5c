// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <new>
#include <utility>
#include <vector>

#include "heap_watch.hpp"
#include "world/core.hpp"

namespace boxstream::tests {

/// What a callback said in attempts that failed. The next one asks the same again, and is told the same.
template <class Question, class Answer>
class Answers {
 public:
  void from_the_start() { next_ = 0; }

  template <class Ask>
  Answer operator()(const Question& question, Ask&& ask) {
    const heap_watch::Failures wait(false);
    if (next_ == given_.size()) given_.push_back({question, ask()});
    EXPECT_TRUE(given_[next_].first == question) << "another attempt asks something else";
    return given_[next_++].second;
  }

  /// The last question will not be asked again.
  void forget_last() {
    const heap_watch::Failures wait(false);
    given_.erase(given_.begin() + static_cast<std::ptrdiff_t>(--next_));
  }

 private:
  std::vector<std::pair<Question, Answer>> given_;
  std::size_t next_ = 0;
};

/// What becomes of a call that ran out of memory.
enum class Then {
  again,           ///< it is made again at once
  look_and_again,  ///< after a look at everything, which brings the index up to date
  give_up,         ///< std::bad_alloc goes on to the caller
};

/// A World whose calls run out of memory where heap_watch::fail_at says so. Where they are made again, it is to callers
/// a World like any other. Only its own allocations fail, not those of callbacks.
template <class S>
class FlakyWorld {
 public:
  using Box = BasicAabb<S>;
  using Core = detail::WorldCore<S>;

  FlakyWorld(WorldOptions options, detail::SearchMode mode, Then then) : world_(options, mode), then_(then) {}

  /// The look. Nothing fails meanwhile.
  std::function<void()> look;
  std::size_t failures() const { return failures_; }

  ProxyId create(const Box& box, Filter filter, std::uint64_t user) {
    return insist([&] { return world_.create(box, filter, user); });
  }
  void create(Span<const Box> boxes, Span<const Filter> filters, Span<ProxyId> out, Span<const std::uint64_t> users) {
    insist([&] { world_.create(boxes, filters, out, users); });
  }
  bool destroy(ProxyId id) {
    return insist([&] { return world_.destroy(id); });
  }
  std::size_t destroy(Span<const ProxyId> ids) {
    return insist([&] { return world_.destroy(ids); });
  }
  void clear() {
    insist([&] { world_.clear(); });
  }
  void shrink_to_fit() {
    insist([&] { world_.shrink_to_fit(); });
  }
  bool move(ProxyId id, const Box& box) {
    return insist([&] { return world_.move(id, box); });
  }
  std::size_t move(Span<const ProxyId> ids, Span<const Box> boxes) {
    return insist([&] { return world_.move(ids, boxes); });
  }
  bool set_filter(ProxyId id, Filter filter) {
    return insist([&] { return world_.set_filter(id, filter); });
  }
  bool refilter(ProxyId id) {
    return insist([&] { return world_.refilter(id); });
  }
  void refilter() {
    insist([&] { world_.refilter(); });
  }
  bool set_user(ProxyId id, std::uint64_t user) {
    return insist([&] { return world_.set_user(id, user); });
  }
  bool release(ProxyId a, ProxyId b) {
    return insist([&] { return world_.release(a, b); });
  }

  WorldStats update() {
    return insist([&] { return world_.update(); });
  }
  WorldStats update(ProxyPairFilter accept) {
    Answers<std::pair<ProxyId, ProxyId>, bool> answers;
    return insist([&] {
      answers.from_the_start();
      return world_.update([&](ProxyId a, ProxyId b) { return answers({a, b}, [&] { return accept(a, b); }); });
    });
  }

  /// A failure leaves the pairs held that were announced before: the caller hears of the others too.
  void begin_pairs_of(ProxyId id, ProxyPairFilter accept, FunctionRef<void(ProxyPair)> begin) {
    Answers<std::pair<ProxyId, ProxyId>, bool> answers;
    const Then then = std::exchange(then_, Then::again);
    insist([&] {
      answers.from_the_start();
      world_.begin_pairs_of(
          id,
          [&](ProxyId a, ProxyId b) {
            return answers({a, b}, [&] { return accept(a, b); });
          },
          [&](ProxyPair pair) {
            answers.forget_last();
            const heap_watch::Failures wait(false);
            begin(pair);
          });
    });
    then_ = then;
  }

  void query_box(const Box& box, ProxyVisitor visit) {
    Answers<ProxyId, bool> answers;
    insist([&] {
      answers.from_the_start();
      world_.query_box(box, [&](ProxyId id) { return answers(id, [&] { return visit(id); }); });
    });
  }
  void query_planes(Span<const BasicPlane<S>> planes, ProxyVisitor visit) {
    Answers<ProxyId, bool> answers;
    insist([&] {
      answers.from_the_start();
      world_.query_planes(planes, [&](ProxyId id) { return answers(id, [&] { return visit(id); }); });
    });
  }
  void query_ray(const BasicRay<S>& ray, RayVisitor<S> visit) {
    Answers<ProxyId, S> answers;
    insist([&] {
      answers.from_the_start();
      world_.query_ray(
          ray, [&](ProxyId id, S enter, S length) { return answers(id, [&] { return visit(id, enter, length); }); });
    });
  }
  std::size_t query_nearest(const S (&point)[3], Span<ProxyId> out) {
    return insist([&] { return world_.query_nearest(point, out); });
  }
  void query_nearest_box(const Box& box, S limit, NearVisitor<S> visit) {
    Answers<ProxyId, S> answers;
    insist([&] {
      answers.from_the_start();
      world_.query_nearest_box(
          box, limit, [&](ProxyId id, S distance) { return answers(id, [&] { return visit(id, distance); }); });
    });
  }
  void nearest_pairs(FlakyWorld& other, S limit, NearPairVisitor<S> visit) {
    Answers<std::pair<ProxyId, ProxyId>, S> answers;
    insist([&] {
      answers.from_the_start();
      world_.nearest_pairs(other.world_, limit, [&](ProxyPair pair, S distance) {
        return answers({pair.a, pair.b}, [&] { return visit(pair, distance); });
      });
    });
  }
  Box bounds() {
    return insist([&] { return world_.bounds(); });
  }
  /// Which makes the index fresh, and that may fail.
  void validate() {
    const Then then = std::exchange(then_, Then::again);
    bounds();
    then_ = then;
    world_.validate();
  }

  bool contains(ProxyId id) const { return world_.contains(id); }
  std::size_t size() const { return world_.size(); }
  Box box(ProxyId id) const { return world_.box(id); }
  Filter filter(ProxyId id) const { return world_.filter(id); }
  std::uint64_t user(ProxyId id) const { return world_.user(id); }
  Span<const ProxyPair> begun() const { return world_.begun(); }
  Span<const ProxyPair> ended() const { return world_.ended(); }
  Splice changes() const { return world_.changes(); }
  std::optional<std::uint32_t> pair_place(ProxyId a, ProxyId b) const { return world_.pair_place(a, b); }
  std::uint64_t pair_count() const { return world_.pair_count(); }
  void for_each_pair(FunctionRef<bool(ProxyPair)> visit) const { world_.for_each_pair(visit); }
  void stream_pairs(ProxyPairSink sink) const { world_.stream_pairs(sink); }

 private:
  template <class Call>
  auto insist(Call&& call) {
    for (;;) {
      try {
        const heap_watch::Failures come(!is_looked_at_);
        return call();
      } catch (const std::bad_alloc&) {
        ++failures_;
        if (then_ == Then::give_up) throw;
      }
      if (then_ != Then::look_and_again) continue;
      is_looked_at_ = true;
      look();
      is_looked_at_ = false;
    }
  }

  Core world_;
  Then then_;
  std::size_t failures_ = 0;
  bool is_looked_at_ = false;
};

}  // namespace boxstream::tests
