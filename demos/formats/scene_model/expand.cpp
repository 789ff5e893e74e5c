// SPDX-License-Identifier: MIT
#include "formats/scene_model/expand.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "formats/scene_model/expand_parts.hpp"

namespace boxstream::scenes {
namespace {

std::size_t resized_shape(Expanded& out, std::size_t shape, double factor) {
  if (factor == 1) return shape;
  ShapeValue value = out.shapes[shape].value;  // a copy: the list grows meanwhile
  std::visit(
      [&]<class S>(S& s) {
        if constexpr (S::use == ShapeUse::part) {
          s.resize(factor);
        } else if constexpr (S::use == ShapeUse::any_body) {
          for (CompoundChild& child : s.children)
            child = {resized_shape(out, child.shape, factor), times(child.position, factor), child.rotation};
        }  // Fixed bodies are never resized: the loader refuses it.
      },
      value);
  const std::size_t resized = add_shape(out, std::move(value));
  if (const auto margin = out.shapes[shape].margin) out.shapes[resized].margin = *margin * factor;
  return resized;
}

std::string pointer_of(const char* block, std::size_t index, const std::vector<std::size_t>& begins) {
  const auto after = std::upper_bound(begins.begin(), begins.end(), index);
  if (after == begins.begin()) return std::string("/") + block + "/" + std::to_string(index);
  return "/generators/" + std::to_string(after - begins.begin() - 1);
}

}  // namespace

std::vector<std::size_t> deal(const std::vector<MixEntry>& mix, int count, Random& random) {
  double total = 0;
  for (const MixEntry& entry : mix) total += entry.weight;
  std::vector<std::size_t> cards;
  cards.reserve(static_cast<std::size_t>(count));
  double sum = 0;
  for (std::size_t i = 0; i < mix.size(); ++i) {
    sum += mix[i].weight;
    const auto upto = static_cast<std::size_t>(std::lround(count * (sum / total)));
    while (cards.size() < upto) cards.push_back(i);
  }
  for (std::size_t i = cards.size(); i > 1; --i) std::swap(cards[i - 1], cards[random.below(i)]);
  return cards;
}

Body draw_body(const MixEntry& entry, Random& random, Expanded& out) {
  Body body;
  body.traits = entry.traits;
  const double size =
      entry.scale[0] < entry.scale[1] ? random.log_range(entry.scale[0], entry.scale[1]) : entry.scale[0];
  body.traits.shape = resized_shape(out, entry.traits.shape, size);
  if (body.traits.mass) *body.traits.mass *= size * size * size;
  if (body.traits.ccd) body.traits.ccd = Ccd{body.traits.ccd->threshold * size, body.traits.ccd->radius * size};
  return body;
}

std::size_t add_shape(Expanded& out, ShapeValue value) {
  out.shapes.push_back({"", std::move(value), {}});
  return out.shapes.size() - 1;
}

Vec3 lattice_place(int index, const std::array<int, 2>& columns, const Vec3& spacing, const Vec3& origin) {
  const int x = index % columns[0];
  const int z = index / columns[0] % columns[1];
  const int y = index / columns[0] / columns[1];
  return {origin[0] + (x - 0.5 * (columns[0] - 1)) * spacing[0], origin[1] + y * spacing[1],
          origin[2] + (z - 0.5 * (columns[1] - 1)) * spacing[2]};
}

Vec3 turned(const Quat& q, const Vec3& v) {
  const Vec3 u{q[0], q[1], q[2]};
  const auto cross = [](const Vec3& a, const Vec3& b) {
    return Vec3{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  };
  const Vec3 t = cross(u, v);
  const Vec3 c = cross(u, t);
  return {v[0] + 2 * (q[3] * t[0] + c[0]), v[1] + 2 * (q[3] * t[1] + c[1]), v[2] + 2 * (q[3] * t[2] + c[2])};
}

Quat product(const Quat& a, const Quat& b) {
  return {a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1], a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0],
          a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3], a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2]};
}

void GridGenerator::generate(Random& random, Expanded& out) const {
  const std::vector<std::size_t> cards = deal(mix, count, random);
  for (int i = 0; i < count; ++i) {
    Body body = draw_body(mix[cards[static_cast<std::size_t>(i)]], random, out);
    body.position = lattice_place(i, columns, spacing, origin);
    for (double& x : body.position) x += random.range(-jitter, jitter);
    if (turned) body.rotation = random.rotation();
    body.velocity = random.in_ball(speed);
    const double dx = body.position[0] - origin[0], dz = body.position[2] - origin[2];
    if (const double distance = std::hypot(dx, dz); distance > 0) {
      body.velocity[0] -= vortex * dz / distance;
      body.velocity[2] += vortex * dx / distance;
    }
    out.bodies.push_back(std::move(body));
  }
}

void WallGenerator::generate(Random&, Expanded& out) const {
  const Vec3 half = std::get<BoxShape>(out.shapes[brick.shape].value).half_extents;
  const double pitch = 2 * half[0] + gap;
  const double half_length = half[0] - gap / 2;  // two half bricks and a gap are as long as one brick
  const std::size_t half_brick = add_shape(out, BoxShape{{half_length / 2, half[1], half[2]}});
  out.shapes[half_brick].margin = out.shapes[brick.shape].margin;
  for (int row = 0; row < rows; ++row) {
    const bool odd = row % 2 != 0;
    const double y = origin[1] + half[1] * (2 * row + 1);
    const auto lay = [&](double x, bool whole) {
      Body body;
      body.traits = brick;
      if (!whole) {
        body.traits.shape = half_brick;
        if (body.traits.mass) *body.traits.mass *= half_length / (2 * half[0]);
      }
      body.position = {origin[0] + x, y, origin[2]};
      out.bodies.push_back(std::move(body));
    };
    const double left = -0.5 * columns * pitch;
    if (odd) lay(left + gap / 2 + half_length / 2, false);
    for (int column = 0; column < columns - (odd ? 1 : 0); ++column)
      lay(left + (column + (odd ? 1.0 : 0.5)) * pitch, true);
    if (odd) lay(-left - gap / 2 - half_length / 2, false);
  }
}

void ChainGenerator::generate(Random&, Expanded& out) const {
  const Vec3& d = direction;
  // The shortest turn from +y to the direction; for straight down, half a turn about x.
  Quat rotation{1, 0, 0, 0};
  if (d[1] > -1 + 1e-9) {
    const double w = std::sqrt(0.5 * (1 + d[1]));
    rotation = {d[2] / (2 * w), 0, -d[0] / (2 * w), w};
  }
  const auto along = [&](double distance) {
    return Vec3{anchor[0] + d[0] * distance, anchor[1] + d[1] * distance, anchor[2] + d[2] * distance};
  };
  for (int i = 0; i <= links; ++i) {
    const bool last = i == links;
    Body body;
    body.traits = last ? end : link;
    body.position = along(last ? i * pitch + end_offset : (i + 0.5) * pitch);
    body.rotation = rotation;
    out.bodies.push_back(std::move(body));
    Joint joint;
    joint.a = out.bodies.size() - 1;
    if (i > 0) joint.b = joint.a - 1;
    joint.value = BallJoint{along(i * pitch)};
    out.joints.push_back(joint);
  }
}

void ContainerGenerator::generate(Random&, Expanded& out) const {
  const double t = thickness / 2;
  const Vec3 half{size[0] / 2, size[1] / 2, size[2] / 2};
  const auto add = [&](const Vec3& extents, double x, double y, double z) {
    Body body;
    body.traits.shape = add_shape(out, BoxShape{extents});
    body.traits.type = BodyType::fixed;
    body.traits.material = material;
    body.position = {floor[0] + x, floor[1] + y, floor[2] + z};
    out.bodies.push_back(std::move(body));
  };
  // The boxes reach through each other: where they only met at an edge, a body pressed into the corner would squeeze
  // out.
  const Vec3 slab{half[0] + 2 * t, t, half[2] + 2 * t};
  const double foot = -2 * t, top = size[1] + (lid ? 2 * t : 0);
  const double tall = (top - foot) / 2, middle = (top + foot) / 2;
  add(slab, 0, -t, 0);
  add({t, tall, slab[2]}, -half[0] - t, middle, 0);
  add({t, tall, slab[2]}, half[0] + t, middle, 0);
  add({slab[0], tall, t}, 0, middle, -half[2] - t);
  add({slab[0], tall, t}, 0, middle, half[2] + t);
  if (lid) add(slab, 0, size[1] + t, 0);
}

Expanded expand(const Scene& scene) {
  Expanded out{scene.shapes,     scene.bodies,          scene.joints,
               scene.exclusions, {scene.bodies.size()}, {scene.joints.size()}};
  for (std::size_t i = 0; i < scene.generators.size(); ++i) {
    // A stream of its own for each generator: changing one leaves the others as they were.
    Random random(scene.world.seed + 0x9e3779b97f4a7c15u * (i + 1));
    std::visit([&](const auto& generator) { generator.generate(random, out); }, scene.generators[i]);
    out.bodies_of_generator.push_back(out.bodies.size());
    out.joints_of_generator.push_back(out.joints.size());
  }
  return out;
}

std::string pointer_of_body(const Expanded& expanded, std::size_t body) {
  return pointer_of("bodies", body, expanded.bodies_of_generator);
}

std::string pointer_of_joint(const Expanded& expanded, std::size_t joint) {
  return pointer_of("joints", joint, expanded.joints_of_generator);
}

void ImportGenerator::generate(Random&, Expanded& out) const {
  const std::size_t first_shape = out.shapes.size(), first_body = out.bodies.size();
  for (Shape shape : shapes) {
    if (auto* const compound = std::get_if<CompoundShape>(&shape.value))
      for (CompoundChild& child : compound->children) child.shape += first_shape;
    out.shapes.push_back(std::move(shape));
  }
  for (Body body : bodies) {
    body.traits.shape += first_shape;
    out.bodies.push_back(std::move(body));
  }
  for (Joint joint : joints) {
    joint.a += first_body;
    if (joint.b) *joint.b += first_body;
    out.joints.push_back(joint);
  }
  for (const auto& [a, b] : exclusions) out.exclusions.push_back({a + first_body, b + first_body});
}

}  // namespace boxstream::scenes
