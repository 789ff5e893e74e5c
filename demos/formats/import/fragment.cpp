// SPDX-License-Identifier: MIT
#include "formats/import/fragment.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace boxstream::imports {
namespace {

/// JSON has no word for numbers that are not finite; they would turn into nulls.
void check_finite(const Json& value) {
  if (value.is_number_float() && !std::isfinite(value.get<double>()))
    throw std::runtime_error("a number that is not finite");
  if (value.is_structured())
    for (const Json& part : value) check_finite(part);
}

void append(Json& list, Json item, const char* what) {
  if (list.size() >= Fragment::most)
    throw std::runtime_error("more than " + std::to_string(Fragment::most) + " " + what);
  check_finite(item);
  list.push_back(std::move(item));
}

Json rotation(const Quat& q) {
  const double sine = std::hypot(q[0], q[1], q[2]);
  if (!(sine > 0)) return nullptr;
  return {{"axis", Vec3{q[0] / sine, q[1] / sine, q[2] / sine}},
          {"degrees", 2 * std::atan2(sine, q[3]) * 180 / std::numbers::pi}};
}

void put_place(Json& item, const Frame& place) {
  item["position"] = place.origin;
  if (Json turn = rotation(place.turn); !turn.is_null()) item["rotation"] = std::move(turn);
}

std::string unused(const std::set<std::string>& taken, const std::string& wish) {
  const std::string base = wish.empty() ? "unnamed" : wish;
  if (!taken.contains(base)) return base;
  // Many bodies of one name are usual; trying 2, 3, ... for each would take time without end.
  std::size_t number = taken.size();
  while (taken.contains(base + " " + std::to_string(number))) ++number;
  return base + " " + std::to_string(number);
}

}  // namespace

std::string Fragment::free_name(const std::string& wish) {
  return *names_.insert(unused(names_, wish)).first;
}

std::string Fragment::add_shape(const std::string& wish, Json shape) {
  const std::string name = *shape_names_.insert(unused(shape_names_, wish)).first;
  Json named{{"name", name}};
  named.update(shape);
  append(shapes_, std::move(named), "shapes");
  return name;
}

std::string Fragment::add_pieces(const std::string& wish, const std::vector<Piece>& pieces) {
  if (pieces.size() == 1 && pieces[0].place.origin == Vec3{} && pieces[0].place.turn == Quat{0, 0, 0, 1})
    return add_shape(wish, pieces[0].shape);
  Json children = Json::array();
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    Json child{{"shape", add_shape(wish + "/" + std::to_string(i), pieces[i].shape)}};
    put_place(child, pieces[i].place);
    children.push_back(std::move(child));
  }
  return add_shape(wish, {{"type", "compound"}, {"children", std::move(children)}});
}

void Fragment::add_body(const BodyNote& body) {
  Json item{{"name", body.name}, {"shape", body.shape}};
  if (body.mass) item["mass"] = *body.mass;
  put_place(item, place_.place(body.place));
  for (const auto& [key, value] : body.more.items()) {
    const bool is_vector = key == "velocity" || key == "spin";
    item[key] = is_vector ? Json(turned(place_.turn, value.get<Vec3>())) : value;
  }
  append(bodies_, std::move(item), "bodies");
}

void Fragment::add_joint(Json joint, const std::string& a, const std::optional<std::string>& b, const Vec3& pivot,
                         const std::optional<Vec3>& axis) {
  joint["a"] = a;
  if (b) joint["b"] = *b;
  joint["pivot"] = place_.place(pivot);
  if (axis) joint["axis"] = turned(place_.turn, *axis);
  append(joints_, std::move(joint), "joints");
}

void Fragment::exclude(const std::string& a, const std::string& b) {
  if (exclusions_pairs_.insert(std::minmax(a, b)).second) exclusions_.push_back({a, b});
}

void Fragment::set_gravity(const Vec3& gravity) {
  gravity_ = turned(place_.turn, gravity);
}

void Fragment::note(const std::string& line) {
  append(notes_, line, "things that cannot be carried over");
}

std::string Fragment::text() const {
  Json all{{"shapes", shapes_}, {"materials", materials_},   {"bodies", bodies_},
           {"joints", joints_}, {"exclusions", exclusions_}, {"notes", notes_}};
  if (gravity_) all["gravity"] = *gravity_;
  check_finite(all);
  // Names may be in any encoding, JSON is UTF-8.
  return all.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Json box_shape(const Vec3& half_extents) {
  return {{"type", "box"}, {"half_extents", half_extents}};
}
Json sphere_shape(double radius) {
  return {{"type", "sphere"}, {"radius", radius}};
}
Json cylinder_shape(double radius, double height) {
  return {{"type", "cylinder"}, {"radius", radius}, {"height", height}};
}
Json capsule_shape(double radius, double height) {
  return {{"type", "capsule"}, {"radius", radius}, {"height", height}};
}
Json hull_shape(const std::vector<Vec3>& points) {
  return {{"type", "hull"}, {"points", points}};
}
Json mesh_shape(const TriangleMesh& mesh) {
  return {{"type", "mesh"}, {"vertices", mesh.vertices}, {"triangles", mesh.triangles}};
}

Quat y_to_z() {
  return {std::numbers::sqrt2 / 2, 0, 0, std::numbers::sqrt2 / 2};
}

}  // namespace boxstream::imports
