// SPDX-License-Identifier: MIT
#include "tables/results_table.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <stdexcept>

namespace boxstream::bench {
namespace {

Row row_of(const std::string& suite, const std::string& peer, double peer_ms) {
  Row row;
  row.suite = suite;
  row.case_name = "U";
  row.n = 100000;
  row.k = 50000;
  row.peer = peer;
  row.ours_ms = 2;
  row.ours_min = 1.5;
  row.peer_ms = peer_ms;
  row.peer_min = peer_ms;
  row.pairs_equal = true;
  return row;
}

void write_rows(const std::string& path) {
  Report report(describe_machine());
  report.add(row_of("batch", "cgal:300", 30));
  Row tuned = row_of("tune", "plan:z,x8,y8", 1.5);
  tuned.yardstick = true;
  report.add(tuned);
  Row skipped = row_of("batch", "fcl-sap", 1);
  skipped.skipped = "over limit";
  report.add(skipped);
  report.write_json(path);
}

TEST(ResultsTable, RowsComeBackFromJson) {
  write_rows("table_rows.json");
  const std::vector<Row> rows = read_results("table_rows.json").rows;
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0].peer, "cgal:300");
  EXPECT_EQ(rows[0].ratio(), 15);
  EXPECT_EQ(rows[0].pairs_equal, true);
  EXPECT_FALSE(rows[0].yardstick);
  EXPECT_TRUE(rows[1].yardstick);
  EXPECT_EQ(rows[2].skipped, "over limit");
  EXPECT_NE(describe_run(read_results("table_rows.json").machine).find("SIMD target"), std::string::npos);
  EXPECT_THROW(read_results("no_such_file.json"), std::runtime_error);
  std::ofstream("table_nothing.json") << "{}";
  EXPECT_THROW(read_results("table_nothing.json"), std::runtime_error);
}

TEST(ResultsTable, HasTheBestPeersAndTheYardsticks) {
  write_rows("table_rows.json");
  const std::string text = results_table(read_results("table_rows.json").rows);
  EXPECT_NE(text.find("In none of 1 cases a peer is faster.\n"), std::string::npos) << text;
  EXPECT_NE(text.find("| batch | U | 100000 | 1 | 50000 | 2 | cgal:300 | 30 | 15.00 | 1 |"), std::string::npos) << text;
  EXPECT_NE(text.find("| tune | U | 100000 | 1 | 2 | plan:z,x8,y8 | 1.5 | 0.75 |"), std::string::npos) << text;
  EXPECT_EQ(results_table({}), "");
}

TEST(ResultsTable, NamesTheCasesInWhichAPeerIsFasterWorstFirst) {
  std::vector<Row> rows{row_of("batch", "sweep", 1.9), row_of("sets", "tree", 30), row_of("users", "dbvt", 1)};
  const std::string text = results_table(rows);
  EXPECT_NE(
      text.find("In 2 of 3 cases a peer is faster, worst first: `users` U, 100000: 0.50; `batch` U, 100000: 0.95."),
      std::string::npos)
      << text;
}

TEST(ResultsTable, WorstFramesStandBesideTheLeastWorstOfAPeer) {
  Report report(describe_machine());
  for (const double worst : {9.0, 4.0, 7.0}) {
    Row row = row_of("frames", "peer:" + std::to_string(int(worst)), 3);
    row.ours_frames = {2, 3, 6};
    row.peer_frames = {2, 3, worst};
    report.add(row);
  }
  Row yardstick = row_of("frames", "detector", 1);
  yardstick.yardstick = true;
  yardstick.ours_frames = yardstick.peer_frames = {1, 1, 1};
  report.add(yardstick);
  report.write_json("table_frames.json");
  const std::string text = frames_table(read_results("table_frames.json").rows);
  EXPECT_NE(text.find("| U | 100000 | 2000, 3000, 6000 | 3.0 | peer:4 | 2000, 4000 | 2.0 |"), std::string::npos)
      << text;
  EXPECT_EQ(text.find("detector"), std::string::npos);
  EXPECT_EQ(frames_table({}), "");
}

TEST(ResultsTable, GoesBetweenTheMarksOfAPage) {
  const std::string page = "before\n<!-- results: begin -->\nold\n<!-- results: end -->\nafter\n";
  const std::string changed = put_block(page, "results", "new\n");
  EXPECT_EQ(changed, "before\n<!-- results: begin -->\nnew\n<!-- results: end -->\nafter\n");
  EXPECT_EQ(put_block(changed, "results", "new\n"), changed);
  EXPECT_THROW(put_block(page, "other", "new\n"), std::runtime_error);
  EXPECT_THROW(put_block("no marks", "results", "new\n"), std::runtime_error);
}

}  // namespace
}  // namespace boxstream::bench
