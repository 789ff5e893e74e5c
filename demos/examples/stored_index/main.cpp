// SPDX-License-Identifier: MIT
// Boxes that stay: an index made once, stored in a file, loaded and asked.
#include <boxstream/boxstream.hpp>

#include <cstdio>
#include <exception>
#include <fstream>
#include <iterator>
#include <vector>

int main() {
  const char* const file = "houses.boxindex";
  {
    // Ten by ten houses, each 8 by 6 and 5 high, every 20 metres.
    std::vector<boxstream::Aabb> houses;
    for (int i = 0; i < 100; ++i) {
      const float x = 20.f * static_cast<float>(i % 10), y = 20.f * static_cast<float>(i / 10);
      houses.push_back({{x, y, 0}, {x + 8, y + 6, 5}});
    }
    const std::vector<std::uint8_t> bytes = boxstream::BoxIndex(houses).save();
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    std::printf("%zu bytes\n", bytes.size());
  }

  std::ifstream in(file, std::ios::binary);
  std::vector<std::uint8_t> bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  const boxstream::BoxIndex index = boxstream::BoxIndex::load(bytes);

  int count = 0;
  index.query_box({{0, 0, 0}, {50, 30, 10}}, [&](std::uint32_t) { return ++count, true; });
  std::printf("%d houses in the window\n", count);

  const float from[3] = {-10, 3, 2}, along[3] = {1, 0, 0};
  index.query_ray(boxstream::Ray::along(from, along, 1000), [](std::uint32_t house, float enter, float) {
    std::printf("the ray enters house %u after %g metres\n", house, enter);
    return enter;  // only what is nearer than this
  });

  const float here[3] = {95, 95, 0};
  std::uint32_t nearest[3];
  index.query_nearest(here, nearest);
  std::printf("nearest: %u, %u, %u\n", nearest[0], nearest[1], nearest[2]);

  bytes[50] ^= 1;
  try {
    boxstream::BoxIndex::load(bytes);
  } catch (const std::exception& error) {
    std::printf("%s\n", error.what());
  }
  std::remove(file);
}
