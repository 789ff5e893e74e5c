// SPDX-License-Identifier: MIT
// No input is quadratic: how much a search compares, by its own counts, for boxes as buildings, meshes and worlds have
// them and for boxes that are made to make it compare too much.
#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "hard_boxes.hpp"
#include "same_pairs.hpp"
#include "sanitized.hpp"
#include "swift_sweep.hpp"

namespace boxstream::tests {
namespace {

/// Comparisons, and boxes taken into leaves, for n boxes of k pairs are at most this many times n log2(n)^3 + k; less
/// unless boxes are made against the sample of the planner.
constexpr double most_work = 4;
constexpr double most_work_by_itself = 1;

/// At the sizes of which tests make many: all families, some of them under sanitizers.
std::vector<batches::HardFamily> families() {
  std::vector<batches::HardFamily> some;
  for (std::size_t i = 0; i < batches::hard_families().size(); i += sanitized ? 7 : 1)
    some.push_back(batches::hard_families()[i]);
  return some;
}

/// Of sorted pairs, those between the even and the odd places, as the two sets have them.
Pairs between_others(const Pairs& pairs) {
  Pairs some;
  for (const Pair pair : pairs)
    if (pair.a % 2 != pair.b % 2)
      some.push_back(pair.a % 2 == 0 ? Pair{pair.a / 2, pair.b / 2} : Pair{pair.b / 2, pair.a / 2});
  std::sort(some.begin(), some.end());
  return some;
}

template <class S>
class Bound : public testing::Test {
 protected:
  void SetUp() override {
    if (sanitized && sizeof(S) == 8) GTEST_SKIP() << "the same as with floats";
  }

  static void expect_bounded(const Stats& stats, const std::string& name, double most = most_work_by_itself) {
    const double work = work_by_bound(stats);
    EXPECT_LE(work, most) << name << ", " << stats.boxes << " boxes, " << stats.pairs << " pairs, " << stats.tests
                          << " tests, " << stats.records << " records";
    if (work > worst_) {
      worst_ = work;
      testing::Test::RecordProperty("worst", name + ": " + std::to_string(work));
    }
  }

  /// Boxes as one set, and as two with every other one in each.
  void expect_both(const Boxes<S>& boxes, const std::string& name) {
    const Pairs truth = swift_sweep(boxes);
    expect_bounded(detector_.find_pairs(boxes, pairs_), name);
    expect_same_pairs(pairs_, truth, boxes, name, 1);
    const auto first = every_other(boxes, 0), second = every_other(boxes, 1);
    expect_bounded(detector_.find_pairs(first, second, pairs_), name + ", two sets");
    expect_same_pairs(pairs_, between_others(truth), first, second, name + ", two sets", 1);
  }

  Detector detector_;
  Pairs pairs_;

 private:
  static inline double worst_ = 0;
};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Bound, Scalars);

/// The truth that the others are held against.
TYPED_TEST(Bound, TheOracleIsRight) {
  for (const batches::HardFamily& family : families()) {
    const auto boxes = hard_boxes<TypeParam>(family, 300, 2);
    EXPECT_EQ(swift_sweep(boxes), brute_force(boxes)) << family.name;
  }
}

TYPED_TEST(Bound, TenThousand) {
  for (const batches::HardFamily& family : families())
    for (const std::size_t n : {1000, 10000}) this->expect_both(hard_boxes<TypeParam>(family, n, 1), family.name);
}

/// Each family as floats or as doubles.
TYPED_TEST(Bound, AHundredThousand) {
  const auto all = families();
  for (std::size_t i = sizeof(TypeParam) / 8; i < all.size(); i += 2)
    this->expect_both(hard_boxes<TypeParam>(all[i], sanitized ? 20000 : 100000, 1), all[i].name);
}

/// Ends that nearly coincide: one step of the number apart.
TYPED_TEST(Bound, EndsOneStepApart) {
  for (const batches::HardFamily& family : families()) {
    if (family.name.find("moved") != std::string::npos) continue;
    auto boxes = hard_boxes<TypeParam>(family, 10000, 1);
    move_by_one_step(boxes, 1);
    this->expect_both(boxes, family.name + ", one step apart");
  }
}

/// Few of one family against many of another.
TYPED_TEST(Bound, FewAgainstMany) {
  const auto all = families();
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto many = hard_boxes<TypeParam>(all[i], 20000, 1);
    for (const std::size_t few : {10, 300}) {
      const auto some = hard_boxes<TypeParam>(all[(i * 7 + 5) % all.size()], few, 2);
      this->expect_bounded(this->detector_.find_pairs(some, many, this->pairs_), "few against " + all[i].name);
      this->expect_bounded(this->detector_.find_pairs(many, some, this->pairs_), "few against " + all[i].name);
    }
  }
}

/// Those that share their ends compare little more than those that do not, and a heap in a world than a heap alone.
TYPED_TEST(Bound, TiesAndHeapsCostLittle) {
  constexpr std::size_t n = 100000;
  const auto tests = [&](const batches::Boxes& boxes) {
    return static_cast<double>(this->detector_.find_pairs(rounded_to<TypeParam>(boxes), this->pairs_).tests);
  };
  for (const int pieces : {1, 2, 4, 16, 0}) {
    batches::Random random(1), same(1);
    const double tied = tests(bars(n, random, {3, pieces, 0})), loose = tests(bars(n, same, {3, pieces, 0.1}));
    EXPECT_LE(tied, 3 * loose) << pieces << " pieces a line";
  }
  for (const double share : {0.8, 0.85, 0.9}) {
    batches::Random random(1), same(1);
    const double heap = tests(heaps(n, random, {share, 1e4, 1})), alone = tests(heaps(n, same, {1, 1e4, 1}));
    EXPECT_LE(heap, 3 * alone) << share << " of the boxes in the heap";
  }
}

/// Cost a box grows no faster than log2(n)^2.
TYPED_TEST(Bound, GrowsSlowly) {
  constexpr std::size_t n = 20000;
  const auto each = [&](const batches::HardFamily& family, std::size_t size) {
    const Stats stats = this->detector_.find_pairs(hard_boxes<TypeParam>(family, size, 1), this->pairs_);
    return static_cast<double>(stats.tests + stats.records) / static_cast<double>(size);
  };
  const double growth = std::pow(std::log2(8.0 * static_cast<double>(n)) / std::log2(static_cast<double>(n)), 2);
  for (const batches::HardFamily& family : families()) {
    if (family.largest < 8 * n) continue;
    const double some = each(family, n), more = each(family, 8 * n);
    EXPECT_LE(more, 2 * growth * std::max(some, 60.0)) << family.name << ": " << some << ", " << more << " a box";
  }
}

/// The same at ten times the size, where plans are others. Boxes that span a heap, but are so few that most samples
/// miss them, do not make every box of it be looked at once more.
TYPED_TEST(Bound, HeapsAndRodsGrowSlowly) {
  if (sanitized) GTEST_SKIP() << "too large";
  const double growth = 10 * std::pow(std::log(1e6) / std::log(1e5), 2);
  for (const char* name : {"heap of 0.85 in a world of 10000.0", "rods of 0.45 in 3 directions"})
    for (const std::uint64_t seed : {1, 2, 3}) {
      const auto search = [&](std::size_t n) {
        return this->detector_.find_pairs(hard_boxes<TypeParam>(batches::hard_family(name), n, seed), this->pairs_);
      };
      const Stats some = search(100000), more = search(1000000);
      // A sweep compares by sixteens.
      const auto steps = [](const Stats& stats) { return static_cast<double>(stats.tests / 16 + stats.records); };
      EXPECT_LE(steps(more), growth * steps(some)) << name;
      EXPECT_LE(static_cast<double>(more.records), growth * static_cast<double>(some.records)) << name;
      if (name[0] != 'h') continue;
      EXPECT_LE(some.records, 150'000u) << name << ", seed " << seed;
      EXPECT_LE(more.records, 1'500'000u) << name << ", seed " << seed;
    }
}

/// An adversary that knows where the sample of the root looks: there the boxes differ on one axis alone, elsewhere on
/// another one.
TYPED_TEST(Bound, WhereTheSampleIsShownAnotherAxis) {
  for (const std::size_t n : {3000, 9000, 60000}) {
    if (sanitized && n > 10000) continue;
    const auto seen = sampled_places(n);
    const auto count = static_cast<std::size_t>(std::count(seen.begin(), seen.end(), true));
    ASSERT_GT(count, 15u);
    ASSERT_LT(count, n / 8);
    for (int shown = 0; shown < 3; ++shown)
      for (int hidden = 0; hidden < 3; ++hidden) {
        if (shown == hidden) continue;
        batches::Random random(n);
        const auto differ_on = [&](int axis) {
          return rounded_to<TypeParam>(flattened(n, random, 7u & ~(1u << axis), 0));
        };
        const auto some = differ_on(shown), others = differ_on(hidden);
        this->expect_both(misleading(some, others),
                          "shown " + std::to_string(shown) + ", hidden " + std::to_string(hidden));
      }
  }
}

/// The same with any two families.
TYPED_TEST(Bound, WhereTheSampleIsShownAnotherFamily) {
  const auto all = families();
  const std::size_t n = 10000;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::size_t j = (i * 37 + 11) % all.size();
    const auto some = hard_boxes<TypeParam>(all[j], n, 1), others = hard_boxes<TypeParam>(all[i], n, 1);
    if (some.size() != n || others.size() != n) continue;
    this->expect_both(misleading(some, others), all[i].name + " behind " + all[j].name);
  }
}

/// The same with specks where it looks and cubes elsewhere that a thousand others touch, so that budgets, which grow by
/// pairs, let bad plans go on.
TYPED_TEST(Bound, WhereTheSampleDoesNotShowHowManyTouch) {
  const std::size_t n = sanitized ? 5000 : 20000;
  for (const unsigned seed : {1u, 2u}) {
    Random random(seed);
    const auto cubes = [&](double least, double most) {
      Boxes<TypeParam> boxes(n);
      for (auto& box : boxes) {
        const double size = random.between(least, most);
        for (int d = 0; d < 3; ++d) {
          const double lo = random.unit();
          box.min[d] = static_cast<TypeParam>(lo);
          box.max[d] = static_cast<TypeParam>(lo + size);
        }
      }
      return boxes;
    };
    for (const double side : {0.45, 0.3}) {
      const auto specks = cubes(0.001, 0.002), large = cubes(side / 2, side);
      const Stats stats =
          this->detector_.stream_pairs(misleading(specks, large), [](Span<const Pair>) { return true; });
      this->expect_bounded(stats, "cubes of " + std::to_string(side), most_work);
    }
  }
}

/// The same with cubes where it looks and plates elsewhere, which many slabs of each cut share: what a cut copies is
/// charged to the budgets of all that is below it, or each copy would have the whole budget of its box.
TYPED_TEST(Bound, CopiesAreChargedToTheLeaves) {
  if (sanitized) GTEST_SKIP() << "cuts copy as much as this from 60000 boxes on";
  constexpr std::size_t n = 60000;
  Random random(7);
  const auto boxes_of = [&](double longest, double shortest) {
    Boxes<TypeParam> boxes(n);
    for (auto& box : boxes) {
      const auto thin_axis = static_cast<int>(random.index(3));
      for (int d = 0; d < 3; ++d) {
        const double lo = random.unit(), size = d == thin_axis ? shortest : longest * random.between(0.5, 1);
        box.min[d] = static_cast<TypeParam>(lo);
        box.max[d] = static_cast<TypeParam>(lo + size);
      }
    }
    return boxes;
  };
  const auto cubes = boxes_of(0.001, 0.0005), plates = boxes_of(0.45, 0.0001);
  const auto boxes = misleading(cubes, plates);
  this->expect_bounded(this->detector_.stream_pairs(boxes, [](Span<const Pair>) { return true; }), "plates");
}

/// A few at ten times the size; their pairs are those of the sweep at the sizes above.
TYPED_TEST(Bound, AMillion) {
  if (sanitized) GTEST_SKIP() << "the same at smaller sizes";
  for (const char* name : {"bars in 3 directions, 1 a line", "bars in 3 directions, short",
                           "bars in 3 directions, 2 a line, ends moved by 0.1", "rods of 0.45 in 3 directions",
                           "heap of 0.85 in a world of 10000.0", "heaps of 0.85, nested 9 deep",
                           "mesh graded in 30 steps", "rebar, 1 a line"}) {
    const auto boxes = hard_boxes<TypeParam>(batches::hard_family(name), 1000000, 1);
    this->expect_bounded(this->detector_.find_pairs(boxes, this->pairs_), name);
  }
}

}  // namespace
}  // namespace boxstream::tests
