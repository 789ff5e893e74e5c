// SPDX-License-Identifier: MIT
// What goes wrong on one rank is thrown on all, none waits for ever, and the next search is whole.
#include <cstdint>
#include <exception>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/box_sets.hpp"
#include "heap_watch.hpp"
#include "shares.hpp"

namespace boxstream::mpi_test {
namespace {

namespace heap_watch = tests::heap_watch;

const auto take_all = [](Span<const WidePair>) { return true; };

const Boxes<float>& dense() {
  static const auto boxes = tests::box_set<float>("dense").make(2000, 1);
  return boxes;
}

std::size_t pairs_of_dense() {
  static const std::size_t pairs = boxstream::find_pairs(dense()).size();
  return pairs;
}

void expect_whole_search() {
  const Share<float> share(dense(), Way::round_robin);
  const auto pairs = from_all(mpi::stream_pairs(MPI_COMM_WORLD, share.boxes, share.ids, take_all).pairs);
  std::uint64_t found = 0;
  for (const std::uint64_t count : pairs) found += count;
  EXPECT_EQ(found, pairs_of_dense());
}

/// That `search` throws an Error of `culprit` on this rank, and whether the exception nested in it is an E.
template <class E, class Search>
void expect_error(int culprit, const std::string& reason, Search&& search) {
  try {
    search();
    ADD_FAILURE() << "no error";
  } catch (const mpi::Error& error) {
    EXPECT_EQ(error.rank(), culprit);
    const std::string what = error.what();
    EXPECT_NE(what.find("rank " + std::to_string(culprit) + ": "), std::string::npos) << what;
    EXPECT_NE(what.find(reason), std::string::npos) << what;
    bool nested = false;
    try {
      std::rethrow_if_nested(error);
    } catch (const E&) {
      nested = true;
    }
    EXPECT_EQ(nested, rank() == culprit);
  }
}

TEST(Failures, SinkThatThrowsOnOneRank) {
  for (int culprit = 0; culprit < size(); ++culprit) {
    const Share<float> share(dense(), Way::sorted);
    const auto sink = [&](Span<const WidePair>) -> bool {
      if (rank() == culprit) throw std::domain_error("the sink is full");
      return true;
    };
    expect_error<std::domain_error>(culprit, "the sink is full",
                                    [&] { mpi::stream_pairs(MPI_COMM_WORLD, share.boxes, share.ids, sink); });
  }
  expect_whole_search();
}

TEST(Failures, SinkThatThrowsOnAllNamesTheFirst) {
  const Share<float> share(dense(), Way::round_robin);
  const auto sink = [](Span<const WidePair>) -> bool { throw 1; };
  try {
    mpi::stream_pairs(MPI_COMM_WORLD, share.boxes, share.ids, sink);
    ADD_FAILURE() << "no error";
  } catch (const mpi::Error& error) {
    EXPECT_EQ(std::string(error.what()), "boxstream: rank 0: an exception of unknown type");
  }
}

TEST(Failures, ErrorsOfTheLibraryHaveItsNameOnce) {
  const Share<float> share(dense(), Way::round_robin);
  const std::vector<std::uint64_t> wrong{3, 4};
  const auto sink = [&](Span<const WidePair>) {
    PairsOfSets out;
    Detector().find_pairs(Span<const Aabb>(share.boxes), wrong, out);
    return true;
  };
  try {
    mpi::stream_pairs(MPI_COMM_WORLD, share.boxes, share.ids, sink);
    ADD_FAILURE() << "no error";
  } catch (const mpi::Error& error) {
    EXPECT_EQ(std::string(error.what()),
              "boxstream: rank 0: offsets of sets must ascend from 0 to the number of boxes");
  }
}

TEST(Failures, SinkThatStopsStopsItsRankAlone) {
  const Share<float> share(dense(), Way::round_robin);
  std::size_t calls = 0;
  const auto sink = [&](Span<const WidePair>) { return ++calls != 0 && rank() != 0; };
  const mpi::Stats own = mpi::stream_pairs(MPI_COMM_WORLD, share.boxes, share.ids, sink);
  const auto all = from_all(own);
  for (std::size_t i = 1; i < all.size(); ++i) EXPECT_GT(all[i].pairs, 100u);
  EXPECT_TRUE(rank() != 0 || calls == 1);
  expect_whole_search();
}

TEST(Failures, TooFewIdsOnOneRank) {
  const int culprit = size() - 1;
  Share<float> share(dense(), Way::round_robin);
  if (rank() == culprit) share.ids.pop_back();
  std::vector<WidePair> out{{1, 2}};
  expect_error<std::invalid_argument>(culprit, "as many ids",
                                      [&] { mpi::find_pairs(MPI_COMM_WORLD, share.boxes, share.ids, out); });
  EXPECT_TRUE(out.empty());
  expect_whole_search();
}

TEST(Failures, EachAllocationOfOneRankMayFail) {
  const int culprit = size() / 2;
  const Share<float> share(dense(), Way::every_other_empty);
  std::uint64_t failed = 1, failures = 0;
  for (std::int64_t first = 0; failed != 0; first += size() > 4 ? 5 : 1) {
    std::vector<WidePair> out;
    if (rank() == culprit) heap_watch::fail_at(first);
    bool threw = false;
    try {
      mpi::find_pairs(MPI_COMM_WORLD, share.boxes, share.ids, out);
    } catch (const std::exception&) {
      threw = true;
    }
    failed = rank() == culprit && heap_watch::stop_failing() ? 1 : 0;
    MPI_Bcast(&failed, 1, MPI_UINT64_T, culprit, MPI_COMM_WORLD);
    failures += failed;
    const auto threw_on = from_all(threw ? 1 : 0);
    for (const int on_rank : threw_on) EXPECT_EQ(on_rank, threw_on[0]) << "allocation " << first;
    EXPECT_TRUE(!threw || out.empty());
    if (!threw) {
      std::uint64_t found = out.size();
      MPI_Allreduce(MPI_IN_PLACE, &found, 1, MPI_UINT64_T, MPI_SUM, MPI_COMM_WORLD);
      EXPECT_EQ(found, pairs_of_dense());
    }
  }
  EXPECT_GT(failures, 5u);
}

TEST(Failures, EachAllocationOfOneRankMayFailInAWorld) {
  const int culprit = size() - 1;
  const Share<float> share(dense(), Way::round_robin);
  std::uint64_t failed = 1, failures = 0;
  for (std::int64_t first = 0; failed != 0; first = first * 9 / 8 + 1) {
    mpi::World world(MPI_COMM_WORLD);
    bool threw = false;
    if (rank() == culprit) heap_watch::fail_at(first);
    try {
      world.update(share.boxes, share.ids);
    } catch (const std::exception&) {
      threw = true;
    }
    failed = rank() == culprit && heap_watch::stop_failing() ? 1 : 0;
    MPI_Bcast(&failed, 1, MPI_UINT64_T, culprit, MPI_COMM_WORLD);
    failures += failed;
    for (const int on_rank : from_all(threw ? 1 : 0)) EXPECT_EQ(on_rank, threw ? 1 : 0) << "allocation " << first;
    EXPECT_TRUE(!threw || world.begun().empty());
    std::uint64_t found = threw ? world.update(share.boxes, share.ids).begun : world.begun().size();
    MPI_Allreduce(MPI_IN_PLACE, &found, 1, MPI_UINT64_T, MPI_SUM, MPI_COMM_WORLD);
    EXPECT_EQ(found, pairs_of_dense());
  }
  EXPECT_GT(failures, 5u);
}

}  // namespace
}  // namespace boxstream::mpi_test
