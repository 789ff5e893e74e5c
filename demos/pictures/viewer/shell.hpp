// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace boxstream::view {

/// The viewer's page without anything to view: HTML, styles and scripts in one. Whatever is to be viewed goes in where
/// `shell_mark` stands. Empty if this library was built without Node.js, which puts the page together.
std::string_view shell();

inline constexpr std::string_view shell_mark = "<!--run-->";

/// The same of the page that shows what accuracy costs in time; its JSON goes in where `accuracy_mark` stands.
std::string_view accuracy_shell();

inline constexpr std::string_view accuracy_mark = "/*data*/";

}  // namespace boxstream::view
