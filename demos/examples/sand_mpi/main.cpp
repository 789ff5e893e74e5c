// SPDX-License-Identifier: MIT
// Sand slides down a chute, on several ranks. Each grain is moved by one rank, for good. What two grains do to each
// other is worked out by the rank in whose part of space they meet: it asks where they are, and sends back forces.
//   mpirun -n 4 sand_mpi [GRAINS]     writes sand.svg: the sand before and after, and whose part of space is where
#include <boxstream/mpi.hpp>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <utility>
#include <vector>

#include "chute.hpp"
#include "picture.hpp"

namespace {

template <class T>
using ForRanks = std::vector<std::vector<T>>;

/// out[r] goes to rank r; what comes from it is in [r] of the result.
template <class T>
ForRanks<T> exchange(const ForRanks<T>& out) {
  const std::size_t ranks = out.size();
  std::vector<int> sent, received(ranks);
  for (const std::vector<T>& list : out) sent.push_back(int(list.size() * sizeof(T)));
  MPI_Alltoall(sent.data(), 1, MPI_INT, received.data(), 1, MPI_INT, MPI_COMM_WORLD);
  ForRanks<T> in(ranks);
  std::vector<MPI_Request> requests(2 * ranks);
  for (std::size_t r = 0; r < ranks; ++r) {
    in[r].resize(std::size_t(received[r]) / sizeof(T));
    MPI_Irecv(in[r].data(), received[r], MPI_BYTE, int(r), 0, MPI_COMM_WORLD, &requests[r]);
    MPI_Isend(out[r].data(), sent[r], MPI_BYTE, int(r), 0, MPI_COMM_WORLD, &requests[ranks + r]);
  }
  MPI_Waitall(int(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
  return in;
}

/// Larger than the grain, so that it can stay while the grain moves a little.
boxstream::Aabb box_around(const Grain& grain) {
  const auto& [x, y, z] = grain.at;
  const double reach = grain.radius + 0.15;
  return {{float(x - reach), float(y - reach), float(z - reach)},
          {float(x + reach), float(y + reach), float(z + reach)}};
}

bool is_inside(const Grain& grain, const boxstream::Aabb& box) {
  const double at[] = {grain.at.x, grain.at.y, grain.at.z};
  for (int d = 0; d < 3; ++d)
    if (at[d] - grain.radius < box.min[d] || at[d] + grain.radius > box.max[d]) return false;
  return true;
}

class Sand {
 public:
  Sand(const Chute& chute, std::uint64_t grains, std::size_t rank, std::size_t ranks)
      : chute_(chute), ranks_(ranks), share_((grains + ranks - 1) / ranks), first_(share_ * rank), places_(grains) {
    for (std::uint64_t id = first_; id < std::min(grains, first_ + share_); ++id) {
      grains_.push_back(chute.start(id));
      boxes_.push_back(box_around(grains_.back()));
      ids_.push_back(id);
    }
  }

  void step() {
    // Few boxes change in a step.
    for (std::size_t i = 0; i < grains_.size(); ++i)
      if (!is_inside(grains_[i], boxes_[i])) boxes_[i] = box_around(grains_[i]);
    stats_ = world_.update(boxes_, ids_);
    begun += stats_.begun;
    ended += stats_.ended;
    find_near();

    const ForRanks<std::uint64_t> wanted = exchange(asked_);
    ForRanks<Grain> answers(ranks_);
    ForRanks<Force> forces(ranks_);
    for (std::size_t r = 0; r < ranks_; ++r) {
      for (const std::uint64_t id : wanted[r]) answers[r].push_back(grains_[id - first_]);
      forces[r].resize(asked_[r].size());
    }
    const ForRanks<Grain> seen = exchange(answers);
    for (const auto& [a, b] : near_) {
      const Force force = chute_.contact(seen[a.rank][a.index], seen[b.rank][b.index]);
      forces[a.rank][a.index].add(force);
      forces[b.rank][b.index].add(force, -1);
    }
    const ForRanks<Force> found = exchange(forces);
    std::vector<Force> sums(grains_.size());
    for (std::size_t r = 0; r < ranks_; ++r)
      for (std::size_t k = 0; k < wanted[r].size(); ++k) sums[wanted[r][k] - first_].add(found[r][k]);
    for (std::size_t i = 0; i < grains_.size(); ++i) chute_.move(grains_[i], sums[i]);
  }

  /// Of all ranks, on rank 0.
  std::vector<View> view() const {
    View own{stats_.part, stats_.held, near_.size(), {}};
    for (std::size_t k = 0; k < 1000 && !grains_.empty(); ++k) own.dots[k] = grains_[hash(k) % grains_.size()].at;
    std::vector<View> all(ranks_);
    MPI_Gather(&own, sizeof own, MPI_BYTE, all.data(), sizeof own, MPI_BYTE, 0, MPI_COMM_WORLD);
    return all;
  }

  std::uint64_t beyond(double x) const {
    return std::uint64_t(std::count_if(grains_.begin(), grains_.end(), [x](const Grain& g) { return g.at.x > x; }));
  }
  std::uint64_t pairs() const { return near_.size(); }

  std::uint64_t begun = 0, ended = 0;  // pairs, on this rank

 private:
  /// Where the state of a grain will be among the answers to `asked_`.
  struct Place {
    std::uint32_t step = 0, rank = 0, index = 0;
  };

  /// The pairs of this rank, and which grains it has to ask whom for.
  void find_near() {
    ++step_;
    asked_.assign(ranks_, {});
    near_.clear();
    const auto place_of = [&](std::uint64_t id) {
      Place& place = places_[id];
      if (place.step != step_) {
        std::vector<std::uint64_t>& asked = asked_[id / share_];
        place = {step_, std::uint32_t(id / share_), std::uint32_t(asked.size())};
        asked.push_back(id);
      }
      return place;
    };
    world_.for_each_pair([&](boxstream::WidePair pair) {
      near_.emplace_back(place_of(pair.a), place_of(pair.b));
      return true;
    });
  }

  const Chute& chute_;
  std::size_t ranks_;
  std::uint64_t share_, first_;  // of the grains that a rank moves
  std::vector<Grain> grains_;
  std::vector<boxstream::Aabb> boxes_;
  std::vector<std::uint64_t> ids_;
  boxstream::mpi::World world_{MPI_COMM_WORLD};
  boxstream::mpi::WorldStats stats_;
  std::uint32_t step_ = 0;
  std::vector<Place> places_;  // of all grains of all ranks
  ForRanks<std::uint64_t> asked_;
  std::vector<std::pair<Place, Place>> near_;
};

void run(std::uint64_t grains) {
  int rank = 0, ranks = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  const Chute chute(grains);
  Sand sand(chute, grains, std::size_t(rank), std::size_t(ranks));
  sand.step();
  std::vector<std::vector<View>> moments{sand.view()};
  for (std::uint64_t step = 1; step < chute.steps; ++step) sand.step();
  moments.push_back(sand.view());

  unsigned long long sums[] = {sand.beyond(chute.length), sand.pairs(), sand.begun, sand.ended};
  MPI_Allreduce(MPI_IN_PLACE, sums, 4, MPI_UNSIGNED_LONG_LONG, MPI_SUM, MPI_COMM_WORLD);
  if (rank != 0) return;
  std::printf("%zu grains, %zu steps: %llu are further down than any was\n", std::size_t(grains),
              std::size_t(chute.steps), sums[0]);
  std::printf("%llu pairs of boxes: %llu began, %llu ended\n", sums[1], sums[2], sums[3]);
  draw(moments, 1.5 * chute.length, double(chute.layers));
}

}  // namespace

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  run(argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 20'000);
  MPI_Finalize();
}
