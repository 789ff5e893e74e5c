// SPDX-License-Identifier: MIT
#include "box_sets.hpp"

#include <stdexcept>

#include "box_sets/arranged.hpp"
#include "box_sets/numbers.hpp"
#include "box_sets/scattered.hpp"

namespace boxstream::tests {

template <class S>
const std::vector<BoxSet<S>>& box_sets() {
  using namespace families;
  constexpr std::size_t any = std::numeric_limits<std::size_t>::max();
  static const std::vector<BoxSet<S>> sets = {
      {"sparse", sparse<S>, any, 450, 1800},
      {"dense", dense<S>, any, 10000, 40000},
      {"all_overlapping", all_overlapping<S>, 700, 244650, 244650},
      {"identical", identical<S>, 700, 244650, 244650},
      {"equal_low", equal_low<S>, 700, 244650, 244650},
      {"touching_lattice", touching_lattice<S>, any, 20000, 26000},
      {"one_step_apart", one_step_apart<S>, any, 700, 1000},
      {"below_float", below_float<S>, any, 7000, 22000},
      {"slices_x", slices<S, 0>, any, 500, 2000},
      {"slices_y", slices<S, 1>, any, 500, 2000},
      {"slices_z", slices<S, 2>, any, 500, 2000},
      {"rods_x", rods<S, 0>, any, 400, 2000},
      {"rods_y", rods<S, 1>, any, 400, 2000},
      {"rods_z", rods<S, 2>, any, 400, 2000},
      {"rods_mixed", rods<S, 3>, any, 2000, 8000},
      {"nested", nested<S>, 700, 244650, 244650},
      {"comb_and_plates_x", comb_and_plates<S, 0>, any, 230, 1000},
      {"comb_and_plates_y", comb_and_plates<S, 1>, any, 230, 1000},
      {"comb_and_plates_z", comb_and_plates<S, 2>, any, 230, 1000},
      {"clusters", clusters<S>, any, 600, 2400},
      {"six_decades", six_decades<S>, any, 2000, 8000},
      {"dust_and_planes", dust_and_planes<S>, any, 5000, 7000},
      {"infinite", infinite<S>, 2100, 4000, 16000},
      {"flat", flat<S>, any, 1500, 6000},
      {"layer", layer<S>, any, 2000, 8000},
      {"staircase", staircase<S>, any, 1999, 1999},
      {"signed_zeros", signed_zeros<S>, 700, 25000, 120000},
      {"denormals", denormals<S>, sizeof(S) == 8 ? 3000 : any, 700, 4000},
      {"invalid_among_valid", invalid_among_valid<S>, any, 6000, 25000, true},
      {"full_range", full_range<S>, 2100, 8000, 36000},
      {"ties", ties<S>, 2100, 16000, 60000},
      {"spanning_the_median", spanning_the_median<S>, any, 1000, 4000},
      {"two_far_groups", two_far_groups<S>, any, 5000, 20000},
      {"sphere", sphere<S>, any, 1500, 6000},
  };
  return sets;
}

template <class S>
const BoxSet<S>& box_set(const std::string& name) {
  for (const auto& set : box_sets<S>())
    if (set.name == name) return set;
  throw std::out_of_range("no box set named " + name);
}

template const std::vector<BoxSet<float>>& box_sets<float>();
template const std::vector<BoxSet<double>>& box_sets<double>();
template const BoxSet<float>& box_set<float>(const std::string&);
template const BoxSet<double>& box_set<double>(const std::string&);

}  // namespace boxstream::tests
