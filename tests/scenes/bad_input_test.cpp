// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <ostream>

#include "scene/scene.hpp"
#include "scene/scene_error.hpp"
#include "small_scene.hpp"

namespace boxstream::scenes_test {
namespace {

using scenes::SceneError;

/// What the loader says about a text; empty if it takes it.
std::string complaint(const std::string& text) {
  try {
    scenes::parse_scene(text, "bad.json");
  } catch (const SceneError& error) {
    return error.what();
  }
  return {};
}

struct BadScene {
  const char* name;
  const char* from;
  std::string to;
  const char* message;
};

/// For the listings of ctest.
void PrintTo(const BadScene& bad, std::ostream* out) {
  *out << bad.name;
}

class BadScenes : public testing::TestWithParam<BadScene> {};

TEST(GoodScene, IsTakenAsItStands) {
  EXPECT_EQ(complaint(small_scene), "");
}

TEST_P(BadScenes, AreRefusedWithPlaceAndReason) {
  const BadScene& bad = GetParam();
  const std::string message = complaint(spoilt(bad.from, bad.to));
  EXPECT_EQ(message, std::string("bad.json: ") + bad.message);
  EXPECT_EQ(message.find('\n'), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(
    Table, BadScenes,
    testing::ValuesIn(std::vector<BadScene>{
        {"UnknownKeyAtTheTop", "\"format\": 1", "\"format\": 1, \"gravity\": 3",
         "/gravity: unknown key (known: format, meta, time, world, solver, broadphase, materials, shapes, bodies, "
         "generators, joints, sensors, characters, soft_bodies, fields, rays, expect)"},
        {"UnknownKeyInside", "\"dt\": 0.01", "\"dt\": 0.01, \"substeps\": 4",
         "/time/substeps: unknown key (known: dt, steps)"},
        {"BrickOfAPyramidThatIsNoBox", "\"levels\": 2, \"origin\": [-2, 0, 6], \"brick\": {\"shape\": \"box\"",
         "\"levels\": 2, \"origin\": [-2, 0, 6], \"brick\": {\"shape\": \"ball\"",
         "/generators/5/brick/shape: a brick is a box"},
        {"TowerOfTwo", "\"around\": 6", "\"around\": 2", "/generators/6/around: must be at least 3, got 2"},
        {"ScatterWithoutABox", "\"size\": [3, 3, 3], ", "", "/generators/7: key \"size\" is missing"},
        {"NoRays", "\"rays\": [{\"count\": 8", "\"rays\": [{\"count\": 0", "/rays/0/count: must be at least 1, got 0"},
        {"UnknownKeyInBody", "\"mass\": 1, \"position\": [0, 3, 0]",
         "\"mass\": 1, \"colour\": \"red\", \"position\": [0, 3, 0]",
         "/bodies/1/colour: unknown key (known: name, shape, material, type, mass, density, linear_damping, "
         "angular_damping, group, mask, ccd, sleep, position, rotation, velocity, spin)"},
        {"KeyWithSlash", "\"seed\": 9", "\"seed\": 9, \"a/b~c\": 1",
         "/world/a~1b~0c: unknown key (known: gravity, bounds, seed)"},
        {"KeyWithNewline", "\"seed\": 9", "\"seed\": 9, \"a\\nb\": 1",
         "/world/a\\x0ab: unknown key (known: gravity, bounds, seed)"},
        {"KeyTwice", "\"seed\": 9", "\"seed\": 9, \"seed\": 9", "/world/seed: key given twice"},
        {"MissingBlock", "\"time\": {\"dt\": 0.01, \"steps\": 10},", "", "/: key \"time\" is missing"},
        {"MissingKey", "\"about\": \"A bit of everything.\", ", "", "/meta: key \"about\" is missing"},
        {"OtherFormat", "\"format\": 1", "\"format\": 2", "/format: must be at most 1, got 2"},
        {"NumberAsString", "\"dt\": 0.01", "\"dt\": \"0.01\"",
         "/time/dt: expected a number, got a value of type string"},
        {"NanAsString", "\"mass\": 1, \"position\": [0, 3, 0]", "\"mass\": \"nan\", \"position\": [0, 3, 0]",
         "/bodies/1/mass: expected a number, got a value of type string"},
        {"NanLiteral", "\"position\": [0, 3, 0]", "\"position\": [0, NaN, 0]",
         "/bodies/1/position/1: parse error at line 21, column 64: syntax error while parsing value - invalid literal; "
         "last read: '0, N'"},
        {"Infinite", "\"position\": [0, 3, 0]", "\"position\": [0, 1e999, 0]",
         "/bodies/1/position/1: number out of range: 1e999"},
        {"MinusInfinite", "\"position\": [0, 3, 0]", "\"position\": [-1e999, 3, 0]",
         "/bodies/1/position/0: number out of range: -1e999"},
        {"BeyondFloat", "\"position\": [0, 3, 0]", "\"position\": [0, 1e39, 0]",
         "/bodies/1/position/1: must be at most 100000, got 1e+39"},
        {"NegativeMass", "\"mass\": 1, \"position\": [0, 3, 0]", "\"mass\": -1, \"position\": [0, 3, 0]",
         "/bodies/1/mass: must be greater than 0, got -1"},
        {"ZeroMass", "\"mass\": 1, \"position\": [0, 3, 0]", "\"mass\": 0, \"position\": [0, 3, 0]",
         "/bodies/1/mass: must be greater than 0, got 0"},
        {"NoMass", "\"shape\": \"box\", \"mass\": 1, \"position\": [0, 3, 0]",
         "\"shape\": \"box\", \"position\": [0, 3, 0]", "/bodies/1: a dynamic body needs \"mass\" or \"density\""},
        {"MassAndDensity", "\"mass\": 1, \"position\": [0, 3, 0]",
         "\"mass\": 1, \"density\": 5, \"position\": [0, 3, 0]",
         "/bodies/1/density: give \"mass\" or \"density\", not both"},
        {"StaticWithMass", "\"type\": \"static\", \"material\"", "\"type\": \"static\", \"mass\": 3, \"material\"",
         "/bodies/0/mass: only dynamic bodies have mass"},
        {"Null", "\"seed\": 9", "\"seed\": null", "/world/seed: expected a whole number, got null"},
        {"ListForObject", "\"time\": {\"dt\": 0.01, \"steps\": 10}", "\"time\": [0.01, 10]",
         "/time: expected an object, got a value of type array"},
        {"ObjectForList", "\"sensors\": [{\"name\": \"gate\", \"half_extents\": [1, 1, 1], \"position\": [0, 1, 0]}]",
         "\"sensors\": {}", "/sensors: expected a list, got a value of type object"},
        {"TwoCoordinates", "\"position\": [0, 3, 0]", "\"position\": [0, 3]",
         "/bodies/1/position: must have 3 elements, got 2"},
        {"StringForBool", "\"split_impulse\": true", "\"split_impulse\": \"yes\"",
         "/solver/split_impulse: expected true or false, got a value of type string"},
        {"FractionForCount", "\"steps\": 10", "\"steps\": 10.5",
         "/time/steps: expected a whole number, got a value of type number"},
        {"NegativeCount", "\"seed\": 9", "\"seed\": -9", "/world/seed: must be at least 0, got -9"},
        {"HugeCount", "\"count\": 4", "\"count\": 18446744073709551615",
         "/generators/1/count: must be at most 1000000, got 18446744073709551615"},
        {"EmptyName", "\"name\": \"gate\"", "\"name\": \"\"", "/sensors/0/name: must not be empty"},
        {"DanglingShape", "\"name\": \"one\", \"shape\": \"box\"", "\"name\": \"one\", \"shape\": \"bo\"",
         "/bodies/1/shape: no shape called \"bo\""},
        {"DanglingMaterial", "\"type\": \"static\", \"material\": \"wood\"",
         "\"type\": \"static\", \"material\": \"steel\"", "/bodies/0/material: no material called \"steel\""},
        {"DanglingBody", "\"a\": \"one\", \"b\": \"two\"", "\"a\": \"one\", \"b\": \"three\"",
         "/joints/0/b: no body called \"three\""},
        {"DanglingChild", "{\"shape\": \"ball\", \"position\": [0, 1, 0]}",
         "{\"shape\": \"cube\", \"position\": [0, 1, 0]}",
         "/shapes/7/children/1/shape: no shape before this one called \"cube\""},
        {"ChildNotConvex", "{\"shape\": \"ball\", \"position\": [0, 1, 0]}",
         "{\"shape\": \"floor\", \"position\": [0, 1, 0]}",
         "/shapes/7/children/1/shape: parts of a compound are convex"},
        {"SecondShapeOfAName", "\"name\": \"pill\"", "\"name\": \"ball\"",
         "/shapes/3/name: a second shape called \"ball\""},
        {"SecondBodyOfAName", "\"name\": \"two\"", "\"name\": \"one\"", "/bodies/2/name: a second body called \"one\""},
        {"JoinedToItself", "\"a\": \"one\", \"b\": \"two\"", "\"a\": \"one\", \"b\": \"one\"",
         "/joints/0/b: a body joined to itself"},
        {"JoinedToStatic", "\"a\": \"one\", \"b\": \"two\"", "\"a\": \"one\", \"b\": \"ground\"",
         "/joints/0/b: a joint to a static body: leave it out instead"},
        {"UnknownShapeType", "\"type\": \"capsule\"", "\"type\": \"torus\"",
         "/shapes/3/type: unknown value \"torus\" (known: box, sphere, capsule, cylinder, cone, hull, plane, "
         "heightfield, mesh, compound)"},
        {"UnknownBroadphase", "\"kind\": \"dbvt\"", "\"kind\": \"octree\"",
         "/broadphase/kind: unknown value \"octree\" (known: boxstream, dbvt, dbvt-deferred, sap, simple)"},
        {"DynamicPlane", "\"name\": \"one\", \"shape\": \"box\"", "\"name\": \"one\", \"shape\": \"floor\"",
         "/bodies/1/shape: this kind of shape is for static bodies only"},
        {"ZeroSize", "\"half_extents\": [0.5, 0.5, 0.5]", "\"half_extents\": [0.5, 0, 0.5]",
         "/shapes/1/half_extents/1: must be greater than 0, got 0"},
        {"ZeroDirection", "\"normal\": [0, 1, 0]", "\"normal\": [0, 0, 0]",
         "/shapes/0/normal: a direction must not be zero"},
        {"FlatHull", "[0, 0, 1]]}", "[1, 1, 0]]}", "/shapes/4/points: all points lie in one plane"},
        {"FewHeights", "\"heights\": [0, 0, 0, 1]", "\"heights\": [0, 0, 1]",
         "/shapes/5/heights: must have 4 elements, got 3"},
        {"NoHeights", ", \"heights\": [0, 0, 0, 1]", "", "/shapes/5: a height field needs \"heights\" or \"hills\""},
        {"CornerOutOfRange", "\"triangles\": [[0, 1, 2]]", "\"triangles\": [[0, 1, 3]]",
         "/shapes/6/triangles/0/2: must be at most 2, got 3"},
        {"TriangleWithoutArea", "\"triangles\": [[0, 1, 2]]", "\"triangles\": [[0, 1, 1]]",
         "/shapes/6/triangles/0: a triangle without area"},
        {"MissingMeshFile", "\"vertices\": [[0, 0, 0], [0, 0, 1], [1, 0, 0]], \"triangles\": [[0, 1, 2]]",
         "\"file\": \"no/such.json\"", "/shapes/6/file: no such file: no/such.json"},
        {"InvertedBounds", "\"max\": [20, 20, 20]", "\"max\": [20, -20, 20]",
         "/world/bounds/max: must be greater than \"min\" on every axis"},
        {"InvertedLimits", "\"limits\": [-90, 90]", "\"limits\": [90, -90]",
         "/joints/0/limits: must be in ascending order, got 90 and -90"},
        {"InvertedScale", "\"scale\": [0.5, 1]", "\"scale\": [1, 0.5]",
         "/generators/1/mix/0/scale: must be in ascending order, got 1 and 0.5"},
        {"BrickNotABox", "\"brick\": {\"shape\": \"box\", \"mass\": 1}",
         "\"brick\": {\"shape\": \"ball\", \"mass\": 1}", "/generators/2/brick/shape: a brick is a box"},
        {"BadPart", "\"link\": {\"shape\": \"pill\", \"mass\": 1}", "\"link\": {\"shape\": \"pill\", \"mass\": -1}",
         "/generators/3/link/mass: must be greater than 0, got -1"},
        {"EmptyMix", "\"mix\": [{\"shape\": \"ball\", \"mass\": 2, \"scale\": [0.5, 1]}]", "\"mix\": []",
         "/generators/1/mix: must have at least 1 elements, got 0"},
        {"NoPath", "\"path\": [[0, 2, -5], [4, 2, -5]]", "\"path\": []",
         "/characters/0/path: must have at least 1 elements, got 0"},
        {"BadPin", "\"pinned\": [0, 3]", "\"pinned\": [4]", "/soft_bodies/0/pinned/0: must be at most 3, got 4"},
        {"GroupTooLarge", "\"group\": 1", "\"group\": 4294967296",
         "/bodies/1/group: must be at most 2147483647, got 4294967296"},
        {"RestitutionAboveOne", "\"restitution\": 0.1", "\"restitution\": 1.1",
         "/materials/wood/restitution: must be at most 1, got 1.1"},
        {"TimeStepTooLarge", "\"dt\": 0.01", "\"dt\": 1", "/time/dt: must be at most 0.1, got 1"},
        {"NegativeExpectation", "\"expect\": {\"sensors\": 1}", "\"expect\": {\"sensors\": -1}",
         "/expect/sensors: must be at least 0, got -1"},
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
        {"TooManyBodies", "\"count\": 1, \"columns\": [1, 1]", "\"count\": 90909, \"columns\": [1, 1]",
         "/generators/4: more than 1000000 bodies in all"},
        {"TooLongAWall", "\"columns\": 2, \"rows\": 2, \"origin\"", "\"columns\": 1000000, \"rows\": 2, \"origin\"",
         "/generators/2/rows: must be at most 1, got 2"},
        {"NestedTooDeeply", "\"seed\": 9", "\"seed\": " + std::string(40, '[') + std::string(40, ']'),
         "/world/seed/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0: nested too deeply"},
    }),
    [](const auto& test) { return test.param.name; });

TEST(BadFile, MissingFileIsNamed) {
  try {
    scenes::load_scene("no/such/scene.json");
    FAIL() << "loaded";
  } catch (const SceneError& error) {
    EXPECT_STREQ(error.what(), "no/such/scene.json: cannot be read: No such file or directory");
  }
}

TEST(BadFile, DirectoryIsNoScene) {
  const std::string path = std::filesystem::temp_directory_path().string();
  try {
    scenes::load_scene(path);
    FAIL() << "loaded";
  } catch (const SceneError& error) {
    EXPECT_EQ(error.what(), path + ": cannot be read: Is a directory");
  }
}

TEST(BadFile, EmptyTextIsNoScene) {
  EXPECT_EQ(complaint("").rfind("bad.json: /: parse error at line 1, column 1", 0), 0u) << complaint("");
}

TEST(BadFile, AnyPrefixOfASceneIsRefused) {
  for (std::size_t length = 0; length < small_scene.size() - 1; length += 7)
    EXPECT_NE(complaint(small_scene.substr(0, length)), "") << length;
}

}  // namespace
}  // namespace boxstream::scenes_test
