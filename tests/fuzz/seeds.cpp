// SPDX-License-Identifier: MIT
// usage: boxstream_fuzz_seeds DIRECTORY
// Writes inputs to begin with into DIRECTORY/TARGET: recorded streams, box files, and choices at random. Scenes need
// none: demos/scenes has them.
#include <filesystem>
#include <fstream>
#include <iostream>
#include <random>
#include <sstream>
#include <string>
#include <variant>
#include <vector>

#include "formats/aabbs/writer.hpp"
#include "formats/record/streams.hpp"

namespace {

namespace fs = std::filesystem;
using namespace boxstream;

class Seeds {
 public:
  explicit Seeds(fs::path directory) : directory_(std::move(directory)) {}

  void put(const std::string& target, const std::string& bytes) {
    const fs::path place = directory_ / target;
    fs::create_directories(place);
    std::ofstream out(place / ("seed-" + std::to_string(count_++)), std::ios::binary);
    out.exceptions(std::ios::failbit | std::ios::badbit);
    out << bytes;
    out.close();
  }

 private:
  fs::path directory_;
  int count_ = 0;
};

std::string text(const record_test::Bytes& bytes) {
  return {bytes.begin(), bytes.end()};
}

void put_streams(Seeds& seeds) {
  for (const record::Scalar scalar : {record::Scalar::float32, record::Scalar::float64}) {
    record::Header header;
    header.scalar = scalar;
    seeds.put("record_reader", text(record_test::write(record_test::one_of_each(), header)));
    seeds.put("record_reader", text(record_test::write(record_test::random_ops(1, 40), header)));
  }
  for (std::uint32_t seed = 0; seed < 24; ++seed) {
    record::Header header;
    // The first byte chooses how the adapter is set up.
    header.about = std::string(1, static_cast<char>(seed * 5));
    const auto temper = seed % 3 == 0 ? record_test::Temper::tame : record_test::Temper::wild;
    auto ops = record_test::random_ops(seed, 20 + 8 * seed, temper);
    if (seed % 2 == 0)
      std::erase_if(ops, [](const record::Op& op) { return std::holds_alternative<record::Refilter>(op); });
    seeds.put("bullet", text(record_test::write(ops, header)));
  }
}

void put_box_files(Seeds& seeds) {
  for (const std::uint32_t objects : {1u, 3u}) {
    std::ostringstream out;
    aabbs::Writer writer(out, {"Scene", "Cubes", objects, 2, {{-5, -5, -5}, {5, 5, 5}}});
    for (int frame = 0; frame <= 2; ++frame)
      writer.frame(std::vector<Aabb>(objects, {{0, 0, 0}, {1, 1, static_cast<float>(frame)}}));
    writer.finish();
    seeds.put("aabbs", out.str());
    seeds.put("aabbs", out.str().erase(aabbs::header_size, objects * aabbs::box_size));
  }
}

void put_choices(Seeds& seeds) {
  std::mt19937 random(1);
  for (const char* const target :
       {"core", "index", "rules", "world", "fcl", "import_bullet", "import_mesh", "import_urdf"})
    for (std::size_t i = 0; i < 32; ++i) {
      std::string bytes(32 + 16 * i, '\0');
      for (char& byte : bytes) byte = static_cast<char>(random());
      seeds.put(target, bytes);
    }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: boxstream_fuzz_seeds DIRECTORY\n";
    return 2;
  }
  Seeds seeds(argv[1]);
  put_streams(seeds);
  put_box_files(seeds);
  put_choices(seeds);
  return 0;
}
