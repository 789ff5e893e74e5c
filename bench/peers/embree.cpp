// SPDX-License-Identifier: MIT
#include <embree3/rtcore.h>

#include <cstdint>
#include <memory>

#include "peers/cross.hpp"
#include "peers/peer.hpp"

namespace boxstream::bench {

namespace {

/// Embree on one thread.
class Device {
 public:
  Device() : device_(rtcNewDevice("threads=1,set_affinity=0")) {}
  ~Device() { rtcReleaseDevice(device_); }
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;
  RTCDevice get() const { return device_; }

 private:
  RTCDevice device_;
};

/// A scene whose primitives are boxes. The boxes are borrowed.
class Scene {
 public:
  Scene(const Device& device, Span<const Aabb> boxes) : boxes_(boxes), scene_(rtcNewScene(device.get())) {
    const RTCGeometry geometry = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(boxes.size()));
    rtcSetGeometryUserData(geometry, &boxes_);
    rtcSetGeometryBoundsFunction(geometry, bound, nullptr);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_LOW);
    rtcCommitScene(scene_);
  }
  ~Scene() { rtcReleaseScene(scene_); }
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;
  RTCScene get() const { return scene_; }

 private:
  static void bound(const RTCBoundsFunctionArguments* arguments) {
    const Aabb& box = (*static_cast<const Span<const Aabb>*>(arguments->geometryUserPtr))[arguments->primID];
    RTCBounds& out = *arguments->bounds_o;
    out.lower_x = box.min[0];
    out.lower_y = box.min[1];
    out.lower_z = box.min[2];
    out.upper_x = box.max[0];
    out.upper_y = box.max[1];
    out.upper_z = box.max[2];
  }

  Span<const Aabb> boxes_;
  RTCScene scene_;
};

/// Keeps those candidates that are pairs.
struct Collector {
  Span<const Aabb> a, b;
  bool self;
  std::vector<Pair>& pairs;

  static void collect(void* user, RTCCollision* collisions, unsigned count) {
    auto& collector = *static_cast<Collector*>(user);
    for (unsigned i = 0; i < count; ++i) collector.add(collisions[i].primID0, collisions[i].primID1);
  }

  // Of one scene with itself, both orders are reported, and each box with itself.
  void add(std::uint32_t i, std::uint32_t j) {
    if ((!self || i < j) && overlaps(a[i], b[j])) pairs.push_back({i, j});
  }
};

void collide(const Scene& first, const Scene& second, Collector& collector) {
  collector.pairs.clear();
  rtcCollide(first.get(), second.get(), Collector::collect, &collector);
}

/// The first search of a device starts its threads, which is not to be timed.
void warm_up(Peer& peer) {
  const Aabb boxes[2] = {{{0, 0, 0}, {1, 1, 1}}, {{1, 1, 1}, {2, 2, 2}}};
  std::vector<Pair> pairs;
  peer.find_pairs(boxes, pairs);
}

class EmbreePeer final : public Peer {
 public:
  EmbreePeer() { warm_up(*this); }

  void find_pairs(Span<const Aabb> boxes, std::vector<Pair>& pairs) override {
    pairs.clear();
    if (boxes.empty()) return;
    const Scene scene(device_, boxes);
    Collector collector{boxes, boxes, true, pairs};
    collide(scene, scene, collector);
  }

 private:
  Device device_;
};

}  // namespace

std::vector<PeerConfig> make_embree_peers() {
  std::vector<PeerConfig> peers;
  peers.push_back({"embree", "embree", 1, "", std::make_unique<EmbreePeer>()});
  return peers;
}

CrossSearch make_embree_cross() {
  return [device = std::make_shared<Device>()](Span<const Aabb> a, Span<const Aabb> b, std::vector<Pair>& pairs) {
    pairs.clear();
    if (a.empty() || b.empty()) return;
    const Scene first(*device, a), second(*device, b);
    Collector collector{a, b, false, pairs};
    collide(first, second, collector);
  };
}

}  // namespace boxstream::bench
