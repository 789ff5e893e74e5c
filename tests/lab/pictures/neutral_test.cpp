// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <sstream>

#include "mixed.hpp"
#include "pictures/viewer/film.hpp"
#include "pictures/viewer/page.hpp"
#include "pictures/viewer/recording.hpp"

namespace boxstream::view {
namespace {

TEST(Recordings, ChangeNothing) {
  const scenes::Scene scene = view_test::mixed_scene();
  constexpr int steps = 80;
  for (const char* const broadphase : {"boxstream", "dbvt"}) {
    scenes::Simulation alone(scene, broadphase);
    scenes::Simulation watched(scene, broadphase);
    Film film(watched, {steps, 0, "test"});
    Recording recording(watched, {steps});
    std::vector<scenes::StepResult> results;
    for (int i = 0; i < steps; ++i) {
      const scenes::StepResult expected = alone.step();
      const scenes::StepResult result = watched.step();
      film.add_step();
      recording.add_step();
      results.push_back(result);
      ASSERT_EQ(result.state_hash, expected.state_hash) << broadphase << ", step " << i + 1;
      ASSERT_EQ(watched.pairs(), alone.pairs());
    }
    std::ostringstream out;
    film.write(out);
    recording.finish();
    write_page(out, {{&recording, "", &results}}, "test");
    EXPECT_EQ(watched.state_hash(), alone.state_hash());
  }
}

}  // namespace
}  // namespace boxstream::view
