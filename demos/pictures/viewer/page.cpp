// SPDX-License-Identifier: MIT
#include "pictures/viewer/page.hpp"

#include <ostream>

#include "pictures/viewer/description.hpp"
#include "pictures/viewer/shell.hpp"
#include "pictures/viewer/text.hpp"

namespace boxstream::view {
namespace {

void put(std::ostream& out, const std::string& id, std::string_view bytes) {
  out << "<script type=\"text/plain\" id=\"" << id << "\">" << base64(bytes) << "</script>\n";
}

}  // namespace

bool has_pages() {
  return !shell().empty();
}

void write_page(std::ostream& out, const std::vector<PageWorld>& worlds, const std::string& versions) {
  const std::string_view page = shell();
  const std::size_t mark = page.find(shell_mark);
  if (mark == std::string_view::npos) return;
  out << page.substr(0, mark);
  for (std::size_t w = 0; w < worlds.size(); ++w) {
    const std::string number = std::to_string(w);
    put(out, "world-" + number, deflated(describe(worlds[w], versions)));
    const std::vector<std::string>& blocks = worlds[w].recording->blocks();
    for (std::size_t i = 0; i < blocks.size(); ++i) put(out, "frames-" + number + "-" + std::to_string(i), blocks[i]);
  }
  out << page.substr(mark + shell_mark.size());
}

}  // namespace boxstream::view
