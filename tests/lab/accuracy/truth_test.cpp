// SPDX-License-Identifier: MIT
#include "accuracy/truth.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "accuracy/knob.hpp"
#include "accuracy/work_precision.hpp"

namespace boxstream::accuracy_test {
namespace {

using namespace accuracy;

std::vector<Truth::Point> read(const std::string& text) {
  std::istringstream file(text);
  return read_truth(file, "t.csv");
}

std::string complaint(const std::string& text) {
  try {
    read(text);
  } catch (const BadKnob& error) {
    return error.what();
  }
  return "";
}

TEST(Truth, ColumnsAreFoundByName) {
  const auto points = read("\xef\xbb\xbfz, x,seconds,note,y\r\n3,1,0.5,a,2\r\n\n6,4,1,b,5\n");
  ASSERT_EQ(points.size(), 2u);
  EXPECT_EQ(points[0].seconds, 0.5);
  EXPECT_EQ(points[1].place, (std::array<double, 3>{4, 5, 6}));
}

TEST(Truth, SaysWhatIsWrongAndWhere) {
  EXPECT_EQ(complaint("t,x,y,z\n0,1,2,3\n"), "t.csv: the first line names no column \"seconds\" (seconds,x,y,z)");
  EXPECT_EQ(complaint("seconds,x,y,z\n0,1,2\n"), "t.csv:2: too few columns");
  EXPECT_EQ(complaint("seconds,x,y,z\n0,1,2,1e\n"), "t.csv:2: not a number: '1e'");
  EXPECT_EQ(complaint("seconds,x,y,z\n0,1,2,nan\n"), "t.csv:2: not a number: 'nan'");
  EXPECT_EQ(complaint("seconds,x,y,z\n1,1,2,3\n1,1,2,3\n"), "t.csv:3: times must be 0 or later, and grow");
  EXPECT_EQ(complaint("seconds,x,y,z\n"), "t.csv: no line of numbers");
}

TEST(Bound, HasUnits) {
  EXPECT_DOUBLE_EQ(parse_bound("5mm"), 0.005);
  EXPECT_DOUBLE_EQ(parse_bound("2.5 cm"), 0.025);
  EXPECT_DOUBLE_EQ(parse_bound("0.1%"), 0.001);
  EXPECT_DOUBLE_EQ(parse_bound("3"), 3);
  for (const char* wrong : {"", "mm", "-1", "0", "5 ft", "nan"}) EXPECT_THROW(parse_bound(wrong), BadKnob) << wrong;
}

}  // namespace
}  // namespace boxstream::accuracy_test
