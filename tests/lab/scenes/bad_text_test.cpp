// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <filesystem>
#include <ostream>

#include "complaint.hpp"
#include "formats/scene_json/load_scene.hpp"
#include "small_scene.hpp"

namespace boxstream::scenes_test {
namespace {

/// Faults that no parsed document can have; bad_scenes.json has all others.
struct BadText {
  const char* name;
  const char* from;
  std::string to;
  const char* message;
};

/// For the listings of ctest.
void PrintTo(const BadText& bad, std::ostream* out) {
  *out << bad.name;
}

class BadTexts : public testing::TestWithParam<BadText> {};

TEST_P(BadTexts, AreRefusedWithPlaceAndReason) {
  const BadText& bad = GetParam();
  const std::string message = complaint(spoilt(bad.from, bad.to), "bad.json");
  EXPECT_EQ(message, std::string("bad.json: ") + bad.message);
  EXPECT_EQ(message.find('\n'), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(
    Table, BadTexts,
    testing::ValuesIn(std::vector<BadText>{
        {"KeyWithNewline", "\"seed\": 9", "\"seed\": 9, \"a\\nb\": 1",
         "/world/a\\x0ab: unknown key (known: gravity, bounds, on_leave, self_similar, ccd, seed)"},
        {"KeyTwice", "\"seed\": 9", "\"seed\": 9, \"seed\": 9", "/world/seed: key given twice"},
        {"NanLiteral", "\"position\": [0, 3, 0]", "\"position\": [0, NaN, 0]",
         "/bodies/1/position/1: parse error at line 21, column 64: syntax error while parsing value - invalid literal; "
         "last read: '0, N'"},
        {"Infinite", "\"position\": [0, 3, 0]", "\"position\": [0, 1e999, 0]",
         "/bodies/1/position/1: number out of range: 1e999"},
        {"MinusInfinite", "\"position\": [0, 3, 0]", "\"position\": [-1e999, 3, 0]",
         "/bodies/1/position/0: number out of range: -1e999"},
        {"CutOff", "\"expect\": {\"sensors\": 1}\n}", "\"expect\": {\"sensors\": 1",
         "/expect: parse error at line 53, column 26: syntax error while parsing object - unexpected end of input; "
         "expected '}'"},
        {"TrailingText", "\"expect\": {\"sensors\": 1}\n}", "\"expect\": {\"sensors\": 1}\n} x",
         "/: parse error at line 54, column 3: syntax error while parsing value - invalid literal; last read: "
         "'1}<U+000A>} x'; expected end of input"},
        {"Comment", "\"format\": 1", "/* one */ \"format\": 1",
         "/: parse error at line 2, column 3: syntax error while parsing object key - invalid literal; last read: "
         "'{<U+000A>  /'; expected string literal"},
        {"BadUtf8", "\"name\": \"gate\"",
         "\"name\": \"g\xff"
         "te\"",
         "/sensors/0/name: parse error at line 44, column 26: syntax error while parsing value - invalid string: "
         "ill-formed UTF-8 byte; last read: '\"g\\xff'"},
        {"NestedTooDeeply", "\"seed\": 9", "\"seed\": " + std::string(40, '[') + std::string(40, ']'),
         "/world/seed/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0: nested too deeply"},
    }),
    [](const auto& test) { return test.param.name; });

TEST(BadFile, MissingFileIsNamed) {
  try {
    scenes::load_scene("no/such/scene.json");
    FAIL() << "loaded";
  } catch (const scenes::SceneError& error) {
    EXPECT_STREQ(error.what(), "no/such/scene.json: cannot be read: No such file or directory");
  }
}

TEST(BadFile, DirectoryIsNoScene) {
  const std::string path = std::filesystem::temp_directory_path().string();
  try {
    scenes::load_scene(path);
    FAIL() << "loaded";
  } catch (const scenes::SceneError& error) {
    EXPECT_EQ(error.what(), path + ": cannot be read: Is a directory");
  }
}

TEST(BadFile, EmptyTextIsNoScene) {
  EXPECT_EQ(complaint("", "bad.json").rfind("bad.json: /: parse error at line 1, column 1", 0), 0u)
      << complaint("", "bad.json");
}

TEST(BadFile, AnyPrefixOfASceneIsRefused) {
  for (std::size_t length = 0; length < small_scene.size() - 1; length += 7)
    EXPECT_NE(complaint(small_scene.substr(0, length), "bad.json"), "") << length;
}

}  // namespace
}  // namespace boxstream::scenes_test
