// SPDX-License-Identifier: MIT
// Histories left to chance, in which memory runs out now and then: once, or twice in a row, in the World, in its
// searches on threads and in the executor itself. What the World says then and in the twenty updates that follow is
// compared with the model. BOXSTREAM_FAILING_MINUTES says for how long.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <memory>
#include <random>

#include "changes.hpp"
#include "flaky_world.hpp"
#include "heap_watch.hpp"
#include "sanitized.hpp"
#include "thread_pool.hpp"

namespace boxstream::tests {

namespace {

/// Threads that start at once, of an executor that needs memory before its tasks and after them.
class HungryExecutor final : public Executor {
 public:
  unsigned concurrency() const override { return pool_.concurrency(); }
  std::uint32_t start_nanoseconds() override {
    eat();
    return 0;
  }
  void parallel_for(std::size_t count, FunctionRef<void(std::size_t)> task) override {
    eat();
    pool_.parallel_for(count, task);
    eat();
  }

 private:
  static void eat() { const std::vector<int> memory(1); }

  threads::ThreadPool pool_{3};
};

/// A number is a box in a crowd (its lowest bits) at a time (the others). Crowds tremble, drift or jump.
constexpr unsigned crowd_bits = 12;

template <class S>
struct Crowd {
  double extent;

  BasicAabb<S> operator()(unsigned number) const {
    const unsigned who = number % (1u << crowd_bits), when = number >> crowd_bits;
    if (who % 97 == 96) return box_from<S>(number);
    std::minstd_rand home(who + 1), now(number * 2654435761u % 2147483646u + 1);
    home.discard(3);
    now.discard(3);
    const auto share = [](std::minstd_rand& random) { return double(random() >> 8) / double(1u << 23); };
    const bool jumps = when % 8 == 7 && who % 3 == 0, trembles = when % 8 < 4;
    BasicAabb<S> box;
    for (int d = 0; d < 3; ++d) {
      const double at = extent * share(jumps ? now : home), side = 0.6 + share(home);
      const double drift = 0.03 * when * (d + 1), tremble = trembles ? 0.02 * share(now) : 0;
      box.min[d] = S(at + drift + tremble);
      box.max[d] = S(at + drift + tremble + side);
    }
    return box;
  }
};

/// Of one seed.
template <class S>
class History : Changes<S, FlakyWorld<S>> {
  using Base = Changes<S, FlakyWorld<S>>;
  using Base::id;
  using Base::model_;

 public:
  History(unsigned seed, FlakyWorld<S>& world, bool sticky, std::size_t boxes)
      : Base(world, sticky, Crowd<S>{std::cbrt(double(boxes)) * 1.1}), random_(seed), boxes_(boxes) {}

  void play() {
    Base::bulk_create(unsigned(boxes_), pick(1u << crowd_bits));
    for (int frame = 0; frame < 12 && !::testing::Test::HasFailure(); ++frame) {
      if (pick(2) == 0) heap_watch::fail_at(pick(1u << pick(5)), pick(2) == 0 ? heap_watch::never : pick(8));
      try_frame();
      heap_watch::stop_failing();
    }
    for (int frame = 0; frame < 20 && !::testing::Test::HasFailure(); ++frame) {
      this->frame();
      Base::compare_state();
    }
    Base::query(pick(10000));
    Base::distances(pick(10000));
  }

 private:
  unsigned pick(unsigned n) { return unsigned(random_() >> 8) % n; }

  /// What the caller gives up is left out; the history goes on. The model's own memory does not fail.
  void try_frame() {
    const heap_watch::Failures wait(false);
    try {
      frame();
    } catch (const std::bad_alloc&) {
    }
  }

  void frame() {
    move_some();
    for (unsigned i = pick(3); i > 0; --i) change_something();
    if (pick(10) != 0) Base::update(pick(2) == 0 ? 0 : 2 + pick(3));
  }

  void move_some() {
    const unsigned time = ++now_ << crowd_bits;
    const unsigned kind = pick(8);
    if (kind == 0) return;
    if (kind == 1) return Base::nudge_few(pick(10000), time + pick(1000));
    if (kind == 2) return Base::bulk_move(pick(10000), time);
    const unsigned stride = kind == 3 ? 20 : kind == 4 ? 3 : 1;
    for (const Birth b : model_.alive())
      if (b % stride == 0) Base::move(b, time + unsigned(b) % (1u << crowd_bits));
  }

  void change_something() {
    const auto living = model_.alive();
    if (living.empty()) return Base::bulk_create(20 + pick(30), pick(10000));
    const Birth some = living[pick(unsigned(living.size()))];
    switch (pick(12)) {
      case 0:
        return Base::create(pick(10000));
      case 1:
        return Base::bulk_create(pick(60), pick(10000));
      case 2:
        return Base::destroy(some);
      case 3:
        return Base::bulk_destroy(pick(10000), pick(10000));
      case 4:
        return Base::filter(some, pick(100));
      case 5:
        return pick(4) == 0 ? Base::refilter() : Base::refilter(some);
      case 6:
      case 7:
        return Base::release(pick(10000), pick(10000));
      case 8:
      case 9:
        return Base::begin_pairs(some, 1 + pick(3));
      case 10:
        return Base::query(pick(10000));
      default:
        return pick(20) == 0 ? Base::clear() : Base::distances(pick(10000));
    }
  }

  std::minstd_rand random_;
  std::size_t boxes_;
  unsigned now_ = 0;
};

/// Returns how many allocations failed.
template <class S>
std::size_t play(unsigned seed, HungryExecutor& executor) {
  std::minstd_rand random(seed + 12345);
  random.discard(5);
  const auto pick = [&](unsigned n) { return unsigned(random() >> 8) % n; };
  // Candidates drift from 128 boxes on, more than 384 are not few, and threads share work from 2000.
  const unsigned size = pick(sanitized ? 400 : 100);
  const bool on_threads = size == 0;
  const std::size_t boxes = on_threads ? 2500 : size < 3 ? 600 : size < 20 ? 400 + pick(60) : 30 + pick(60);
  WorldOptions options;
  options.sticky_filters = pick(4) == 0;
  options.executor = on_threads || pick(2) == 0 ? &executor : nullptr;
  const detail::SearchMode modes[] = {detail::SearchMode::cheapest, detail::SearchMode::candidates,
                                      detail::SearchMode::cheapest, detail::SearchMode::probe, detail::SearchMode::all};
  FlakyWorld<S> world(options, modes[pick(5)], Then(pick(3)));
  History<S> history(seed, world, options.sticky_filters, boxes);
  world.look = [] {};
  history.play();
  return world.failures();
}

std::chrono::duration<double> time_to_play() {
  const char* const minutes = std::getenv("BOXSTREAM_FAILING_MINUTES");
  return std::chrono::duration<double>(minutes != nullptr ? 60 * std::atof(minutes) : sanitized ? 20 : 60);
}

/// Plays histories until `is_enough(seed)`.
template <class IsEnough>
void play_from(unsigned first, IsEnough&& is_enough) {
  HungryExecutor executor;
  std::size_t failures = 0;
  unsigned seed = first;
  for (; !is_enough(seed) && !::testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    failures += seed % 2 == 0 ? play<float>(seed, executor) : play<double>(seed, executor);
    heap_watch::stop_failing();
  }
  EXPECT_GT(failures, 2 * (seed - first)) << "hardly anything was put to the test";
  std::printf("%u histories, %zu failed allocations\n", seed - first, failures);
}

constexpr unsigned always_played = sanitized ? 20 : 100;

TEST(FailingHistories, TheFirstAgreeWithTheModel) {
  play_from(0, [](unsigned seed) { return seed == always_played; });
}

TEST(FailingHistories, OthersAgreeWithTheModelForAWhile) {
  const auto end = std::chrono::steady_clock::now() + time_to_play();
  play_from(always_played, [&](unsigned) { return std::chrono::steady_clock::now() > end; });
}

}  // namespace

}  // namespace boxstream::tests
