// SPDX-License-Identifier: MIT
// The reader of .bsrec files: any bytes give well-formed calls or a complaint in one line, the same each time, and what
// could be read is written and read again without a change.
//
// Input: a .bsrec file (docs/bsrec.md), whole or broken.
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "finding.hpp"
#include "formats/record/op.hpp"
#include "formats/record/reader.hpp"
#include "formats/record/replay.hpp"
#include "formats/record/same_op.hpp"
#include "formats/record/writer.hpp"

namespace boxstream::fuzz {
namespace {

using record::CutOff;
using record::Op;
using record::Reader;
using record::RecordError;

using Input = Span<const std::uint8_t>;

void promise_a_place(const RecordError& error) {
  const std::string text = error.what();
  promise_one_line(text);
  promise(text.starts_with("offset "), "a complaint without a place: " + text);
}

struct Reading {
  std::optional<record::Header> header;
  std::vector<Op> ops;
  std::string complaint;
};

Reading read(Input bytes, CutOff cut_off) {
  Reading reading;
  try {
    Reader reader(bytes, cut_off);
    reading.header = reader.header();
    promise_one_line("header: " + text_of(reader.header()));
    try {
      std::size_t last = 0;
      while (const std::optional<Op> op = reader.next()) {
        promise(reader.offset() > last && reader.offset() < bytes.size(), "offset of an op");
        last = reader.offset();
        promise_one_line(text_of(*op, reader.header().scalar));
        reading.ops.push_back(*op);
      }
    } catch (const RecordError& error) {
      promise_a_place(error);
      reading.complaint = error.what();
      try {
        reader.next();
        found("an error was forgotten");
      } catch (const RecordError& again) {
        promise(reading.complaint == again.what(), "another error at the second call");
      }
    }
  } catch (const RecordError& error) {
    promise_a_place(error);
    reading.complaint = error.what();
  }
  return reading;
}

void check_census(Input bytes, const Reading& reading) {
  try {
    const record::Census census = record::census_of(bytes);
    promise(reading.complaint.empty(), "a census of a broken file");
    promise(census.created + census.moves + census.destroyed + census.refilters + census.box_queries +
                    census.ray_queries + census.batches + census.resets ==
                reading.ops.size(),
            "census and calls differ");
  } catch (const RecordError& error) {
    promise(reading.complaint == error.what(), "the census has another complaint");
  }
}

void check_writer(const Reading& reading) {
  std::ostringstream out;
  record::Writer writer(out, *reading.header);
  for (const Op& op : reading.ops) writer.write(op);
  writer.finish();
  const std::string text = out.str();
  const Reading again = read({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}, CutOff::is_error);
  promise(again.complaint.empty(), "what was written cannot be read: " + again.complaint);
  // Moves to the same box are not written.
  std::size_t at = 0;
  for (const Op& op : reading.ops) {
    if (at < again.ops.size() && record_test::same(op, again.ops[at]))
      ++at;
    else
      promise(std::holds_alternative<record::Move>(op), "written and read, a call is another one");
  }
  promise(at == again.ops.size(), "there are more calls than were written");
}

}  // namespace
}  // namespace boxstream::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace boxstream;
  const fuzz::Input bytes(data, size);
  const fuzz::Reading whole = fuzz::read(bytes, record::CutOff::is_error);
  const fuzz::Reading partial = fuzz::read(bytes, record::CutOff::is_end);
  fuzz::promise(partial.ops.size() == whole.ops.size(), "taken for a partial file it has other calls");
  fuzz::check_census(bytes, whole);
  if (whole.header) fuzz::check_writer(whole);
  return 0;
}
