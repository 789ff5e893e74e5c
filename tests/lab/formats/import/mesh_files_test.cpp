// SPDX-License-Identifier: MIT
#include "formats/import/mesh_files/mesh_files.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <numbers>
#include <string>

#include "formats/import/mesh.hpp"
#include "formats/import/mesh_reader.hpp"
#include "mesh_files.hpp"
#include "scratch_directory.hpp"

namespace boxstream::import_test {
namespace {

using imports::RawMesh;
using imports::read_obj;
using imports::read_off;
using imports::read_ply;
using imports::read_stl;
using tool_test::ScratchDirectory;
using Faces = std::vector<std::uint32_t>;
using Triangle = std::array<std::uint32_t, 3>;

template <class Read>
std::string complaint(Read read, const std::string& bytes) {
  try {
    read(bytes);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "none";
}

/// Coordinates as metres of UTM have them: floats are half a metre apart there.
const std::string far_corners =
    "v 448262.362 5411932.412 100.070\nv 448262.649 5411932.656 101.966\nv 1e-9 -2.5e300 7\n";

TEST(MeshFiles, HaveTheDoublesThatAreNearest) {
  const RawMesh mesh = read_obj(far_corners + "f 1 2 3\n");
  EXPECT_EQ(mesh.vertices[0], (std::array<double, 3>{448262.362, 5411932.412, 100.070}));
  EXPECT_EQ(mesh.vertices[1], (std::array<double, 3>{448262.649, 5411932.656, 101.966}));
  EXPECT_EQ(mesh.vertices[2], (std::array<double, 3>{1e-9, -2.5e300, 7}));
  const RawMesh off = read_off("OFF\n3 1 0\n448262.362 5411932.412 .07\n+1 2. 3\n1e-400 1 1\n3 0 1 2\n");
  EXPECT_EQ(off.vertices[0][1], 5411932.412);
  EXPECT_EQ(off.vertices[1], (std::array<double, 3>{1, 2, 3}));
  EXPECT_EQ(off.vertices[2][0], 0);
  const RawMesh stl = read_stl(
      "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 1.000000001\nvertex 1 0 1\nvertex 0 1 1\n"
      "endloop\nendfacet\nendsolid\n");
  EXPECT_EQ(stl.vertices[0][2], 1.000000001);
}

TEST(MeshFiles, NumberFacesAsTheFileDoes) {
  const std::string corners = "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 1 1 5\n";
  const RawMesh mesh = read_obj("mtllib a.mtl\no first\n" + corners +
                                "usemtl red\nf 1 2 3 4\nl 1 2\nusemtl blue\ng x y\nf 1//1 2//1 5//2\np 3\nusemtl red\n"
                                "o second\nf -4/2/1 -3/1/1 -1/1/1\n");
  EXPECT_EQ(mesh.faces, (Faces{0, 0, 1, 2}));
  EXPECT_EQ(mesh.triangles[2], (Triangle{0, 1, 4}));
  EXPECT_EQ(mesh.triangles[3], (Triangle{1, 2, 4}));
  const RawMesh off = read_off(
      "COFF\n# a comment\n4 2 0\n0 0 0 255 0 0 255\n1 0 0 9 9 9 9\n1 1 0 1 1 1 1\n0 1 0 0 0 0 0\n"
      "4 0 1 2 3 128 128 128\n3 0 1 3 1 0 0\n");
  EXPECT_EQ(off.faces, (Faces{0, 0, 1}));
}

TEST(MeshFiles, TakeTextAsProgramsWriteIt) {
  for (const char* const end : {"\n", "\r\n", "\r"}) {
    std::string text = "# by a program\nv 0 0 0 1.0\nv 1 0 0 0.5 0.5 0.5\nv 0 1 0\nf 1 \\\n 2 3  # the only one\n";
    for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += std::strlen(end))
      text.replace(at, 1, end);
    for (const char* const mark : {"", "\xEF\xBB\xBF"}) {
      const RawMesh mesh = read_obj(mark + text);
      ASSERT_EQ(mesh.triangles.size(), 1u) << text;
      EXPECT_EQ(mesh.triangles[0], (Triangle{0, 1, 2}));
    }
  }
}

TEST(MeshFiles, HaveCommentsAndNamesOfAnyWords) {
  EXPECT_EQ(read_obj("v 0 0 0# one\nv 1 0 0 #two\nv 0 1 0\nf 1 2 3# f 1 1 1\n").triangles[0], (Triangle{0, 1, 2}));
  // A comment may end with the sign that continues a line, as names of folders do.
  EXPECT_EQ(read_obj("# from C:\\meshes\\\nv 7 0 0\nv 1 0 0\nv 0 1 0\nf 1 \\\n2 3 # all \\\nf 3 2 1\n").triangles,
            (std::vector<Triangle>{{0, 1, 2}, {2, 1, 0}}));
  for (const char* const name : {"facet vertex", " vertex 1 2", "outer loop endloop solid"}) {
    std::string text = as_ascii_stl(tetrahedron());
    text.insert(text.find('\n'), std::string(" ") + name);
    while (text.back() == '\n') text.pop_back();
    EXPECT_EQ(read_stl(text + " " + name + "\n" + text + " " + name).triangles.size(), 8u) << text;
  }
  const char* const lines = "\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  for (const char* const head : {"OFF", "off", "COFF"}) EXPECT_EQ(read_off(head + std::string(lines)).faces.size(), 1u);
  EXPECT_EQ(read_off("OFF3 1 0" + std::string(lines).substr(6)).faces.size(), 1u);
  const char* const ply =
      "\nformat ascii 1.0\nelement vertex 1\nproperty int x\nproperty int y\nproperty int z\nend_header\n7 8 9\n";
  for (const char* const head : {"ply", "PLY"})
    EXPECT_EQ(read_ply(head + std::string(ply)).vertices[0], (std::array<double, 3>{7, 8, 9}));
}

double area_along_z(const RawMesh& mesh) {
  double area = 0;
  for (const Triangle& t : mesh.triangles) {
    const auto &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
    const double twice = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    EXPECT_GE(twice, 0) << "none is turned over";
    area += twice / 2;
  }
  return area;
}

/// A star of n points has twice as many corners, of which every second one bends inwards.
TEST(MeshFiles, CutPolygonsThatAreNotConvexIntoTheirOwnArea) {
  for (const int n : {3, 4, 5, 8, 30, 100})
    for (const double far : {0.0, 5e6}) {
      std::string text;
      double area = 0;
      std::string face = "f";
      for (int i = 0; i < 2 * n; ++i) {
        const double r = i % 2 == 0 ? 2 : 0.5, angle = 3.14159265358979 * i / n;
        text +=
            "v " + std::to_string(far + r * std::cos(angle)) + ' ' + std::to_string(far + r * std::sin(angle)) + " 1\n";
        face += ' ' + std::to_string(i + 1);
        area += 2 * 0.5 * std::sin(3.14159265358979 / n) / 2;
      }
      const RawMesh mesh = read_obj(text + face + "\n");
      EXPECT_EQ(mesh.triangles.size(), static_cast<std::size_t>(2 * n - 2));
      EXPECT_NEAR(area_along_z(mesh), area, 1e-5 * n) << n;
      EXPECT_EQ(mesh.faces.back(), 0u);
    }
}

/// Corners on a circle, of which every second one may be pulled in; the circle is a third of a metre up.
std::string round_face(int corners, double inner) {
  std::string text, face = "f";
  char line[100];
  for (int i = 0; i < corners; ++i) {
    const double r = i % 2 == 0 ? 1 : inner, angle = 2 * std::numbers::pi * i / corners;
    std::snprintf(line, sizeof line, "v %.17g %.17g 0.33\n", r * std::cos(angle), r * std::sin(angle));
    text += line;
    face += ' ' + std::to_string(i + 1);
  }
  return text + face + "\n";
}

TEST(MeshFiles, OfVeryManyCornersAreConvexOrRefused) {
  const RawMesh disc = read_obj(round_face(2600, 1));
  EXPECT_EQ(disc.triangles.size(), 2598u);
  EXPECT_NEAR(area_along_z(disc), 1300 * std::sin(2 * std::numbers::pi / 2600), 1e-12);
  EXPECT_EQ(complaint(read_obj, round_face(2600, 0.4)), "face 0, from 0 on: a face of 2600 corners that is not convex");
}

/// Of length 3 and width 2e-9; there along one side and back along the other, each up and down by turns.
std::string sliver(int corners, double up_and_down) {
  std::string text, face = "f";
  char line[100];
  for (int i = 0; i < corners; ++i) {
    const int half = corners / 2, along = i < half ? i : corners - 1 - i;
    const double y = (i < half ? -1e-9 : 1e-9) + (i % 2 == 0 ? up_and_down : -up_and_down);
    std::snprintf(line, sizeof line, "v %.17g %.17g 0.2\n", 3.0 * along / (half - 1), y);
    text += line;
    face += ' ' + std::to_string(i + 1);
  }
  return text + face + "\n";
}

TEST(MeshFiles, OfVeryManyCornersMayBeSliversThatRoundingBends) {
  for (const double rounding : {0.0, 1e-9, 2e-8}) EXPECT_EQ(read_obj(sliver(2400, rounding)).triangles.size(), 2398u);
  EXPECT_EQ(complaint(read_obj, sliver(2400, 0.01)), "face 0, from 0 on: a face of 2400 corners that is not convex");
}

TEST(MeshFiles, OfStlAreBinaryWhenTheirSizeSaysSo) {
  std::string solid = as_binary_stl(tetrahedron());
  solid.replace(0, 5, "solid");
  EXPECT_EQ(read_stl(solid).triangles.size(), 4u);
  EXPECT_EQ(read_stl(as_ascii_stl(tetrahedron())).triangles.size(), 4u);
  std::string loud = as_ascii_stl(tetrahedron());
  for (char& c : loud) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  EXPECT_EQ(read_stl(loud).triangles.size(), 4u);
  EXPECT_EQ(complaint(read_stl, "text = " + loud), "a text that does not begin with \"solid\"");
  EXPECT_EQ(complaint(read_stl, "K\xF6rper\n" + loud), "a text that does not begin with \"solid\"");
  EXPECT_EQ(read_stl(solid + "by a program").triangles.size(), 4u);
  for (const std::string& whole : {solid, as_binary_stl(tetrahedron())})
    EXPECT_EQ(complaint(read_stl, whole.substr(0, 200)), "cut off: 4 triangles take 284 bytes");
}

TEST(MeshFiles, OfStlEndWithTheirLastSolid) {
  const std::string solid = as_ascii_stl(tetrahedron());  // two lines, and seven for each facet
  const auto first_lines = [&](int lines) {
    std::size_t end = 0;
    for (int i = 0; i < lines; ++i) end = solid.find('\n', end) + 1;
    return solid.substr(0, end);
  };
  for (const int lines : {9, 11, 12, 13})
    EXPECT_EQ(complaint(read_stl, first_lines(lines)), "line " + std::to_string(lines) + ": cut off");
  const std::string note = "no endsolid after its last facet: it may be cut off";
  for (const auto& [text, triangles] :
       {std::pair{first_lines(14), 2u}, {first_lines(15), 2u}, {solid + first_lines(29), 8u}}) {
    EXPECT_EQ(read_stl(text).triangles.size(), triangles);
    EXPECT_EQ(imports::unread_in_stl(text), note);
  }
  EXPECT_EQ(read_stl(solid + solid).triangles.size(), 8u);
  for (const std::string end :
       {"endsolid\n", "endsolidPlate", "ENDSOLID plate\n", "end solid plate of steel\n", "End Solid"}) {
    const std::string text = first_lines(29) + end;
    EXPECT_EQ(read_stl(text + "\n" + text).triangles.size(), 8u) << end;
    EXPECT_EQ(imports::unread_in_stl(text), "") << end;
  }
}

TEST(MeshFiles, OfPlyHaveDoublesInEveryOrder) {
  const std::string properties =
      " 1.0\nelement vertex 3\nproperty uchar red\nproperty double z\nproperty double x\nproperty double y\n"
      "element face 1\nproperty list uchar int vertex_index\nproperty float quality\nend_header\n";
  std::string little = "ply\nformat binary_little_endian" + properties,
              big = "ply\nformat binary_big_endian" + properties, text = "ply\nformat ascii" + properties;
  const auto put = [&](auto number) {
    char bytes[sizeof number];
    std::memcpy(bytes, &number, sizeof number);
    little.append(bytes, sizeof number);
    std::reverse(bytes, bytes + sizeof number);
    big.append(bytes, sizeof number);
  };
  const double place[3][3] = {{100.07, 448262.362, 5411932.412}, {1, 2, 3}, {1, 5, 0.1}};
  for (const auto& zxy : place) {
    put(static_cast<std::uint8_t>(200));
    text += "200";
    for (const double x : zxy) {
      put(x);
      char word[40];
      std::snprintf(word, sizeof word, " %.17g", x);
      text += word;
    }
    text += "\n";
  }
  put(static_cast<std::uint8_t>(3));
  for (const std::int32_t corner : {0, 1, 2}) put(corner);
  put(0.5f);
  text += "3 0 1 2 0.5\n";
  for (const std::string& bytes : {text, little, big}) {
    const RawMesh mesh = read_ply(bytes);
    ASSERT_EQ(mesh.vertices.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_EQ(mesh.vertices[i], (std::array<double, 3>{place[i][1], place[i][2], place[i][0]}));
    EXPECT_EQ(mesh.triangles, std::vector<Triangle>({{0, 1, 2}}));
  }
}

TEST(MeshFiles, ThatAreBrokenSayWhereAndWhy) {
  EXPECT_EQ(complaint(read_obj, "v 0 0\n"), "line 1: cut off, or a vertex with fewer than three coordinates");
  EXPECT_EQ(complaint(read_obj, "v 0 0 0\nv 0 zero 0\n"), "line 2: no number where a coordinate should be: 'zero'");
  EXPECT_EQ(complaint(read_obj, "v 0 0 0\nf 1 1 1\nf 1 2 3\n"), "face 1 has vertex 1, both from 0 on: there are 1");
  EXPECT_EQ(complaint(read_obj, "v 0 0 0\nf 1 0 1\n"), "line 2: a face with a vertex that is not there: '0'");
  EXPECT_EQ(complaint(read_obj, "v 0 0 0\nf -1 -2 1\n"), "line 2: a face with a vertex that is not there: '-2'");
  EXPECT_EQ(complaint(read_off, "OFF\n2 1 0\n0 0 0\n"), "line 3: cut off, or more than one vertex or face in a line");
  EXPECT_EQ(complaint(read_off, "OFF\n1 1 0\n0 0 0\n3 0 0 1\n"), "line 4: a face with a vertex that is not there: '1'");
  EXPECT_EQ(complaint(read_off, "4OFF\n1 1 0\n"), "line 1: surfaces of other than three dimensions are not read");
  EXPECT_EQ(complaint(read_ply, "solid\n"), "does not begin with \"ply\"");
  const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
  EXPECT_EQ(complaint(read_ply, "ply\nformat ascii 1.0\nelement vertex 2\n" + xyz + "end_header\n1 1 1\n"),
            "'vertex' 1 of 2: cut off");
  EXPECT_EQ(complaint(read_ply,
                      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
                      "property float Z\nend_header\n1 1 1\n"),
            "vertices without a property 'z'");
  for (const auto& [face, what] :
       {std::pair("-3 0 0 0", "a list of -3.000000 numbers"), std::pair("2.5 0 0 0", "a list of 2.500000 numbers"),
        std::pair("nan 0 0 0", "a list of nan numbers"), std::pair("3 0 0 0.5", "a vertex that is not there")})
    EXPECT_EQ(complaint(read_ply, "ply\nformat ascii 1.0\nelement vertex 1\n" + xyz +
                                      "element face 1\nproperty list float float vertex_indices\nend_header\n1 1 1\n" +
                                      face + "\n"),
              std::string("'face' 0 of 1: ") + what);
  EXPECT_EQ(complaint(read_ply, "ply\nformat ascii 1.0\nelement vertex 1\nproperty half x\nend_header\n1\n"),
            "a property of an unknown type: 'half'");
  EXPECT_EQ(complaint(read_stl, "solid\nouter loop\nvertex 0 0 0\nendloop\n"), "line 4: a facet of 1 vertices");
}

TEST(MeshFiles, InSixteenBitsASignAreRefused) {
  const ScratchDirectory scratch;
  for (const std::string mark : {"\xff\xfe", "\xfe\xff"})
    for (const char* const name : {"a.obj", "a.ply", "a.stl", "a.off"}) try {
        imports::read_surface(scratch.write(name, mark + std::string("v\0 \0", 4)));
        FAIL() << name;
      } catch (const std::runtime_error& error) {
        EXPECT_EQ(error.what(), scratch.file(name) + ": a text in UTF-16: save it as UTF-8");
      }
}

TEST(MeshFiles, OfStlSayWhatTheyDoNotCount) {
  std::string solid = as_binary_stl(tetrahedron());
  EXPECT_EQ(imports::unread_in_stl(solid + "by a program"), "");
  EXPECT_EQ(imports::unread_in_stl(solid.substr(0, 50)), "");
  EXPECT_EQ(imports::unread_in_stl(as_ascii_stl(tetrahedron())), "");
  solid[80] = 3;
  EXPECT_EQ(read_stl(solid).triangles.size(), 3u);
  std::string none = solid;
  none[80] = 0;
  EXPECT_EQ(complaint(read_stl, none), "its count is 0 triangles, and there are bytes of 4: the rest is not read");
  const ScratchDirectory scratch;
  EXPECT_EQ(imports::surface_note(scratch.write("a.stl", solid)),
            "its count is 3 triangles, and there are bytes of 4: the rest is not read");
}

TEST(MeshFiles, OfColladaSayThatNumbersAreRounded) {
  const auto collada = [](const std::string& places) {
    return "<source id='normals'><float_array>0.1 0.1</float_array></source><source id=\"p\"><float_array id='x' "
           "count='6'>" +
           places + "</float_array></source><vertices id='v'><input semantic='POSITION' source='#p'/></vertices>";
  };
  EXPECT_EQ(imports::rounding_in_collada(collada("0 0.5 -3 16777216 1e3\n7")), "");
  EXPECT_EQ(imports::rounding_in_collada(collada("0 5411932.412 16777217 1 2 3")),
            "2 of 6 coordinates are no floats and become floats, by up to 1: .obj, .ply, .stl and .off are read as "
            "doubles");
  EXPECT_EQ(imports::rounding_in_collada("<source id='p'><float_array>0.1"), "");
}

/// As many as there are parts in a model of a building; attributes may have lines to themselves.
TEST(MeshFiles, OfColladaMayHaveManySources) {
  constexpr int count = 20'000;
  std::string sources, inputs;
  for (int i = 0; i < count; ++i) {
    const std::string id = "s" + std::to_string(i);
    sources += "<source\n\tid='" + id + "'><float_array>0.3 0.25 0.7</float_array></source>";
    inputs += "<input\tsemantic='POSITION'\n source='#" + id + "'/>";
  }
  const std::string rounded = imports::rounding_in_collada(sources + inputs + inputs);
  EXPECT_EQ(rounded.substr(0, rounded.find(" coord")), "40000 of 60000");
  EXPECT_EQ(imports::rounding_in_collada(sources), "");
}

TEST(MeshFiles, AreSurfacesWithTheFilesFaces) {
  const ScratchDirectory scratch;
  const auto of = [&](const std::string& name, const std::string& text) {
    try {
      return std::to_string(imports::read_surface(scratch.write(name, text)).faces.back());
    } catch (const std::runtime_error& error) {
      return std::string(error.what()).substr(scratch.file(name).size() + 2);
    }
  };
  EXPECT_EQ(of("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 4 3\nf 1 2 3\n"), "1");
  EXPECT_EQ(of("a.off", "OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"), "0");
  EXPECT_EQ(of("cloud.obj", "v 0 0 0\nv 1 0 0\n"), "no triangles in it, but 2 vertices: a cloud of points?");
  EXPECT_EQ(of("empty.off", ""), "line 0: cut off, or more than one vertex or face in a line");
}

}  // namespace
}  // namespace boxstream::import_test
