// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "report.hpp"

namespace boxstream::bench {

/// The rows of a file that Report wrote. Throws std::runtime_error when it is no such file.
std::vector<Row> read_rows(const std::string& json_path);

/// One line, in Markdown, that says on what machine, when and from which sources a file's rows were measured.
std::string describe_run(const std::string& json_path);

/// In Markdown: what the project wants of the rows' cases, and what they gave; then the best peer of each case. Empty
/// without rows.
std::string results_table(const std::vector<Row>& rows);

/// `page` with `text` in place of what is between its lines `<!-- NAME: begin -->` and `<!-- NAME: end -->`. Throws
/// std::runtime_error if it does not have both, in this order.
std::string put_block(const std::string& page, const std::string& name, const std::string& text);

/// The same with a file; with an empty path, prints `text` instead.
void put_or_print(const std::string& path, const std::string& name, const std::string& text);

}  // namespace boxstream::bench
