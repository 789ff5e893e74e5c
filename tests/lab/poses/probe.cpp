// SPDX-License-Identifier: MIT
// One hard pose, one manager, one solver of FCL; prints what happens as it happens, since FCL may end the program. Or
// all of them, each in a process of its own: then a JSON document for poses_table.py.
#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include <boxstream/fcl.hpp>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <exception>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "ask_ccd.hpp"
#include "fcl_objects.hpp"
#include "gaps.hpp"
#include "outcome.hpp"

namespace {

using namespace boxstream::poses;
using Object = ::fcl::CollisionObject<double>;
using Base = ::fcl::BroadPhaseCollisionManager<double>;

struct Asked {
  const HardPose* pose;
  const Object* a;
  ::fcl::GJKSolverType solver;
  int later_calls = 0;
};

void ask_distance(const Asked& asked, const Object* first, const Object* second) {
  ::fcl::DistanceRequest<double> request;
  request.gjk_solver_type = asked.solver;
  request.enable_signed_distance = asked.pose->query == Query::signed_distance;
  ::fcl::DistanceResult<double> result;
  ::fcl::distance(first, second, request, result);
  std::printf("distance %.17g\n", result.min_distance);
}

void ask_contact(const Asked& asked, const Object* first, const Object* second) {
  ::fcl::CollisionRequest<double> request(1, true);
  request.gjk_solver_type = asked.solver;
  ::fcl::CollisionResult<double> result;
  ::fcl::collide(first, second, request, result);
  const bool is_contact = result.isCollision();
  const double depth = is_contact ? result.getContact(0).penetration_depth : 0;
  std::printf("contact %d %.17g %.9g\n", is_contact, depth, is_contact ? result.getContact(0).normal.norm() : 0);
}

/// A distance query, since shapes that are apart come up in no other.
bool answer(Object* first, Object* second, void* data, double&) {
  const Asked& asked = *static_cast<Asked*>(data);
  std::printf("pair %d\n", first != asked.a);
  std::fflush(stdout);
  if (asked.pose->query == Query::contact)
    ask_contact(asked, first, second);
  else
    ask_distance(asked, first, second);
  std::fflush(stdout);
  return false;
}

bool count(Object*, Object*, void* data, double&) {
  ++static_cast<Asked*>(data)->later_calls;
  return false;
}

/// What FCL says after the place in its sources.
std::string first_reason(const std::string& what) {
  const std::string place = "inl.h:(";
  const std::size_t at = what.find(place);
  const std::size_t begin = at == std::string::npos ? 0 : what.find("): ", at) + 3;
  return what.substr(begin, what.find('\n', begin) - begin);
}

void ask(const HardPose& pose, Base& manager, Solver solver) {
  const auto a = object<double>(pose.a), b = object<double>(pose.b);
  manager.registerObject(a.get());
  manager.registerObject(b.get());
  manager.setup();
  Asked asked{&pose, a.get(), solver == Solver::libccd ? ::fcl::GST_LIBCCD : ::fcl::GST_INDEP};
  try {
    manager.distance(&asked, answer);
  } catch (const std::exception& error) {
    std::printf("threw %s\n", first_reason(error.what()).c_str());
  }
  manager.distance(&asked, count);
  std::printf("after %d\n", asked.later_calls);
}

nlohmann::json json_of(const Outcome& o) {
  nlohmann::json j{{"outcome", o.kind}, {"delivered", o.delivered}, {"in_order", o.in_order}, {"after", o.after}};
  if (!o.message.empty()) j["message"] = o.message;
  if (std::isfinite(o.value)) j["value"] = o.value;
  return j;
}

nlohmann::json report(const std::string& program, const HardPose& pose) {
  nlohmann::json j{{"name", pose.name},   {"row", pose.row},     {"source", pose.source}, {"own", pose.own},
                   {"truth", pose.truth}, {"known", pose.known}, {"a", text(pose.a)},     {"b", text(pose.b)}};
  static const char* const queries[] = {"distance", "signed distance", "contact"};
  j["query"] = queries[static_cast<int>(pose.query)];
  for (const Manager manager : {Manager::boxstream, Manager::native})
    for (const Solver solver : {Solver::libccd, Solver::indep})
      j[name(manager)][name(solver)] = json_of(run(program, pose, manager, solver));
  const Verdict ours = ask_ccd(pose.a, pose.b);
  j["ccd"] = {{"outcome", name(ours.kind)}, {"value", ours.value}, {"why", ours.why}};
  return j;
}

/// How often what came out, by the gap.
nlohmann::json count_gaps(const std::string& program) {
  nlohmann::json rows = nlohmann::json::array();
  for (const double gap : gaps) rows.push_back({{"gap", gap}});
  const auto count = [&](int index, const char* who, const std::string& outcome) {
    nlohmann::json& counts = rows[static_cast<std::size_t>(index) % gaps.size()][who];
    counts[outcome] = (counts.contains(outcome) ? counts[outcome].get<int>() : 0) + 1;
  };
  for (const Solver solver : {Solver::libccd, Solver::indep}) {
    std::cerr << gap_poses << " small gaps, " << name(solver) << "\n";
    const std::vector<Outcome> outcomes = run_gaps(program, solver);
    for (int i = 0; i < gap_poses; ++i) count(i, name(solver), outcomes[static_cast<std::size_t>(i)].kind);
  }
  for (int i = 0; i < gap_poses; ++i) {
    const HardPose pose = gap_pose(i);
    count(i, "ccd", name(ask_ccd(pose.a, pose.b).kind));
  }
  return rows;
}

int run_gaps_from(const std::string& solver, int first, int last) {
  for (int i = first; i < last; ++i) {
    std::puts("case");
    boxstream::fcl::CollisionManager<double> manager;
    ask(gap_pose(i), manager, solver == name(Solver::libccd) ? Solver::libccd : Solver::indep);
  }
  return 0;
}

int run_all(const std::string& program) {
  nlohmann::json poses = nlohmann::json::array();
  for (const HardPose& pose : all()) {
    std::cerr << poses.size() + 1 << "/" << all().size() << " " << pose.name << "\n";
    poses.push_back(report(program, pose));
  }
  std::cout << nlohmann::json{{"poses", poses}, {"gaps", count_gaps(program)}}.dump(1) << "\n";
  return 0;
}

int run_one(const std::string& pose_name, const std::string& manager, const std::string& solver) {
  for (const HardPose& pose : all()) {
    if (pose.name != pose_name) continue;
    const Solver chosen = solver == name(Solver::libccd) ? Solver::libccd : Solver::indep;
    if (manager == name(Manager::boxstream)) {
      boxstream::fcl::CollisionManager<double> ours;
      ask(pose, ours, chosen);
    } else {
      ::fcl::DynamicAABBTreeCollisionManager<double> tree;
      ask(pose, tree, chosen);
    }
    return 0;
  }
  std::cerr << "no pose is called " << pose_name << "\n";
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc == 2 && std::strcmp(argv[1], "--all") == 0) return run_all("/proc/self/exe");
    if (argc == 5 && std::strcmp(argv[1], "--gaps") == 0)
      return run_gaps_from(argv[2], std::stoi(argv[3]), std::stoi(argv[4]));
    if (argc == 4) return run_one(argv[1], argv[2], argv[3]);
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 2;
  }
  std::cerr << "usage: boxstream_pose_probe POSE boxstream|native libccd|indep\n"
               "       boxstream_pose_probe --gaps libccd|indep FIRST LAST\n"
               "       boxstream_pose_probe --all\n";
  return 2;
}
