// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <sstream>

#include "pictures/drawing/camera.hpp"
#include "pictures/drawing/chart.hpp"
#include "pictures/drawing/colour_bar.hpp"
#include "pictures/drawing/png_file.hpp"
#include "pictures/drawing/poster.hpp"
#include "pictures/drawing/render.hpp"
#include "pictures/drawing/set_dressing.hpp"
#include "sanitized.hpp"
#include "scratch_directory.hpp"

namespace boxstream::picture {
namespace {

Drawable at(Shape shape, Vec3 origin, Colour colour = {0.8F, 0.2F, 0.2F}) {
  Drawable d{std::move(shape), {}, colour, true};
  d.transform.origin = origin;
  return d;
}

/// Where a point lands in the picture: x and y in [-1, 1] if it is inside.
Vec3 project(const Camera& camera, float aspect, Vec3 p) {
  const Vec3 forward = normalized(camera.target - camera.eye);
  const Vec3 right = normalized(cross(forward, camera.up));
  const Vec3 up = cross(right, forward);
  const Vec3 v = p - camera.eye;
  const float tangent = std::tan(camera.field_of_view_degrees * 3.14159265F / 360);
  const float depth = dot(v, forward);
  return {dot(v, right) / (depth * tangent * aspect), dot(v, up) / (depth * tangent), depth};
}

TEST(Picture, CameraShowsAllSubjectsAndIgnoresScenery) {
  for (const Vec3 stretch : {Vec3{1, 1, 1}, Vec3{20, 1, 1}, Vec3{1, 30, 1}, Vec3{1, 1, 25}, Vec3{0, 0, 0}}) {
    std::vector<Drawable> drawables;
    for (int i = 0; i < 27; ++i) {
      const Vec3 place{static_cast<float>(i % 3), static_cast<float>(i / 3 % 3), static_cast<float>(i / 9)};
      drawables.push_back(at(Sphere{0.2F}, place * stretch + Vec3{100, 50, -30}));
    }
    drawables.push_back(at(Box{{500, 1, 500}}, {0, 0, 0}));
    drawables.back().subject = false;
    drawables.push_back(at(Sphere{1}, {std::numeric_limits<float>::quiet_NaN(), 0, 0}));
    for (const float aspect : {0.5F, 1.0F, 16.0F / 9}) {
      const Camera camera = frame(drawables, aspect);
      float widest = 0;
      for (int i = 0; i < 27; ++i) {
        const Vec3 seen = project(camera, aspect, drawables[static_cast<std::size_t>(i)].transform.origin);
        EXPECT_GT(seen.z, 0);
        EXPECT_LT(std::fabs(seen.x), 1);
        EXPECT_LT(std::fabs(seen.y), 1);
        widest = std::max({widest, std::fabs(seen.x), std::fabs(seen.y)});
      }
      EXPECT_TRUE(stretch.x == 0 || widest > 0.5F) << "the subjects are lost in the picture";
    }
  }
}

TEST(Picture, CameraFramesTheCrowdAndNotWhatFlewAway) {
  std::vector<Drawable> drawables;
  for (int i = 0; i < 125; ++i)
    drawables.push_back(
        at(Sphere{0.2F}, {static_cast<float>(i % 5), static_cast<float>(i / 5 % 5), static_cast<float>(i / 25)}));
  const Camera crowd = frame(drawables, 1.5F);
  for (const Vec3 far : {Vec3{300, 0, 0}, Vec3{0, -900, 0}, Vec3{2, 2, 80}, Vec3{1000, 1000, 1000}})
    drawables.push_back(at(Sphere{0.2F}, far));
  const Camera with_strays = frame(drawables, 1.5F);
  EXPECT_LT(length(with_strays.eye - crowd.eye), 0.05F * length(crowd.eye - crowd.target));
  // Of a few bodies each is what the picture is about.
  drawables.erase(drawables.begin() + 4, drawables.end() - 1);
  EXPECT_GT(length(frame(drawables, 1.5F).eye), 1000);
}

TEST(Picture, NothingToFrameIsNoError) {
  const Camera camera = frame({}, 1.5F);
  EXPECT_TRUE(is_finite(camera.eye));
  EXPECT_GT(length(camera.eye - camera.target), 0);
  EXPECT_EQ(render({}, camera, {16, 16}).rgb.size(), 16U * 16U * 3U);
}

/// Mean of one channel over the middle of the picture.
double middle_mean(const Image& image, int channel) {
  double sum = 0;
  int count = 0;
  for (int y = image.height * 2 / 5; y < image.height * 3 / 5; ++y)
    for (int x = image.width * 2 / 5; x < image.width * 3 / 5; ++x, ++count)
      sum +=
          image
              .rgb[(static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x)) *
                       3 +
                   static_cast<std::size_t>(channel)];
  return sum / count;
}

TEST(Picture, EveryShapeIsSeenInItsColour) {
  auto mesh = std::make_shared<Mesh>();
  mesh->vertices = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh->triangles = {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {0, 2, 1}};
  auto smooth = std::make_shared<Mesh>(*mesh);
  smooth->smooth = true;
  std::vector<Shape> shapes{Box{{1, 1, 1}},
                            Sphere{1},
                            Cylinder{1, 1},
                            Cone{1.5F, 1},
                            std::shared_ptr<const Mesh>(mesh),
                            std::shared_ptr<const Mesh>(smooth)};
  for (int axis = 0; axis < 3; ++axis) shapes.push_back(Capsule{1, 1, axis});
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const std::vector<Drawable> scene{at(shapes[i], {3, 2, 1})};
    const Image image = render(scene, frame(scene, 1), {64, 64, 8});
    EXPECT_GT(middle_mean(image, 0), 1.7 * middle_mean(image, 1)) << "shape " << i;
    const std::vector<Drawable> away{at(shapes[i], {1000, 2, 1})};
    const Image empty = render(away, frame(scene, 1), {64, 64, 8});
    EXPECT_LT(middle_mean(empty, 0), middle_mean(empty, 2)) << "shape " << i;
  }
}

TEST(Picture, RenderDoesNotDependOnThreads) {
  std::vector<Drawable> scene{{Plane{}, {}, {0.8F, 0.8F, 0.8F}, false}};
  for (int i = 0; i < 30; ++i) {
    const auto f = static_cast<float>(i);
    scene.push_back(
        at(i % 2 ? Shape{Sphere{0.5F}} : Shape{Box{{0.4F, 0.5F, 0.3F}}}, {f * 0.3F, 0.5F, std::sin(f) * 3}));
  }
  const Camera camera = frame(scene, 1.5F);
  EXPECT_EQ(render(scene, camera, {150, 100, 8, 1}).rgb, render(scene, camera, {150, 100, 8, 3}).rgb);
}

/// How far each channel of each pixel is from that of another picture.
std::vector<int> differences(const Image& a, const Image& b) {
  std::vector<int> all;
  for (std::size_t i = 0; i < a.rgb.size(); ++i) all.push_back(std::abs(int{a.rgb[i]} - int{b.rgb[i]}));
  std::sort(all.begin(), all.end());
  return all;
}

TEST(Picture, ShadowsAreSoftWithoutGrain) {
  if (tests::sanitized) GTEST_SKIP() << "takes long under a sanitizer";
  std::vector<Drawable> scene{{Plane{}, {}, {0.8F, 0.8F, 0.8F}, false}};
  for (int i = 0; i < 8; ++i)
    scene.push_back(at(i % 2 ? Shape{Sphere{0.5F}} : Shape{Box{{0.4F, 0.5F, 0.3F}}},
                       {static_cast<float>(i % 3) * 1.2F, 0.5F, static_cast<float>(i) * 0.6F}));
  const Camera camera = frame(scene, 1.5F);
  const std::vector<int> error = differences(render(scene, camera, {240, 160}), render(scene, camera, {240, 160, 256}));
  // Of 255.
  EXPECT_LE(error[error.size() * 9 / 10], 2);
  EXPECT_LE(error[error.size() * 995 / 1000], 20);
}

TEST(Picture, WallsInFrontAreCutAwayAndAFloorIsAdded) {
  std::vector<Drawable> scene{at(Sphere{1}, {0, 0, 0})};
  const Camera camera = frame(scene, 1);
  const Vec3 towards_eye = normalized(camera.eye - camera.target);
  Drawable front = at(Box{{2, 2, 2}}, towards_eye * 6);
  Drawable back = at(Box{{2, 2, 2}}, towards_eye * -6);
  front.subject = back.subject = false;
  scene.insert(scene.end(), {front, back});
  cut_away(scene, camera);
  ASSERT_EQ(scene.size(), 2U);
  EXPECT_LT(dot(scene[1].transform.origin, towards_eye), 0);
  add_floor(scene);
  ASSERT_EQ(scene.size(), 3U);
  EXPECT_FLOAT_EQ(scene[2].transform.origin.y, std::min(*lowest_point(scene[0]), *lowest_point(scene[1])));
  add_floor(scene);
  EXPECT_EQ(scene.size(), 3U);
}

TEST(Picture, PngKeepsEveryPixel) {
  const tool_test::ScratchDirectory directory;
  Image image{37, 23, {}};
  for (int i = 0; i < 37 * 23 * 3; ++i) image.rgb.push_back(static_cast<std::uint8_t>(i * 31));
  {
    std::ofstream out(directory.file("a.png"), std::ios::binary);
    write_png(image, out);
  }
  const Image back = read_png(directory.file("a.png"));
  EXPECT_EQ(back.width, 37);
  EXPECT_EQ(back.height, 23);
  EXPECT_EQ(back.rgb, image.rgb);
  EXPECT_THROW(read_png(directory.write("text.png", "no picture")), std::runtime_error);
}

TEST(Picture, PosterWithOddSeries) {
  const tool_test::ScratchDirectory directory;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Poster poster{"odd", "series", {}, {}, {}, {}};
  poster.charts = {{"none", "step", 1, {}},
                   {"empty", "step", 1, {{"a", {}, {}}}},
                   {"one", "step", 1, {{"a", {}, {3}}}},
                   {"zeros", "step", 1, {{"a", {}, {0, 0, 0}}}},
                   {"holes and peaks", "step", 1, {{"a", {}, {1, nan, 2, 1e300, -1}}, {"b", {}, {nan, nan}}}}};
  {
    std::ofstream out(directory.file("a.png"), std::ios::binary);
    write_poster(poster, out, PictureFormat::png);
  }
  EXPECT_EQ(read_png(directory.file("a.png")).width, poster_width);
  std::ostringstream svg;
  write_poster(poster, svg, PictureFormat::svg);
  EXPECT_NE(svg.str().find("</svg>"), std::string::npos);
}

TEST(Picture, SpikesAreClippedAtThe99thPercentile) {
  Chart chart{"times", "step", 1, {{"a", {}, std::vector<double>(200, 2.0)}, {"b", {}, std::vector<double>(200, 1.0)}}};
  EXPECT_EQ(y_extent(chart).above, 0U);
  EXPECT_GT(y_extent(chart).top, 2);
  chart.series[0].values[7] = 90;
  chart.series[1].values[150] = 40;
  const Extent extent = y_extent(chart);
  EXPECT_EQ(extent.above, 2U);
  EXPECT_EQ(extent.peak, 90);
  EXPECT_LT(extent.top, 3);
  // More than one in a hundred is no spike.
  std::fill_n(chart.series[0].values.begin(), 8, 90);
  EXPECT_GT(y_extent(chart).top, 90);
  EXPECT_EQ(y_extent({"none", "step", 1, {}}).top, 1);
}

TEST(Picture, ColourBarIsDrawnWithinThePicture) {
  const Image plain{400, 300, std::vector<std::uint8_t>(400 * 300 * 3, 60)};
  const Image drawn = with_colour_bar(plain, {"speed", "0", "9 m/s", {{0, 0, 1}, {1, 0, 0}}});
  ASSERT_EQ(drawn.rgb.size(), plain.rgb.size());
  EXPECT_TRUE(std::equal(plain.rgb.begin(), plain.rgb.begin() + 400 * 200 * 3, drawn.rgb.begin()));
  bool blue = false, red = false;
  for (std::size_t i = 0; i + 2 < drawn.rgb.size(); i += 3) {
    blue = blue || (drawn.rgb[i] < 40 && drawn.rgb[i + 2] > 215);
    red = red || (drawn.rgb[i] > 215 && drawn.rgb[i + 2] < 40);
  }
  EXPECT_TRUE(blue && red);
}

TEST(Picture, FormatByEnding) {
  EXPECT_EQ(picture_format("a.png"), PictureFormat::png);
  EXPECT_EQ(picture_format("dir.svg/a.PNG"), PictureFormat::png);
  EXPECT_EQ(picture_format("a.Svg"), PictureFormat::svg);
  for (const char* const other : {"", ".png", "png", "a.png ", "a.jpg"}) EXPECT_FALSE(picture_format(other)) << other;
}

}  // namespace
}  // namespace boxstream::picture
