// SPDX-License-Identifier: MIT
#include "boxstream/simulate/drawables.hpp"

#include <algorithm>
#include <array>

#include "boxstream/shared/print.hpp"

namespace boxstream::tool {
namespace {

using picture::Colour;
using picture::Transform;
using scenes::Drawable;
using State = scenes::Drawable::State;
using Kind = scenes::Drawable::Kind;

constexpr Colour floor_colour{0.78F, 0.79F, 0.80F};
constexpr Colour scenery_colour{0.72F, 0.71F, 0.68F};
constexpr Colour sensor_colour{0.10F, 0.62F, 0.45F};
constexpr Colour character_colour{0.84F, 0.15F, 0.24F};
constexpr Colour kinematic_colour{0.30F, 0.33F, 0.38F};
// Bodies run through these in order of creation, so that mixing shows.
constexpr std::array<Colour, 5> creation_colours{{{0.13F, 0.36F, 0.56F},
                                                  {0.16F, 0.61F, 0.56F},
                                                  {0.93F, 0.77F, 0.42F},
                                                  {0.94F, 0.55F, 0.30F},
                                                  {0.86F, 0.30F, 0.26F}}};

Colour blend(Colour a, Colour b, float t) {
  return {a.r + (b.r - a.r) * t, a.g + (b.g - a.g) * t, a.b + (b.b - a.b) * t};
}

Colour creation_colour(std::uint32_t object, std::size_t objects) {
  const float place = static_cast<float>(object) / static_cast<float>(std::max<std::size_t>(objects, 1));
  const float at = std::min(place, 0.9999F) * (creation_colours.size() - 1);
  const auto lower = static_cast<std::size_t>(at);
  // A little light and dark keeps neighbours apart.
  const float shade = 0.06F * static_cast<float>(object * 2654435761U >> 30) - 0.09F;
  const Colour c = blend(creation_colours[lower], creation_colours[lower + 1], at - static_cast<float>(lower));
  return shade > 0 ? blend(c, {1, 1, 1}, shade) : blend(c, {0, 0, 0}, -shade);
}

picture::Vec3 to_vec(const std::array<float, 3>& a) {
  return {a[0], a[1], a[2]};
}

Transform transform_of(const Drawable& d) {
  Transform t;
  for (std::size_t column = 0; column < 3; ++column)
    t.column[column] = {d.rotation[column], d.rotation[3 + column], d.rotation[6 + column]};
  t.origin = to_vec(d.position);
  return t;
}

/// Turns y onto the normal.
Transform plane_transform(const Drawable& d) {
  const picture::Vec3 normal = normalized(to_vec(d.size));
  const picture::Vec3 x = picture::perpendicular(normal);
  return {{x, normal, cross(x, normal)}, to_vec(d.position)};
}

class Collector {
 public:
  explicit Collector(std::size_t objects) : objects_(objects) {}

  void add(const Drawable& d) {
    if (d.state == State::sensor) return add_frame(d);
    const bool plane = d.kind == Kind::plane;
    const bool subject = d.state != State::fixed && !plane;
    drawables_.push_back({shape_of(d), plane ? plane_transform(d) : transform_of(d), colour_of(d), subject});
  }
  std::vector<picture::Drawable> take() { return std::move(drawables_); }

 private:
  Colour colour_of(const Drawable& d) const {
    if (d.kind == Kind::plane) return floor_colour;
    if (d.state == State::fixed) return scenery_colour;
    if (d.state == State::kinematic || d.state == State::wheel) return kinematic_colour;
    if (d.state == State::character) return character_colour;
    return creation_colour(d.object, objects_);
  }

  picture::Shape shape_of(const Drawable& d) {
    switch (d.kind) {
      case Kind::box:
        return picture::Box{to_vec(d.size)};
      case Kind::sphere:
        return picture::Sphere{d.size[0]};
      case Kind::capsule:
        return picture::Capsule{d.size[0], d.size[1]};
      case Kind::cylinder:
        return picture::Cylinder{d.size[0], d.size[1]};
      case Kind::cone:
        return picture::Cone{d.size[0], d.size[1]};
      case Kind::plane:
        return picture::Plane{};
      case Kind::triangles:
        break;
    }
    return mesh_of(d);
  }

  std::shared_ptr<const picture::Mesh> mesh_of(const Drawable& d) {
    auto mesh = std::make_shared<picture::Mesh>();
    std::transform(d.vertices.begin(), d.vertices.end(), std::back_inserter(mesh->vertices), to_vec);
    mesh->triangles.assign(d.triangles.begin(), d.triangles.end());
    // Hulls have true edges; cloth and terrain stand for curved surfaces.
    mesh->smooth = d.state == State::soft || d.state == State::fixed;
    return mesh;
  }

  /// The twelve edges of a box, as thin rods: a sensor is not a solid.
  void add_frame(const Drawable& d) {
    const Transform t = transform_of(d);
    const std::array<float, 3>& half = d.size;
    const float radius = 0.02F * std::min({half[0], half[1], half[2]});
    for (int axis = 0; axis < 3; ++axis) {
      const auto u = static_cast<std::size_t>((axis + 1) % 3);
      const auto v = static_cast<std::size_t>((axis + 2) % 3);
      for (const float su : {-1.0F, 1.0F}) {
        for (const float sv : {-1.0F, 1.0F}) {
          std::array<float, 3> middle{};
          middle[u] = su * half[u];
          middle[v] = sv * half[v];
          Transform edge = t;
          edge.origin = t.point(to_vec(middle));
          const picture::Capsule rod{radius, half[static_cast<std::size_t>(axis)], axis};
          drawables_.push_back({rod, edge, sensor_colour, false});
        }
      }
    }
  }

  std::size_t objects_;
  std::vector<picture::Drawable> drawables_;
};

}  // namespace

std::vector<picture::Drawable> drawables(const scenes::Simulation& simulation) {
  Collector collector(simulation.objects().size());
  simulation.for_each_drawable([&](const Drawable& d) { collector.add(d); });
  return collector.take();
}

picture::ColourBar creation_bar(const scenes::Simulation& simulation) {
  return {"objects, in order of creation",
          "1",
          grouped(simulation.objects().size()),
          {creation_colours.begin(), creation_colours.end()}};
}

}  // namespace boxstream::tool
