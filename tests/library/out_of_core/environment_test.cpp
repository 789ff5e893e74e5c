// SPDX-License-Identifier: MIT
// Floating-point environments of hosts, traps above all: nothing is computed in them, and nothing is left of them.
#include <boxstream/decomposition.hpp>
#include <boxstream/out_of_core.hpp>

#include <cfenv>
#include <cstdint>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "core/box_sets.hpp"
#include "core/executors.hpp"
#include "float_environment.hpp"
#include "vector_reader.hpp"

namespace boxstream::out_of_core_test {
namespace {

using tests::Mood;

template <class S>
class Environment : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Environment, Scalars);

/// Looks at every call whether the caller's environment is there.
template <class S>
class MoodReader final : public BasicBoxReader<S> {
 public:
  MoodReader(BasicBoxReader<S>& reader, const Mood& mood) : reader_(reader), mood_(mood) {}
  void rewind() override {
    is_on_ = is_on_ && mood_.is_on();
    reader_.rewind();
  }
  Span<const BasicAabb<S>> read() override {
    is_on_ = is_on_ && mood_.is_on();
    return reader_.read();
  }
  bool is_on() const { return is_on_; }

 private:
  BasicBoxReader<S>& reader_;
  const Mood& mood_;
  bool is_on_ = true;
};

/// What a search finds in an environment.
template <class S>
std::vector<WidePair> pairs_in(unsigned number, BasicBoxReader<S>& boxes, const OutOfCoreOptions& options) {
  std::vector<WidePair> found;
  bool is_on = true;
  {
    const Mood mood(number);
    MoodReader<S> reader(boxes, mood);
    std::feclearexcept(FE_ALL_EXCEPT);
    stream_pairs(
        reader,
        [&](Span<const WidePair> pairs) {
          is_on = is_on && mood.is_on();
          found.insert(found.end(), pairs.begin(), pairs.end());
          return true;
        },
        options);
    is_on = is_on && reader.is_on() && mood.is_on() && std::fetestexcept(FE_ALL_EXCEPT) == 0;
  }
  EXPECT_TRUE(is_on) << "environment " << number;
  return found;
}

/// In memory, by regions, by blocks, with an executor.
TYPED_TEST(Environment, SamePairsInAnyAndNoTraps) {
  tests::InlineExecutor executor(3, 0);
  for (const auto& set : tests::box_sets_to_repeat<TypeParam>()) {
    SCOPED_TRACE(set.name);
    VectorReader<TypeParam> reader(set.make(std::min<std::size_t>(2200, set.largest), 6));
    for (const OutOfCoreOptions& options :
         {OutOfCoreOptions{64 << 10}, OutOfCoreOptions{300 << 10}, OutOfCoreOptions{65 << 20, {}, &executor}}) {
      const auto expected = pairs_in<TypeParam>(0, reader, options);
      for (unsigned number = 1; number < Mood::count; ++number)
        ASSERT_TRUE(pairs_in<TypeParam>(number, reader, options) == expected) << "environment " << number;
    }
  }
}

/// Everything that a decomposition says.
template <class S>
std::vector<std::uint64_t> said_of(const std::vector<BasicAabb<S>>& boxes) {
  std::vector<std::uint64_t> said;
  const BasicDecomposition<S> parts(boxes, 11);
  std::vector<BasicAabb<S>> bounds;
  for (std::size_t part = 0; part < parts.size(); ++part) bounds.push_back(parts.bounds(part));
  for (const auto& box : boxes)
    parts.for_each_touched(box, [&](std::size_t part) { said.push_back(8 * part + parts.before(part, box)); });
  for (const auto& box : bounds) parts.for_each_touched(box, [&](std::size_t part) { said.push_back(part); });
  for (std::uint64_t id = 0; id < 3000; ++id) said.push_back(is_sampled(id, 3000, 2) ? 1 : 0);
  return said;
}

TYPED_TEST(Environment, SameDecompositionInAnyAndNoTraps) {
  for (const auto& set : tests::box_sets_to_repeat<TypeParam>()) {
    SCOPED_TRACE(set.name);
    const auto boxes = set.make(std::min<std::size_t>(1500, set.largest), 3);
    const auto expected = said_of<TypeParam>(boxes);
    for (unsigned number = 1; number < Mood::count; ++number) {
      std::vector<std::uint64_t> said;
      {
        const Mood mood(number);
        said = said_of<TypeParam>(boxes);
      }
      ASSERT_TRUE(said == expected) << "environment " << number;
    }
  }
}

}  // namespace
}  // namespace boxstream::out_of_core_test
