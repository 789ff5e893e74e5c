// SPDX-License-Identifier: MIT
#include "boxstream/manual/roff.hpp"

#include <sstream>
#include <string_view>

namespace boxstream::tool {
namespace {

/// Typewriter signs, which roff would set as typographic ones, and its own backslash.
std::string escaped(std::string_view text) {
  std::string roff;
  for (const char c : text) switch (c) {
      case '\\':
        roff += "\\(rs";
        break;
      case '-':
        roff += "\\-";
        break;
      case '\'':
        roff += "\\(aq";
        break;
      case '`':
        roff += "\\(ga";
        break;
      case '^':
        roff += "\\(ha";
        break;
      case '~':
        roff += "\\(ti";
        break;
      case '"':
        roff += "\\(dq";
        break;
      default:
        roff += c;
    }
  return roff;
}

}  // namespace

std::string Roff::plain(const std::string& word) {
  return escaped(word);
}

std::string Roff::bold(const std::string& word) {
  return "\\fB" + escaped(word) + "\\fR";
}

std::string Roff::italic(const std::string& word) {
  return "\\fI" + escaped(word) + "\\fR";
}

void Roff::title(const std::string& page, const std::string& source) {
  raw_line(".TH \"" + escaped(page) + "\" \"1\" \"\" \"" + escaped(source) + "\" \"User Commands\"");
}

void Roff::section(const std::string& name) {
  raw_line(".SH " + name);
}

void Roff::entry(const std::string& term, const std::string& text) {
  raw_line(".TP\n" + term);
  line(text);
}

void Roff::prose(const std::string& text) {
  std::istringstream lines(text);
  bool literal = false, parted = false, begun = false;
  const auto become = [&](bool wanted) {
    if (wanted != literal) raw_line(wanted ? ".RS 2\n.nf" : ".fi\n.RE");
    literal = wanted;
  };
  for (std::string each; std::getline(lines, each);) {
    if (each.empty()) {
      parted = begun;
      continue;
    }
    if (parted) become(false), raw_line(".PP");
    become(each.starts_with("  "));
    line(each.substr(literal ? 2 : 0));
    parted = false, begun = true;
  }
  become(false);
}

void Roff::line(const std::string& text) {
  const bool is_request = text.starts_with(".") || text.starts_with("'");
  raw_line((is_request ? "\\&" : "") + escaped(text));
}

}  // namespace boxstream::tool
