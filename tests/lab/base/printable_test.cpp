// SPDX-License-Identifier: MIT
#include "base/words.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <random>

namespace boxstream::files {
namespace {

TEST(Printable, WhatSteersATerminalIsShownInsteadOfDone) {
  EXPECT_EQ(printable("plain text, 1 < 2"), "plain text, 1 < 2");
  EXPECT_EQ(printable("\x1b[2Jgone\r\a"), "\\x1b[2Jgone\\x0d\\x07");
  EXPECT_EQ(printable("two\nlines\tand\x7f"), "two\\x0alines\\x09and\\x7f");
  EXPECT_EQ(printable_lines("two\nlines\r\n"), "two\nlines\\x0d\n");
  // The one byte and the character that some terminals take for ESC [.
  EXPECT_EQ(printable("\x9b"
                      "2J"),
            "\\x9b2J");
  EXPECT_EQ(printable("\xc2\x9b"
                      "2J"),
            "\\xc2\\x9b2J");
  EXPECT_EQ(printable("abc\xe2\x80\xaegnp.exe"), "abc\\xe2\\x80\\xaegnp.exe");
}

TEST(Printable, OtherScriptsStay) {
  for (const char* const text : {"Würfel", "ящик", "箱", "ˆ", "\xf0\x9f\x93\xa6", "\xf4\x8f\xbf\xbf"})
    EXPECT_EQ(printable(text), text);
}

TEST(Printable, BytesThatAreNoUtf8) {
  EXPECT_EQ(printable("\xff"), "\\xff");
  EXPECT_EQ(printable("\xc3"), "\\xc3");
  EXPECT_EQ(printable("\xe2\x82"), "\\xe2\\x82");
  EXPECT_EQ(printable("\xc0\x9b"), "\\xc0\\x9b");
  EXPECT_EQ(printable("\xe0\x82\x9b"), "\\xe0\\x82\\x9b");
  EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80");
  EXPECT_EQ(printable("\xf5\x80\x80\x80"), "\\xf5\\x80\\x80\\x80");
  EXPECT_EQ(printable("\xc3x"), "\\xc3x");
  EXPECT_EQ(printable(std::string_view("\0a", 2)), "\\x00a");
}

/// Whatever comes, no byte is left that a terminal takes for an order, and nothing is changed twice.
TEST(Printable, AnyBytes) {
  std::mt19937 random(1);
  for (int round = 0; round < 20'000; ++round) {
    std::string text(random() % 12, '\0');
    for (char& c : text) c = static_cast<char>(random() % 3 == 0 ? 0x80 + random() % 128 : random() % 256);
    const std::string shown = printable(text);
    for (std::size_t i = 0; i < shown.size(); ++i) {
      const auto byte = static_cast<unsigned char>(shown[i]);
      ASSERT_TRUE(byte >= 0x20 && byte != 0x7f);
      if (byte == 0xc2) {
        ASSERT_GE(static_cast<unsigned char>(shown.at(i + 1)), 0xa0);
      }
    }
    ASSERT_EQ(printable(shown), shown);
  }
}

}  // namespace
}  // namespace boxstream::files
