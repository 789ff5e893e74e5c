// SPDX-License-Identifier: MIT
#include "boxstream/mesh/painted_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <memory>
#include <stdexcept>

#include "boxstream/shared/bad_input.hpp"
#include "formats/import/file_kind.hpp"
#include "pictures/drawing/camera.hpp"
#include "pictures/drawing/colour_bar.hpp"
#include "pictures/drawing/png_file.hpp"
#include "pictures/drawing/render.hpp"
#include "pictures/viewer/glb_file.hpp"

namespace boxstream::tool {
namespace {

using picture::Colour;

constexpr Colour plain_colour{0.72F, 0.74F, 0.77F};

std::string kind_of(const std::string& path) {
  const std::string kind = imports::file_kind(path);
  if (kind != "ply" && kind != "glb" && kind != "png")
    throw BadInput(fmt::format("{}: surfaces are written as .ply, .glb or .png", path));
  return kind;
}

static_assert(std::endian::native == std::endian::little, "numbers are written as they are in memory");

template <class T>
void put(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

std::uint8_t byte_of(float channel) {
  return static_cast<std::uint8_t>(std::lround(255 * channel));
}

bool are_floats(const std::vector<scenes::Vec3>& vertices) {
  return std::all_of(vertices.begin(), vertices.end(), [](const scenes::Vec3& v) {
    return std::all_of(v.begin(), v.end(), [](double x) { return double{static_cast<float>(x)} == x; });
  });
}

void write_ply(const PaintedMesh& painted, std::ostream& out) {
  const bool has_colours = !painted.colours.empty(), has_floats = are_floats(painted.mesh.vertices);
  std::string bytes = fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {0}\nproperty {1} x\nproperty {1} y\nproperty {1} z\n",
      painted.mesh.vertices.size(), has_floats ? "float" : "double");
  if (has_colours) bytes += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  bytes += fmt::format("element face {}\nproperty list uchar int vertex_indices\nend_header\n",
                       painted.mesh.triangles.size());
  for (std::size_t i = 0; i < painted.mesh.vertices.size(); ++i) {
    for (const double x : painted.mesh.vertices[i])
      if (has_floats)
        put(bytes, static_cast<float>(x));
      else
        put(bytes, x);
    if (!has_colours) continue;
    const Colour c = painted.colours[i];
    for (const float channel : {c.r, c.g, c.b}) put(bytes, byte_of(channel));
  }
  for (const auto& triangle : painted.mesh.triangles) {
    put(bytes, std::uint8_t{3});
    for (const std::uint32_t v : triangle) put(bytes, static_cast<std::int32_t>(v));
  }
  out << bytes;
}

/// glTF wants linear light.
float linear(float srgb) {
  return srgb <= 0.04045F ? srgb / 12.92F : std::pow((srgb + 0.055F) / 1.055F, 2.4F);
}

void write_glb(const PaintedMesh& painted, std::ostream& out) {
  view::GlbFile file;
  std::vector<float> places, colours;
  for (const auto& v : painted.mesh.vertices)
    for (const double x : v) places.push_back(static_cast<float>(x));
  for (const Colour& c : painted.colours)
    for (const float channel : {c.r, c.g, c.b}) colours.push_back(linear(channel));
  std::vector<std::uint32_t> corners;
  for (const auto& t : painted.mesh.triangles) corners.insert(corners.end(), t.begin(), t.end());

  using Use = view::GlbFile::Use;
  view::GlbFile::Json attributes{{"POSITION", file.add_floats(places, 3, Use::vertices, true)}};
  if (!colours.empty()) attributes["COLOR_0"] = file.add_floats(colours, 3, Use::vertices, false);
  const std::size_t indices = file.add_indices(corners);
  view::GlbFile::Json base = {1, 1, 1, 1};
  if (colours.empty()) base = {linear(plain_colour.r), linear(plain_colour.g), linear(plain_colour.b), 1};
  file.write(out,
             {{"asset", {{"generator", "boxstream"}}},
              {"scene", 0},
              {"scenes", {{{"nodes", {0}}}}},
              {"nodes", {{{"mesh", 0}}}},
              {"materials",
               {{{"pbrMetallicRoughness", {{"baseColorFactor", base}, {"metallicFactor", 0}, {"roughnessFactor", 0.7}}},
                 {"doubleSided", true}}}},
              {"meshes", {{{"primitives", {{{"attributes", attributes}, {"indices", indices}, {"material", 0}}}}}}}});
}

/// Pictures know one colour a thing, so triangles go by the average of their corners, in this many levels a channel.
std::vector<picture::Drawable> by_colour(const PaintedMesh& painted) {
  constexpr float levels = 24;
  std::map<std::array<int, 3>, std::shared_ptr<picture::Mesh>> things;
  const auto colour_of = [&](std::uint32_t v) { return painted.colours.empty() ? plain_colour : painted.colours[v]; };
  for (const auto& t : painted.mesh.triangles) {
    const Colour a = colour_of(t[0]), b = colour_of(t[1]), c = colour_of(t[2]);
    const auto level = [&](float x, float y, float z) {
      return static_cast<int>(std::lround((x + y + z) / 3 * levels));
    };
    auto& thing = things[{level(a.r, b.r, c.r), level(a.g, b.g, c.g), level(a.b, b.b, c.b)}];
    if (!thing) thing = std::make_shared<picture::Mesh>();
    const auto first = static_cast<std::uint32_t>(thing->vertices.size());
    for (const std::uint32_t v : t) {
      const auto& p = painted.mesh.vertices[v];
      thing->vertices.push_back({static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])});
    }
    thing->triangles.push_back({first, first + 1, first + 2});
  }
  std::vector<picture::Drawable> drawables;
  for (const auto& [level, thing] : things) {
    const auto channel = [&, &at = level](std::size_t k) { return static_cast<float>(at[k]) / levels; };
    drawables.push_back({thing, {}, {channel(0), channel(1), channel(2)}});
  }
  return drawables;
}

void write_picture(const PaintedMesh& painted, std::ostream& out) {
  const std::vector<picture::Drawable> drawables = by_colour(painted);
  picture::RenderOptions options;
  options.width = 1000;
  options.height = 1000;
  const picture::Image image = picture::render(drawables, picture::frame(drawables, 1), options);
  picture::write_png(painted.bar.colours.empty() ? image : picture::with_colour_bar(image, painted.bar), out);
}

}  // namespace

PaintedMeshFile::PaintedMeshFile(const std::string& path) : kind_(kind_of(path)), file_(path) {}

void PaintedMeshFile::write(const PaintedMesh& painted) {
  if (kind_ == "png")
    write_picture(painted, file_.stream());
  else if (kind_ == "ply")
    write_ply(painted, file_.stream());
  else
    write_glb(painted, file_.stream());
  file_.commit();
}

}  // namespace boxstream::tool
