// SPDX-License-Identifier: MIT
// sand.svg: the sand from the side, each grain in the colour of the rank whose part of space it is in.
#pragma once

#include <algorithm>
#include <cstdio>
#include <vector>

#include <boxstream/aabb.hpp>

#include "chute.hpp"

/// What a rank has to show of a moment.
struct View {
  boxstream::Aabb64 part;  // of space
  unsigned long long held, pairs;
  Vec dots[1000];  // places of some of its grains

  bool has(const Vec& at) const {
    return at.x >= part.min[0] && at.x < part.max[0] && at.y >= part.min[1] && at.y < part.max[1] &&
           at.z >= part.min[2] && at.z < part.max[2];
  }
};

/// A moment above the next one; of each, the views of all ranks.
inline void draw(const std::vector<std::vector<View>>& moments, double width, double height) {
  std::FILE* svg = std::fopen("sand.svg", "w");
  if (svg == nullptr) return std::perror("sand.svg");
  const double step = 1.5 * height, sky = 1.35 * height, text = height / 14;
  std::fprintf(
      svg,
      "<svg xmlns='http://www.w3.org/2000/svg' width='1000' viewBox='0 0 %g %g' font-size='%g' stroke-width='%g'>\n",
      width, step * double(moments.size()), text, height / 200);
  double ground = sky;
  for (const std::vector<View>& views : moments) {
    for (std::size_t rank = 0; rank < views.size(); ++rank) {
      const View& view = views[rank];
      if (view.part.min[0] > view.part.max[0]) continue;  // no space is left for it
      std::fprintf(svg, "<g fill='hsl(%d,55%%,45%%)'>\n", int(rank * 360 / views.size()));
      for (const View& other : views)
        for (const Vec& at : other.dots)
          if (view.has(at))
            std::fprintf(svg, "<circle cx='%.2f' cy='%.2f' r='%.2f'/>\n", at.x, ground - at.z, height / 90);
      const double left = std::clamp(view.part.min[0], 0., width), right = std::clamp(view.part.max[0], 0., width);
      const double low = std::clamp(view.part.min[2], 0., sky), high = std::clamp(view.part.max[2], 0., sky);
      std::fprintf(svg, "<rect x='%.2f' y='%.2f' width='%.2f' height='%.2f' fill-opacity='.12' stroke='#333'/>\n", left,
                   ground - high, right - left, high - low);
      std::fprintf(svg, "<text x='%.2f' y='%.2f'>rank %zu: %llu grains", left + text / 3, ground - high + 1.2 * text,
                   rank, view.held);
      std::fprintf(svg, "<tspan x='%.2f' dy='1.2em'>%llu pairs</tspan></text>\n</g>\n", left + text / 3, view.pairs);
    }
    ground += step;
  }
  std::fprintf(svg, "</svg>\n");
  std::fclose(svg);
}
