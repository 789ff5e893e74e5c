// SPDX-License-Identifier: MIT
#include "tables/plot.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "tables/report.hpp"
#include "tables/speedup.hpp"

namespace boxstream::bench {
namespace {

Row row(std::size_t n, const std::string& peer, double ours_ms, double peer_ms) {
  Row r;
  r.suite = "scaling";
  r.case_name = "U";
  r.n = n;
  r.peer = peer;
  r.ours_ms = ours_ms;
  r.peer_ms = peer_ms;
  r.pairs_equal = true;
  return r;
}

void write_rows(const std::string& path) {
  Report report(describe_machine());
  report.add(row(1000, "cgal:300", 0.1, 0.5));
  report.add(row(100, "cgal:10", 0.01, 0.03));
  Row over = row(1000, "brute", 0.1, 0);
  over.skipped = "over limit";
  report.add(over);
  Row parallel = row(1000, "cgal-tbb:10", 0.05, 0.4);
  parallel.threads = 2;
  report.add(parallel);
  report.write_json(path);
}

TEST(Plots, LinesAreOneAPeerInOrderOfN) {
  write_rows("plot_rows.json");
  const Plot plot = read_plot("plot_rows.json", "scaling", "U", PlotValue::milliseconds);
  ASSERT_EQ(plot.lines.size(), 2u);
  EXPECT_TRUE(plot.lines[0].ours);
  EXPECT_EQ(plot.lines[1].name, "cgal");
  ASSERT_EQ(plot.lines[1].points.size(), 2u);
  EXPECT_EQ(plot.lines[1].points[0].x, 100);
  EXPECT_EQ(plot.lines[1].points[1].y, 0.5);
  const Plot per_box = read_plot("plot_rows.json", "scaling", "U", PlotValue::nanoseconds_per_box);
  EXPECT_NEAR(per_box.lines[0].points[1].y, 100, 1e-9);
}

TEST(Plots, NamedPeersAreCalledWhatTheyAreCalled) {
  write_rows("plot_rows.json");
  const Plot plot =
      read_plot("plot_rows.json", "scaling", "U", PlotValue::milliseconds, {{"cgal", "CGAL's boxes"}}, 999);
  ASSERT_EQ(plot.lines.size(), 2u);
  EXPECT_EQ(plot.lines[0].points.size(), 1u);
  EXPECT_EQ(plot.lines[1].name, "CGAL's boxes");
  EXPECT_THROW(read_plot("plot_rows.json", "scaling", "U", PlotValue::milliseconds, {{"cgall", "x"}}),
               std::runtime_error);
}

TEST(Plots, SpeedAgainstThreadsIsMeasuredAndModelled) {
  EXPECT_DOUBLE_EQ(amdahl(0, 64), 64);
  EXPECT_DOUBLE_EQ(amdahl(1, 64), 1);
  EXPECT_DOUBLE_EQ(amdahl(0.5, 2), 4.0 / 3);
  Report report(describe_machine());
  report.add(row(1000, serial_share, 1.0, 0.5));
  Row together = row(1000, "one-thread", 1.0, 1.25);
  together.threads = 2;
  report.add(together);
  report.write_json("speedup_rows.json");
  const Plot plot = read_speedup("speedup_rows.json", "U");
  ASSERT_EQ(plot.lines.size(), 2u);
  EXPECT_NEAR(plot.lines[0].points[1].y, 4.0 / 3, 1e-9);
  EXPECT_EQ(plot.lines[1].points[1].x, 2);
  EXPECT_NEAR(plot.lines[1].points[1].y, 1.25, 1e-9);
  EXPECT_THROW(read_speedup("speedup_rows.json", "S"), std::runtime_error);
}

TEST(Plots, AreWrittenAsSvgAndPng) {
  write_rows("plot_rows.json");
  const Plot plot = read_plot("plot_rows.json", "scaling", "U", PlotValue::milliseconds);
  picture::write_plot(plot, "plot.svg");
  picture::write_plot(plot, "plot.png");
  std::ostringstream text;
  text << std::ifstream("plot.svg").rdbuf();
  EXPECT_NE(text.str().find("<svg"), std::string::npos);
  EXPECT_GT(std::filesystem::file_size("plot.png"), 10000u);
  EXPECT_THROW(picture::write_plot(plot, "plot.jpg"), std::runtime_error);
  EXPECT_THROW(picture::write_plot(plot, "no/such/directory/plot.svg"), std::runtime_error);
}

TEST(Plots, FilesWithoutSuchRowsAreRefused) {
  write_rows("plot_rows.json");
  EXPECT_THROW(read_plot("plot_rows.json", "scaling", "D", PlotValue::milliseconds), std::runtime_error);
  EXPECT_THROW(read_plot("no_such_file.json", "scaling", "U", PlotValue::milliseconds), std::runtime_error);
  std::ofstream("plot_nothing.json") << "{}";
  EXPECT_THROW(read_plot("plot_nothing.json", "scaling", "U", PlotValue::milliseconds), std::runtime_error);
  std::ofstream("plot_nothing.json") << "not JSON";
  EXPECT_THROW(read_plot("plot_nothing.json", "scaling", "U", PlotValue::milliseconds), std::runtime_error);
}

}  // namespace
}  // namespace boxstream::bench
