// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "formats/import/mesh.hpp"
#include "formats/scene_json/load_scene.hpp"
#include "mesh/generators.hpp"
#include "mesh/point_triangle.hpp"
#include "mesh/self_intersection.hpp"
#include "mesh/three_phases.hpp"
#include "pictures/drawing/png_file.hpp"
#include "process.hpp"
#include "refusal.hpp"
#include "sanitized.hpp"
#include "scratch_directory.hpp"

namespace boxstream::tool_test {
namespace {

/// The number in the line that begins with `what`.
std::uint64_t count_of(const std::string& text, const std::string& what) {
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    if (line.rfind(what, 0) != 0) continue;
    std::string digits;
    for (const char c : line.substr(what.size()))
      if (c != ' ') digits += c;
    return std::stoull(digits);
  }
  ADD_FAILURE() << "no '" << what << "' in " << text;
  return 0;
}

bool is_red(const std::uint8_t* pixel) {
  return pixel[0] > 90 && pixel[0] > 2 * pixel[1] && pixel[0] > 2 * pixel[2];
}

TEST(Mesh, CheckFindsWhereTheKleinBottleMeetsItself) {
  if (tests::sanitized) GTEST_SKIP() << "takes long under a sanitizer";
  const ScratchDirectory directory;
  for (const char* const kind : {"ply", "glb"}) {
    SCOPED_TRACE(kind);
    const std::string file = directory.file(std::string("klein.") + kind);
    ASSERT_EQ(run_tool({"mesh", "make", "klein", "40", "--out", file}).exit_code, 0);
    const std::string red = directory.file(std::string("red.") + kind), png = directory.file("red.png");
    const Outcome run = run_tool({"mesh", "check", file, "--picture", red});
    EXPECT_EQ(run.exit_code, 1);
    EXPECT_EQ(lasting_words(run), "");
    const auto expected = mesh::self_intersections(mesh::klein_bottle(40, 20));
    EXPECT_EQ(count_of(run.out, "vertices"), 800u);
    EXPECT_EQ(count_of(run.out, "triangles  "), 1600u);
    EXPECT_EQ(count_of(run.out, "candidate pairs"), expected.candidates);
    EXPECT_EQ(count_of(run.out, "intersecting pairs"), expected.pairs.size());
    EXPECT_NE(run.out.find("\nand "), std::string::npos);
    // What was painted is the same surface, though its red triangles have vertices of their own.
    const Outcome again = run_tool({"mesh", "check", red, "--list", "--picture", png});
    EXPECT_EQ(count_of(again.out, "intersecting pairs"), expected.pairs.size());
    EXPECT_EQ(static_cast<std::size_t>(std::count(again.out.begin(), again.out.end(), '\n')),
              7 + expected.pairs.size());
    const picture::Image image = picture::read_png(png);
    std::size_t reds = 0;
    for (std::size_t i = 0; i < image.rgb.size(); i += 3) reds += is_red(&image.rgb[i]);
    EXPECT_GT(reds, 500u);
    EXPECT_LT(reds, image.rgb.size() / 3 / 4);
  }
}

TEST(Mesh, CheckIsContentWithASphere) {
  const ScratchDirectory directory;
  ASSERT_EQ(run_tool({"mesh", "make", "sphere", "30", "--out", directory.file("s.ply")}).exit_code, 0);
  const Outcome run = run_tool({"mesh", "check", directory.file("s.ply")});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(count_of(run.out, "intersecting pairs"), 0u);
  EXPECT_EQ(count_of(run.out, "without area"), 0u);
}

TEST(Mesh, CheckCountsTrianglesWithoutArea) {
  const ScratchDirectory directory;
  const std::string file = directory.write("flat.obj",
                                           "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\nv 0 0 1\nv 1 0 1\nv 0 1 1\n"
                                           "f 1 2 3\nf 1 2 4\nf 5 6 7\n");
  const Outcome run = run_tool({"mesh", "check", file});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(count_of(run.out, "triangles  "), 3u);
  EXPECT_EQ(count_of(run.out, "without area"), 1u);
}

/// Metres of UTM are no floats, halves are.
TEST(Mesh, PaintedFilesHaveTheCoordinatesThatWereRead) {
  const ScratchDirectory directory;
  const std::string painted = directory.file("painted.ply");
  const auto painted_as = [&](const std::string& corners, const std::string& property) {
    const std::string file = directory.write("a.obj", corners + "f 1 2 3\n");
    EXPECT_EQ(run_tool({"mesh", "check", file, "--picture", painted}).exit_code, 0);
    EXPECT_EQ(imports::read_surface(painted).vertices, imports::read_surface(file).vertices);
    EXPECT_NE(directory.read("painted.ply").find("property " + property + " x\n"), std::string::npos);
  };
  painted_as("v 331045.127 4687210.933 12.25\nv 331046.127 4687210.933 12.25\nv 331045.127 4687211.9 12.5\n", "double");
  painted_as("v 331045.5 0.25 1\nv 7 8 9\nv -0.5 1.5 2\n", "float");
}

/// Numbers of the line that begins with `what`: vertices, largest, mean, rms.
std::vector<double> numbers_of(const std::string& text, const std::string& what) {
  const std::size_t at = text.find("\n" + what);
  if (at == std::string::npos) return {};
  std::istringstream in(text.substr(at + 1 + what.size()));
  std::vector<double> numbers(4);
  for (double& x : numbers) in >> x;
  return numbers;
}

TEST(Mesh, DistanceOfTwoSurfaces) {
  const ScratchDirectory directory;
  const std::string fine = directory.file("fine.ply"), coarse = directory.file("coarse.glb");
  ASSERT_EQ(run_tool({"mesh", "make", "sphere", "64", "--out", fine}).exit_code, 0);
  ASSERT_EQ(run_tool({"mesh", "make", "sphere", "16", "--out", coarse}).exit_code, 0);
  const Outcome run = run_tool({"mesh", "distance", fine, coarse, "--picture", directory.file("a.ply"),
                                "--picture-back", directory.file("b.glb")});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto a = mesh::sphere(32, 64), b = mesh::sphere(8, 16);
  const auto expect = [&](const char* what, const mesh::TriangleMesh& from, const mesh::TriangleMesh& to) {
    double largest = 0, sum = 0;
    for (const auto& nearest : mesh::three_phase_distances(from.vertices, to)) {
      largest = std::max(largest, std::sqrt(nearest.squared));
      sum += std::sqrt(nearest.squared);
    }
    const auto numbers = numbers_of(run.out, what);
    ASSERT_EQ(numbers.size(), 4u) << run.out;
    EXPECT_EQ(numbers[0], static_cast<double>(from.vertices.size()));
    EXPECT_NEAR(numbers[1], largest, 1e-5 * largest);
    EXPECT_NEAR(numbers[2], sum / numbers[0], 1e-5 * largest);
  };
  expect("A", a, b);
  expect("B", b, a);
  EXPECT_EQ(numbers_of(run.out, "both")[1], std::max(numbers_of(run.out, "A")[1], numbers_of(run.out, "B")[1]));
  // The surfaces are as they were, with colours: three bytes a vertex.
  EXPECT_EQ(imports::read_surface(directory.file("a.ply")).triangles, imports::read_surface(fine).triangles);
  EXPECT_EQ(imports::read_surface(directory.file("b.glb")).vertices, imports::read_surface(coarse).vertices);
  const std::string ply = directory.read("a.ply");
  EXPECT_NE(ply.find("property uchar red"), std::string::npos);
  EXPECT_EQ(ply.size(), ply.find("end_header\n") + 11 + a.vertices.size() * 15 + a.triangles.size() * 13);
  // A vertex of the coarse sphere is a vertex of the fine one, so black; the farthest of the fine one is white.
  const std::string bytes = ply.substr(ply.find("end_header\n") + 11);
  std::size_t black = 0, white = 0;
  for (std::size_t i = 0; i < a.vertices.size(); ++i) {
    black += bytes.substr(15 * i + 12, 3) == std::string(3, '\0');
    white += bytes.substr(15 * i + 12, 3) == std::string(3, '\xff');
  }
  EXPECT_GE(black, 2u);
  EXPECT_GE(white, 1u);
}

TEST(Mesh, DistanceOfFilesOfScenes) {
  const std::string ring = scenes::shipped("meshes/ring.obj"), dish = scenes::shipped("meshes/dish.stl");
  const Outcome run = run_tool({"mesh", "distance", ring, dish});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto a = imports::read_surface(ring), b = imports::read_surface(dish);
  double largest = 0;
  for (const auto& v : a.vertices) {
    double least = 1e300;
    for (std::size_t t = 0; t < b.triangles.size(); ++t)
      least = std::min(least, mesh::TriangleDistance(mesh::triangle_of(b, t)).squared(v, least));
    largest = std::max(largest, std::sqrt(least));
  }
  EXPECT_GT(largest, 0);
  EXPECT_NEAR(numbers_of(run.out, "A")[1], largest, 1e-5 * largest);
  EXPECT_EQ(numbers_of(run_tool({"mesh", "distance", ring, ring}).out, "both")[1], 0);
  EXPECT_EQ(run_tool({"mesh", "check", ring}).exit_code, 0);
  EXPECT_EQ(run_tool({"mesh", "check", dish}).exit_code, 0);
}

TEST(Mesh, BadInputIsOneLineAndNothingIsWritten) {
  const ScratchDirectory directory;
  const std::string good = directory.write("good.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
                    empty = directory.write("empty.obj", "v 0 0 0\n"), text = directory.write("a.txt", "no mesh"),
                    out = directory.file("out.ply");
  const std::size_t before = directory.count();
  struct Case {
    std::vector<std::string> arguments;
    std::string reason;
  };
  const Case cases[] = {
      {{"mesh"}, "subcommand"},
      {{"mesh", "check", directory.file("none.ply"), "--picture", out}, "none.ply"},
      {{"mesh", "check", empty, "--picture", out}, "empty.obj"},
      {{"mesh", "check", text, "--picture", out}, "not a kind of mesh"},
      {{"mesh", "check", good, "--picture", directory.file("out.obj")}, "written as .ply, .glb or .png"},
      {{"mesh", "distance", good, "--picture", out}, "B"},
      {{"mesh", "distance", good, empty, "--picture", out}, "empty.obj"},
      {{"mesh", "make", "cube", "--out", out}, "cube"},
      {{"mesh", "make", "klein", "7", "--out", out}, "7"},
      {{"mesh", "make", "klein", "20"}, "--out"},
      {{"mesh", "make", "klein", "20", "--out", directory.file("none/out.ply")}, "cannot be written"},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.reason);
    expect_refusal(run_tool(c.arguments), {c.reason});
    EXPECT_EQ(directory.count(), before);
  }
}

}  // namespace
}  // namespace boxstream::tool_test
