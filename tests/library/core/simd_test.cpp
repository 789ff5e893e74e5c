// SPDX-License-Identifier: MIT
// Every SIMD target that the library was compiled for and this machine runs: the vector code on its own, at sizes
// around any width, and whole searches, whose order must not depend on the target.
#include <algorithm>
#include <cfenv>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <hwy/highway.h>
#include <boxstream/detector.hpp>

#include "base/arena.hpp"
#include "batch/cuts/cells.hpp"
#include "batch/leaf/sweep.hpp"
#include "batch/records/load.hpp"
#include "box_sets.hpp"
#include "checks.hpp"
#include "float_environment.hpp"
#include "golden_file.hpp"
#include "many_sets.hpp"
#include "random.hpp"
#include "sanitized.hpp"
#include "simd_targets.hpp"

namespace boxstream::tests {
namespace {

using detail::Record;

using Simd = EachSimdTarget;
INSTANTIATE_TEST_SUITE_P(Targets, Simd, testing::ValuesIn(simd_targets()), simd_target_name);

class CollectingBuffer final : public detail::PairBuffer {
 public:
  explicit CollectingBuffer(Pairs& pairs) : pairs_(pairs) {}

 protected:
  bool take(Pair* pairs, std::size_t count) override {
    pairs_.insert(pairs_.end(), pairs, pairs + count);
    return true;
  }

 private:
  Pairs& pairs_;
};

/// Records as the tree makes them, `before` included, from a few key values so that ties abound.
std::vector<Record> random_records(Random& random, std::size_t n, int spread, std::uint32_t first_id,
                                   detail::KeyKind kind) {
  // The largest keys that there are: of infinities, and (with room to spare) of a window's ends.
  const std::int32_t infinity = kind == detail::KeyKind::float32   ? 0x7f800000
                                : kind == detail::KeyKind::float64 ? 0x7ff00000
                                                                   : INT32_MAX - 1;
  const std::int32_t lowest = kind == detail::KeyKind::linear ? INT32_MIN + 1 : ~infinity;
  std::vector<Record> records(n);
  for (std::size_t i = 0; i < n; ++i) {
    Record& r = records[i];
    for (int d = 0; d < 3; ++d) {
      const auto key = [&](int value) { return value * 0x00100000; };
      const int lo = random.integer(-spread, spread);
      r.lo[d] = random.chance(0.02) ? lowest : random.chance(0.02) ? infinity : key(lo);
      r.hi[d] = random.chance(0.02) || r.lo[d] == infinity
                    ? infinity
                    : std::max(r.lo[d], key(lo + random.integer(0, spread / 3 + 1)));
    }
    r.id = first_id + static_cast<std::uint32_t>(i);
    r.before = random.chance(0.5) ? static_cast<std::uint32_t>(random.index(8)) : 0;
  }
  return records;
}

bool owned(const Record& a, const Record& b) {
  for (int d = 0; d < 3; ++d)
    if (a.lo[d] > b.hi[d] || b.lo[d] > a.hi[d]) return false;
  return (a.before & b.before) == 0;
}

detail::SweepPlan random_plan(Random& random) {
  detail::SweepPlan plan;
  plan.axis = random.integer(0, 2);
  const std::int32_t keys[] = {INT32_MIN, ~0x7f800000, -0x00200000, 0, 0x00200000, 0x7f800000, INT32_MAX};
  if (random.chance(0.7)) {
    const std::int32_t a = keys[random.index(7)], b = keys[random.index(7)];
    plan.typical_min = std::min(a, b);
    plan.typical_max = std::max(a, b);
  }
  return plan;
}

void expect_sorted_equal(Pairs found, Pairs expected, std::size_t n, const detail::SweepPlan& plan) {
  std::sort(found.begin(), found.end());
  std::sort(expected.begin(), expected.end());
  ASSERT_EQ(found, expected) << "n " << n << ", axis " << plan.axis << ", typical keys " << plan.typical_min << " to "
                             << plan.typical_max;
}

TEST_P(Simd, SweepOfOneSetEqualsTruth) {
  Random random(1);
  detail::Arena arena;
  for (int round = 0; round < 3; ++round)
    for (std::size_t n = 0; n <= 200; ++n)
      for (const auto kind : {detail::KeyKind::float32, detail::KeyKind::float64, detail::KeyKind::linear}) {
        const auto records = random_records(random, n, random.integer(1, 60), 100, kind);
        const auto plan = random_plan(random);
        Pairs found, expected;
        for (std::size_t i = 0; i < n; ++i)
          for (std::size_t j = i + 1; j < n; ++j)
            if (owned(records[i], records[j])) expected.push_back({records[i].id, records[j].id});
        CollectingBuffer buffer(found);
        detail::SweepContext context{arena, buffer, {kind, kind, kind}, detail::PairOrder::smaller_first, 0};
        ASSERT_TRUE(detail::sweep_self(records, plan, context));
        ASSERT_TRUE(buffer.flush());
        ASSERT_NO_FATAL_FAILURE(expect_sorted_equal(found, expected, n, plan));
      }
}

TEST_P(Simd, SweepOfTwoSetsEqualsTruth) {
  Random random(2);
  detail::Arena arena;
  for (int round = 0; round < 3; ++round)
    for (std::size_t n = 0; n <= 150; ++n)
      for (const auto order : {detail::PairOrder::smaller_first, detail::PairOrder::first_set_first}) {
        const int spread = random.integer(1, 60);
        const detail::KeyKind kinds[] = {detail::KeyKind::float32, detail::KeyKind::float64, detail::KeyKind::linear};
        const detail::KeyKind kind = kinds[n % 3];
        const bool ids_of_a_are_larger = random.chance(0.5);
        const auto a = random_records(random, n, spread, ids_of_a_are_larger ? 1000 : 0, kind);
        const auto b = random_records(random, random.index(150), spread, 500, kind);
        const auto plan = random_plan(random);
        Pairs found, expected;
        for (const Record& x : a)
          for (const Record& y : b)
            if (owned(x, y)) {
              const bool swap = order == detail::PairOrder::smaller_first && x.id > y.id;
              expected.push_back(swap ? Pair{y.id, x.id} : Pair{x.id, y.id});
            }
        CollectingBuffer buffer(found);
        detail::SweepContext context{arena, buffer, {kind, kind, kind}, order, 0};
        ASSERT_TRUE(detail::sweep_cross(a, b, plan, context));
        ASSERT_TRUE(buffer.flush());
        ASSERT_NO_FATAL_FAILURE(expect_sorted_equal(found, expected, n, plan));
      }
}

/// Slabs and the keys they are cut at.
struct Cut {
  detail::Slabs slabs;
  std::vector<std::int32_t> keys;

  unsigned slab_of(std::int32_t key) const {
    return static_cast<unsigned>(std::lower_bound(keys.begin(), keys.end(), key) - keys.begin());
  }
};

Cut random_cut(Random& random, int axis, unsigned count) {
  Cut cut;
  if (count == 1) return cut;
  std::set<std::int32_t> keys;
  while (keys.size() < count - 1) keys.insert(random.integer(-100, 900));
  cut.keys.assign(keys.begin(), keys.end());
  cut.slabs.axis = axis;
  cut.slabs.cut(cut.keys.data(), count - 1);
  cut.slabs.most_crossed = count / static_cast<unsigned>(random.integer(1, 4));
  return cut;
}

/// By cell, then of large and of absent ones: ids and `before` of what belongs there, in any order.
std::vector<Pairs> cells_of(const std::vector<detail::Record>& records, std::size_t n, std::uint64_t valid,
                            const Cut& rows, const Cut& columns) {
  const unsigned count = rows.slabs.count * columns.slabs.count;
  std::vector<Pairs> cells(count + 2);
  for (std::size_t i = 0; i < n; ++i) {
    const detail::Record& r = records[i];
    const int u = rows.slabs.axis, v = std::max(columns.slabs.axis, 0);
    const unsigned top = rows.slab_of(r.lo[u]), bottom = rows.slab_of(r.hi[u]);
    const unsigned left = columns.slab_of(r.lo[v]), right = columns.slab_of(r.hi[v]);
    if ((valid >> i & 1) == 0)
      cells[count + 1].push_back({r.id, 0});
    else if (bottom - top > rows.slabs.most_crossed)
      cells[count].push_back({r.id, 0});
    else
      for (unsigned row = top; row <= bottom; ++row)
        for (unsigned column = left; column <= right; ++column)
          cells[row * columns.slabs.count + column].push_back(
              {r.id, (row == top ? 0 : rows.slabs.bit()) | (column == left ? 0 : columns.slabs.bit())});
  }
  return cells;
}

TEST_P(Simd, RecordsComeToTheirCells) {
  Random random(3);
  for (const auto& [rows, columns] :
       {std::pair{2u, 1u}, {9u, 1u}, {31u, 1u}, {64u, 1u}, {2u, 2u}, {3u, 24u}, {16u, 16u}})
    for (std::size_t n = 1; n <= detail::load_block; ++n) {
      const int axis = random.integer(0, 2);
      const Cut in_rows = random_cut(random, axis, rows), in_columns = random_cut(random, (axis + 1) % 3, columns);
      detail::Grid grid;
      grid.rows = in_rows.slabs;
      grid.columns = in_columns.slabs;
      std::vector<detail::Record> records(detail::load_block);
      for (std::size_t i = 0; i < records.size(); ++i)
        for (int d = 0; d < 3; ++d) {
          records[i].lo[d] = random.chance(0.1) ? INT32_MIN + 1 : random.integer(-110, 1000);
          records[i].hi[d] = random.chance(0.1) ? INT32_MAX - 1 : records[i].lo[d] + random.integer(0, 50);
          records[i].id = static_cast<std::uint32_t>(i);
          records[i].before = 0;
        }
      const std::uint64_t valid = random.chance(0.5) ? ~std::uint64_t{0} : ~(std::uint64_t{1} << random.integer(0, 63));
      std::vector<Pairs> expected = cells_of(records, n, valid, in_rows, in_columns);

      std::vector<detail::Place> places(detail::load_block);
      std::vector<std::uint32_t> counts(grid.lists(), 5);
      const detail::Crossings crossings = detail::locate(records.data(), n, valid, grid, places.data(), counts.data());
      std::vector<std::size_t> begins, cursors;
      std::size_t end = 0;
      for (std::size_t list = 0; list < grid.lists(); ++list) {
        ASSERT_EQ(counts[list], 5 + expected[list].size()) << "n " << n << " list " << list;
        begins.push_back(end);
        end += expected[list].size();
      }
      cursors = begins;
      std::vector<detail::Record> out(end);
      detail::copy_to_cells(records.data(), n, places.data(), crossings, grid, cursors.data(), out.data());
      for (std::size_t list = 0; list < grid.lists(); ++list) {
        Pairs found;
        for (std::size_t i = begins[list]; i < cursors[list]; ++i) found.push_back({out[i].id, out[i].before});
        std::sort(found.begin(), found.end());
        std::sort(expected[list].begin(), expected[list].end());
        ASSERT_EQ(found, expected[list]) << "n " << n << " of " << rows << " by " << columns << " list " << list;
      }
    }
}

TEST_P(Simd, LoadRecordsKeepsOrderAndFindsTheInvalid) {
  Random random(4);
  const float special[] = {0.0f,     -0.0f,     1e-45f, -1e-45f, 1.0f,       -1.0f,    3e38f, -3e38f,
                           INFINITY, -INFINITY, NAN,    -NAN,    1.0000001f, -0.9999f, 1e-38f};
  for (std::size_t n = 0; n <= detail::load_block; ++n)
    for (int repeat = 0; repeat < 20; ++repeat) {
      std::vector<Aabb> boxes(n);
      for (Aabb& box : boxes)
        for (int d = 0; d < 3; ++d) {
          const auto pick = [&] { return special[random.integer(0, static_cast<int>(std::size(special)) - 1)]; };
          box.min[d] = pick();
          box.max[d] = random.chance(0.6) ? box.min[d] : pick();
        }
      std::vector<detail::Record> records(n);
      const std::uint64_t valid = detail::load_records(boxes.data(), n, 1000, detail::KeyMap<float>(), records.data());
      for (std::size_t i = 0; i < n; ++i) {
        ASSERT_EQ(valid >> i & 1, is_valid(boxes[i]) ? 1u : 0u) << "n " << n << " i " << i;
        ASSERT_EQ(records[i].id, 1000 + i);
        ASSERT_EQ(records[i].before, 0u);
        for (int d = 0; d < 3; ++d) {
          ASSERT_EQ(records[i].lo[d], detail::order_key(boxes[i].min[d])) << boxes[i].min[d];
          ASSERT_EQ(records[i].hi[d], detail::order_key(boxes[i].max[d])) << boxes[i].max[d];
        }
      }
      if (n < 64) {
        ASSERT_EQ(valid >> n, 0u);
      }
    }
}

/// Bounds in a cube that a window takes in, some far beyond it, some that need all 64 bits, and special values.
Boxes<double> boxes_for_keys(std::size_t n, double centre, Random& random) {
  const double special[] = {0.0, -0.0, 5e-324, -5e-324, 1e-300, 1e300, -1e300, INFINITY, -INFINITY, NAN};
  Boxes<double> boxes(n);
  for (auto& box : boxes)
    for (int d = 0; d < 3; ++d) {
      box.min[d] = centre + random.between(-1, 1);
      box.max[d] = random.chance(0.3) ? std::nextafter(box.min[d], 1e9) : box.min[d] + random.between(0, 0.1);
      if (random.chance(0.02)) box.min[d] = special[random.index(std::size(special))];
      if (random.chance(0.02)) box.max[d] = special[random.index(std::size(special))];
    }
  return boxes;
}

TEST_P(Simd, LoadRecordsOfDoublesIsTheKeyMap) {
  Random random(5);
  for (const double centre : {0.0, 3.0, -1e6, 1e12})
    for (const bool is_fitted : {false, true})
      for (std::size_t n = 0; n <= detail::load_block; ++n) {
        const auto boxes = boxes_for_keys(n, centre, random);
        detail::KeyMap<double> keys;
        if (is_fitted) keys.fit(boxes);
        std::vector<detail::Record> records(n);
        const std::uint64_t valid = detail::load_records(boxes.data(), n, 1000, keys, records.data());
        for (std::size_t i = 0; i < n; ++i) {
          ASSERT_EQ(valid >> i & 1, is_valid(boxes[i]) ? 1u : 0u) << "n " << n << " i " << i;
          ASSERT_EQ(records[i].id, 1000 + i);
          ASSERT_EQ(records[i].before, 0u);
          for (int d = 0; d < 3 && is_valid(boxes[i]); ++d) {
            ASSERT_EQ(records[i].lo[d], keys(boxes[i].min[d], d)) << boxes[i].min[d];
            ASSERT_EQ(records[i].hi[d], keys(boxes[i].max[d], d)) << boxes[i].max[d];
          }
        }
        if (n < 64) {
          ASSERT_EQ(valid >> n, 0u);
        }
      }
}

template <class S>
void check_sizes() {
  Checker<S> checker;
  for (const char* name : {"dense", "ties", "all_overlapping", "below_float", "invalid_among_valid"})
    for (std::size_t n = 0; n <= 130; ++n) {
      const auto a = box_set<S>(name).make(n, n), b = box_set<S>(name).make(n / 2 + 3, n + 1);
      ASSERT_TRUE(checker.one_set(a, name, n));
      ASSERT_TRUE(checker.two_sets(a, b, name, n));
    }
}

/// The boxes of blocks of columns, which keys decide, and the special values among them.
template <class S>
void check_columns() {
  Random random(5);
  constexpr S infinity = std::numeric_limits<S>::infinity();
  const S special[] = {S(0),
                       S(-0.0),
                       std::numeric_limits<S>::denorm_min(),
                       -std::numeric_limits<S>::denorm_min(),
                       S(1),
                       std::nextafter(S(1), S(2)),
                       -infinity,
                       infinity,
                       std::numeric_limits<S>::quiet_NaN()};
  for (std::size_t n = 1; n <= 2 * detail::load_block + 1; n += 1 + n / 20) {
    Boxes<S> sets[2] = {Boxes<S>(n % 70 + 1), Boxes<S>(n)};
    for (Boxes<S>& set : sets)
      for (BasicAabb<S>& box : set)
        for (int d = 0; d < 3; ++d) {
          const auto pick = [&] { return special[random.index(std::size(special))]; };
          box.min[d] = pick();
          box.max[d] = random.chance(0.6) ? box.min[d] : pick();
        }
    Checker<S> check;
    ASSERT_TRUE(check.two_sets(sets[0], sets[1], "special values", n));
    ASSERT_TRUE(check.two_sets(sets[1], sets[0], "special values turned about", n));
  }
}

TEST_P(Simd, FewAgainstMany) {
  check_columns<float>();
  check_columns<double>();
}

/// What is culled, and so the order, is the same on all targets.
TEST_P(Simd, CulledSetsKeepTheirOrder) {
  const auto a = box_set<float>("sphere").make(100000, 1);
  auto b = box_set<float>("sphere").make(100000, 2);
  float largest = 0;
  for (const Aabb& box : a) largest = std::max(largest, box.max[0]);
  for (Aabb& box : b) {
    box.min[0] += largest;
    box.max[0] += largest;
  }
  Detector detector;
  Pairs pairs;
  const Stats stats = detector.find_pairs(a, b, pairs);
  EXPECT_LT(stats.records, stats.boxes / 2);
  static const std::pair<std::uint64_t, Stats> first = {order_hash(pairs), stats};
  EXPECT_EQ(order_hash(pairs), first.first);
  EXPECT_EQ(stats.records, first.second.records);
  EXPECT_EQ(stats.tests, first.second.tests);
}

TEST_P(Simd, SizesUpTo130) {
  check_sizes<float>();
  check_sizes<double>();
}

/// Small sets, of all sizes, alone and many at once: pairs in the order that the first target has.
template <class S>
void check_many_sets() {
  std::vector<std::size_t> sizes;
  for (std::size_t n = 0; n <= 170; ++n) sizes.insert(sizes.end(), n < 20 ? 12 : 2, n);
  const auto sets = make_many<S>(sizes, 1);
  PairsOfSets found;
  std::feclearexcept(FE_ALL_EXCEPT);
  Detector().find_pairs(sets.boxes, sets.offsets, found);
  // Nor is a flag raised, by which hosts with traps would end.
  EXPECT_EQ(std::fetestexcept(flags_of_c), 0);
  static const PairsOfSets first = found;
  expect_same_sets(found, first, "many sets");
  expect_same_sets(search_each(sets, false), first, "one by one");
}

TEST_P(Simd, ManySetsHaveOneOrder) {
  check_many_sets<float>();
  check_many_sets<double>();
}

TEST_P(Simd, GoldenOrderIsTheRecordedOne) {
  if (sanitized) GTEST_SKIP() << "compared without sanitizers, and with them for one target";
  expect_golden_order(nullptr);
}

}  // namespace
}  // namespace boxstream::tests
