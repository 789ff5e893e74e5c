// SPDX-License-Identifier: MIT
#pragma once

#include <tuple>
#include <vector>

namespace boxstream::detail {

/// The vectors of a caller's output while they are filled. They are emptied at once, and again when the scope ends
/// before all was done: whatever throws, and wherever, no output is partial.
template <class... T>
class EmptyOrWhole {
 public:
  explicit EmptyOrWhole(std::vector<T>&... output) : output_(output...) { clear(); }
  ~EmptyOrWhole() {
    if (!is_whole_) clear();
  }
  EmptyOrWhole(const EmptyOrWhole&) = delete;
  EmptyOrWhole& operator=(const EmptyOrWhole&) = delete;

  void is_whole() { is_whole_ = true; }

 private:
  void clear() {
    std::apply([](auto&... vector) { (vector.clear(), ...); }, output_);
  }

  std::tuple<std::vector<T>&...> output_;
  bool is_whole_ = false;
};

}  // namespace boxstream::detail
