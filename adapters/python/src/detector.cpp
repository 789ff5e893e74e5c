// SPDX-License-Identifier: MIT
#include "detector.hpp"

#include <optional>
#include <utility>
#include <vector>

namespace boxstream::python {

namespace {

/// One set of boxes or two, with their filters, as the caller gave them.
class Sets {
 public:
  Sets(py::handle boxes, py::handle other, py::handle groups, py::handle masks, Invalid invalid)
      : a_(boxes, "boxes", invalid) {
    if (other.is_none()) {
      filters_a_ = filters_of(groups, masks, a_.size(), "");
      return;
    }
    b_.emplace(other, "other", invalid);
    b_->floats().require(a_.scalar(), "boxes are");
    const py::tuple two_groups = two(groups, "groups"), two_masks = two(masks, "masks");
    filters_a_ = filters_of(two_groups[0], two_masks[0], a_.size(), "[0]");
    filters_b_ = filters_of(two_groups[1], two_masks[1], b_->size(), "[1]");
  }

  /// `search(a, filters_a)` or `search(a, b, filters_a, filters_b)`.
  template <class Search>
  Stats visit(Search search) const {
    return with_scalar(a_.scalar(), [&](auto s) {
      using S = decltype(s);
      return b_ ? search(a_.as<S>(), b_->as<S>(), Span<const Filter>(filters_a_), Span<const Filter>(filters_b_))
                : search(a_.as<S>(), Span<const Filter>(filters_a_));
    });
  }

 private:
  /// With two sets, a tuple of an array or None for each.
  static py::tuple two(py::handle given, const char* name) {
    if (given.is_none()) return py::make_tuple(py::none(), py::none());
    if (!py::isinstance<py::tuple>(given) || py::len(given) != 2)
      throw py::type_error(std::string(name) + ": expected a tuple of two arrays of uint32 or None, as there are two " +
                           "sets of boxes, got an object of type " + type_of(given));
    return py::reinterpret_borrow<py::tuple>(given);
  }

  Boxes a_;
  std::optional<Boxes> b_;
  std::vector<Filter> filters_a_, filters_b_;
};

template <class S>
using BoxSpan = Span<const BasicAabb<S>>;
using Filters = Span<const Filter>;

/// A search that may be for one set or for two.
template <class One, class Two>
struct Either : One, Two {
  using One::operator();
  using Two::operator();
};
template <class One, class Two>
Either(One, Two) -> Either<One, Two>;

}  // namespace

py::array PyDetector::find_pairs(py::handle boxes, py::handle other, py::handle groups, py::handle masks,
                                 py::handle invalid) {
  const Sets sets(boxes, other, groups, masks, invalid_policy(invalid));
  std::vector<Pair> pairs;
  run([&](Detector& detector, const Unlocked&) {
    return sets.visit(Either{
        [&]<class S>(BoxSpan<S> a, Filters filters) { return detector.find_pairs(a, pairs, filters); },
        [&]<class S>(BoxSpan<S> a, BoxSpan<S> b, Filters filters_a, Filters filters_b) {
          return detector.find_pairs(a, b, pairs, filters_a, filters_b);
        },
    });
  });
  return array_of<std::uint32_t>(std::move(pairs));
}

py::tuple PyDetector::find_pairs_in_sets(py::handle boxes, py::handle offsets, py::handle other,
                                         py::handle other_offsets, py::handle groups, py::handle masks,
                                         py::handle invalid) {
  if (other.is_none() != other_offsets.is_none())
    throw py::type_error("other, other_offsets: expected both or neither, got one");
  const Sets sets(boxes, other, groups, masks, invalid_policy(invalid));
  const std::vector<std::uint64_t> sets_a = offsets_of(offsets, "offsets");
  const std::vector<std::uint64_t> sets_b =
      other.is_none() ? std::vector<std::uint64_t>() : offsets_of(other_offsets, "other_offsets");
  PairsOfSets found;
  run([&](Detector& detector, const Unlocked&) {
    return sets.visit(Either{
        [&]<class S>(BoxSpan<S> a, Filters filters) { return detector.find_pairs(a, sets_a, found, filters); },
        [&]<class S>(BoxSpan<S> a, BoxSpan<S> b, Filters filters_a, Filters filters_b) {
          return detector.find_pairs(a, sets_a, b, sets_b, found, filters_a, filters_b);
        },
    });
  });
  return py::make_tuple(array_of<std::uint32_t>(std::move(found.pairs)),
                        array_of<std::uint64_t>(std::move(found.offsets)));
}

std::uint64_t PyDetector::stream_pairs(py::handle boxes, py::handle callback, py::handle other, py::handle groups,
                                       py::handle masks, py::handle block, py::handle invalid) {
  const Sets sets(boxes, other, groups, masks, invalid_policy(invalid));
  return stream(callback, block, [&](Detector& detector, PairSink sink) {
    return sets.visit(Either{
        [&]<class S>(BoxSpan<S> a, Filters filters) { return detector.stream_pairs(a, sink, filters); },
        [&]<class S>(BoxSpan<S> a, BoxSpan<S> b, Filters filters_a, Filters filters_b) {
          return detector.stream_pairs(a, b, sink, filters_a, filters_b);
        },
    });
  });
}

}  // namespace boxstream::python
