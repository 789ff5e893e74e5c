// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <numbers>
#include <stdexcept>

#include <console_bridge/console.h>
#include <urdf_parser/urdf_parser.h>

#include "import/readers.hpp"
#include "import/urdf_collision.hpp"

namespace boxstream::imports {
namespace {

constexpr std::size_t most_bytes = std::size_t{32} << 20;
constexpr std::size_t most_links = 10'000;

/// urdfdom says only to a log what is wrong; its first complaint is the nearest to the cause.
class FirstComplaint final : public console_bridge::OutputHandler {
 public:
  FirstComplaint() { console_bridge::useOutputHandler(this); }
  ~FirstComplaint() override { console_bridge::restorePreviousOutputHandler(); }
  FirstComplaint(const FirstComplaint&) = delete;
  FirstComplaint& operator=(const FirstComplaint&) = delete;

  void log(const std::string& line, console_bridge::LogLevel level, const char*, int) override {
    if (level >= console_bridge::CONSOLE_BRIDGE_LOG_ERROR && text.empty()) text = line;
  }

  std::string text;
};

/// urdfdom lets a link hang on two joints: then it may hang on itself, and walking down the tree has no end.
void check_is_tree(const urdf::ModelInterface& model) {
  std::map<std::string, std::string> joint_above;
  for (const auto& [name, joint] : model.joints_) {
    const auto [known, is_new] = joint_above.emplace(joint->child_link_name, name);
    if (!is_new)
      throw std::runtime_error("link \"" + joint->child_link_name + "\" hangs on two joints, \"" + known->second +
                               "\" and \"" + name + "\"");
  }
}

urdf::ModelInterfaceSharedPtr parse(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  if (text.size() > most_bytes) throw std::runtime_error("larger than 32 MiB");
  FirstComplaint complaint;
  urdf::ModelInterfaceSharedPtr model = urdf::parseURDF(text);
  // A link that it cannot read in full it leaves in the model all the same, empty from there on.
  if (!complaint.text.empty()) throw std::runtime_error("no URDF: " + complaint.text);
  if (!model || !model->getRoot()) throw std::runtime_error("no URDF");
  if (model->links_.size() > most_links) throw std::runtime_error("more than " + std::to_string(most_links) + " links");
  check_is_tree(*model);
  return model;
}

/// What a link hangs on: a body, or the world; things that cannot move hang on the world even if they have a body.
struct Carrier {
  std::optional<std::string> body;
  bool still = false;
};

class Robot {
 public:
  Robot(const std::string& path, const ImportOptions& options, Fragment& out)
      : collisions_(path, options), options_(options), out_(out) {}

  void add(const urdf::ModelInterface& model) {
    for (const auto& [name, motor] : options_.motors)
      if (!model.joints_.contains(name)) throw std::runtime_error("no joint called \"" + name + "\" for a motor");
    const urdf::Link& root = *model.getRoot();
    if (is_body(root)) {
      const Carrier base = add_body(root, Frame{}, options_.fixed_base);
      add_children(root, Frame{}, base);
    } else if (options_.fixed_base || root.name == "world") {
      add_children(root, Frame{}, Carrier{std::nullopt, true});
    } else {
      add_below_empty_root(root, Frame{});
    }
    for (const auto& [what, joints] : left_out_) out_.note(what + " of joint " + joints + ": left out");
    if (has_inertia_) out_.note("inertia tensors: left out, bodies have those of their shapes");
  }

 private:
  static bool has_mass(const urdf::Link& link) { return link.inertial && link.inertial->mass != 0; }
  static bool is_body(const urdf::Link& link) { return has_mass(link) || !link.collision_array.empty(); }

  static std::string quoted(const std::string& name) { return "\"" + name + "\""; }

  /// A root without mass or shape is a frame of reference; the one link fixed to it stands for it.
  void add_below_empty_root(const urdf::Link& root, const Frame& frame) {
    if (root.child_joints.size() != 1 || root.child_joints[0]->type != urdf::Joint::FIXED)
      throw std::runtime_error("root link " + quoted(root.name) +
                               " has neither mass nor collision shape, so nothing can hang on it unless it is fixed");
    const Frame below = frame.place(frame_of(root.child_joints[0]->parent_to_joint_origin_transform));
    const urdf::Link& link = *root.child_links[0];
    if (!is_body(link)) return add_below_empty_root(link, below);
    add_children(link, below, add_body(link, below, false));
  }

  void add_children(const urdf::Link& link, const Frame& frame, const Carrier& carrier) {
    for (std::size_t i = 0; i < link.child_joints.size(); ++i) {
      const urdf::Joint& joint = *link.child_joints[i];
      const urdf::Link& child = *link.child_links[i];
      const Frame below = frame.place(frame_of(joint.parent_to_joint_origin_transform));
      const bool fixed = joint.type == urdf::Joint::FIXED;
      if (!is_body(child)) {
        // A frame of reference: a tool centre, a camera.
        if (!fixed && !child.child_joints.empty())
          throw std::runtime_error("link " + quoted(child.name) +
                                   " has neither mass nor collision shape, but moves and carries others");
        if (!fixed) out_.note("joint " + quoted(joint.name) + " moves nothing that has a mass: left out");
        add_children(child, below, carrier);
      } else if (fixed && carrier.still) {
        add_children(child, below, add_body(child, below, true));
      } else {
        const Carrier body = add_body(child, below, false, is_driven(joint));
        add_joint(joint, below, *body.body, carrier);
        add_children(child, below, body);
      }
    }
  }

  bool is_driven(const urdf::Joint& joint) const {
    const auto found = options_.motors.find(joint.name);
    return found != options_.motors.end() && found->second.speed != 0;
  }

  /// Engines put what moves slowly to sleep, a driven link too; hence `awake`.
  Carrier add_body(const urdf::Link& link, const Frame& frame, bool still, bool awake = false) {
    BodyNote body;
    body.name = out_.free_name(link.name);
    const LinkSolid solid = collisions_.solid(link, still);
    body.shape = out_.add_pieces(body.name, solid.pieces);
    body.place = frame.place(Frame{solid.centre, {0, 0, 0, 1}});
    if (still) {
      body.more["type"] = "static";
    } else {
      body.mass = solid.mass;
      has_inertia_ = has_inertia_ || has_mass(link);
    }
    if (awake) body.more["sleep"] = false;
    if (!solid.touches) body.more["mask"] = 0;
    out_.add_body(body);
    return {body.name, still};
  }

  void add_joint(const urdf::Joint& joint, const Frame& frame, const std::string& child, const Carrier& carrier) {
    Json item = Json::object();
    std::optional<Vec3> axis = turned(frame.turn, vector(joint.axis));
    switch (joint.type) {
      case urdf::Joint::REVOLUTE:
      case urdf::Joint::CONTINUOUS:
        item["type"] = "hinge";
        break;
      case urdf::Joint::PRISMATIC:
        item["type"] = "slider";
        break;
      case urdf::Joint::FIXED:
        item["type"] = "fixed";
        axis.reset();
        break;
      case urdf::Joint::FLOATING:
        throw std::runtime_error("joint " + quoted(joint.name) + ": floating joints are not supported");
      case urdf::Joint::PLANAR:
        throw std::runtime_error("joint " + quoted(joint.name) + ": planar joints are not supported");
      default:
        throw std::runtime_error("joint " + quoted(joint.name) + ": unknown type");
    }
    if (axis) {
      put_limits(joint, item);
      put_motor(joint, item);
    }
    note_rest(joint);
    std::optional<std::string> parent;
    if (!carrier.still) parent = carrier.body;
    out_.add_joint(std::move(item), child, parent, frame.origin, axis);
    if (carrier.still && carrier.body) out_.set_apart(*carrier.body, child);
  }

  void put_limits(const urdf::Joint& joint, Json& item) {
    if (joint.type == urdf::Joint::CONTINUOUS || !joint.limits) return;
    double low = joint.limits->lower, high = joint.limits->upper;
    if (!(low <= high)) throw std::runtime_error("joint " + quoted(joint.name) + ": limits are not in ascending order");
    if (joint.type == urdf::Joint::REVOLUTE) {
      low *= 180 / std::numbers::pi;
      high *= 180 / std::numbers::pi;
      if (low < -180 || high > 180) {
        left_out("limits beyond half a turn", joint);
        return;
      }
    }
    item["limits"] = {low, high};
  }

  void put_motor(const urdf::Joint& joint, Json& item) const {
    if (const auto found = options_.motors.find(joint.name); found != options_.motors.end())
      item["motor"] = {{"speed", found->second.speed}, {"max_force", found->second.max_force}};
    else if (options_.hold && joint.limits && joint.limits->effort > 0)
      item["motor"] = {{"speed", 0}, {"max_force", joint.limits->effort}};
  }

  void note_rest(const urdf::Joint& joint) {
    if (joint.mimic) left_out("mimic", joint);
    if (joint.safety) left_out("safety controller", joint);
    if (joint.dynamics && joint.dynamics->damping != 0) left_out("damping", joint);
    if (joint.dynamics && joint.dynamics->friction != 0) left_out("friction", joint);
    if (joint.limits && joint.limits->velocity != 0) left_out("limit of speed", joint);
  }

  void left_out(const std::string& what, const urdf::Joint& joint) {
    std::string& joints = left_out_[what];
    if (!joints.empty()) joints += ", ";
    joints += quoted(joint.name);
  }

  UrdfCollisions collisions_;
  const ImportOptions& options_;
  Fragment& out_;
  std::map<std::string, std::string> left_out_;
  bool has_inertia_ = false;
};

}  // namespace

void read_urdf(const std::string& path, const ImportOptions& options, Fragment& out) {
  Robot(path, options, out).add(*parse(path));
}

}  // namespace boxstream::imports
