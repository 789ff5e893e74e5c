// SPDX-License-Identifier: MIT
#include "simulation/query/managers.hpp"

#include <fcl/broadphase/broadphase_SSaP.h>
#include <fcl/broadphase/broadphase_SaP.h>
#include <fcl/broadphase/broadphase_bruteforce.h>
#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/broadphase/broadphase_dynamic_AABB_tree_array.h>
#include <fcl/broadphase/broadphase_interval_tree.h>
#include <fcl/broadphase/broadphase_spatialhash.h>

#include <boxstream/fcl.hpp>
#include <boxstream/fcl/tight_box.hpp>
#include <functional>
#include <stdexcept>
#include <vector>

#include "simulation/query/run.hpp"

namespace boxstream::query {
namespace {

struct Named {
  std::string name;
  std::function<std::unique_ptr<Manager>(const Extent&)> make;
};

template <template <class> class Kind>
Named plain(const char* name) {
  return {name, [](const Extent&) { return std::make_unique<Kind<double>>(); }};
}

std::unique_ptr<Manager> make_tight(const Extent& extent) {
  auto manager = std::make_unique<boxstream::fcl::CollisionManager<double>>();
  manager->setBoxSource(&boxstream::fcl::tightBox<double>);
  manager->setMargin(extent.margin);
  return manager;
}

/// Pairs by the paper's tree.
std::unique_ptr<Manager> make_hybrid(const Extent&) {
  DetectorOptions options;
  options.method = Method::hybrid;
  return std::make_unique<boxstream::fcl::CollisionManager<double>>(options);
}

/// Cells of two mean sides. Objects beyond the limits are held against all others, hence the room.
std::unique_ptr<Manager> make_hash(const Extent& extent) {
  const Eigen::Vector3d room = 0.5 * (extent.all.max_ - extent.all.min_) + Eigen::Vector3d::Constant(extent.mean_side);
  return std::make_unique<::fcl::SpatialHashingCollisionManager<double>>(
      2 * extent.mean_side, extent.all.min_ - room, extent.all.max_ + room,
      static_cast<unsigned>(std::max<std::size_t>(1, extent.objects)));
}

const std::vector<Named>& managers() {
  static const std::vector<Named> all{
      {"boxstream", [](const Extent&) { return std::make_unique<boxstream::fcl::CollisionManager<double>>(); }},
      {"boxstream_tight", make_tight},
      {"hybrid", make_hybrid},
      plain<::fcl::DynamicAABBTreeCollisionManager>("tree"),
      plain<::fcl::DynamicAABBTreeCollisionManager_Array>("tree_array"),
      plain<::fcl::SSaPCollisionManager>("ssap"),
      plain<::fcl::SaPCollisionManager>("sap"),
      plain<::fcl::IntervalTreeCollisionManager>("interval"),
      {"hash", make_hash},
      plain<::fcl::NaiveCollisionManager>("naive")};
  return all;
}

}  // namespace

const std::vector<std::string>& manager_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const Named& manager : managers()) list.push_back(manager.name);
    return list;
  }();
  return names;
}

std::unique_ptr<Manager> make_manager(const std::string& name, const Extent& extent) {
  for (const Named& manager : managers())
    if (manager.name == name) return manager.make(extent);
  throw std::invalid_argument("no manager called " + name);
}

bool updates_lists(const std::string& name) {
  return name != "interval";
}

}  // namespace boxstream::query
