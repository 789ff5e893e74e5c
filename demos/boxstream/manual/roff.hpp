// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace boxstream::tool {

/// Text for a manual page, in roff with the macros of man(7). Text is escaped, so that no word acts as a macro.
class Roff {
 public:
  void title(const std::string& page, const std::string& source);
  void section(const std::string& name);
  /// An entry of a list: `term` is roff, see plain(), bold() and italic(); the text is what follows.
  void entry(const std::string& term, const std::string& text);
  /// Paragraphs with blank lines between them; lines that begin with blanks stay as they are.
  void prose(const std::string& text);
  void raw_line(const std::string& roff) { page_ += roff + "\n"; }

  static std::string plain(const std::string& word);
  static std::string bold(const std::string& word);
  static std::string italic(const std::string& word);

  const std::string& page() const { return page_; }

 private:
  void line(const std::string& text);

  std::string page_;
};

}  // namespace boxstream::tool
