# SPDX-License-Identifier: MIT
# Half of the time of compiling goes into reading headers of other libraries. With this option each of the larger targets
# reads those that most of its files include once. The sanitized presets switch it on; the release preset does without,
# so that every file is known to include what it needs.
option(BOXSTREAM_PRECOMPILE "Precompile headers of other libraries for demos and tests" OFF)

function(boxstream_precompile target)
  if(BOXSTREAM_PRECOMPILE AND TARGET ${target})
    target_precompile_headers(${target} PRIVATE <algorithm> <cmath> <memory> <optional> <string> <vector> ${ARGN})
  endif()
endfunction()

set(json <nlohmann/json.hpp>)
set(format <fmt/format.h>)
set(bullet <btBulletDynamicsCommon.h> <BulletCollision/CollisionDispatch/btGhostObject.h>
  <BulletSoftBody/btSoftRigidDynamicsWorld.h>)
set(gtest <gtest/gtest.h>)
set(fcl <fcl/narrowphase/collision.h> <fcl/narrowphase/distance.h> <fcl/broadphase/broadphase_dynamic_AABB_tree.h>)

boxstream_precompile(boxstream_effects ${bullet})
boxstream_precompile(boxstream_engine ${bullet})
boxstream_precompile(boxstream_import ${bullet} ${json})
boxstream_precompile(boxstream_query ${fcl})
boxstream_precompile(boxstream_scenes ${json} ${format})
boxstream_precompile(boxstream_simulation ${bullet} ${format})
boxstream_precompile(boxstream_tool_parts ${json} ${format})
boxstream_precompile(boxstream_view ${bullet} ${json} ${format})

boxstream_precompile(boxstream_ccd_tests ${gtest})
boxstream_precompile(boxstream_core_test ${gtest})
boxstream_precompile(boxstream_effects_test ${gtest} ${bullet})
boxstream_precompile(boxstream_import_test ${gtest} ${json})
boxstream_precompile(boxstream_scenes_test ${gtest} ${bullet})
boxstream_precompile(boxstream_tool_tests ${gtest} ${json})
boxstream_precompile(boxstream_view_test ${gtest} ${json})
boxstream_precompile(boxstream_world_test ${gtest})
boxstream_precompile(bullet_tests ${gtest} ${bullet})
boxstream_precompile(bullet_float64_tests ${gtest} ${bullet})
boxstream_precompile(fcl_tests ${gtest} ${fcl})
