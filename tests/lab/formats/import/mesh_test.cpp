// SPDX-License-Identifier: MIT
#include "formats/import/mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>

#include "formats/import/geometry.hpp"
#include "formats/scene_model/scene_error.hpp"
#include "mesh_files.hpp"
#include "scratch_directory.hpp"

namespace boxstream::import_test {
namespace {

using imports::measure;
using imports::read_mesh;
using tool_test::ScratchDirectory;

std::string complaint(const std::string& path) {
  try {
    read_mesh(path);
  } catch (const scenes::SceneError& error) {
    return error.what();
  }
  return {};
}

#ifdef BOXSTREAM_HAS_ASSIMP

void expect_tetrahedron(const TriangleMesh& mesh, const Vec3& shift) {
  ASSERT_EQ(mesh.vertices.size(), 4u);
  ASSERT_EQ(mesh.triangles.size(), 4u);
  for (const Vec3& corner : tetrahedron().vertices) {
    const Vec3 there{corner[0] + shift[0], corner[1] + shift[1], corner[2] + shift[2]};
    EXPECT_EQ(std::count(mesh.vertices.begin(), mesh.vertices.end(), there), 1) << testing::PrintToString(there);
  }
  EXPECT_TRUE(imports::is_closed(mesh.triangles));
  EXPECT_NEAR(measure(mesh.vertices, mesh.triangles).volume, 1, 1e-12);  // positive: outside is outside
}

TEST(Mesh, IsTheSameFromEveryFormat) {
  const ScratchDirectory scratch;
  const TriangleMesh solid = tetrahedron();
  expect_tetrahedron(read_mesh(scratch.write("t.obj", as_obj(solid))), {});
  expect_tetrahedron(read_mesh(scratch.write("a.stl", as_ascii_stl(solid))), {});
  expect_tetrahedron(read_mesh(scratch.write("b.STL", as_binary_stl(solid))), {});
  expect_tetrahedron(read_mesh(scratch.write("t.ply", as_ply(solid))), {});
}

TEST(Mesh, OfAGltfSceneIsWhereItsNodesPutIt) {
  const ScratchDirectory scratch;
  const TriangleMesh solid = tetrahedron();
  expect_tetrahedron(read_mesh(scratch.write("t.glb", as_glb(solid))), {10, 0, 0});
  scratch.write("t.bin", gltf_buffer(solid));
  expect_tetrahedron(read_mesh(scratch.write("t.gltf", gltf_json(solid, "t.bin"))), {10, 0, 0});
}

/// A box as two strips, ended by -1 as scanners do, of vertices that have something beside their place.
std::string strips_header(const std::string& format) {
  return "ply\nformat " + format +
         " 1.0\ncomment of no use\nelement vertex 8\nproperty float confidence\nproperty float x\nproperty float y\n"
         "property double z\nelement tristrips 1\nproperty list int int vertex_indices\nend_header\n";
}
constexpr int strips[] = {0, 2, 1, 3, 5, 7, 4, 6, -1, 1, 5, 0, 4, 2, 6, 3, 7, -1};

/// Bit d of a corner's number is its coordinate d.
template <class Write>
void for_each_number(Write write) {
  for (int i = 0; i < 8; ++i) {
    write(0.5f);
    write(static_cast<float>(i & 1));
    write(static_cast<float>(2 * (i >> 1 & 1)));
    write(static_cast<double>(3 * (i >> 2)));
  }
  write(static_cast<int>(std::size(strips)));
  for (const int number : strips) write(number);
}

void expect_box(const TriangleMesh& mesh) {
  EXPECT_EQ(mesh.vertices.size(), 8u);
  EXPECT_EQ(mesh.triangles.size(), 12u);
  EXPECT_TRUE(imports::is_closed(mesh.triangles));
  EXPECT_NEAR(measure(mesh.vertices, mesh.triangles).volume, 6, 1e-12);
}

TEST(Mesh, OfTriangleStripsHasThemAll) {
  const ScratchDirectory scratch;
  std::string text = strips_header("ascii"), little = strips_header("binary_little_endian"),
              big = strips_header("binary_big_endian");
  for_each_number([&](auto number) {
    text += std::to_string(number) + ' ';
    put(little, number);
    std::string bytes;
    put(bytes, number);
    big.append(bytes.rbegin(), bytes.rend());
  });
  expect_box(read_mesh(scratch.write("text.ply", text)));
  expect_box(read_mesh(scratch.write("little.ply", little)));
  expect_box(read_mesh(scratch.write("big.ply", big)));
  const std::string cut = scratch.write("cut.ply", little.substr(0, little.size() - 5));
  EXPECT_EQ(complaint(cut), cut + ": 'tristrips' 0 of 1: cut off");
  text.replace(text.find("-1 1 5"), 2, "99");
  const std::string wrong = scratch.write("wrong.ply", text);
  EXPECT_EQ(complaint(wrong), wrong + ": face 6 has vertex 99, both from 0 on: there are 8");
}

TEST(Mesh, WithVerticesLeftOverIsRefusedOrSaysSo) {
  const ScratchDirectory scratch;
  const auto with_more = [&](int more) {
    TriangleMesh mesh = tetrahedron();
    for (int i = 0; i < more; ++i) mesh.vertices.push_back({5.0 + i, 5, 5});
    return scratch.write("t.ply", as_ply(mesh));
  };
  const TriangleMesh some = read_mesh(with_more(3));
  EXPECT_EQ(imports::left_over_vertices(some), 3u);
  const std::string most = with_more(5);
  EXPECT_EQ(complaint(most), most +
                                 ": 5 of 9 vertices belong to no triangle: its triangles are not all there, or in a "
                                 "form that is not known");
}

TEST(Mesh, ScaledAndMirroredStaysInsideOut) {
  const ScratchDirectory scratch;
  const std::string path = scratch.write("t.obj", as_obj(tetrahedron()));
  const TriangleMesh twice = read_mesh(path, {2, 2, 2});
  EXPECT_NEAR(measure(twice.vertices, twice.triangles).volume, 8, 1e-12);
  const TriangleMesh mirrored = read_mesh(path, {1, 1, -1});
  EXPECT_NEAR(measure(mirrored.vertices, mirrored.triangles).volume, 1, 1e-12);
  EXPECT_NEAR(measure(mirrored.vertices, mirrored.triangles).centroid[2], -0.75, 1e-12);
}

/// Facets of STL have their corners to themselves.
TEST(Mesh, HasAMillionTrianglesWhateverTheirFileRepeats) {
  const ScratchDirectory scratch;
  const TriangleMesh once = tetrahedron();
  TriangleMesh solid = once;
  while (solid.triangles.size() < 350'000)
    solid.triangles.insert(solid.triangles.end(), once.triangles.begin(), once.triangles.end());
  const TriangleMesh mesh = read_mesh(scratch.write("t.stl", as_binary_stl(solid)));
  EXPECT_EQ(mesh.triangles.size(), 350'000u);
  EXPECT_EQ(mesh.vertices.size(), 4u);
  std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  for (int i = 0; i < 1'000'001; ++i) text += "f 1 2 3\n";
  const std::string many = scratch.write("many.obj", text);
  EXPECT_EQ(complaint(many), many + ": more than a million vertices or triangles");
}

TEST(Mesh, HasNoTrianglesWithoutArea) {
  const ScratchDirectory scratch;
  const TriangleMesh mesh = read_mesh(scratch.write("t.obj", as_obj(tetrahedron()) + "f 1 2 2\nv 2 0 0\nf 1 2 5\n"));
  EXPECT_EQ(mesh.triangles.size(), 4u);
}

TEST(BrokenMesh, IsRefusedWithOneLine) {
  const ScratchDirectory scratch;
  const auto refuse = [&](const std::string& name, const std::string& text, const std::string& reason) {
    const std::string path = scratch.write(name, text), line = complaint(path);
    EXPECT_EQ(line.substr(0, path.size() + 2), path + ": ");
    EXPECT_NE(line.find(reason), std::string::npos) << line;
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
  };
  EXPECT_EQ(complaint(scratch.file("none.obj")), scratch.file("none.obj") + ": no such file");
  refuse("mesh.txt", "v 0 0 0\n", "not a kind of mesh");
  refuse("empty.obj", "", "");
  refuse("points.obj", "v 0 0 0\nv 1 0 0\n", "");
  refuse("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", "no triangles in it");
  refuse("nan.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n",
         "vertex 1, from 0 on: a coordinate that is not a finite number");
  refuse("far.obj", "v 0 0 0\nv 1e9 0 0\nv 0 1 0\nf 1 2 3\n", "vertex 1, from 0 on: a coordinate beyond 100 km");
  refuse("missing.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n", "");
  refuse("text.gltf", "hello", "");
  refuse("text.stl", "hello", "");
  refuse("nobuffer.gltf", gltf_json(tetrahedron(), "none.bin"), "");
  refuse("short.glb", as_glb(tetrahedron()).substr(0, 300), "");
  std::string many = as_binary_stl(tetrahedron());
  many[83] = '\x7f';  // says that there are two thousand million triangles
  refuse("many.stl", many, "");
}

/// Files that are right but for a few bytes: all of them are read, or refused with a line, and none takes long.
TEST(BrokenMesh, NeverBringsTheProgramDown) {
  const ScratchDirectory scratch;
  const TriangleMesh solid = torus(1, 0.3, 8, 6);
  std::uint64_t state = 1;
  const auto random = [&](std::size_t below) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return static_cast<std::size_t>((state >> 33) % below);
  };
  const std::pair<const char*, std::string> files[] = {
      {"m.obj", as_obj(solid)}, {"m.stl", as_binary_stl(solid)}, {"m.ply", as_ply(solid)}, {"m.glb", as_glb(solid)}};
  for (const auto& [name, good] : files) {
    for (int round = 0; round < 12; ++round) {
      std::string bad = good;
      for (int i = 0; i < 4; ++i) bad[random(bad.size())] = static_cast<char>(random(256));
      if (round % 3 == 0) bad.resize(random(bad.size()));
      const std::string line = complaint(scratch.write(name, bad));
      EXPECT_EQ(line.find('\n'), std::string::npos) << line;
    }
  }
}

#else

TEST(Mesh, WithoutAssimpIsRefusedWithALine) {
  const ScratchDirectory scratch;
  EXPECT_NE(complaint(scratch.write("t.glb", as_glb(tetrahedron()))).find("this build has no assimp"),
            std::string::npos);
}

#endif

}  // namespace
}  // namespace boxstream::import_test
