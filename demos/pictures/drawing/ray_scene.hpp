// SPDX-License-Identifier: MIT
#pragma once

#include <embree3/rtcore.h>

#include <memory>
#include <span>
#include <vector>

#include "drawable.hpp"

namespace boxstream::picture {

struct Surface {
  /// Linear light, not sRGB.
  Vec3 albedo;
  /// Unit; may point to either side.
  Vec3 normal;
  bool is_plane = false;
};

/// The drawables as an Embree scene. Round things stay exact spheres and round segments; the rest are triangles.
class RayScene {
 public:
  /// Planes are drawn out to `horizon` from their origin.
  RayScene(std::span<const Drawable> drawables, float horizon);

  RTCScene handle() const { return scene_.get(); }
  /// What the ray found at its hit; only for rays that hit this scene.
  Surface surface_at(unsigned geometry, unsigned primitive, float u, float v, Vec3 geometric_normal) const;

 private:
  struct DeviceDeleter {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
  };
  struct SceneDeleter {
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
  };
  struct Finish {
    Vec3 albedo;
    bool is_plane;
  };
  struct Builder;
  void throw_on_error() const;

  // Declared in this order because the scene must go before its device.
  std::unique_ptr<RTCDeviceTy, DeviceDeleter> device_;
  std::unique_ptr<RTCSceneTy, SceneDeleter> scene_;
  std::vector<Finish> finish_[3];
  std::vector<Vec3> corner_normals_;
};

}  // namespace boxstream::picture
