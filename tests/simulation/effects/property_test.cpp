// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "gallery.hpp"

namespace boxstream::effects_test {
namespace {

/// Scenes of the gallery in one, in this order, as far as they fit.
nlohmann::json all_of(const std::vector<std::size_t>& parts) {
  nlohmann::json document = document_of("nothing");
  for (const std::size_t part : parts)
    if (auto both = merged(document, document_of(gallery()[part].name))) document = std::move(*both);
  return document;
}

/// Blocks of a scene that are lists of elements which call for something.
constexpr const char* blocks[] = {"bodies", "generators", "joints", "fields", "sensors", "queries", "soft_bodies"};

RC_GTEST_PROP(Plan, NeverLosesAnEffectWhenAnElementIsAdded, ()) {
  const auto parts = *rc::gen::container<std::vector<std::size_t>>(rc::gen::inRange<std::size_t>(0, gallery().size()));
  const nlohmann::json whole = all_of(parts);
  const Names with = on(effects::plan(scene_of(whole)));
  RC_CLASSIFY(with.size() > 6);
  for (const char* const block : blocks) {
    if (!whole.contains(block)) continue;
    nlohmann::json less = whole;
    less[block].erase(less[block].size() - 1);
    // What speaks of the element by name goes with it.
    if (block == std::string("bodies")) {
      less.erase("joints");
      less.erase("apart");
      less.erase("vehicles");
    }
    Names without = on(effects::plan(scene_of(less)));
    // A joint keeps its bodies from touching, and with that what contacts alone call for.
    if (block == std::string("joints"))
      for (const char* const effect : {"contacts", "friction", "anisotropic_friction", "rolling_friction",
                                       "spinning_friction", "restitution", "ccd_on_demand"})
        without.erase(effect);
    RC_ASSERT(std::includes(with.begin(), with.end(), without.begin(), without.end()));
    if (block == std::string("bodies")) continue;
    // Put back, and the plan is what it was.
    less[block].push_back(whole[block].back());
    RC_ASSERT(on(effects::plan(scene_of(less))) == with);
  }
}

RC_GTEST_PROP(Plan, GrowsWithEachSceneThatIsAdded, ()) {
  const auto parts = *rc::gen::container<std::vector<std::size_t>>(rc::gen::inRange<std::size_t>(0, gallery().size()));
  nlohmann::json document = document_of("nothing");
  Names before;
  for (const std::size_t part : parts) {
    auto both = merged(document, document_of(gallery()[part].name));
    if (!both) continue;
    document = std::move(*both);
    const Names after = on(effects::plan(scene_of(document)));
    RC_ASSERT(std::includes(after.begin(), after.end(), before.begin(), before.end()));
    const Names own = names_of(gallery()[part]);
    RC_ASSERT(std::includes(after.begin(), after.end(), own.begin(), own.end()));
    before = after;
  }
}

}  // namespace
}  // namespace boxstream::effects_test
