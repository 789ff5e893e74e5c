// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "tables/report.hpp"

namespace boxstream::bench {

/// What a file that Report wrote contains.
struct ResultsFile {
  Machine machine;
  std::vector<Row> rows;
};

/// Throws std::runtime_error when the file is no such file.
ResultsFile read_results(const std::string& json_path);

/// One line, in Markdown: the machine, the date and the sources of a run.
std::string describe_run(const Machine& machine);

/// In Markdown: the cases in which a peer is faster, the best peer of each case, and the yardsticks but for the paper's
/// tree. Empty without rows.
std::string results_table(const std::vector<Row>& rows);

/// In Markdown: of each case of frames the median and the worst of ours, and of the peer whose worst one takes least.
/// Empty without such rows.
std::string frames_table(const std::vector<Row>& rows);

/// `page` with `text` in place of what is between its lines `<!-- NAME: begin -->` and `<!-- NAME: end -->`. Throws
/// std::runtime_error if it does not have both, in this order.
std::string put_block(const std::string& page, const std::string& name, const std::string& text);

/// The same with a file; with an empty path, prints `text` instead.
void put_or_print(const std::string& path, const std::string& name, const std::string& text);

}  // namespace boxstream::bench
