// SPDX-License-Identifier: MIT
#include "ray_scene.hpp"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <string>

#include "pictures/solids/surface.hpp"
#include "set_dressing.hpp"

namespace boxstream::picture {
namespace {

// Embree's geometry ids, given by hand so that they index `finish_`.
enum GeometryId : unsigned { triangle_id, sphere_id, segment_id };

float to_linear(float channel) {
  return channel <= 0.04045F ? channel / 12.92F : std::pow((channel + 0.055F) / 1.055F, 2.4F);
}

// Enough that the outline of a cylinder looks round at the size of a picture.
constexpr int round_segments = 28;

solids::Point to_point(Vec3 v) {
  return {v.x, v.y, v.z};
}

Vec3 to_vec(const solids::Point& p) {
  return {p[0], p[1], p[2]};
}

struct PointRadius {
  float x, y, z, radius;
};

}  // namespace

/// Sorts the drawables into one list a geometry kind.
struct RayScene::Builder {
  RayScene& owner;
  float horizon;
  std::vector<Vec3> vertices;
  std::vector<PointRadius> spheres;
  std::vector<PointRadius> segment_ends;

  void add(const Drawable& d) {
    const bool is_plane = std::holds_alternative<Plane>(d.shape);
    const bool finite = is_finite(d.transform.column[0]) && is_finite(d.transform.column[1]) &&
                        is_finite(d.transform.column[2]) && is_finite(d.transform.origin);
    if (!finite || (!is_plane && !bounding_ball(d))) return;
    const Finish finish{{to_linear(d.colour.r), to_linear(d.colour.g), to_linear(d.colour.b)}, is_plane};
    std::visit([&](const auto& shape) { add_shape(shape, d.transform, finish); }, d.shape);
  }

  void add_shape(const Sphere& s, const Transform& t, const Finish& finish) {
    spheres.push_back({t.origin.x, t.origin.y, t.origin.z, s.radius});
    owner.finish_[sphere_id].push_back(finish);
  }
  void add_shape(const Capsule& s, const Transform& t, const Finish& finish) {
    for (const float side : {-1.0F, 1.0F}) {
      const Vec3 p = t.origin + t.column[s.axis] * (side * s.half_length);
      segment_ends.push_back({p.x, p.y, p.z, s.radius});
    }
    owner.finish_[segment_id].push_back(finish);
  }
  void add_shape(const Plane&, const Transform& t, const Finish& finish) {
    add_surface(solids::square(horizon), t, finish);
  }
  void add_shape(const Box& s, const Transform& t, const Finish& finish) {
    add_surface(solids::box(to_point(s.half_extents)), t, finish);
  }
  void add_shape(const Cylinder& s, const Transform& t, const Finish& finish) {
    add_surface(solids::cylinder(s.radius, s.half_length, round_segments), t, finish);
  }
  void add_shape(const Cone& s, const Transform& t, const Finish& finish) {
    add_surface(solids::cone(s.radius, s.half_length, round_segments), t, finish);
  }
  void add_shape(const std::shared_ptr<const Mesh>& s, const Transform& t, const Finish& finish) {
    std::vector<solids::Point> points(s->vertices.size());
    std::transform(s->vertices.begin(), s->vertices.end(), points.begin(), to_point);
    add_surface(s->smooth ? solids::smooth(points, s->triangles) : solids::flat(points, s->triangles), t, finish);
  }
  void add_surface(const solids::Surface& surface, const Transform& t, const Finish& finish) {
    for (const std::uint32_t i : surface.indices) {
      vertices.push_back(t.point(to_vec(surface.positions[i])));
      owner.corner_normals_.push_back(t.direction(to_vec(surface.normals[i])));
    }
    owner.finish_[triangle_id].resize(owner.finish_[triangle_id].size() + surface.indices.size() / 3, finish);
  }

  template <class Item>
  void fill(RTCGeometry geometry, RTCBufferType type, RTCFormat format, const std::vector<Item>& items,
            std::size_t item_bytes, std::size_t count) {
    void* const buffer = rtcSetNewGeometryBuffer(geometry, type, 0, format, item_bytes, count);
    if (!buffer) throw std::runtime_error("Embree: out of memory");
    std::memcpy(buffer, items.data(), item_bytes * count);
  }
  void attach(RTCGeometry geometry, unsigned id) {
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(owner.scene_.get(), geometry, id);
    rtcReleaseGeometry(geometry);
  }
  void commit() {
    if (!vertices.empty()) {
      RTCGeometry g = rtcNewGeometry(owner.device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
      std::vector<std::uint32_t> indices(vertices.size());
      for (std::size_t i = 0; i < indices.size(); ++i) indices[i] = static_cast<std::uint32_t>(i);
      fill(g, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, vertices, sizeof(Vec3), vertices.size());
      fill(g, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, indices, 12, indices.size() / 3);
      attach(g, triangle_id);
    }
    if (!spheres.empty()) {
      RTCGeometry g = rtcNewGeometry(owner.device_.get(), RTC_GEOMETRY_TYPE_SPHERE_POINT);
      fill(g, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT4, spheres, sizeof(PointRadius), spheres.size());
      attach(g, sphere_id);
    }
    if (!segment_ends.empty()) {
      RTCGeometry g = rtcNewGeometry(owner.device_.get(), RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE);
      std::vector<std::uint32_t> starts(segment_ends.size() / 2);
      for (std::size_t i = 0; i < starts.size(); ++i) starts[i] = static_cast<std::uint32_t>(2 * i);
      fill(g, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT4, segment_ends, sizeof(PointRadius), segment_ends.size());
      fill(g, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT, starts, 4, starts.size());
      attach(g, segment_id);
    }
    rtcCommitScene(owner.scene_.get());
    owner.throw_on_error();
  }
};

void RayScene::throw_on_error() const {
  const RTCError error = rtcGetDeviceError(device_.get());
  if (error != RTC_ERROR_NONE) throw std::runtime_error("Embree: error " + std::to_string(error));
}

RayScene::RayScene(std::span<const Drawable> drawables, float horizon) : device_(rtcNewDevice(nullptr)) {
  if (!device_) throw std::runtime_error("Embree: error " + std::to_string(rtcGetDeviceError(nullptr)));
  scene_.reset(rtcNewScene(device_.get()));
  Builder builder{*this, horizon, {}, {}, {}};
  for (const Drawable& d : drawables) builder.add(d);
  builder.commit();
}

Surface RayScene::surface_at(unsigned geometry, unsigned primitive, float u, float v, Vec3 geometric_normal) const {
  const Finish& finish = finish_[geometry][primitive];
  Surface surface{finish.albedo, normalized(geometric_normal), finish.is_plane};
  if (geometry == triangle_id) {
    const Vec3* n = &corner_normals_[std::size_t{primitive} * 3];
    surface.normal = normalized(n[0] * (1 - u - v) + n[1] * u + n[2] * v);
  }
  return surface;
}

}  // namespace boxstream::picture
