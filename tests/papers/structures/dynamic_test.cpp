// SPDX-License-Identifier: MIT
// Histories of insertions and deletions, with the invariants that sections 6.2 and 6.3 promise.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <map>
#include <optional>

#include "box_sets.hpp"
#include "papers/structures/binary_structure.hpp"
#include "papers/structures/kd_boxes.hpp"
#include "papers/structures/kd_builder.hpp"
#include "papers/structures/worst_case_structure.hpp"

namespace boxstream::papers::tests {
namespace {

using boxstream::tests::Random;
using Binary = BinaryStructure<KdBoxes>;
using WorstCase = WorstCaseStructure<KdBoxes, KdBuilder<6>>;
using Numbers = std::vector<std::uint32_t>;

Aabb random_box(Random& random) {
  const auto at = [&] { return static_cast<float>(random.integer(0, 30)); };
  const auto side = [&] { return static_cast<float>(random.integer(0, 4)); };
  return box_at(at(), at(), at(), side(), side(), side());
}

std::vector<KdPoint<6>> points_of(const std::vector<Aabb>& boxes) {
  std::vector<KdPoint<6>> points;
  for (std::uint32_t i = 0; i < boxes.size(); ++i) points.push_back(as_point(boxes[i], i));
  return points;
}

std::uint64_t log_up(std::size_t n) {
  return n < 2 ? 0 : static_cast<std::uint64_t>(std::bit_width(n - 1));
}

void check_invariants(const Binary& binary) {
  // A part for each bit, of just that many objects; never as many deleted as alive.
  std::size_t stored = 0;
  for (std::size_t i = 0; i < binary.parts().size(); ++i) {
    const std::size_t size = binary.parts()[i].items().size();
    ASSERT_EQ(size, binary.stored() & (std::size_t{1} << i));
    stored += size;
  }
  ASSERT_EQ(stored, binary.stored());
  ASSERT_TRUE(2 * binary.size() > binary.stored() || binary.stored() == 0);
}

/// What a level of SteppedLevels does at an insertion, added up over levels: theorem 13 with the constants of
/// KdBuilder.
std::uint64_t most_insertion_work(std::size_t stored) {
  std::uint64_t work = 1;
  for (std::uint64_t level = 1; level <= log_up(stored + 1); ++level) work += 3 + level * 17;
  return work;
}

void check_invariants(const WorstCase& structure) {
  std::size_t stored = 0;
  for (std::size_t level = 0; level < structure.levels().level_count(); ++level) {
    ASSERT_LE(structure.levels().parts_at(level), 3u) << level;
    stored += structure.levels().parts_at(level) << level;
  }
  structure.levels().for_each_part([](const auto& part) { ASSERT_TRUE(std::has_single_bit(part->items().size())); });
  ASSERT_EQ(stored, structure.stored());
  ASSERT_TRUE(2 * structure.size() >= structure.stored());
  // Two insertions more for the second structure; its building, B(n) and two looks at each object, in n / 8 operations,
  // which are no fewer than n / 16 for n >= 8.
  const std::uint64_t most =
      3 * most_insertion_work(structure.stored()) + 16 * (6 + 17 * log_up(structure.stored())) + 1;
  ASSERT_LE(structure.last_work(), most) << structure.stored();
}

/// A history with its brute force beside it.
template <class Dynamic>
class History {
 public:
  explicit History(std::uint64_t seed, std::size_t at_first) : random_(seed) {
    std::vector<Aabb> boxes;
    for (std::size_t i = 0; i < at_first; ++i) boxes.push_back(random_box(random_));
    dynamic_ = Dynamic(points_of(boxes));
    for (std::uint32_t i = 0; i < at_first; ++i) live_[next_number_++] = {i, boxes[i]};
  }

  void insert() {
    const Aabb box = random_box(random_);
    const std::uint32_t number = next_number_++;
    live_[number] = {dynamic_.insert(as_point(box, number)), box};
  }

  void erase() {
    if (live_.empty()) return;
    auto gone = live_.begin();
    std::advance(gone, static_cast<std::ptrdiff_t>(random_.index(std::min<std::size_t>(live_.size(), 40))));
    const auto handle = gone->second.handle;
    ASSERT_TRUE(dynamic_.erase(handle));
    ASSERT_FALSE(dynamic_.erase(handle));
    live_.erase(gone);
  }

  void check() {
    ASSERT_EQ(dynamic_.size(), live_.size());
    check_invariants(dynamic_);
  }

  void check_query() {
    const Aabb wanted = random_.chance(0.1) ? box_at(-1, -1, -1, 99, 99, 99) : random_box(random_);
    Numbers expected, found;
    for (const auto& [number, entry] : live_)
      if (overlaps(entry.box, wanted)) expected.push_back(number);
    dynamic_.query(touching(wanted), [&](std::uint32_t number) { found.push_back(number); });
    std::sort(found.begin(), found.end());
    ASSERT_EQ(found, expected);
  }

  /// Of `operations`, this share are insertions.
  void run(int operations, double insertions) {
    for (int i = 0; i < operations; ++i) {
      random_.chance(insertions) ? insert() : erase();
      ASSERT_NO_FATAL_FAILURE(check());
      if (i % 3 == 0) {
        ASSERT_NO_FATAL_FAILURE(check_query());
      }
    }
  }

  const Dynamic& dynamic() const { return dynamic_; }

 private:
  struct Entry {
    typename Dynamic::Handle handle;
    Aabb box;
  };
  Random random_;
  Dynamic dynamic_;
  std::map<std::uint32_t, Entry> live_;
  std::uint32_t next_number_ = 0;
};

template <class Dynamic>
class Dynamisation : public testing::Test {};
using Both = testing::Types<Binary, WorstCase>;
TYPED_TEST_SUITE(Dynamisation, Both);

/// Growing, shrinking to nothing, coming back, and standing still while all changes.
TYPED_TEST(Dynamisation, AnswersAsItsHistorySays) {
  for (const std::size_t at_first : {0u, 1u, 7u, 8u, 100u, 255u}) {
    SCOPED_TRACE(at_first);
    History<TypeParam> history(at_first, at_first);
    ASSERT_NO_FATAL_FAILURE(history.check());
    ASSERT_NO_FATAL_FAILURE(history.check_query());
    for (const double insertions : {0.9, 0.5, 0.1, 0.0, 1.0, 0.45})
      ASSERT_NO_FATAL_FAILURE(history.run(400, insertions));
  }
}

TYPED_TEST(Dynamisation, EmptyAndStaleHandles) {
  TypeParam dynamic;
  dynamic.query(touching(box_at(0, 0, 0, 9, 9, 9)), [](std::uint32_t) { ADD_FAILURE(); });
  EXPECT_FALSE(dynamic.erase(0));
  const auto handle = dynamic.insert(as_point(box_at(1, 1, 1), 77));
  Numbers found;
  dynamic.query(touching(box_at(0, 0, 0, 9, 9, 9)), [&](std::uint32_t number) { found.push_back(number); });
  EXPECT_EQ(found, Numbers{77});
  EXPECT_TRUE(dynamic.erase(handle));
  EXPECT_FALSE(dynamic.erase(handle));
  EXPECT_EQ(dynamic.size(), 0u);
  EXPECT_EQ(dynamic.stored(), 0u);
}

/// Identical boxes, which no split tells apart.
TYPED_TEST(Dynamisation, IdenticalBoxes) {
  const Aabb box = box_at(1, 1, 1, 1, 1, 1);
  TypeParam dynamic(points_of(std::vector<Aabb>(50, box)));
  std::vector<typename TypeParam::Handle> handles;
  for (std::uint32_t i = 0; i < 300; ++i) {
    handles.push_back(dynamic.insert(as_point(box, 50 + i)));
    if (i % 3 == 0) {
      ASSERT_TRUE(dynamic.erase(handles[i / 2]));
    }
    std::size_t found = 0;
    dynamic.query(touching(box_at(2, 2, 2)), [&](std::uint32_t) { ++found; });
    ASSERT_EQ(found, 50 + i + 1 - (i / 3 + 1));
    ASSERT_EQ(found, dynamic.size());
  }
}

/// However long the history, what is gone leaves no trace: handles are used again.
TYPED_TEST(Dynamisation, HandlesAreUsedAgain) {
  TypeParam dynamic;
  std::vector<typename TypeParam::Handle> handles;
  Random random(9);
  for (std::uint32_t i = 0; i < 5000; ++i) {
    handles.push_back(dynamic.insert(as_point(random_box(random), i)));
    ASSERT_LT(handles.back(), 300u);
    if (handles.size() <= 64) continue;
    std::swap(handles[random.index(64)], handles.back());
    ASSERT_TRUE(dynamic.erase(handles.back()));
    handles.pop_back();
  }
}

/// Theorem 10: s insertions build each object into a part at most log s times, once a level.
TEST(BinaryStructure, BuildsEachObjectOnceALevel) {
  Binary binary;
  Random random(2);
  constexpr std::size_t s = 2048;
  for (std::uint32_t i = 0; i < s; ++i) binary.insert(as_point(random_box(random), i));
  EXPECT_EQ(binary.parts().size(), 12u);
  EXPECT_LE(binary.built(), s * 12);
  EXPECT_GE(binary.built(), s * 11 / 2);
}

/// Theorem 11: what is built anew was paid for by deletions.
TEST(BinaryStructure, BuildsAnewWhenHalfAreDeleted) {
  Random random(3);
  std::vector<Aabb> boxes;
  for (int i = 0; i < 1000; ++i) boxes.push_back(random_box(random));
  Binary binary(points_of(boxes));
  EXPECT_EQ(binary.built(), 1000u);
  for (std::uint32_t i = 0; i < 499; ++i) ASSERT_TRUE(binary.erase(i));
  EXPECT_EQ(binary.stored(), 1000u);
  EXPECT_EQ(binary.built(), 1000u);
  ASSERT_TRUE(binary.erase(499));
  EXPECT_EQ(binary.stored(), 500u);
  EXPECT_EQ(binary.built(), 1500u);
  for (std::uint32_t i = 500; i < 1000; ++i) ASSERT_TRUE(binary.erase(i));
  EXPECT_EQ(binary.stored(), 0u);
  EXPECT_LT(binary.built(), 2000u);
}

/// Theorem 13, counted over long runs: the largest work of one operation grows as log^2 n, while the amortised variant
/// builds all of n at once from time to time.
TEST(WorstCaseStructure, NoOperationWaits) {
  Random random(4);
  WorstCase structure;
  std::vector<WorstCase::Handle> handles;
  std::uint64_t most = 0;
  const auto note = [&] {
    most = std::max(most, structure.last_work());
    ASSERT_NO_FATAL_FAILURE(check_invariants(structure));
  };
  for (std::uint32_t i = 0; i < 20'000; ++i) {
    handles.push_back(structure.insert(as_point(random_box(random), i)));
    ASSERT_NO_FATAL_FAILURE(note());
  }
  EXPECT_LE(most, most_insertion_work(20'000));
  random.shuffle(handles);
  for (const auto handle : handles) {
    ASSERT_TRUE(structure.erase(handle));
    ASSERT_NO_FATAL_FAILURE(note());
  }
  EXPECT_LT(1000 * most, KdBuilder<6>::work_of(20'000));
  EXPECT_EQ(structure.size(), 0u);
}

/// What is deleted is gone within n / 4 operations after a quarter was, even if all of them are insertions.
TEST(WorstCaseStructure, CatchesUpWithInsertions) {
  Random random(6);
  std::vector<Aabb> boxes;
  for (int i = 0; i < 1024; ++i) boxes.push_back(random_box(random));
  WorstCase structure(points_of(boxes));
  for (std::uint32_t i = 0; i < 256; ++i) ASSERT_TRUE(structure.erase(i));
  EXPECT_EQ(structure.stored(), 1024u);
  for (std::uint32_t i = 0; i < 768 / 4; ++i) structure.insert(as_point(random_box(random), 1024 + i));
  EXPECT_EQ(structure.size(), 768u + 192u);
  EXPECT_EQ(structure.stored(), structure.size());
}

}  // namespace
}  // namespace boxstream::papers::tests
