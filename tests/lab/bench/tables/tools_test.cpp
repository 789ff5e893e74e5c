// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "peers/pair_hash.hpp"
#include "tables/report.hpp"

namespace boxstream::bench {
namespace {

TEST(PairHash, TellsSetsApartAndIgnoresOrder) {
  const std::vector<Pair> pairs{{1, 2}, {3, 4}, {2, 7}};
  const PairSummary summary = summarize(pairs);
  EXPECT_EQ(summary, summarize(std::vector<Pair>{{2, 7}, {2, 1}, {4, 3}}));
  EXPECT_NE(summary, summarize(std::vector<Pair>{{1, 2}, {3, 4}, {2, 8}}));
  EXPECT_NE(summary, summarize(std::vector<Pair>{{1, 2}, {3, 4}}));
  EXPECT_NE(summary, summarize(std::vector<Pair>{{1, 2}, {3, 4}, {2, 7}, {2, 7}}));
  // A pair twice and another missing: the count alone would not notice.
  EXPECT_NE(summary, summarize(std::vector<Pair>{{1, 2}, {3, 4}, {3, 4}}));
}

Row row_with(bool pairs_equal) {
  Row row;
  row.suite = "batch";
  row.case_name = "U";
  row.n = 10;
  row.peer = "nobody";
  row.k = 3;
  row.ours_ms = 2;
  row.peer_ms = 8;
  row.pairs_equal = pairs_equal;
  return row;
}

TEST(Report, DifferentPairsAreAFailure) {
  Report report(describe_machine());
  report.add(row_with(true));
  EXPECT_FALSE(report.failed());
  report.add(row_with(false));
  EXPECT_TRUE(report.failed());
}

TEST(Report, TheBestPeerHasTheSmallestRatio) {
  std::vector<Row> rows(4, row_with(true));
  rows[1].peer = "better";
  rows[1].peer_ms = 6;
  rows[2].peer = "skipped";
  rows[2].peer_ms = 1;
  rows[2].skipped = "over limit";
  rows[3].peer = "sort";
  rows[3].peer_ms = 1;
  rows[3].yardstick = true;
  const std::vector<Best> best = best_peers(rows);
  ASSERT_EQ(best.size(), 1u);
  EXPECT_EQ(best[0].row->peer, "better");
  EXPECT_EQ(best[0].peers, 2u);
}

TEST(Report, SkippedPeersHaveNoTimesAndDoNotFail) {
  Report report(describe_machine());
  Row row = row_with(false);
  row.skipped = "too slow";
  report.add(row);
  EXPECT_FALSE(report.failed());
  report.write_json("report_skipped.json");
  const auto document = nlohmann::json::parse(std::ifstream("report_skipped.json"));
  EXPECT_EQ(document["rows"][0]["skipped"], "too slow");
  EXPECT_FALSE(document["rows"][0].contains("peer_ms"));
}

TEST(Report, JsonHasTheRows) {
  Report report(describe_machine());
  report.add(row_with(true));
  report.write_json("report_rows.json");
  const auto document = nlohmann::json::parse(std::ifstream("report_rows.json"));
  for (const char* key : {"cpu", "compiler", "flags", "peer_flags", "simd", "date"})
    EXPECT_TRUE(document["machine"].contains(key)) << key;
  const auto& row = document["rows"].at(0);
  for (const char* key : {"suite", "case", "n", "peer", "k", "ours_ms", "peer_ms", "ratio", "ours_min", "peer_min",
                          "pairs_equal", "threads", "simd"})
    EXPECT_TRUE(row.contains(key)) << key;
  EXPECT_EQ(row["ratio"], 4.0);
  EXPECT_EQ(row["pairs_equal"], true);
}

TEST(Report, JsonThatCannotBeWrittenIsAnError) {
  const Report report(describe_machine());
  EXPECT_THROW(report.write_json("no/such/directory/rows.json"), std::runtime_error);
}

}  // namespace
}  // namespace boxstream::bench
