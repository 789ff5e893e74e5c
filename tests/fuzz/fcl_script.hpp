// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <stdexcept>

#include "fcl/support.hpp"
#include "finding.hpp"

namespace boxstream::fuzz {

/// What a callback does: takes down the call, asks something else, and ends the query by a word or an exception.
template <class S>
struct Script {
  std::size_t stop = 0;  // at this call, if not 0
  bool throws = false;
  S limit = std::numeric_limits<S>::max();
  std::function<void()> nested;
  fcl_test::Calls calls = {};

  static bool on_pair(fcl_test::Object<S>* a, fcl_test::Object<S>* b, void* data) {
    Script& script = *static_cast<Script*>(data);
    script.calls.push_back({fcl_test::name_of(a), fcl_test::name_of(b)});
    promise(script.stop == 0 || script.calls.size() <= script.stop, "called again after the end");
    if (script.nested && script.calls.size() % 8 == 1) script.nested();
    if (script.calls.size() != script.stop) return false;
    if (script.throws) throw std::logic_error("narrow phase");
    return true;
  }
  static bool on_distance(fcl_test::Object<S>* a, fcl_test::Object<S>* b, void* data, S& dist) {
    dist = static_cast<Script*>(data)->limit;
    return on_pair(a, b, data);
  }

  /// True if the query came to its own end.
  template <class Query>
  bool run(Query query) {
    try {
      query(*this);
    } catch (const std::logic_error&) {
      promise(throws && calls.size() == stop, "an exception that no callback threw");
    }
    return stop == 0 || calls.size() < stop;
  }
};

}  // namespace boxstream::fuzz
