// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "formats/import/geometry.hpp"
#include "formats/import/mesh.hpp"
#include "formats/scene_model/joints.hpp"

namespace boxstream::imports {

using Json = nlohmann::ordered_json;

/// A convex piece of a body: a shape without a name, and its pose.
struct Piece {
  Json shape;
  Frame place;
};

struct BodyNote {
  std::string name;
  std::string shape;
  Frame place;                 // of the centre of mass, in the file's coordinates
  std::optional<double> mass;  // dynamic if there
  Json more = Json::object();  // further keys, as scenes have them
};

/// Blocks of a scene in the making. Takes everything in the coordinates of the file and puts it where it goes.
/// Throws std::runtime_error for more than `most` of anything and for numbers that are not finite.
class Fragment {
 public:
  static constexpr std::size_t most = 100'000;

  explicit Fragment(const Frame& place) : place_(place) {}

  /// Whether the file's axes are kept.
  bool is_upright() const { return place_.turn == Quat{0, 0, 0, 1}; }

  /// A name like `wish` that no body has yet.
  std::string free_name(const std::string& wish);

  /// Both give the name of the shape.
  std::string add_shape(const std::string& wish, Json shape);
  /// One shape for all of them: a compound unless it is one piece in the middle.
  std::string add_pieces(const std::string& wish, const std::vector<Piece>& pieces);

  void add_material(const std::string& name, Json material) { materials_[name] = std::move(material); }
  void add_body(const BodyNote& body);

  /// `joint` has its type and everything but places and directions.
  void add_joint(Json joint, const std::string& a, const std::optional<std::string>& b, const Vec3& pivot,
                 const std::optional<Vec3>& axis);
  /// The two pass through each other. Does nothing if they are excluded already.
  void exclude(const std::string& a, const std::string& b);
  void set_gravity(const Vec3& gravity);
  void note(const std::string& line);

  std::string text() const;

 private:
  Frame place_;
  std::set<std::string> names_;
  std::set<std::string> shape_names_;
  std::set<std::pair<std::string, std::string>> exclusions_pairs_;
  Json shapes_ = Json::array();
  Json materials_ = Json::object();
  Json bodies_ = Json::array();
  Json joints_ = Json::array();
  Json exclusions_ = Json::array();
  Json notes_ = Json::array();
  std::optional<Vec3> gravity_;
};

Json box_shape(const Vec3& half_extents);
Json sphere_shape(double radius);
Json cylinder_shape(double radius, double height);
Json capsule_shape(double radius, double height);
Json hull_shape(const std::vector<Vec3>& points);
Json mesh_shape(const TriangleMesh& mesh);

/// The turn that takes y to z: scenes have round shapes along y, others have them along z.
Quat y_to_z();

}  // namespace boxstream::imports
