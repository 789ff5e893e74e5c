// SPDX-License-Identifier: MIT
// Small streams that ask for much: what a replay takes is in proportion to the stream, or refused in one line.
#include <gtest/gtest.h>

#include <sys/resource.h>

#include <fstream>

#include "formats/record/pair_limit.hpp"
#include "sanitized.hpp"
#include "streams.hpp"

namespace boxstream::record_test {
namespace {

using namespace record;

/// In a row that sap's bounds hold.
Aabb64 box_at(double place) {
  const double x = place / 64 - 90;
  return {{x, 0, 0}, {x + 0.25 / 64, 1, 1}};
}

/// Boxes side by side, each `apart` from the next.
std::vector<Op> row(std::uint32_t count, double apart) {
  std::vector<Op> ops;
  for (std::uint32_t i = 0; i < count; ++i) ops.push_back(Create{i, 0, 1, -1, box_at(apart * i)});
  return ops;
}

/// Kinds of streams of `count` proxies that ask for some count^2 pairs or hits.
struct Kind {
  const char* name;
  std::vector<Op> ops;
  bool is_refused;
};

std::vector<Kind> kinds(std::uint32_t count) {
  const std::vector<Op> heap = row(count, 0);
  std::vector<Op> one_batch = heap, batches = heap, gathered = row(count, 4), swapped = gathered, queries = gathered,
                  refused_by_filter = heap;
  one_batch.push_back(Batch{});
  for (int i = 0; i < 200; ++i) batches.push_back(Batch{});
  gathered.push_back(Batch{});
  swapped.push_back(Batch{});
  for (std::uint32_t i = 0; i < count; ++i) gathered.push_back(Move{i, box_at(0)});
  for (std::uint32_t i = 0; i < count; ++i) swapped.push_back(Move{i, box_at(4.0 * (count - 1 - i))});
  gathered.push_back(Batch{});
  swapped.push_back(Batch{});
  for (std::uint32_t i = 0; i < 2 * count; ++i) queries.push_back(BoxQuery{{{-1, -1, -1}, {1e6, 2, 2}}});
  queries.push_back(Batch{});
  for (std::uint32_t i = 0; i < count; ++i) std::get<Create>(refused_by_filter[i]).mask = 0;
  refused_by_filter.push_back(Batch{});
  return {{"all at one place", one_batch, true},
          {"many batches of them", batches, true},
          {"no batch", heap, false},
          {"moved to one place", gathered, true},
          {"moved past each other", swapped, false},
          {"box queries that hit all", queries, false},
          {"pairs that filters refuse", refused_by_filter, false}};
}

std::string refusal(const Bytes& bytes, const std::string& broadphase, std::uint64_t most) {
  std::vector<std::unique_ptr<Player>> players;
  players.push_back(std::make_unique<Player>(broadphase, make(broadphase, 5000), most));
  try {
    replay(bytes, players, CutOff::is_error, {}, most);
    return {};
  } catch (const RecordError& error) {
    return error.what();
  }
}

long most_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss / 1024;  // MiB
}

/// Of what comes from now on, where the system allows it: else what another test took would hide it.
long most_memory_begun_anew() {
  std::ofstream("/proc/self/clear_refs") << 5;
  return most_memory();
}

TEST(Limits, FewBytesThatAskForManyPairs) {
  const long before = most_memory_begun_anew();
  for (const Kind& kind : kinds(1500)) {
    const Bytes bytes = write(kind.ops);
    ASSERT_LT(bytes.size(), 130'000U) << kind.name;
    for (const char* const broadphase : {"boxstream", "dbvt", "dbvt-deferred", "sap"}) {
      const bool finds_at_once = std::string(broadphase) == "dbvt" || std::string(broadphase) == "sap";
      const std::string said = refusal(bytes, broadphase, 20'000);
      // Those that look for pairs at every call find them without a batch.
      const bool is_refused = kind.is_refused || (finds_at_once && std::string(kind.name) == "no batch");
      EXPECT_EQ(said, is_refused ? "more than 20000 pairs at once (--max-pairs allows more)" : "")
          << kind.name << ", " << broadphase;
    }
  }
  EXPECT_LT(most_memory() - before, tests::sanitized ? 4000 : 100);  // 1.1 million pairs would take more
}

/// The hits of a query are given up before those of many are there: each of these has 3000.
TEST(Limits, QueriesTakeNoMoreThanOneOfThem) {
  std::vector<Op> ops = row(3000, 4);
  for (int i = 0; i < 20'000; ++i) ops.push_back(BoxQuery{{{-1, -1, -1}, {1e6, 2, 2}}});
  ops.push_back(Batch{});
  const Bytes bytes = write(ops);
  const long before = most_memory_begun_anew();
  EXPECT_EQ(refusal(bytes, "boxstream", 20'000), "");
  EXPECT_LT(most_memory() - before, tests::sanitized ? 4000 : 60);  // all of them: 240 MB
}

TEST(Limits, AsManyAsAllowedAreReplayed) {
  std::vector<Op> ops = row(100, 0);
  ops.push_back(Batch{});
  EXPECT_EQ(refusal(write(ops), "dbvt-deferred", 100 * 99 / 2 - 1).substr(0, 9), "more than");
  // No refusal, but a difference: the batch says that there are none.
  EXPECT_EQ(refusal(write(ops), "dbvt-deferred", 100 * 99 / 2), "");
}

}  // namespace
}  // namespace boxstream::record_test
