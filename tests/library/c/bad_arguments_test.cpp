// SPDX-License-Identifier: MIT
// Every function with each bad argument: a status, one line of text, and neither the handle nor what the caller gave to
// be filled has changed. So the next call does what it would have done.
#include <climits>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <string>

#include "handles.hpp"

namespace boxstream::c_test {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();

/// Everything that functions write, with a pattern in it.
struct Outputs {
  boxstream_id ids[4];
  std::size_t count;
  const boxstream_pair* pairs;
  boxstream_stats stats;
  boxstream_world_stats world_stats;
  boxstream_world* world;
  boxstream_detector* detector;

  Outputs() { std::memset(static_cast<void*>(this), 0x5a, sizeof *this); }
  bool untouched() const {
    const Outputs fresh;
    return std::memcmp(static_cast<const void*>(this), &fresh, sizeof fresh) == 0;
  }
};

void expect_refused(boxstream_status found, boxstream_status expected, const std::string& what) {
  EXPECT_EQ(found, expected) << what;
  const std::string text = boxstream_error_text();
  EXPECT_FALSE(text.empty()) << what;
  EXPECT_EQ(text.find('\n'), std::string::npos) << what;
}

/// A bad argument, and what it is.
struct Bad {
  std::string what;
  std::function<boxstream_status()> call;
  boxstream_status expected = BOXSTREAM_BAD_ARGUMENT;
};

std::vector<boxstream_scalar> bad_scalars(boxstream_scalar good) {
  return {2, 3, 99, -1, -7, 255, 256, INT_MAX, INT_MIN, good == BOXSTREAM_FLOAT ? BOXSTREAM_DOUBLE : BOXSTREAM_FLOAT};
}

/// Views that are wrong, but for which scalar a world has.
std::vector<std::pair<std::string, boxstream_boxes>> bad_views(const boxstream_boxes& good) {
  boxstream_boxes no_data = good, crooked = good, endless = good, crooked_filters = good;
  no_data.data = nullptr;
  crooked.data = static_cast<const char*>(good.data) + 1;
  endless.count = SIZE_MAX;
  crooked_filters.filters = reinterpret_cast<const boxstream_filter*>(static_cast<const char*>(good.data) + 1);
  return {{"no data", no_data},
          {"data not aligned", crooked},
          {"filters not aligned", crooked_filters},
          {"endless", endless}};
}

boxstream_status expected_of(const std::string& view) {
  return view == "endless" ? BOXSTREAM_TOO_MANY : BOXSTREAM_BAD_ARGUMENT;
}

bool no_visit(void*, boxstream_id) {
  return true;
}
bool no_pairs(void*, const boxstream_id_pair*, std::size_t) {
  return true;
}
bool no_batch(void*, const boxstream_pair*, std::size_t) {
  return true;
}
double no_ray(void*, boxstream_id, double, double length) {
  return length;
}
double no_near(void*, boxstream_id, double) {
  return 1;
}
double no_near_pair(void*, boxstream_id_pair, double) {
  return 1;
}

/// A world that has a pair, one that ended, one that began, and one that will begin.
template <class S>
struct WithHistory {
  std::vector<Box<S>> boxes{{0, 0, 0, 1, 1, 1}, {1, 0, 0, 2, 1, 1}, {2, 0, 0, 3, 1, 1}, {5, 0, 0, 6, 1, 1}};
  std::vector<boxstream_id> ids;
  World world = make_world(boxes, ids);

  WithHistory() {
    update();
    place(0, {6, 0, 0, 7, 1, 1});
    update();
    place(1, {5, 0, 0, 6, 1, 1});
  }
  void place(std::size_t i, const Box<S>& to) {
    const boxstream_boxes one{scalar_of<S>, to.data(), 1, nullptr};
    EXPECT_EQ(boxstream_world_move(world.get(), &ids[i], &one, nullptr), BOXSTREAM_OK);
  }
  void update() { EXPECT_EQ(boxstream_world_update(world.get(), nullptr, nullptr, nullptr), BOXSTREAM_OK); }
  std::vector<std::uint64_t> state() const { return state_of(world, ids); }
};

template <class S>
struct BadCallsOfWorld {
  WithHistory<S>& h;
  Outputs& out;
  boxstream_world* const w = h.world.get();
  const boxstream_boxes two{scalar_of<S>, h.boxes.data(), 2, nullptr};
  const std::array<double, 6> box{0, 0, 0, 9, 9, 9};

  std::vector<Bad> all() {
    std::vector<Bad> bad = nulls();
    views(bad);
    sizes(bad);
    return bad;
  }

  std::vector<Bad> nulls() {
    return {
        {"insert: no world", [=, this] { return boxstream_world_insert(nullptr, &two, nullptr, out.ids); }},
        {"insert: no boxes", [=, this] { return boxstream_world_insert(w, nullptr, nullptr, out.ids); }},
        {"insert: no ids", [=, this] { return boxstream_world_insert(w, &two, nullptr, nullptr); }},
        {"remove: no world", [=, this] { return boxstream_world_remove(nullptr, h.ids.data(), 2, &out.count); }},
        {"remove: no ids", [=, this] { return boxstream_world_remove(w, nullptr, 2, &out.count); }},
        {"move: no world", [=, this] { return boxstream_world_move(nullptr, h.ids.data(), &two, &out.count); }},
        {"move: no ids", [=, this] { return boxstream_world_move(w, nullptr, &two, &out.count); }},
        {"move: no boxes", [=, this] { return boxstream_world_move(w, h.ids.data(), nullptr, &out.count); }},
        {"update: no world", [] { return boxstream_world_update(nullptr, nullptr, nullptr, nullptr); }},
        {"stream_pairs: no world", [] { return boxstream_world_stream_pairs(nullptr, no_pairs, nullptr); }},
        {"stream_pairs: no sink", [=, this] { return boxstream_world_stream_pairs(w, nullptr, nullptr); }},
        {"query_box: no world",
         [=, this] { return boxstream_world_query_box(nullptr, box.data(), no_visit, nullptr); }},
        {"query_box: no box", [=, this] { return boxstream_world_query_box(w, nullptr, no_visit, nullptr); }},
        {"query_box: no visitor", [=, this] { return boxstream_world_query_box(w, box.data(), nullptr, nullptr); }},
        {"query_ray: no world",
         [=, this] { return boxstream_world_query_ray(nullptr, box.data(), box.data() + 3, 1, no_ray, nullptr); }},
        {"query_ray: no origin",
         [=, this] { return boxstream_world_query_ray(w, nullptr, box.data(), 1, no_ray, nullptr); }},
        {"query_ray: no direction",
         [=, this] { return boxstream_world_query_ray(w, box.data(), nullptr, 1, no_ray, nullptr); }},
        {"query_ray: no visitor",
         [=, this] { return boxstream_world_query_ray(w, box.data(), box.data() + 3, 1, nullptr, nullptr); }},
        {"nearest: no world",
         [=, this] { return boxstream_world_query_nearest(nullptr, box.data(), out.ids, 2, &out.count); }},
        {"nearest: no point", [=, this] { return boxstream_world_query_nearest(w, nullptr, out.ids, 2, &out.count); }},
        {"nearest: no ids", [=, this] { return boxstream_world_query_nearest(w, box.data(), nullptr, 2, &out.count); }},
        {"near: no world", [=, this] { return boxstream_world_query_near(nullptr, box.data(), 1, no_near, nullptr); }},
        {"near: no box", [=, this] { return boxstream_world_query_near(w, nullptr, 1, no_near, nullptr); }},
        {"near: no visitor", [=, this] { return boxstream_world_query_near(w, box.data(), 1, nullptr, nullptr); }},
        {"near_pairs: no world", [] { return boxstream_world_near_pairs(nullptr, 1, no_near_pair, nullptr); }},
        {"near_pairs: no visitor", [=, this] { return boxstream_world_near_pairs(w, 1, nullptr, nullptr); }},
        {"create: no place", [] { return boxstream_world_create(scalar_of<S>, nullptr, nullptr); }},
    };
  }

  void view(std::vector<Bad>& bad, const std::string& what, const boxstream_boxes& boxes, boxstream_status expected) {
    bad.push_back(
        {"insert: " + what, [=, this] { return boxstream_world_insert(w, &boxes, nullptr, out.ids); }, expected});
    if (boxes.filters == nullptr)  // which move does not use
      bad.push_back(
          {"move: " + what, [=, this] { return boxstream_world_move(w, h.ids.data(), &boxes, &out.count); }, expected});
  }

  void views(std::vector<Bad>& bad) {
    for (const auto& [what, boxes] : bad_views(two)) view(bad, what, boxes, expected_of(what));
    for (const boxstream_scalar scalar : bad_scalars(scalar_of<S>)) {
      boxstream_boxes strange = two;
      strange.scalar = scalar;
      view(bad, "scalar " + std::to_string(scalar), strange, BOXSTREAM_BAD_ARGUMENT);
      strange = {scalar, nullptr, 0, nullptr};
      view(bad, "none of scalar " + std::to_string(scalar), strange, BOXSTREAM_BAD_ARGUMENT);
      if (scalar != BOXSTREAM_FLOAT && scalar != BOXSTREAM_DOUBLE)
        bad.push_back({"create", [=, this] { return boxstream_world_create(scalar, nullptr, &out.world); }});
    }
  }

  void sizes(std::vector<Bad>& bad) {
    for (const std::size_t size : {std::size_t{0}, std::size_t{1}, sizeof(std::size_t) - 1})
      bad.push_back({"update: stats of size " + std::to_string(size), [=, this] {
                       boxstream_world_stats stats = {size, 7, 7, 7, 7, 7, 7};
                       const auto status = boxstream_world_update(w, nullptr, nullptr, &stats);
                       EXPECT_TRUE(stats.size == size && stats.proxies == 7 && stats.ended == 7);
                       return status;
                     }});
    bad.push_back({"remove: endless",
                   [=, this] { return boxstream_world_remove(w, h.ids.data(), SIZE_MAX, &out.count); },
                   BOXSTREAM_TOO_MANY});
    bad.push_back({"nearest: endless",
                   [=, this] { return boxstream_world_query_nearest(w, box.data(), out.ids, SIZE_MAX, &out.count); },
                   BOXSTREAM_TOO_MANY});
  }
};

template <class S>
class BadArguments : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(BadArguments, Scalars);

TYPED_TEST(BadArguments, LeaveAWorldAsItWas) {
  WithHistory<TypeParam> tried, twin;
  Outputs out;
  BadCallsOfWorld<TypeParam> calls{tried, out};
  const auto before = tried.state();
  for (const Bad& bad : calls.all()) {
    expect_refused(bad.call(), bad.expected, bad.what);
    EXPECT_EQ(tried.state(), before) << bad.what;
    EXPECT_TRUE(out.untouched()) << bad.what;
  }
  tried.update(), twin.update();
  EXPECT_EQ(tried.state(), twin.state());
  std::size_t begun = 0;
  boxstream_world_begun(tried.world.get(), &begun);
  EXPECT_EQ(begun, 2u);  // which no refused call has used up
}

template <class S>
struct BadCallsOfDetector {
  boxstream_detector* d;
  Outputs& out;
  std::vector<Box<S>> boxes{{0, 0, 0, 1, 1, 1}, {1, 0, 0, 2, 1, 1}};
  boxstream_boxes two{scalar_of<S>, boxes.data(), 2, nullptr};
  boxstream_balls balls{scalar_of<S>, boxes.data(), 2};

  boxstream_status find(const boxstream_boxes* a, const boxstream_boxes* b) {
    return boxstream_find_pairs(d, a, b, &out.pairs, &out.count, &out.stats);
  }
  boxstream_status stream(const boxstream_boxes* a, const boxstream_boxes* b) {
    return boxstream_stream_pairs(d, a, b, no_batch, nullptr, &out.stats);
  }
  boxstream_status near(const boxstream_balls* of, double distance) {
    return boxstream_find_near_pairs(d, of, distance, &out.pairs, &out.count, &out.stats);
  }

  std::vector<Bad> nulls() {
    return {
        {"find: no detector",
         [&] { return boxstream_find_pairs(nullptr, &two, nullptr, &out.pairs, &out.count, nullptr); }},
        {"find: no boxes", [&] { return find(nullptr, &two); }},
        {"find: no pairs", [&] { return boxstream_find_pairs(d, &two, nullptr, nullptr, &out.count, &out.stats); }},
        {"find: no count", [&] { return boxstream_find_pairs(d, &two, nullptr, &out.pairs, nullptr, &out.stats); }},
        {"stream: no detector",
         [&] { return boxstream_stream_pairs(nullptr, &two, nullptr, no_batch, nullptr, nullptr); }},
        {"stream: no boxes", [&] { return stream(nullptr, &two); }},
        {"stream: no sink", [&] { return boxstream_stream_pairs(d, &two, nullptr, nullptr, nullptr, &out.stats); }},
        {"near: no detector",
         [&] { return boxstream_find_near_pairs(nullptr, &balls, 1, &out.pairs, &out.count, nullptr); }},
        {"near: no balls", [&] { return near(nullptr, 1); }},
        {"near: no pairs", [&] { return boxstream_find_near_pairs(d, &balls, 1, nullptr, &out.count, &out.stats); }},
        {"near: no count", [&] { return boxstream_find_near_pairs(d, &balls, 1, &out.pairs, nullptr, &out.stats); }},
        {"create: no place", [&] { return boxstream_detector_create(nullptr, nullptr); }},
    };
  }

  void view(std::vector<Bad>& bad, const std::string& what, const boxstream_boxes& boxes_, boxstream_status expected) {
    bad.push_back({"find: " + what, [=, this] { return find(&boxes_, nullptr); }, expected});
    bad.push_back({"find, first of two: " + what, [=, this] { return find(&boxes_, &two); }, expected});
    bad.push_back({"find, second of two: " + what, [=, this] { return find(&two, &boxes_); }, expected});
    bad.push_back({"stream: " + what, [=, this] { return stream(&boxes_, nullptr); }, expected});
    bad.push_back({"stream, second of two: " + what, [=, this] { return stream(&two, &boxes_); }, expected});
    const boxstream_balls same{boxes_.scalar, boxes_.data, boxes_.count};
    if (boxes_.filters == nullptr) bad.push_back({"near: " + what, [=, this] { return near(&same, 1); }, expected});
  }

  void views(std::vector<Bad>& bad) {
    for (const auto& [what, boxes_] : bad_views(two)) view(bad, what, boxes_, expected_of(what));
    for (const boxstream_scalar scalar : {2, 98, -1, INT_MAX, INT_MIN})
      for (const std::size_t count : {0, 2}) {
        boxstream_boxes strange = two;
        strange.scalar = scalar, strange.count = count;
        view(bad, "scalar " + std::to_string(scalar), strange, BOXSTREAM_BAD_ARGUMENT);
      }
    static const std::vector<Box<double>> doubles(2);
    static const std::vector<Box<float>> floats(2);
    static const boxstream_boxes other = scalar_of<S> == BOXSTREAM_FLOAT ? view_of(doubles) : view_of(floats);
    bad.push_back({"find: two scalars", [=, this] { return find(&two, &other); }});
    bad.push_back({"stream: two scalars", [=, this] { return stream(&two, &other); }});
  }

  void numbers(std::vector<Bad>& bad) {
    for (const double distance : {-1e-300, -1.0, inf, -inf, nan})
      bad.push_back({"near: distance " + std::to_string(distance), [=, this] { return near(&balls, distance); }});
    for (const std::size_t size : {std::size_t{0}, sizeof(std::size_t) - 1})
      for (const int function : {0, 1, 2})
        bad.push_back({"stats of size " + std::to_string(size), [=, this] {
                         boxstream_stats stats{size, 7, 7, 7, 7};
                         boxstream_status status = BOXSTREAM_OK;
                         if (function == 0)
                           status = boxstream_find_pairs(d, &two, nullptr, &out.pairs, &out.count, &stats);
                         if (function == 1)
                           status = boxstream_stream_pairs(d, &two, nullptr, no_batch, nullptr, &stats);
                         if (function == 2)
                           status = boxstream_find_near_pairs(d, &balls, 1, &out.pairs, &out.count, &stats);
                         EXPECT_TRUE(stats.size == size && stats.boxes == 7 && stats.tests == 7);
                         return status;
                       }});
  }
};

TYPED_TEST(BadArguments, LeaveADetectorAndItsPairsAsTheyWere) {
  const Detector detector = make_detector();
  Outputs out;
  BadCallsOfDetector<TypeParam> calls{detector.get(), out};
  const boxstream_pair* pairs = nullptr;
  std::size_t count = 0;
  ASSERT_EQ(boxstream_find_pairs(detector.get(), &calls.two, nullptr, &pairs, &count, nullptr), BOXSTREAM_OK);
  ASSERT_EQ(count, 1u);
  std::vector<Bad> all = calls.nulls();
  calls.views(all);
  calls.numbers(all);
  for (const Bad& bad : all) {
    expect_refused(bad.call(), bad.expected, bad.what);
    EXPECT_TRUE(out.untouched()) << bad.what;
    EXPECT_TRUE(pairs[0].a == 0 && pairs[0].b == 1) << bad.what;
  }
}

unsigned one(void*) {
  return 1;
}
void no_tasks(void*, std::size_t, void (*)(void*, std::size_t), void*) {}

TEST(BadExecutors, MakeNothing) {
  const boxstream_executor good{sizeof good, nullptr, one, no_tasks, nullptr};
  std::vector<boxstream_executor> bad(4, good);
  bad[0].size = 0;
  bad[1].size = sizeof good - 1;
  bad[2].concurrency = nullptr;
  bad[3].parallel_for = nullptr;
  for (const boxstream_executor& executor : bad) {
    Outputs out;
    expect_refused(boxstream_detector_create(&executor, &out.detector), BOXSTREAM_BAD_ARGUMENT, "detector");
    expect_refused(boxstream_world_create(BOXSTREAM_FLOAT, &executor, &out.world), BOXSTREAM_BAD_ARGUMENT, "world");
    EXPECT_TRUE(out.untouched());
  }
}

void run_counted(void* user, std::size_t count, void (*task)(void*, std::size_t), void* context) {
  ++*static_cast<int*>(user);
  for (std::size_t i = 0; i < count; ++i) task(context, i);
}

/// As that of a program with a header of a later version.
TEST(Executors, MayHaveMembersThatTheLibraryDoesNotKnow) {
  constexpr int side = 150;
  std::vector<Box<float>> boxes;
  for (int i = 0; i < side * side; ++i) {
    const float x = static_cast<float>(i % side), y = static_cast<float>(i / side);
    boxes.push_back({x, y, 0, x + 1, y + 1, 1});
  }
  struct Later {
    boxstream_executor known;
    void* more[3];
  };
  int runs = 0;
  const auto two = [](void*) { return 2u; };
  const auto at_once = [](void*) { return std::uint32_t{0}; };
  const Later later{{sizeof(Later), &runs, two, run_counted, at_once}, {}};
  const Detector detector = make_detector(&later.known);
  const boxstream_boxes view = view_of(boxes);
  const boxstream_pair* pairs = nullptr;
  std::size_t count = 0;
  ASSERT_EQ(boxstream_find_pairs(detector.get(), &view, nullptr, &pairs, &count, nullptr), BOXSTREAM_OK);
  EXPECT_EQ(count, std::size_t{2 * side * (side - 1) + 2 * (side - 1) * (side - 1)});
  EXPECT_GT(runs, 0);
}

/// Those that have no status answer with what an empty world would.
TEST(NoWorld, IsAnEmptyOne) {
  std::size_t count = 7;
  EXPECT_EQ(boxstream_world_begun(nullptr, &count), nullptr);
  EXPECT_EQ(count, 0u);
  EXPECT_EQ(boxstream_world_ended(nullptr, nullptr), nullptr);
  EXPECT_EQ(boxstream_world_size(nullptr) + boxstream_world_pair_count(nullptr) + boxstream_world_user(nullptr, {1, 1}),
            0u);
  EXPECT_FALSE(boxstream_world_contains(nullptr, {1, 1}) || boxstream_world_set_filter(nullptr, {1, 1}, {1, 1}));
}

}  // namespace
}  // namespace boxstream::c_test
