// SPDX-License-Identifier: MIT
#include "papers/experiments/experiment.hpp"

namespace boxstream::papers {

Span<const Experiment> experiments() {
  static constexpr Experiment all[] = {
      {"level", "ApproxMedian: the height that Level(n) starts from", median_heights},
      {"6", "The procedures compared, complete case, balanced distribution", figure_6},
      {"7", "Version Three under two cutoffs, balanced distribution", figure_7},
      {"8", "Version Three over one cutoff, balanced distribution", figure_8},
      {"9", "The first segment tree streamed, under two cutoffs", figure_9},
      {"table1", "Version Three on skewed distributions", table_1},
      {"batches", "Version Three on what the paper did not measure", other_batches},
      {"10", "Version Three over one cutoff, sphere distribution", figure_10},
      {"13", "Version One after sorting structures and after sorting pointers", figure_13},
      {"14", "Sorting structures against sorting pointers, by size of structure", figure_14},
      {"18", "Version One against Version Two", figure_18},
      {"20", "Cubes: Version Four against Version Three", figure_20},
      {"21", "Boxes: Version Four on bounding cubes against Version Three", figure_21},
      {"22", "Self-intersections of the Klein bottle", figure_22},
      {"23", "Distance of a surface and coarse ones of the same shape, in three phases", figure_23},
      {"table3", "Bytes per object", table_3},
  };
  return all;
}

}  // namespace boxstream::papers
