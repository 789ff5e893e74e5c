// SPDX-License-Identifier: MIT
// A pile of a million grains on several ranks: which touch, and, in sand.svg, whose part of space is where.
//   mpirun -n 4 sand_mpi
#include <boxstream/mpi.hpp>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <vector>

namespace {

constexpr std::uint64_t grains = 1'000'000;
constexpr std::int64_t radius = 1'000'000, height = radius / 4;  // of the pile, in thousandths of a millimetre

std::uint64_t hash(std::uint64_t x) {
  x = (x ^ (x >> 31)) * 0x7fb5d329728ea185;
  x = (x ^ (x >> 27)) * 0x81dadef4bc2dd44d;
  return x ^ (x >> 33);
}

/// The same on every machine. Places are tried until one is in the cone.
boxstream::Aabb grain(std::uint64_t id) {
  for (std::uint64_t seed = hash(id + 1);; seed = hash(seed)) {
    const std::int64_t x = std::int64_t(seed % (2 * radius)) - radius;
    const std::int64_t y = std::int64_t((seed >> 22) % (2 * radius)) - radius;
    const std::int64_t z = std::int64_t((seed >> 43) % height), at = radius - radius / height * z;
    if (x * x + y * y > at * at) continue;
    const std::int64_t size = 5000 + std::int64_t(hash(seed) % 5000);
    return {{float(x), float(y), float(z)}, {float(x + size), float(y + size), float(z + size)}};
  }
}

struct Share {
  boxstream::mpi::Stats stats;
  float dots[250][2];  // places of some of its grains
};

/// Some grains of this rank, as it sees them from above.
void choose_dots(Share& share) {
  const boxstream::Aabb64& part = share.stats.part;
  int chosen = 0;
  for (std::uint64_t id = 0; chosen < 250 && id < grains; ++id) {
    const boxstream::Aabb box = grain(id);
    bool inside = true;
    for (int d = 0; d < 3; ++d) inside = inside && box.min[d] >= part.min[d] && box.min[d] < part.max[d];
    if (!inside) continue;
    std::copy(box.min, box.min + 2, share.dots[chosen++]);
  }
}

void draw(const std::vector<Share>& shares) {
  std::FILE* svg = std::fopen("sand.svg", "w");
  if (svg == nullptr) return std::perror("sand.svg");
  std::fprintf(svg, "<svg xmlns='http://www.w3.org/2000/svg' width='640' height='640' viewBox='-1.1 -1.1 2.2 2.2'>\n");
  for (std::size_t rank = 0; rank < shares.size(); ++rank) {
    const Share& share = shares[rank];
    const boxstream::Aabb64& part = share.stats.part;
    if (part.min[0] > part.max[0]) continue;
    const auto place = [](double x) { return std::clamp(x / radius, -1.05, 1.05); };
    const int hue = int(rank * 360 / shares.size());
    std::fprintf(svg, "<g fill='hsl(%d,60%%,40%%)'>\n", hue);
    for (const auto& dot : share.dots)
      std::fprintf(svg, "<circle cx='%.4f' cy='%.4f' r='.006'/>\n", double(dot[0]) / radius, double(dot[1]) / radius);
    std::fprintf(
        svg,
        "<rect x='%.4f' y='%.4f' width='%.4f' height='%.4f' fill-opacity='.15' stroke='#333' stroke-width='.006'/>\n",
        place(part.min[0]), place(part.min[1]), place(part.max[0]) - place(part.min[0]),
        place(part.max[1]) - place(part.min[1]));
    std::fprintf(svg, "<text x='%.4f' y='%.4f' font-size='.045'>rank %zu: %llu grains, %llu pairs</text>\n</g>\n",
                 place(part.min[0]) + 0.03, place(part.min[1]) + 0.08, rank,
                 static_cast<unsigned long long>(share.stats.received),
                 static_cast<unsigned long long>(share.stats.pairs));
  }
  std::fprintf(svg, "</svg>\n");
  std::fclose(svg);
}

}  // namespace

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  int rank = 0, ranks = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  std::vector<boxstream::Aabb> boxes;
  std::vector<std::uint64_t> ids;
  for (auto id = std::uint64_t(rank); id < grains; id += std::uint64_t(ranks)) {
    boxes.push_back(grain(id));
    ids.push_back(id);
  }
  std::vector<boxstream::WidePair> pairs;  // of ids: those that this rank has
  Share own{boxstream::mpi::find_pairs(MPI_COMM_WORLD, boxes, ids, pairs), {}};
  choose_dots(own);

  std::vector<Share> shares(rank == 0 ? std::size_t(ranks) : 0);
  MPI_Gather(&own, sizeof own, MPI_BYTE, shares.data(), sizeof own, MPI_BYTE, 0, MPI_COMM_WORLD);
  if (rank == 0) {
    std::uint64_t all = 0;
    for (const Share& share : shares) all += share.stats.pairs;
    std::printf("%llu grains, %llu touching pairs\n", static_cast<unsigned long long>(grains),
                static_cast<unsigned long long>(all));
    draw(shares);
  }
  MPI_Finalize();
}
