// SPDX-License-Identifier: MIT
// Hosts that trap or flush or round otherwise: every function of the header with every special value at every place,
// beside what it answers in the default environment. A trap kills the process.
#include <cstring>
#include <fstream>
#include <limits>
#include <regex>
#include <set>
#include <sstream>

#include "float_environment.hpp"
#include "handles.hpp"
#include "source_path.hpp"

namespace boxstream::c_test {
namespace {

using Limits = std::numeric_limits<double>;
const std::vector<double> special_values{0,
                                         -0.0,
                                         0.1,
                                         -1.0 / 3,
                                         1e18,
                                         1e-30,
                                         1e-42,
                                         -1e-44,
                                         1e-300,
                                         -Limits::denorm_min(),
                                         1e39,
                                         -1e300,
                                         3.5e38,
                                         Limits::max(),
                                         -Limits::infinity(),
                                         Limits::infinity(),
                                         Limits::quiet_NaN(),
                                         Limits::signaling_NaN()};

/// In what an answer consists: the bits of its numbers.
std::uint64_t bits_of(double x) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &x, sizeof bits);
  return bits;
}

std::set<std::string> called;

#define CALL(function, ...) (called.insert(#function), function(__VA_ARGS__))

/// Calls of all functions that take a number, or find one out. Boxes are made before traps are set.
template <class S>
class Calls {
 public:
  Calls() {
    for (const double special : special_values) {
      const auto x = static_cast<S>(special);
      for (std::size_t at = 0; at < 6; ++at) {
        Box<S> box{1, 1, 1, 2, 2, 2};
        box[at] = x;
        boxes_.push_back(box);
        balls_.push_back({x, S(1), S(at), S(0.5)});
      }
      balls_.push_back({S(1), S(2), S(3), x});
    }
    std::feclearexcept(FE_ALL_EXCEPT);
  }

  /// What they answered.
  std::vector<std::uint64_t> run() {
    seen_.clear();
    for (const boxstream_method method : {boxstream_method{BOXSTREAM_PLANNED}, boxstream_method{BOXSTREAM_HYBRID}}) {
      searches(method);
      world_of_all(method);
      for (const double special : special_values) queries(special);
      changes();
    }
    return seen_;
  }

 private:
  void searches(boxstream_method method) {
    boxstream_detector* detector = nullptr;
    if (method == BOXSTREAM_PLANNED) {
      see(CALL(boxstream_detector_create, nullptr, &detector));
    } else {
      see(CALL(boxstream_detector_create_with, nullptr, method, 0, &detector));
    }
    const boxstream_boxes view = view_of(boxes_);
    const boxstream_boxes few{scalar_of<S>, boxes_.data(), 5, nullptr};
    const boxstream_balls balls{scalar_of<S>, balls_.data(), balls_.size()};
    const boxstream_pair* pairs = nullptr;
    std::size_t count = 0;
    boxstream_stats stats = BOXSTREAM_STATS_INIT;
    for (const boxstream_boxes* other : {static_cast<const boxstream_boxes*>(nullptr), &few}) {
      see(CALL(boxstream_find_pairs, detector, &view, other, &pairs, &count, &stats)), see(count);
      see(CALL(
          boxstream_stream_pairs, detector, &view, other,
          [](void*, const boxstream_pair*, std::size_t) { return true; }, nullptr, &stats));
    }
    for (const double special : special_values)
      see(CALL(boxstream_find_near_pairs, detector, &balls, special, &pairs, &count, &stats)), see(count);
    see(CALL(boxstream_detector_shrink_to_fit, detector));
    see(CALL(boxstream_find_pairs, detector, &view, nullptr, &pairs, &count, &stats)), see(count);
    CALL(boxstream_detector_destroy, detector);
  }

  void world_of_all(boxstream_method method) {
    boxstream_world* world = nullptr;
    if (method == BOXSTREAM_PLANNED) {
      see(CALL(boxstream_world_create, scalar_of<S>, nullptr, &world));
    } else {
      see(CALL(boxstream_world_create_with, scalar_of<S>, nullptr, method, 0, &world));
    }
    world_.reset(world);
    ids_.resize(boxes_.size());
    const boxstream_boxes view = view_of(boxes_);
    see(CALL(boxstream_world_insert, world, &view, nullptr, ids_.data()));
    update();
  }

  void update() {
    boxstream_world_stats stats = BOXSTREAM_WORLD_STATS_INIT;
    see(CALL(boxstream_world_update, world_.get(), nullptr, nullptr, &stats));
    see(stats.pairs), see(stats.moved);
  }

  void queries(double special) {
    special_ = special;
    const double usual[] = {0.3, 1, 2, 1.7, 2, 3};
    for (std::size_t at = 0; at < 7; ++at) {
      double all[7] = {0.3, 1, 2, 1.7, 2, 3, 9};
      std::memcpy(&all[at], &special_, sizeof special_);
      queries(all, all[6]);
      if (at < 6) queries(usual, special_);
    }
    visits_ = 0;
    see(CALL(
        boxstream_world_near_pairs, world_.get(), special,
        [](void* user, boxstream_id_pair, double distance) { return static_cast<Calls*>(user)->answer(distance); },
        this));
  }

  void queries(const double* box, double limit) {
    boxstream_world* const w = world_.get();
    visits_ = 0;
    see(CALL(
        boxstream_world_query_box, w, box,
        [](void* user, boxstream_id id) { return static_cast<Calls*>(user)->see(id.slot), true; }, this));
    see(CALL(
        boxstream_world_query_near, w, box, limit,
        [](void* user, boxstream_id, double distance) { return static_cast<Calls*>(user)->answer(distance); }, this));
    see(CALL(
        boxstream_world_query_ray, w, box, box + 3, limit,
        [](void* user, boxstream_id, double enter, double length) {
          static_cast<Calls*>(user)->see(bits_of(enter));
          return static_cast<Calls*>(user)->answer(length);
        },
        this));
    boxstream_id near[7];
    std::size_t found = 0;
    for (const double* point : {box, box + 3}) {
      see(CALL(boxstream_world_query_nearest, w, point, near, 7, &found));
      for (std::size_t i = 0; i < found; ++i) see(near[i].slot);
    }
  }

  void changes() {
    boxstream_world* const w = world_.get();
    std::size_t live = 0, count = 0;
    std::vector<Box<S>> shuffled(boxes_.rbegin(), boxes_.rend());
    const boxstream_boxes view = view_of(shuffled);
    see(CALL(boxstream_world_move, w, ids_.data(), &view, &live)), see(live);
    see(CALL(boxstream_world_set_filter, w, ids_[3], {1, 2}));
    update();
    CALL(boxstream_world_begun, w, &count), see(count);
    CALL(boxstream_world_ended, w, &count), see(count);
    see(CALL(boxstream_world_pair_count, w)), see(CALL(boxstream_world_size, w));
    see(CALL(boxstream_world_contains, w, ids_[0])), see(CALL(boxstream_world_user, w, ids_[0]));
    see(CALL(
        boxstream_world_stream_pairs, w, [](void*, const boxstream_id_pair*, std::size_t) { return true; }, nullptr));
    see(CALL(boxstream_world_shrink_to_fit, w)), see(CALL(boxstream_world_pair_count, w));
    see(CALL(boxstream_world_remove, w, ids_.data(), ids_.size() / 2, &live));
    update();
    CALL(boxstream_world_destroy, world_.release());
    CALL(boxstream_error_text), CALL(boxstream_simd_target);
    see(CALL(boxstream_version));
  }

  void see(std::uint64_t number) { seen_.push_back(number); }
  /// Of a visitor: a special value now and then. It computes nothing.
  double answer(double usual) {
    see(bits_of(usual));
    return ++visits_ % 3 == 0 ? special_ : usual;
  }

  std::vector<Box<S>> boxes_;
  std::vector<std::array<S, 4>> balls_;
  World world_;
  std::vector<boxstream_id> ids_;
  std::vector<std::uint64_t> seen_;
  double special_ = 0;
  unsigned visits_ = 0;
};

template <class S>
class Traps : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Traps, Scalars);

#if defined(BOXSTREAM_TESTS_CAN_TRAP)
TYPED_TEST(Traps, NoCallHasAnyForSpecialValues) {
  Calls<TypeParam> calls;
  const auto expected = calls.run();
  std::vector<std::uint64_t> found;
  tests::with_traps(FE_ALL_EXCEPT, [&] { found = calls.run(); });
  EXPECT_TRUE(found == expected);
  EXPECT_GT(expected.size(), 1000u);
}
#endif

TYPED_TEST(Traps, NoCallRaisesAFlag) {
  Calls<TypeParam> calls;
  std::feclearexcept(FE_ALL_EXCEPT);
  EXPECT_FALSE(calls.run().empty());
  EXPECT_EQ(std::fetestexcept(tests::flags_of_c), 0);
}

TYPED_TEST(Traps, AnswersAreThoseOfTheDefaultEnvironment) {
  Calls<TypeParam> calls;
  const auto expected = calls.run();
  for (unsigned number = 0; number < tests::Mood::count; ++number) {
    std::vector<std::uint64_t> found;
    {
      const tests::Mood mood(number);
      found = calls.run();
      EXPECT_TRUE(mood.is_on()) << number;
    }
    EXPECT_TRUE(found == expected) << "environment " << number;
  }
}

/// What the header declares and these tests do not call would not be tested.
TEST(AllFunctions, AreCalledUnderTraps) {
  Calls<float>().run();
  std::ifstream file(tests::source_path("adapters/c/include/boxstream/boxstream.h"));
  std::stringstream text;
  text << file.rdbuf();
  const std::string header = text.str();
  const std::regex declaration("BOXSTREAM_C_API[^;(]*?(boxstream_\\w+)\\(");
  std::set<std::string> declared;
  for (std::sregex_iterator it(header.begin(), header.end(), declaration), end; it != end; ++it)
    declared.insert((*it)[1]);
  EXPECT_EQ(called, declared);
}

}  // namespace
}  // namespace boxstream::c_test
