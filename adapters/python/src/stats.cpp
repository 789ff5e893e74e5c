// SPDX-License-Identifier: MIT
#include <sstream>

#include "detector.hpp"

namespace boxstream::python {

namespace {

std::string text_of(const Stats& stats) {
  std::ostringstream text;
  text << "boxstream.Stats(boxes=" << stats.boxes << ", invalid=" << stats.invalid << ", pairs=" << stats.pairs
       << ", nodes=" << stats.nodes << ", cells=" << stats.cells << ", records=" << stats.records
       << ", tests=" << stats.tests << ", over_budget=" << stats.over_budget << ")";
  return text.str();
}

std::string text_of(const WorldStats& stats) {
  std::ostringstream text;
  text << "boxstream.WorldStats(proxies=" << stats.proxies << ", invalid=" << stats.invalid << ", moved=" << stats.moved
       << ", pairs=" << stats.pairs << ", begun=" << stats.begun << ", ended=" << stats.ended
       << ", search=" << text_of(stats.search) << ")";
  return text.str();
}

}  // namespace

void add_stats(py::module_& module) {
  py::class_<Stats>(module, "Stats", "What one search did. Counts do not depend on threads or on the SIMD width.")
      .def_readonly("boxes", &Stats::boxes, "int: boxes given, both sets together.")
      .def_readonly("invalid", &Stats::invalid, "int: of these, boxes with a NaN or min > max; they pair with nothing.")
      .def_readonly("pairs", &Stats::pairs, "int: pairs delivered.")
      .def_readonly("nodes", &Stats::nodes, "int: nodes of the streamed tree that were split.")
      .def_readonly("cells", &Stats::cells, "int: leaves that were swept.")
      .def_readonly("records", &Stats::records, "int: boxes swept in all leaves, copies included.")
      .def_readonly("tests", &Stats::tests, "int: comparisons of two boxes in the sweeps.")
      .def_readonly("over_budget", &Stats::over_budget, "int: sweeps that compared too much and were cut at medians.")
      .def("__repr__", [](const Stats& stats) { return text_of(stats); });
  py::class_<WorldStats>(module, "WorldStats", "What one update of a World did.")
      .def_readonly("proxies", &WorldStats::proxies, "int: live proxies.")
      .def_readonly("invalid", &WorldStats::invalid, "int: proxies whose box has a NaN or min > max.")
      .def_readonly("moved", &WorldStats::moved,
                    "int: proxies whose box changed since the last update, new ones included.")
      .def_readonly("pairs", &WorldStats::pairs, "int: pairs held.")
      .def_readonly("begun", &WorldStats::begun, "int: pairs that began.")
      .def_readonly("ended", &WorldStats::ended, "int: pairs that ended.")
      .def_readonly("search", &WorldStats::search, "Stats: of the batch, if one ran.")
      .def("__repr__", [](const WorldStats& stats) { return text_of(stats); });
}

}  // namespace boxstream::python
