// SPDX-License-Identifier: MIT
#include <cmath>
#include <numbers>

#include "formats/scene_json/load_parts.hpp"

namespace boxstream::scenes {
namespace {

constexpr Range any_damping{0, 1};

std::optional<std::uint32_t> read_bits(Fields& fields, const std::string& key) {
  const auto node = fields.find(key);
  if (!node) return std::nullopt;
  // Bullet keeps these in an int.
  const std::uint64_t bits = node->count();
  if (bits > 0x7fffffff) node->fail("must be at most 2147483647, got " + std::to_string(bits));
  return static_cast<std::uint32_t>(bits);
}

/// "ccd": false excludes it, an object requests it.
void read_ccd(Fields& fields, BodyTraits& traits) {
  const auto node = fields.find("ccd");
  if (!node) return;
  if (!node->is_object()) {
    if (node->json() != false) node->fail("must be false or an object with \"threshold\" and \"radius\"");
    traits.may_ccd = false;
    return;
  }
  Fields ccd(*node);
  const double threshold = ccd.number("threshold", any_size);
  traits.ccd = Ccd{threshold, ccd.number("radius", any_size)};
  ccd.finish();
}

/// true is the method that conserves most.
void read_gyro(Fields& fields, BodyTraits& traits) {
  const auto node = fields.find("gyro");
  if (!node) return;
  if (node->is_string()) {
    traits.gyro =
        std::array{Gyro::conserving, Gyro::explicit_step, Gyro::implicit_world,
                   Gyro::implicit_body}[node->choice({"conserving", "explicit", "implicit_world", "implicit_body"})];
  } else {
    traits.gyro = node->boolean() ? Gyro::conserving : Gyro::off;
  }
}

/// Whether a body can have this tensor: it takes work to spin it about any axis.
bool is_positive(const Vec3& m, const Vec3& p) {
  const double xy = p[0], xz = p[1], yz = p[2];
  return m[0] * m[1] > xy * xy && m[0] * m[2] > xz * xz && m[1] * m[2] > yz * yz &&
         m[0] * (m[1] * m[2] - yz * yz) - xy * (xy * m[2] - yz * xz) + xz * (xy * yz - m[1] * xz) > 0;
}

/// Moments about the axes of the body, and products, about its centre of mass.
void read_inertia(Fields& fields, Body& body) {
  const bool dynamic = body.traits.type == BodyType::dynamic;
  if (const auto node = fields.find("inertia")) {
    if (!dynamic) node->fail("only dynamic bodies have inertia");
    const std::vector<Node> entries = node->list(3, 6);
    if (entries.size() != 3 && entries.size() != 6) node->fail("must have 3 moments, or 3 moments and 3 products");
    body.inertia.emplace();
    for (std::size_t i = 0; i < 3; ++i) (*body.inertia)[i] = entries[i].number(positive(max_inertia));
    for (std::size_t i = 3; i < entries.size(); ++i)
      body.products[i - 3] = entries[i].number({-max_inertia, max_inertia});
    if (!is_positive(*body.inertia, body.products)) node->fail("no body has these products with these moments");
  }
  if (const auto node = fields.find("centre_of_mass")) {
    if (!dynamic) node->fail("only dynamic bodies have a centre of mass");
    body.centre = node->vec3(any_place);
  }
}

}  // namespace

Vec3 read_direction(const Node& node) {
  const Vec3 v = node.vec3({-1e6, 1e6});
  const double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  if (!(length > 1e-6)) node.fail("a direction must not be zero");
  return {v[0] / length, v[1] / length, v[2] / length};
}

Quat read_rotation(Fields& fields) {
  const auto node = fields.find("rotation");
  if (!node) return {0, 0, 0, 1};
  Fields turn(*node);
  const Vec3 axis = read_direction(turn.require("axis"));
  const double half = turn.number("degrees", {-360, 360}) * std::numbers::pi / 360;
  turn.finish();
  const double s = std::sin(half);
  return {axis[0] * s, axis[1] * s, axis[2] * s, std::cos(half)};
}

BodyTraits read_traits(Fields& fields, const Scene& scene, const Names& names, bool may_be_fixed) {
  BodyTraits traits;
  const Node shape = fields.require("shape");
  traits.shape = look_up(names.shapes, shape, "shape");
  traits.material = read_material(fields, names);
  if (may_be_fixed)
    if (const auto type = fields.find("type"))
      traits.type = std::array{BodyType::fixed, BodyType::kinematic,
                               BodyType::dynamic}[type->choice({"static", "kinematic", "dynamic"})];
  if (traits.type != BodyType::fixed && use_of(scene.shapes[traits.shape].value) == ShapeUse::fixed_body)
    shape.fail("this kind of shape is for static bodies only");

  const auto mass = fields.find("mass");
  const auto density = fields.find("density");
  if (traits.type == BodyType::dynamic) {
    if (mass && density) density->fail("give \"mass\" or \"density\", not both");
    if (mass) {
      traits.mass = mass->number(positive(max_mass));
    } else if (density) {
      traits.density = density->number(positive(1e5));
    } else {
      fields.node().fail("a dynamic body needs \"mass\" or \"density\"");
    }
  } else if (mass || density) {
    (mass ? mass : density)->fail("only dynamic bodies have mass");
  }
  traits.linear_damping = fields.number("linear_damping", 0, any_damping);
  traits.angular_damping = fields.number("angular_damping", 0, any_damping);
  traits.group = read_bits(fields, "group");
  traits.mask = read_bits(fields, "mask");
  read_ccd(fields, traits);
  traits.sleep = fields.boolean("sleep", true);
  read_gyro(fields, traits);
  return traits;
}

void load_bodies(const Node& node, Scene& scene, Names& names) {
  for (const Node& item : node.list(0, max_count)) {
    Fields fields(item);
    Body body;
    if (const auto name = fields.find("name")) {
      body.name = name->text();
      if (!names.bodies.emplace(body.name, scene.bodies.size()).second)
        name->fail("a second body called \"" + body.name + "\"");
    }
    body.traits = read_traits(fields, scene, names, true);
    body.position = fields.vec3("position", body.position, any_place);
    body.rotation = read_rotation(fields);
    read_inertia(fields, body);
    if (body.traits.type != BodyType::fixed) {
      body.velocity = fields.vec3("velocity", body.velocity, any_velocity);
      body.spin = fields.vec3("spin", body.spin, any_velocity);
    } else {
      body.surface_velocity = fields.vec3("surface_velocity", body.surface_velocity, any_velocity);
    }
    fields.finish();
    scene.bodies.push_back(std::move(body));
  }
}

}  // namespace boxstream::scenes
