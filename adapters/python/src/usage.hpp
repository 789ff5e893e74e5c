// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>

#include "apart.hpp"

namespace boxstream::python {

/// Who uses an object while the interpreter's lock is released: any number that read, or one that changes it. Its own
/// members are guarded by that lock. A second use that does not go together with the first is an error, not a wait:
/// the first could be a search whose callback makes the second.
class Usage {
 public:
  explicit Usage(const char* what) : what_(what) {}
  Usage(const Usage&) = delete;
  Usage& operator=(const Usage&) = delete;

  class Change {
   public:
    explicit Change(Usage& usage) : usage_(usage) {
      if (usage.changing_) let_go();
      if (usage.changing_ || usage.readers_ != 0) usage.refuse();
      usage.changing_ = true;
    }
    ~Change() { usage_.changing_ = false; }
    Change(const Change&) = delete;
    Change& operator=(const Change&) = delete;

   private:
    Usage& usage_;
  };

  class Read {
   public:
    explicit Read(Usage& usage) : usage_(usage) {
      if (usage.changing_) let_go();
      if (usage.changing_) usage.refuse();
      ++usage.readers_;
    }
    ~Read() { --usage_.readers_; }
    Read(const Read&) = delete;
    Read& operator=(const Read&) = delete;

   private:
    Usage& usage_;
  };

 private:
  [[noreturn]] void refuse() const {
    throw std::runtime_error(
        std::string("this ") + what_ +
        " is in use, by another thread, by the caller's own callback, or by a search that was left "
        "and goes on");
  }

  const char* what_;
  int readers_ = 0;
  bool changing_ = false;
};

}  // namespace boxstream::python
