// SPDX-License-Identifier: MIT
#include "detector.hpp"

#include <algorithm>
#include <utility>

namespace boxstream::python {

void PyDetector::refuse_pairs(const std::string& what) {
  const std::string text = "pairs: " + what + "; stream_pairs passes them on block by block";
  PyErr_SetString(PyExc_MemoryError, text.c_str());
  throw py::error_already_set();
}

namespace {

/// `detector.stream_pairs` of one set or of two.
Stats stream_all(Detector& detector, const Search& search, PairSink sink) {
  return search.has_other() ? detector.stream_pairs(search.a(), search.b(), sink, search.rules())
                            : detector.stream_pairs(search.a(), sink, search.rules());
}

}  // namespace

py::array PyDetector::find_pairs(SearchPointer search, py::handle dtype, py::handle max_pairs) {
  const Indices indices = indices_of(dtype);
  std::vector<Pair> pairs = collect(max_pairs, search->boxes(), [search](Detector& detector, PairSink sink) {
    return stream_all(detector, *search, sink);
  });
  search->warn(stats_);
  return index_array(std::move(pairs), indices, 2);
}

py::tuple PyDetector::find_pairs_in_sets(SearchPointer search, py::handle offsets, py::handle other_offsets,
                                         py::handle dtype) {
  if (search->has_other() == other_offsets.is_none())
    throw py::type_error("other, other_offsets: expected both or neither, got one");
  const Indices indices = indices_of(dtype);
  const auto offsets_of = [](py::handle given, const char* name, std::size_t boxes) {
    std::vector<std::int64_t> signed_ones = integers_of<std::int64_t>(given, name);
    if (signed_ones.empty() || signed_ones.front() != 0 || signed_ones.back() != static_cast<std::int64_t>(boxes) ||
        !std::is_sorted(signed_ones.begin(), signed_ones.end()))
      throw py::value_error(std::string(name) + ": expected integers that ascend from 0 to the number of boxes, " +
                            std::to_string(boxes) + "; numpy.append(0, numpy.cumsum(sizes)) makes them of sizes");
    return std::vector<std::uint64_t>(signed_ones.begin(), signed_ones.end());
  };
  std::vector<std::uint64_t> sets_a = offsets_of(offsets, "offsets", search->a().size()), sets_b;
  if (search->has_other()) sets_b = offsets_of(other_offsets, "other_offsets", search->b().size());
  const auto found = std::make_shared<PairsOfSets>();
  run_whole(search->boxes(), least_apart_silent,
            [search, found, sets_a = std::move(sets_a), sets_b = std::move(sets_b)](Detector& detector, GoesOn) {
              return search->has_other()
                         ? detector.find_pairs(search->a(), sets_a, search->b(), sets_b, *found, search->rules())
                         : detector.find_pairs(search->a(), sets_a, *found, search->rules());
            });
  search->warn(stats_);
  return py::make_tuple(index_array(std::move(found->pairs), indices, 2),
                        array_of<std::int64_t>(std::move(found->offsets)));
}

py::tuple PyDetector::find_neighbours(SearchPointer search, py::handle both, py::handle dtype) {
  const Indices indices = indices_of(dtype);
  const Directions directions = flag_of(both, "both") ? Directions::both : Directions::one;
  const auto found = std::make_shared<Neighbours>();
  run_whole(search->boxes(), least_apart_silent, [search, found, directions](Detector& detector, GoesOn) {
    return search->has_other() ? detector.find_neighbours(search->a(), search->b(), *found, search->rules())
                               : detector.find_neighbours(search->a(), *found, search->rules(), directions);
  });
  search->warn(stats_);
  return py::make_tuple(array_of<std::int64_t>(std::move(found->offsets)),
                        index_array(std::move(found->indices), indices, 0));
}

std::uint64_t PyDetector::stream_pairs(const Search& search, py::handle callback, py::handle block, py::handle dtype) {
  const std::uint64_t passed = stream(
      callback, block, dtype, [&](Detector& detector, PairSink sink) { return stream_all(detector, search, sink); });
  search.warn(stats_);
  return passed;
}

py::array PyDetector::find_near_pairs(std::shared_ptr<const NearSearch> search, py::handle dtype,
                                      py::handle max_pairs) {
  const Indices indices = indices_of(dtype);
  std::vector<Pair> pairs = collect(max_pairs, search->points(), [search](Detector& detector, PairSink sink) {
    return search->visit(
        [&](auto balls) { return boxstream::stream_near_pairs(detector, balls, search->distance(), sink); });
  });
  search->warn(stats_);
  return index_array(std::move(pairs), indices, 2);
}

std::uint64_t PyDetector::stream_near_pairs(const NearSearch& search, py::handle callback, py::handle block,
                                            py::handle dtype) {
  const std::uint64_t passed = search.visit([&](auto balls) {
    return stream(callback, block, dtype, [&](Detector& detector, PairSink sink) {
      return boxstream::stream_near_pairs(detector, balls, search.distance(), sink);
    });
  });
  search.warn(stats_);
  return passed;
}

}  // namespace boxstream::python
