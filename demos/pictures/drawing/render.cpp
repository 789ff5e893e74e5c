// SPDX-License-Identifier: MIT
#include "render.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <limits>
#include <numbers>
#include <thread>
#include <vector>

#include "grain.hpp"
#include "ray_scene.hpp"

namespace boxstream::picture {
namespace {

constexpr int packet = 8;
// Points of one sample: place in the pixel, place on the sun, direction to the sky.
constexpr int sample_dimensions = 6;
using SamplePoint = std::array<float, sample_dimensions>;

const Vec3 sun_direction = normalized({0.45F, 1.0F, 0.62F});
// Half-width of the sun: wide enough for a soft edge on shadows.
constexpr float sun_spread = 0.045F;
constexpr Vec3 sun_light{2.5F, 2.36F, 2.12F};
constexpr Vec3 sky_light{0.78F, 0.87F, 1.0F};
constexpr Vec3 ground_light{0.42F, 0.40F, 0.37F};
constexpr Vec3 horizon_colour{0.80F, 0.85F, 0.90F};
constexpr Vec3 zenith_colour{0.42F, 0.55F, 0.72F};
constexpr float exposure = 0.5F;

float fract(float x) {
  return x - std::floor(x);
}
Vec3 mix(Vec3 a, Vec3 b, float t) {
  return a * (1 - t) + b * t;
}
float smooth_step(float from, float to, float x) {
  const float t = std::clamp((x - from) / (to - from), 0.0F, 1.0F);
  return t * t * (3 - 2 * t);
}

/// Points that fill the unit cube evenly for any count (the generalised golden ratio sequence).
std::vector<SamplePoint> even_points(int count) {
  double ratio = 1.1;
  for (int i = 0; i < 40; ++i) ratio = std::pow(1 + ratio, 1.0 / (sample_dimensions + 1));
  std::vector<SamplePoint> points(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    double step = 1;
    for (float& coordinate : points[static_cast<std::size_t>(i)]) {
      step /= ratio;
      const double x = 0.5 + step * (i + 1);
      coordinate = static_cast<float>(x - std::floor(x));
    }
  }
  return points;
}

/// A well mixed number in [0, 1) for each pixel and dimension: moves the same points elsewhere in each pixel.
float pixel_shift(std::uint32_t x, std::uint32_t y, std::uint32_t dimension) {
  std::uint32_t h = x * 0x9E3779B1U ^ (y * 0x85EBCA77U + dimension * 0xC2B2AE3DU);
  h ^= h >> 15;
  h *= 0x2C1B3C6DU;
  h ^= h >> 12;
  h *= 0x297A2D39U;
  h ^= h >> 15;
  return static_cast<float>(h >> 8) * 0x1p-24F;
}

Vec3 background(Vec3 direction) {
  return mix(horizon_colour, zenith_colour, smooth_step(0.0F, 0.7F, direction.y));
}

/// A filmic curve (Narkowicz's fit of ACES): keeps highlights from clipping hard.
float tone(float x) {
  return std::clamp(x * (2.51F * x + 0.03F) / (x * (2.43F * x + 0.59F) + 0.14F), 0.0F, 1.0F);
}

std::uint8_t to_srgb_byte(float linear) {
  const float c = linear <= 0.0031308F ? 12.92F * linear : 1.055F * std::pow(linear, 1 / 2.4F) - 0.055F;
  return static_cast<std::uint8_t>(std::lround(255 * std::clamp(c, 0.0F, 1.0F)));
}

/// One hit of a packet, waiting for its light.
struct ShadingPoint {
  Vec3 position;
  Vec3 normal;
  Vec3 albedo;
  Vec3 view;
  float background_share;
  float footprint;
};

/// Those of one pixel.
class Samples {
 public:
  void add(Vec3 colour) {
    const float bright = brightness(colour);
    sum_.colour = sum_.colour + colour;
    sum_.variance += bright * bright;
    brightness_ += bright;
    ++count_;
  }
  void add(Vec3 colour, const ShadingPoint& p) {
    add(colour);
    sum_.albedo = sum_.albedo + p.albedo;
    sum_.normal = sum_.normal + p.normal;
    sum_.position = sum_.position + p.position;
    sum_.footprint += p.footprint;
  }
  Pixel mean() const {
    const float share = 1.0F / static_cast<float>(count_), mean = brightness_ * share;
    return {sum_.colour * share,   sum_.albedo * share,    sum_.normal * share,
            sum_.position * share, sum_.footprint * share, std::max(0.0F, sum_.variance * share - mean * mean) * share};
  }

 private:
  Pixel sum_;
  float brightness_ = 0;
  int count_ = 0;
};

class Tracer {
 public:
  Tracer(const RayScene& scene, const Camera& camera, const RenderOptions& options)
      : scene_(scene),
        camera_(camera),
        options_(options),
        points_(even_points((std::max(options.samples, 1) + packet - 1) / packet * packet)) {
    forward_ = normalized(camera.target - camera.eye);
    right_ = normalized(cross(forward_, camera.up));
    up_ = cross(right_, forward_);
    tan_half_ = std::tan(camera.field_of_view_degrees * std::numbers::pi_v<float> / 360);
    grid_step_ = std::pow(10.0F, std::floor(std::log10(std::max(camera.scene_radius, 1e-6F) * 0.8F)));
  }

  void trace_row(int y, Pixel* row) const {
    for (int x = 0; x < options_.width; ++x) {
      SamplePoint shift;
      for (std::uint32_t d = 0; d < sample_dimensions; ++d)
        shift[d] = pixel_shift(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), d);
      Samples samples;
      for (std::size_t first = 0; first < points_.size(); first += packet) trace_packet(x, y, first, shift, samples);
      row[x] = samples.mean();
    }
  }

 private:
  void trace_packet(int x, int y, std::size_t first, const SamplePoint& shift, Samples& samples) const {
    alignas(32) RTCRayHit8 rays;
    alignas(32) int valid[packet];
    std::array<SamplePoint, packet> at;
    for (int i = 0; i < packet; ++i) {
      for (int d = 0; d < sample_dimensions; ++d)
        at[i][d] = fract(points_[first + static_cast<std::size_t>(i)][d] + shift[d]);
      const float sx = 2 * (static_cast<float>(x) + at[i][0]) / static_cast<float>(options_.width) - 1;
      const float sy = 1 - 2 * (static_cast<float>(y) + at[i][1]) / static_cast<float>(options_.height);
      const float aspect = static_cast<float>(options_.width) / static_cast<float>(options_.height);
      const Vec3 direction = normalized(forward_ + right_ * (sx * tan_half_ * aspect) + up_ * (sy * tan_half_));
      set_ray(rays.ray, i, camera_.eye, direction, std::numeric_limits<float>::infinity());
      rays.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
      rays.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
      valid[i] = -1;
    }
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcIntersect8(valid, scene_.handle(), &context, &rays);

    std::array<ShadingPoint, packet> hits;
    for (int i = 0; i < packet; ++i) {
      const Vec3 direction{rays.ray.dir_x[i], rays.ray.dir_y[i], rays.ray.dir_z[i]};
      if (rays.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) {
        valid[i] = 0;
        samples.add(background(direction));
        continue;
      }
      hits[i] = shading_point(rays, i, direction);
    }

    alignas(32) RTCRay8 sun_rays;
    alignas(32) RTCRay8 sky_rays;
    std::array<Vec3, packet> to_sun;
    std::array<Vec3, packet> to_sky;
    for (int i = 0; i < packet; ++i) {
      if (!valid[i]) continue;
      to_sun[i] = normalized(sun_direction + disc(sun_direction, at[i][2], at[i][3]) * sun_spread);
      // Cosine-weighted: a uniform disc lifted onto the hemisphere.
      const Vec3 flat = disc(hits[i].normal, at[i][4], at[i][5]);
      to_sky[i] = normalized(flat + hits[i].normal * std::sqrt(std::max(0.0F, 1 - dot(flat, flat))));
      set_ray(sun_rays, i, hits[i].position, to_sun[i], std::numeric_limits<float>::infinity());
      set_ray(sky_rays, i, hits[i].position, to_sky[i], camera_.scene_radius);
    }
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcOccluded8(valid, scene_.handle(), &context, &sun_rays);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    rtcOccluded8(valid, scene_.handle(), &context, &sky_rays);

    for (int i = 0; i < packet; ++i) {
      if (!valid[i]) continue;
      const ShadingPoint& p = hits[i];
      Vec3 light = sky_rays.tfar[i] >= 0 ? mix(ground_light, sky_light, 0.5F + 0.5F * to_sky[i].y)
                                         : ground_light * 0.35F * p.albedo;
      Vec3 gloss;
      if (sun_rays.tfar[i] >= 0) {
        light = light + sun_light * std::max(0.0F, dot(p.normal, to_sun[i]));
        const float facing = std::max(0.0F, dot(p.normal, normalized(to_sun[i] - p.view)));
        gloss = sun_light * (0.10F * std::pow(facing, 48.0F));
      }
      const Vec3 lit = (p.albedo * light + gloss) * exposure;
      const Vec3 shown{tone(lit.x), tone(lit.y), tone(lit.z)};
      samples.add(mix(shown, background(p.view), p.background_share), p);
    }
  }

  ShadingPoint shading_point(const RTCRayHit8& rays, int i, Vec3 direction) const {
    const Vec3 face = normalized({rays.hit.Ng_x[i], rays.hit.Ng_y[i], rays.hit.Ng_z[i]});
    Surface surface = scene_.surface_at(rays.hit.geomID[i], rays.hit.primID[i], rays.hit.u[i], rays.hit.v[i], face);
    if (dot(surface.normal, direction) > 0) surface.normal = surface.normal * -1;
    const Vec3 front = dot(face, direction) > 0 ? face * -1 : face;
    const float t = rays.ray.tfar[i];
    // Shadow rays start a little off the surface, or rounding would let it shadow itself.
    const Vec3 position = camera_.eye + direction * t + front * (2e-4F * t);
    const float footprint = t * 2 * tan_half_ / static_cast<float>(options_.height);
    if (surface.is_plane) surface.albedo = surface.albedo * grid_shade(position, surface.normal, footprint);
    const float away = length(position - camera_.target) / camera_.scene_radius;
    const float fade = surface.is_plane ? smooth_step(1.3F, 5.0F, away) : smooth_step(4.0F, 12.0F, away);
    return {position, surface.normal, surface.albedo, direction, fade, footprint};
  }

  /// Thin lines one grid step apart, and slightly stronger ones each five steps.
  float grid_shade(Vec3 p, Vec3 normal, float pixel) const {
    const float a = std::fabs(normal.x) > 0.7F ? p.y : p.x;
    const float b = std::fabs(normal.z) > 0.7F ? p.y : p.z;
    const auto near_line = [&](float step) {
      const float from_line =
          std::min(std::fabs(fract(a / step + 0.5F) - 0.5F), std::fabs(fract(b / step + 0.5F) - 0.5F));
      return from_line * step < std::max(0.7F * pixel, 0.004F * grid_step_);
    };
    if (near_line(5 * grid_step_)) return 0.62F;
    return near_line(grid_step_) ? 0.80F : 1.0F;
  }

  /// A point of the unit disc at right angles to `axis`.
  static Vec3 disc(Vec3 axis, float u, float v) {
    const Vec3 a = perpendicular(axis);
    const float r = std::sqrt(u);
    const float angle = 2 * std::numbers::pi_v<float> * v;
    return a * (r * std::cos(angle)) + cross(axis, a) * (r * std::sin(angle));
  }

  static void set_ray(RTCRay8& rays, int i, Vec3 from, Vec3 direction, float length) {
    rays.org_x[i] = from.x;
    rays.org_y[i] = from.y;
    rays.org_z[i] = from.z;
    rays.dir_x[i] = direction.x;
    rays.dir_y[i] = direction.y;
    rays.dir_z[i] = direction.z;
    rays.tnear[i] = 0;
    rays.tfar[i] = length;
    rays.time[i] = 0;
    rays.mask[i] = ~0U;
    rays.id[i] = static_cast<unsigned>(i);
    rays.flags[i] = 0;
  }

  const RayScene& scene_;
  const Camera& camera_;
  const RenderOptions& options_;
  std::vector<SamplePoint> points_;
  Vec3 forward_, right_, up_;
  float tan_half_ = 0;
  float grid_step_ = 1;
};

/// `work(y)` for each row, on this thread and others. 0 threads: one for each of the hardware's.
template <class Work>
void for_each_row(int rows, int threads, const Work& work) {
  std::atomic<int> next_row{0};
  const auto take_rows = [&] {
    for (int y = next_row++; y < rows; y = next_row++) work(y);
  };
  const int hardware = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  std::vector<std::jthread> helpers;
  for (int i = 1; i < (threads > 0 ? threads : hardware); ++i) helpers.emplace_back(take_rows);
  take_rows();
}

}  // namespace

Image render(std::span<const Drawable> drawables, const Camera& camera, const RenderOptions& options) {
  const RayScene scene(drawables, 60 * camera.scene_radius);
  const Tracer tracer(scene, camera, options);
  const auto width = static_cast<std::size_t>(options.width), height = static_cast<std::size_t>(options.height);
  PixelGrid grid{options.width, options.height, std::vector<Pixel>(width * height)};
  for_each_row(options.height, options.threads,
               [&](int y) { tracer.trace_row(y, &grid.pixels[static_cast<std::size_t>(y) * width]); });
  Image image{options.width, options.height, std::vector<std::uint8_t>(3 * width * height)};
  for_each_row(options.height, options.threads, [&](int y) {
    std::uint8_t* byte = &image.rgb[3 * static_cast<std::size_t>(y) * width];
    for (int x = 0; x < options.width; ++x) {
      const Vec3 colour = without_grain(grid, x, y);
      for (const float channel : {colour.x, colour.y, colour.z}) *byte++ = to_srgb_byte(channel);
    }
  });
  return image;
}

}  // namespace boxstream::picture
