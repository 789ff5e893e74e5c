// SPDX-License-Identifier: MIT
// Whatever throws, wherever it throws and at whichever call: an output is empty then, and the Detector works.
#include <cstdint>
#include <functional>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

#include <boxstream/near.hpp>

#include <gtest/gtest.h>

#include "box_sets.hpp"
#include "heap_watch.hpp"
#include "many_sets.hpp"
#include "sanitized.hpp"

namespace boxstream::tests {
namespace {

enum class Place { concurrency, start, before_work, amid_work, after_work, nowhere };
constexpr const char* names[] = {"concurrency()", "start_nanoseconds()", "before work", "amid work", "after work"};

/// Runs all on the calling thread, and throws at one place, the given number of calls from now.
class ThrowingExecutor final : public Executor {
 public:
  struct Thrown : std::runtime_error {
    using std::runtime_error::runtime_error;
  };

  void throw_at(Place place, int call) {
    place_ = place;
    left_ = call;
  }

  unsigned concurrency() const override {
    pass(Place::concurrency);
    return 3;
  }
  std::uint32_t start_nanoseconds() override {
    pass(Place::start);
    return 0;
  }
  void parallel_for(std::size_t count, FunctionRef<void(std::size_t)> task) override {
    pass(Place::before_work);
    for (std::size_t i = 0; i < count; ++i) {
      if (i == count / 2) pass(Place::amid_work);
      task(i);
    }
    pass(Place::after_work);
  }

 private:
  void pass(Place place) const {
    if (place == place_ && left_-- == 0) throw Thrown("the executor fails");
  }

  Place place_ = Place::nowhere;
  mutable int left_ = 0;
};

template <class S>
struct Function {
  std::string name;
  /// Of the output only those parts are used that the function has.
  std::function<void(Detector&, PairsOfSets&)> call;
};

/// Every function that fills an output.
template <class S>
class Outputs : public testing::Test {
 protected:
  Outputs() {
    for (const auto& box : a_) balls_.push_back({{box.min[0], box.min[1], box.min[2]}, (box.max[0] - box.min[0]) / 2});
  }

  std::vector<Function<S>> functions() const {
    return {
        {"one set", [this](Detector& d, PairsOfSets& out) { d.find_pairs(a_, out.pairs); }},
        {"filtered", [this](Detector& d, PairsOfSets& out) { d.find_pairs(sets_.boxes, out.pairs, sets_.filters); }},
        {"two sets", [this](Detector& d, PairsOfSets& out) { d.find_pairs(a_, sets_.boxes, out.pairs); }},
        {"many sets", [this](Detector& d, PairsOfSets& out) { d.find_pairs(sets_.boxes, sets_.offsets, out); }},
        {"many times two sets",
         [this](Detector& d, PairsOfSets& out) {
           d.find_pairs(sets_.boxes, sets_.offsets, sets_.boxes, sets_.offsets, out, sets_.filters, sets_.filters);
         }},
        {"balls", [this](Detector& d, PairsOfSets& out) {
           find_near_pairs(d, Span<const BasicBall<S>>(balls_), S(0), out.pairs);
         }}};
  }

 private:
  /// Small ones, so that some are tasks, between two that all threads search together.
  static std::vector<std::size_t> sizes() {
    std::vector<std::size_t> sizes = uneven_sizes(70, 4);
    sizes.insert(sizes.begin(), 2300);
    sizes.push_back(4100);
    return sizes;
  }

  const Boxes<S> a_ = box_set<S>("dense").make(5300, 1);
  const ManySets<S> sets_ = make_many<S>(sizes(), 9);
  std::vector<BasicBall<S>> balls_;
};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Outputs, Scalars);

void expect_equal(const PairsOfSets& out, const PairsOfSets& whole) {
  EXPECT_TRUE(out.pairs == whole.pairs);
  EXPECT_TRUE(out.offsets == whole.offsets);
}

/// Of an earlier search by the same function.
PairsOfSets left_overs_of(const PairsOfSets& whole) {
  return {{{7, 8}}, whole.offsets.empty() ? std::vector<std::uint64_t>() : std::vector<std::uint64_t>{9}};
}

TYPED_TEST(Outputs, AreEmptyWhereverAnExecutorThrows) {
  for (const auto& function : this->functions())
    for (const Place place :
         {Place::concurrency, Place::start, Place::before_work, Place::amid_work, Place::after_work}) {
      SCOPED_TRACE(function.name + ", " + names[static_cast<int>(place)]);
      ThrowingExecutor executor;
      Detector detector(DetectorOptions{&executor});
      PairsOfSets whole;
      function.call(detector, whole);
      ASSERT_FALSE(whole.pairs.empty());
      bool threw = true;
      for (int call = 0; threw; call += sanitized ? 5 : 1) {
        PairsOfSets out = left_overs_of(whole);
        executor.throw_at(place, call);
        try {
          function.call(detector, out);
          threw = false;
        } catch (const ThrowingExecutor::Thrown&) {
        }
        ASSERT_TRUE(threw || call > 0) << "it was never called";
        expect_equal(out, threw ? PairsOfSets() : whole);
        executor.throw_at(Place::nowhere, 0);
        function.call(detector, out);
        expect_equal(out, whole);
        if (this->HasFailure()) return;
      }
    }
}

TYPED_TEST(Outputs, AreEmptyWhereverMemoryFails) {
  for (const auto& function : this->functions())
    for (const bool shared : {false, true}) {
      SCOPED_TRACE(function.name);
      ThrowingExecutor executor;
      PairsOfSets whole;
      {
        Detector detector;
        function.call(detector, whole);
      }
      bool failed = true;
      for (std::int64_t first = 0; failed; first += 1 + first / (sanitized ? 2 : 12)) {
        Detector detector(DetectorOptions{shared ? &executor : nullptr});
        PairsOfSets out = left_overs_of(whole);
        heap_watch::fail_at(first);
        bool threw = false;
        try {
          function.call(detector, out);
        } catch (const std::bad_alloc&) {
          threw = true;
        }
        failed = heap_watch::stop_failing();
        expect_equal(out, threw ? PairsOfSets() : whole);
        if (this->HasFailure()) return;
      }
    }
}

}  // namespace
}  // namespace boxstream::tests
