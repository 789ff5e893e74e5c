// SPDX-License-Identifier: MIT
#include "papers/experiments/experiment.hpp"

namespace boxstream::papers {

Span<const Experiment> experiments() {
  static constexpr Experiment all[] = {
      {"level", "ApproxMedian: the height that Level(n) starts from", median_heights},
      {"6", "The procedures compared: Version One, presorted, balanced distribution", figure_6},
      {"7", "Version Three under two cutoffs, balanced distribution", figure_7},
      {"8", "Version Three over one cutoff, balanced distribution", figure_8},
      {"9", "The first segment tree streamed, under two cutoffs", figure_9},
      {"trees", "What the trees would hold if they were kept in memory", trees_in_memory},
      {"table1", "Version Three on skewed distributions, in two readings", table_1},
      {"order", "Version Three with the dimensions in other orders, and restarting in another dimension",
       dimension_orders},
      {"batches", "Version Three on what the paper did not measure", other_batches},
      {"10", "Version One over one cutoff, sphere distribution", figure_10},
      {"table2", "Reading and writing an integer, by how much memory is visited", table_2},
      {"13", "Version One after sorting structures and after sorting pointers", figure_13},
      {"14", "Sorting structures against sorting pointers, by size of structure", figure_14},
      {"15", "The size up to which sorting structures is faster, by their number", figure_15},
      {"18", "Version One against Version Two", figure_18},
      {"20", "Cubes: Version Four against Version Three", figure_20},
      {"21", "Boxes: Version Four on bounding cubes against Version Three", figure_21},
      {"22", "Self-intersections of the Klein bottle, by Version One and by the engine", figure_22},
      {"23", "Distance of a surface and coarse ones, by Version Three and by the engine", figure_23},
      {"table3", "Bytes per object", table_3},
  };
  return all;
}

}  // namespace boxstream::papers
