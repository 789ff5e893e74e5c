// SPDX-License-Identifier: MIT
//
// Boxes and spheres fall onto a plane, simulated by the Open Dynamics Engine with contacts between the pairs that
// ode::Space finds. Each of ODE's own spaces finds the pairs of the same geoms beside it, and has to find the same, but
// for pairs that do not touch: dSweepAndPruneSpace pairs what is unbounded, as the plane, with all others.
#include <ode/ode.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "examples/ode/space.hpp"

namespace {

using GeomPair = std::pair<dGeomID, dGeomID>;

bool touch_on(const dReal* a, const dReal* b) {
  return a[0] <= b[1] && b[0] <= a[1];
}

bool boxes_touch(const GeomPair& pair) {
  dReal a[6], b[6];
  dGeomGetAABB(pair.first, a);
  dGeomGetAABB(pair.second, b);
  return touch_on(a, b) && touch_on(a + 2, b + 2) && touch_on(a + 4, b + 4);
}

/// Collects the pairs of one pass, the lesser address first.
void collect(void* pairs, dGeomID a, dGeomID b) {
  static_cast<std::vector<GeomPair>*>(pairs)->push_back(std::minmax(a, b));
}

double milliseconds(const auto& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

/// Bodies in layers above a plane, in a space of ODE's and in one of ours.
class Scene {
 public:
  Scene(int bodies, dSpaceID native) : native_(native) {
    dWorldSetGravity(world_, 0, 0, dReal(-9.81));
    add(dCreatePlane(native_, 0, 0, 1, 0));
    const int side = std::max(1, static_cast<int>(std::cbrt(bodies)));
    for (int i = 0; i < bodies; ++i) add_body(i, i % side, i / side % side, i / side / side);
  }
  ~Scene() {
    for (const dGeomID geom : geoms_) ours_.remove(geom);
    dSpaceDestroy(native_);
    dJointGroupDestroy(contacts_);
    dWorldDestroy(world_);
  }
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  /// Finds the pairs twice, and steps with contacts between them. False if they differ.
  bool step() {
    dReal bounds[6];
    for (const dGeomID geom : geoms_) dGeomGetAABB(geom, bounds);  // ODE computes it anew here, for both
    native_pairs.clear();
    native_ms += milliseconds([&] { dSpaceCollide(native_, &native_pairs, &collect); });
    our_pairs.clear();
    our_ms += milliseconds([&] {
      ours_.update();
      ours_.collide(&our_pairs, &collect);
    });
    std::erase_if(native_pairs, [](const GeomPair& pair) { return !boxes_touch(pair); });
    for (const GeomPair& pair : our_pairs) touch(pair);
    dWorldQuickStep(world_, dReal(0.01));
    dJointGroupEmpty(contacts_);
    std::sort(native_pairs.begin(), native_pairs.end());
    std::sort(our_pairs.begin(), our_pairs.end());
    return native_pairs == our_pairs;
  }

  std::vector<GeomPair> native_pairs, our_pairs;
  double native_ms = 0, our_ms = 0;

 private:
  void add(dGeomID geom) {
    geoms_.push_back(geom);
    ours_.add(geom);
  }

  void add_body(int i, int x, int y, int z) {
    const dBodyID body = dBodyCreate(world_);
    const dReal lean = dReal(0.05) * (i % 7);
    dBodySetPosition(body, dReal(1.2) * x + lean, dReal(1.2) * y - lean, 1 + dReal(1.1) * z);
    dMass mass;
    dMassSetBoxTotal(&mass, 1, 1, 1, 1);
    dBodySetMass(body, &mass);
    const dGeomID geom = i % 3 == 0 ? dCreateSphere(native_, dReal(0.5)) : dCreateBox(native_, 1, 1, 1);
    dGeomSetBody(geom, body);
    add(geom);
  }

  void touch(const GeomPair& pair) {
    constexpr int most = 4;
    dContact contacts[most] = {};
    const int found = dCollide(pair.first, pair.second, most, &contacts[0].geom, sizeof(dContact));
    for (int i = 0; i < found; ++i) {
      contacts[i].surface.mode = dContactApprox1;
      contacts[i].surface.mu = dReal(0.6);
      dJointAttach(dJointCreateContact(world_, contacts_, &contacts[i]), dGeomGetBody(pair.first),
                   dGeomGetBody(pair.second));
    }
  }

  dWorldID world_ = dWorldCreate();
  dJointGroupID contacts_ = dJointGroupCreate(0);
  dSpaceID native_;
  boxstream::ode::Space ours_;
  std::vector<dGeomID> geoms_;
};

bool run(const char* name, dSpaceID native, int bodies, int steps) {
  Scene scene(bodies, native);
  std::size_t pairs = 0;
  for (int step = 0; step < steps; ++step) {
    if (!scene.step()) {
      std::printf("%-20s differs in step %d: %zu pairs, ours %zu\n", name, step, scene.native_pairs.size(),
                  scene.our_pairs.size());
      return false;
    }
    pairs = scene.our_pairs.size();
  }
  std::printf("%-20s %8zu %12.3f %12.3f %8.2f\n", name, pairs, scene.native_ms / steps, scene.our_ms / steps,
              scene.native_ms / scene.our_ms);
  return true;
}

int usage(std::FILE* out) {
  std::fputs(
      "usage: boxstream_ode_falls [BODIES [STEPS]]\n"
      "Bodies (500) fall for some steps (200) of 10 ms in the Open Dynamics Engine, with boxstream as its broad-phase\n"
      "and each of ODE's own beside it. Prints the pairs of the last step and milliseconds a step.\n"
      "Exit code 0: all found the same pairs in every step; 1: some did not; 2: bad arguments.\n",
      out);
  return out == stdout ? 0 : 2;
}

}  // namespace

int main(int argc, char** argv) {
  int counts[2] = {500, 200};
  for (int i = 1; i < argc; ++i) {
    char* end = nullptr;
    if (std::strcmp(argv[i], "--help") == 0 || std::strcmp(argv[i], "-h") == 0) return usage(stdout);
    if (i > 2) return usage(stderr);
    const long count = std::strtol(argv[i], &end, 10);
    if (*end != '\0' || count < 1 || count > 1000000) return usage(stderr);
    counts[i - 1] = static_cast<int>(count);
  }
  dInitODE();
  std::printf("%-20s %8s %12s %12s %8s\n", "space of ODE", "pairs", "its ms", "ours", "ratio");
  const dVector3 center = {0, 0, 0}, extents = {64, 64, 64};
  bool same = run("simple", dSimpleSpaceCreate(nullptr), counts[0], counts[1]);
  same &= run("hash", dHashSpaceCreate(nullptr), counts[0], counts[1]);
  same &= run("sweep and prune", dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XYZ), counts[0], counts[1]);
  same &= run("quad tree", dQuadTreeSpaceCreate(nullptr, center, extents, 6), counts[0], counts[1]);
  dCloseODE();
  return same ? 0 : 1;
}
