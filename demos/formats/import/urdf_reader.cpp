// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <numbers>
#include <set>
#include <stdexcept>
#include <string_view>

#include <console_bridge/console.h>
#include <urdf_parser/urdf_parser.h>

#include "formats/import/import_file.hpp"
#include "formats/import/touching.hpp"
#include "formats/import/urdf_collision.hpp"
#include "formats/import/urdf_files.hpp"

namespace boxstream::imports {
namespace {

constexpr std::size_t most_text_bytes = std::size_t{32} << 20;
constexpr std::size_t most_links = 10'000;

/// What scenes take, in m and in N or N m. Files have larger numbers for joints without limits.
constexpr double farthest = 1e5, most_force = 1e9;

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
  // Links in a ring hang on each other, and not on the root: they would be left out.
  std::vector<const urdf::Link*> below{model.getRoot().get()};
  std::set<std::string> reached;
  while (!below.empty()) {
    const urdf::Link& link = *below.back();
    below.pop_back();
    reached.insert(link.name);
    for (const auto& child : link.child_links) below.push_back(child.get());
  }
  for (const auto& [name, link] : model.links_)
    if (!reached.contains(name))
      throw std::runtime_error("link \"" + name + "\" does not hang on the root link \"" + model.getRoot()->name +
                               "\"");
}

std::string text_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(file), {}};
  if (text.size() > most_text_bytes) throw std::runtime_error("larger than 32 MiB");
  return text;
}

std::string without_comments(const std::string& text) {
  std::string rest;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t begin = std::min(text.find("<!--", at), text.size());
    rest.append(text, at, begin - at);
    at = std::min(text.find("-->", begin), text.size() - 3) + 3;
  }
  return rest;
}

/// Whether an XML text without comments has an element that is begun by `tag`, as "<link".
bool has_element(const std::string& text, const std::string& tag) {
  for (std::size_t at = 0; (at = text.find(tag, at)) != text.npos;) {
    at += tag.size();
    // Other elements begin with the same letters.
    if (at < text.size() && std::string_view(" \t\r\n/>").find(text[at]) != std::string_view::npos) return true;
  }
  return false;
}

/// Elements of other programs, which say how links rub and bounce.
void note_extensions(const std::string& text, Fragment& out) {
  for (const std::string tag : {"<contact", "<gazebo"})
    if (has_element(text, tag)) out.note("elements " + tag + ">: left out");
}

urdf::ModelInterfaceSharedPtr parse(const std::string& text) {
  FirstComplaint complaint;
  urdf::ModelInterfaceSharedPtr model = urdf::parseURDF(with_capsules_as_meshes(text));
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
    for (const auto& [name, motor] : options_.motors) check_takes_motor(model, name);
    const urdf::Link& root = *model.getRoot();
    if (options_.fixed_base || root.name == "world") {
      add_still(root, Frame{}, std::nullopt);
    } else if (can_move(held_together(root))) {
      add_moving(root, Frame{}, nullptr, {});
    } else {
      out_.note("root link " + quoted(root.name) + " has no mass: it stands still, as a fixed base does");
      add_still(root, Frame{}, std::nullopt);
    }
    exclude_touching();
    for (const auto& [what, joints] : left_out_) out_.note(what + " of joint " + joints + ": left out");
    for (const auto& [what, names] : said_) out_.note(what + names);
  }

 private:
  static void check_takes_motor(const urdf::ModelInterface& model, const std::string& name) {
    const auto found = model.joints_.find(name);
    if (found == model.joints_.end()) throw std::runtime_error("no joint called " + quoted(name) + " for a motor");
    const bool is_floating = found->second->type == urdf::Joint::FLOATING;
    if (is_floating || is_fixed(*found->second))
      throw std::runtime_error("joint " + quoted(name) + " is " + (is_floating ? "floating" : "fixed") +
                               ": no motor moves it");
  }

  static bool is_body(const std::vector<Member>& members) {
    return std::any_of(members.begin(), members.end(), [](const Member& member) {
      return has_mass(*member.link) || !member.link->collision_array.empty();
    });
  }
  bool can_move(const std::vector<Member>& members) const {
    return std::any_of(members.begin(), members.end(), [&](const Member& member) {
      return has_mass(*member.link) || (options_.density && !member.link->collision_array.empty());
    });
  }

  static std::string quoted(const std::string& name) { return "\"" + name + "\""; }

  static bool is_fixed(const urdf::Joint& joint) { return joint.type == urdf::Joint::FIXED; }

  static Frame origin_of(const urdf::Joint& joint) { return frame_of(joint.parent_to_joint_origin_transform); }

  /// A link and what fixed joints hold to it. Links without mass and shape among them are frames of reference: a tool
  /// centre, a camera.
  static std::vector<Member> held_together(const urdf::Link& top) {
    std::vector<Member> members{{&top, Frame{}}};
    for (std::size_t next = 0; next < members.size(); ++next) {
      const Member member = members[next];
      for (std::size_t i = 0; i < member.link->child_joints.size(); ++i)
        if (const urdf::Joint& joint = *member.link->child_joints[i]; is_fixed(joint))
          members.push_back({member.link->child_links[i].get(), member.frame.place(origin_of(joint))});
    }
    return members;
  }

  /// Each link a static body.
  void add_still(const urdf::Link& link, const Frame& frame, std::optional<std::string> above) {
    if (!link.collision_array.empty()) above = add_still_body(link, frame);
    for (std::size_t i = 0; i < link.child_joints.size(); ++i) {
      const urdf::Joint& joint = *link.child_joints[i];
      const Frame below = frame.place(origin_of(joint));
      if (is_fixed(joint))
        add_still(*link.child_links[i], below, above);
      else
        add_moving(*link.child_links[i], below, &joint, {above, true});
    }
  }

  /// A link and what is fixed to it, as one body on a joint (none: it hangs on nothing), which is at `frame`.
  void add_moving(const urdf::Link& top, const Frame& frame, const urdf::Joint* joint, const Carrier& carrier) {
    const std::vector<Member> members = held_together(top);
    const Frame here = joint != nullptr ? frame.place(start_of(*joint)) : frame;
    Carrier body;
    if (is_body(members)) {
      body.body = add_body(members, here, joint != nullptr && is_driven(*joint));
      if (joint != nullptr && joint->type != urdf::Joint::FLOATING) add_joint(*joint, frame, *body.body, carrier);
    } else {
      out_.note("joint " + quoted(joint->name) + " moves nothing that has a mass: left out");
    }
    for (const Member& member : members) {
      for (std::size_t i = 0; i < member.link->child_joints.size(); ++i) {
        const urdf::Joint& next = *member.link->child_joints[i];
        if (is_fixed(next)) continue;
        if (!body.body)
          throw std::runtime_error("link " + quoted(top.name) +
                                   " has neither mass nor collision shape, but moves and carries others");
        add_moving(*member.link->child_links[i], here.place(member.frame).place(origin_of(next)), &next, body);
      }
    }
  }

  bool is_driven(const urdf::Joint& joint) const {
    const auto found = options_.motors.find(joint.name);
    return found != options_.motors.end() && found->second.speed != 0;
  }

  /// Engines put what moves slowly to sleep, a driven link too; hence `awake`.
  std::string add_body(const std::vector<Member>& members, const Frame& frame, bool awake) {
    BodyNote body;
    body.name = out_.free_name(members[0].link->name);
    const LinkSolid solid = collisions_.solid(members);
    body.shape = out_.add_pieces(body.name, solid.pieces);
    body.place = frame.place(solid.place);
    body.mass = solid.mass;
    if (solid.inertia)
      body.more["inertia"] = *solid.inertia;
    else if (has_any_mass(members))
      put_shape_inertia(body);
    if (awake) body.more["sleep"] = false;
    if (!solid.touches) body.more["mask"] = 0;
    out_.add_body(body);
    if (solid.touches) remember(body.name, {solid.pieces, body.place, false});
    return body.name;
  }

  std::string add_still_body(const urdf::Link& link, const Frame& frame) {
    BodyNote body;
    body.name = out_.free_name(link.name);
    const LinkSolid solid = collisions_.still_solid(link);
    body.shape = out_.add_pieces(body.name, solid.pieces);
    body.place = frame.place(solid.place);
    body.more["type"] = "static";
    out_.add_body(body);
    remember(body.name, {solid.pieces, body.place, true});
    return body.name;
  }

  /// The links say where the mass is, and their shapes how it is spread.
  void put_shape_inertia(BodyNote& body) {
    body.more["centre_of_mass"] = Vec3{};
    say("inertia that no body has, so that it is as its shapes say: link ", body.name);
  }

  static bool has_any_mass(const std::vector<Member>& members) {
    return std::any_of(members.begin(), members.end(), [](const Member& m) { return has_mass(*m.link); });
  }

  void add_joint(const urdf::Joint& joint, const Frame& frame, const std::string& child, const Carrier& carrier) {
    Json item = Json::object();
    switch (joint.type) {
      case urdf::Joint::REVOLUTE:
      case urdf::Joint::CONTINUOUS:
        item["type"] = "hinge";
        break;
      case urdf::Joint::PRISMATIC:
        item["type"] = "slider";
        break;
      case urdf::Joint::PLANAR:
        throw std::runtime_error("joint " + quoted(joint.name) + ": planar joints are not supported");
      default:
        throw std::runtime_error("joint " + quoted(joint.name) + ": unknown type");
    }
    put_limits(joint, item);
    put_motor(joint, item);
    note_rest(joint);
    std::optional<std::string> parent;
    if (!carrier.still) parent = carrier.body;
    const Vec3 pivot = frame.place(start_of(joint)).origin;
    out_.add_joint(std::move(item), child, parent, pivot, turned(frame.turn, vector(joint.axis)));
    if (!carrier.body) return;
    if (carrier.still) out_.exclude(*carrier.body, child);
    joined_.insert(std::minmax(*carrier.body, child));
  }

  static bool is_limited(const urdf::Joint& joint) {
    return joint.limits && (joint.type == urdf::Joint::REVOLUTE || joint.type == urdf::Joint::PRISMATIC);
  }

  /// Where the joint is at the start: at 0, or in the middle of limits that 0 is not within, as ROS has it.
  double position_of(const urdf::Joint& joint) {
    if (!is_limited(joint)) return 0;
    const double low = joint.limits->lower, high = joint.limits->upper;
    if (!(low <= high)) throw std::runtime_error("joint " + quoted(joint.name) + ": limits are not in ascending order");
    if (low <= 0 && high >= 0) return 0;
    say("starts in the middle of its limits, which 0 is not within: joint ", joint.name);
    return low + (high - low) / 2;
  }

  Frame start_of(const urdf::Joint& joint) {
    const double position = position_of(joint);
    const Vec3 along = vector(joint.axis);
    const double length = std::sqrt(dot(along, along));
    if (position == 0 || !(length > 0)) return {};
    const Vec3 axis = times(along, 1 / length);
    if (joint.type == urdf::Joint::PRISMATIC) return {times(axis, position), {0, 0, 0, 1}};
    const Vec3 v = times(axis, std::sin(position / 2));
    return {{}, {v[0], v[1], v[2], std::cos(position / 2)}};
  }

  /// Scenes count from where joints are at the start.
  void put_limits(const urdf::Joint& joint, Json& item) {
    if (!is_limited(joint)) return;
    const double start = position_of(joint);
    double low = joint.limits->lower - start, high = joint.limits->upper - start;
    if (joint.type == urdf::Joint::REVOLUTE) {
      low *= 180 / std::numbers::pi;
      high *= 180 / std::numbers::pi;
      if (low < -180 || high > 180) {
        left_out("limits beyond half a turn", joint);
        return;
      }
    } else if (low < -farthest && high > farthest) {
      left_out("limits beyond 100 km", joint);
      return;
    } else {
      // The other end may be a stop that the joint meets.
      low = std::max(low, -farthest);
      high = std::min(high, farthest);
    }
    item["limits"] = {low, high};
  }

  void put_motor(const urdf::Joint& joint, Json& item) {
    if (const auto found = options_.motors.find(joint.name); found != options_.motors.end()) {
      item["motor"] = {{"speed", found->second.speed}, {"max_force", found->second.max_force}};
    } else if (options_.hold) {
      constexpr double plenty = 1e5;  // N m or N
      const bool has_effort = joint.limits && joint.limits->effort > 0;
      if (!has_effort) say("held with more than enough, for it has no effort: joint ", joint.name);
      item["motor"] = {{"speed", 0}, {"max_force", has_effort ? std::min(joint.limits->effort, most_force) : plenty}};
    }
  }

  void note_rest(const urdf::Joint& joint) {
    if (joint.mimic) left_out("mimic", joint);
    if (joint.safety) left_out("safety controller", joint);
    if (joint.dynamics && joint.dynamics->damping != 0) left_out("damping", joint);
    if (joint.dynamics && joint.dynamics->friction != 0) left_out("friction", joint);
    if (joint.limits && joint.limits->velocity != 0) left_out("limit of speed", joint);
  }

  void left_out(const std::string& what, const urdf::Joint& joint) { add_name(left_out_[what], joint.name); }

  void say(const std::string& what, const std::string& name) { add_name(said_[what], name); }

  /// Once, however often it is said.
  static void add_name(std::string& names, const std::string& name) {
    if ((", " + names + ",").find(", " + quoted(name) + ",") != std::string::npos) return;
    if (!names.empty()) names += ", ";
    names += quoted(name);
  }

  void remember(const std::string& name, Placed placed) {
    names_.push_back(name);
    placed_.push_back(std::move(placed));
  }

  /// Links that overlap at the start would be pushed away from each other.
  void exclude_touching() {
    std::string names;
    for (const auto& [i, j] : touching(placed_)) {
      if (joined_.contains(std::minmax(names_[i], names_[j]))) continue;
      out_.exclude(names_[i], names_[j]);
      if (!names.empty()) names += ", ";
      names += quoted(names_[i]) + " and " + quoted(names_[j]);
    }
    if (!names.empty()) out_.note("links that touch at the start pass through each other: " + names);
  }

  UrdfCollisions collisions_;
  const ImportOptions& options_;
  Fragment& out_;
  std::map<std::string, std::string> left_out_;
  std::map<std::string, std::string> said_;
  std::vector<std::string> names_;
  std::vector<Placed> placed_;
  std::set<std::pair<std::string, std::string>> joined_;
};

}  // namespace

void read_urdf(const std::string& path, const ImportOptions& options, Fragment& out) {
  const std::string text = text_of(path);
  Robot(path, options, out).add(*parse(text));
  note_extensions(without_comments(text), out);
}

}  // namespace boxstream::imports
