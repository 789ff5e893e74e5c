// SPDX-License-Identifier: MIT
#include "narrow_phase/in_child.hpp"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <stdexcept>

namespace boxstream::report::narrow {
namespace {

using How = Answer::How;

double misbehave(std::size_t i) {
  switch (i) {
    case 1:
      throw std::runtime_error("no");
    case 2:
      std::abort();
    case 3:
      std::raise(SIGSEGV);
      break;
    case 4:
      for (volatile bool forever = true; forever;) continue;
      break;
    case 6:
      _Exit(3);
    case 7:
      throw Unsure("perhaps");
    default:
      break;
  }
  return 10 + static_cast<double>(i);
}

TEST(InChild, GoesOnBehindWhatDies) {
  const auto answers = ask_in_child(9, 0.02, misbehave);
  std::vector<How> how;
  for (const Answer& answer : answers) how.push_back(answer.how);
  EXPECT_EQ(how, (std::vector{How::answered, How::threw, How::aborted, How::crashed, How::no_end, How::answered,
                              How::crashed, How::unsure, How::answered}));
  EXPECT_EQ(answers[0].value, 10);
  EXPECT_EQ(answers[5].value, 15);
  EXPECT_EQ(answers[8].value, 18);
}

TEST(InChild, MayDieAtTheLast) {
  const auto answers = ask_in_child(3, 0.02, misbehave);
  ASSERT_EQ(answers.size(), 3U);
  EXPECT_EQ(answers[2].how, How::aborted);
}

TEST(InChild, AsksNothingOfNobody) {
  EXPECT_TRUE(ask_in_child(0, 1, [](std::size_t) -> double { throw std::logic_error("asked"); }).empty());
}

}  // namespace
}  // namespace boxstream::report::narrow
