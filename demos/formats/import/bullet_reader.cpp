// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include <BulletFileLoader/btBulletFile.h>
#include <BulletWorldImporter/btBulletWorldImporter.h>

#include "formats/import/bullet_parts.hpp"
#include "formats/import/import_file.hpp"

namespace boxstream::imports {
namespace {

constexpr std::size_t most_file_bytes = std::size_t{256} << 20;

/// "BULLETf-v324": precision, size of pointers, order of bytes, version. Then the first block.
void check_header(const std::vector<char>& bytes) {
  constexpr std::size_t header = 12, smallest_block = 20;
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  const std::string_view text(bytes.data(), std::min(bytes.size(), header));
  const bool right = text.size() == header && text.starts_with("BULLET") && (text[6] == 'f' || text[6] == 'd') &&
                     (text[7] == '-' || text[7] == '_') && (text[8] == 'v' || text[8] == 'V') &&
                     std::all_of(text.begin() + 9, text.end(), is_digit);
  if (!right) throw std::runtime_error("no .bullet file: it does not begin like one");
  if (bytes.size() < header + smallest_block) throw std::runtime_error("cut off after its header");
}

/// Bullet's importer, whose objects stand in no world. It leaves velocities, damping and filters behind; they are taken
/// from the file's own records.
class Importer final : public btBulletWorldImporter {
 public:
  btRigidBody* body_of(const void* record) {
    btCollisionObject** const found = m_bodyMap.find(btHashPtr(record));
    return found != nullptr ? btRigidBody::upcast(*found) : nullptr;
  }
  void setDynamicsWorldInfo(const btVector3& value, const btContactSolverInfo&) override { gravity = vector(value); }

  std::optional<Vec3> gravity;
};

template <class Record>
Vec3 vector_of(const Record& v) {
  return {double{v.m_floats[0]}, double{v.m_floats[1]}, double{v.m_floats[2]}};
}

class World {
 public:
  World(const std::string& path, Fragment& out) : path_(path), out_(out) {}

  template <class BodyRecord, class ConstraintRecord>
  void add(Importer& importer, bParse::btBulletFile& file) {
    if (importer.gravity) out_.set_gravity(*importer.gravity);
    for (int i = 0; i < file.m_rigidBodies.size(); ++i) {
      const auto& record = *reinterpret_cast<const BodyRecord*>(file.m_rigidBodies[i]);
      if (btRigidBody* const body = importer.body_of(&record))
        add_body(*body, record);
      else
        ++left_out_["bodies without a shape, or with one of a kind that the importer does not support"];
    }

    if (bodies_.empty()) throw std::runtime_error("no bodies in it that scenes can have");

    // One by one as long as the importer took all of them: then the flag is that of the same constraint.
    const int constraints = importer.getNumConstraints();
    const bool in_step = constraints == file.m_constraints.size();
    if (!in_step)
      left_out_["constraints that the importer does not support"] += file.m_constraints.size() - constraints;
    for (int i = 0; i < constraints; ++i) {
      const auto* const record = in_step ? reinterpret_cast<const ConstraintRecord*>(file.m_constraints[i]) : nullptr;
      const bool collide = record != nullptr && record->m_disableCollisionsBetweenLinkedBodies == 0;
      add_constraint(*importer.getConstraintByIndex(i), collide, bodies_, out_, left_out_);
    }
    count_rest(file);
    for (const auto& [what, count] : left_out_)
      if (count > 0) out_.note(what + ": " + std::to_string(count) + " left out");
  }

 private:
  template <class Record>
  void add_body(const btRigidBody& body, const Record& record) {
    const auto& object = record.m_collisionObjectData;
    const bool kinematic = (object.m_collisionFlags & btCollisionObject::CF_KINEMATIC_OBJECT) != 0;
    const double inverse_mass = double{record.m_inverseMass};
    const bool dynamic = inverse_mass != 0 && !kinematic && !body.getCollisionShape()->isNonMoving();
    BodyNote note;
    try {
      note.shape = shape_of(*body.getCollisionShape());
    } catch (const std::runtime_error& error) {
      ++left_out_[std::string("bodies of ") + error.what()];
      return;
    }
    note.name = out_.free_name(object.m_name != nullptr ? object.m_name : "body");
    note.place = frame_of(body.getWorldTransform());
    if (dynamic) {
      note.mass = 1 / inverse_mass;
      put_inertia(vector_of(record.m_invInertiaLocal), note);
    } else {
      note.more["type"] = kinematic ? "kinematic" : "static";
    }
    note.more["material"] = material_of(object);
    if (dynamic || kinematic) {
      note.more["velocity"] = vector_of(record.m_linearVelocity);
      note.more["spin"] = vector_of(record.m_angularVelocity);
      note.more["linear_damping"] = double{record.m_linearDamping};
      note.more["angular_damping"] = double{record.m_angularDamping};
      if (object.m_activationState1 == DISABLE_DEACTIVATION) note.more["sleep"] = false;
      if (object.m_ccdMotionThreshold > 0 && object.m_ccdSweptSphereRadius > 0)
        note.more["ccd"] = {{"threshold", double{object.m_ccdMotionThreshold}},
                            {"radius", double{object.m_ccdSweptSphereRadius}}};
    }
    put_filter(object, dynamic, note);
    count_unknown(record, dynamic);
    out_.add_body(note);
    bodies_.emplace(&body, KnownBody{note.name, !dynamic && !kinematic});
  }

  std::string shape_of(const btCollisionShape& shape) {
    if (const auto known = shapes_.find(&shape); known != shapes_.end()) return known->second;
    const std::string wish = shape.getName();
    const std::optional<Json> fixed = fixed_shape(path_, shape);
    const std::string name = fixed ? out_.add_shape(wish, *fixed) : out_.add_pieces(wish, convex_pieces(shape));
    return shapes_.emplace(&shape, name).first->second;
  }

  template <class Object>
  std::string material_of(const Object& object) {
    const Json material{{"friction", double{object.m_friction}},
                        {"rolling", double{object.m_rollingFriction}},
                        {"restitution", double{object.m_restitution}}};
    const std::string key = material.dump();
    const auto [known, added] = materials_.try_emplace(key, "material " + std::to_string(materials_.size()));
    if (added) out_.add_material(known->second, material);
    return known->second;
  }

  /// Bullet has bodies where their centre of mass is, with moments about their own axes. A body that does not turn at
  /// all has none: it is then as hard to turn as its shape.
  void put_inertia(const Vec3& inverse, BodyNote& note) {
    constexpr double least = 1e-15;  // of what scenes have
    if (inverse[0] > least && inverse[1] > least && inverse[2] > least) {
      note.more["inertia"] = {1 / inverse[0], 1 / inverse[1], 1 / inverse[2]};
      return;
    }
    note.more["centre_of_mass"] = Vec3{};
    ++left_out_["bodies without inertia (they have that of their shapes)"];
  }

  /// Files hold filters only of bodies that are in a world.
  template <class Object>
  static void put_filter(const Object& object, bool dynamic, BodyNote& note) {
    const int group = object.m_collisionFilterGroup, mask = object.m_collisionFilterMask;
    const int usual_group = dynamic ? btBroadphaseProxy::DefaultFilter : btBroadphaseProxy::StaticFilter;
    const int usual_mask =
        dynamic ? btBroadphaseProxy::AllFilter : btBroadphaseProxy::AllFilter ^ btBroadphaseProxy::StaticFilter;
    if (group == 0 || (group == usual_group && mask == usual_mask)) return;
    constexpr int bits_of_scenes = 0x7fffffff;
    note.more["group"] = group & bits_of_scenes;
    note.more["mask"] = mask & bits_of_scenes;
  }

  template <class Record>
  void count_unknown(const Record& record, bool dynamic) {
    const auto& object = record.m_collisionObjectData;
    const auto differs = [](const Vec3& v, const Vec3& w) { return dot(minus(v, w), minus(v, w)) > 1e-8; };
    if ((object.m_collisionFlags & btCollisionObject::CF_NO_CONTACT_RESPONSE) != 0)
      ++left_out_["flags of bodies that nothing bounces off"];
    if (object.m_hasAnisotropicFriction != 0) ++left_out_["anisotropic frictions"];
    if (!dynamic) return;
    if (object.m_activationState1 == ISLAND_SLEEPING) ++left_out_["states of bodies that sleep"];
    if (differs(vector_of(record.m_linearFactor), {1, 1, 1}) || differs(vector_of(record.m_angularFactor), {1, 1, 1}))
      ++left_out_["linear or angular factors of bodies"];
  }

  void count_rest(const bParse::btBulletFile& file) {
    left_out_["soft bodies"] += file.m_softBodies.size();
    left_out_["multi-bodies"] += file.m_multiBodies.size();
    left_out_["colliders of multi-bodies"] += file.m_multiBodyLinkColliders.size();
    left_out_["collision objects that are no bodies"] += file.m_collisionObjects.size();
  }

  const std::string& path_;
  Fragment& out_;
  LeftOut left_out_;
  KnownBodies bodies_;
  std::map<const btCollisionShape*, std::string> shapes_;
  std::map<std::string, std::string> materials_;
};

}  // namespace

void read_bullet(const std::string& path, Fragment& out) {
  std::ifstream stream(path, std::ios::binary);
  std::vector<char> bytes{std::istreambuf_iterator<char>(stream), {}};
  if (bytes.size() > most_file_bytes) throw std::runtime_error("larger than 256 MiB");
  check_header(bytes);
  bParse::btBulletFile file(bytes.data(), static_cast<int>(bytes.size()));
  Importer importer;
  if (!file.ok() || !importer.loadFileFromMemory(&file)) throw std::runtime_error("Bullet's importer refuses it");
  World world(path, out);
  if ((file.getFlags() & bParse::FD_DOUBLE_PRECISION) != 0)
    world.add<btRigidBodyDoubleData, btTypedConstraintDoubleData>(importer, file);
  else
    world.add<btRigidBodyFloatData, btTypedConstraintFloatData>(importer, file);
}

}  // namespace boxstream::imports
