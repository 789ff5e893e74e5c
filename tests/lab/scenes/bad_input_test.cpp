// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <ostream>

#include "complaint.hpp"
#include "every_kind.hpp"
#include "source_path.hpp"

namespace boxstream::scenes_test {
namespace {

using Json = nlohmann::json;
using Pointer = Json::json_pointer;

/// One entry of bad_scenes.json, which schema_test.py reads as well: "put" a "value" somewhere or "drop" one from
/// every_kind.json, and the loader names the place "at" (that of "put" if absent) and begins its reason with "reason".
/// "semantic": the schema cannot see it.
struct BadScene {
  std::string name;
  Json entry;
};

/// For the listings of ctest.
void PrintTo(const BadScene& bad, std::ostream* out) {
  *out << bad.name;
}

std::vector<BadScene> bad_scenes() {
  const std::string file = tests::source_path("tests/lab/scenes/bad_scenes.json");
  std::vector<BadScene> bad;
  for (const Json& entry : scenes::parse_json(scenes::read_text_file(file), file))
    bad.push_back({entry.at("name").get<std::string>(), entry});
  return bad;
}

void drop(Json& document, const Pointer& place) {
  Json& parent = document.at(place.parent_pointer());
  if (parent.is_array()) {
    parent.erase(std::stoul(place.back()));
  } else {
    ASSERT_EQ(parent.erase(place.back()), 1u) << place.to_string();
  }
}

class BadScenes : public testing::TestWithParam<BadScene> {};

TEST_P(BadScenes, AreRefusedWithPlaceAndReason) {
  const Json& entry = GetParam().entry;
  Json document = every_kind();
  if (entry.contains("put")) {
    document[Pointer(entry.at("put").get<std::string>())] = entry.at("value");
  } else {
    drop(document, Pointer(entry.at("drop").get<std::string>()));
  }
  const std::string message = complaint(document.dump(), every_kind_file);
  const std::string place = entry.at(entry.contains("at") ? "at" : "put").get<std::string>();
  const std::string expected = every_kind_file + ": " + place + ": " + entry.at("reason").get<std::string>();
  EXPECT_EQ(message.substr(0, expected.size()), expected) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(Table, BadScenes, testing::ValuesIn(bad_scenes()),
                         [](const auto& test) { return test.param.name; });

TEST(GoodScene, OfEveryKindIsTakenAsItStands) {
  EXPECT_EQ(complaint(every_kind().dump(), every_kind_file), "");
}

}  // namespace
}  // namespace boxstream::scenes_test
