// SPDX-License-Identifier: MIT
// The reader of .aabbs files: any bytes give frames or a complaint in one line, from a file and from a pipe, and what
// was read is written and read again without a change.
//
// Input: an .aabbs file (demos/formats/aabbs/format.hpp), whole or broken.
#include <cstring>
#include <ios>
#include <istream>
#include <sstream>
#include <string>
#include <vector>

#include "finding.hpp"
#include "formats/aabbs/reader.hpp"
#include "formats/aabbs/writer.hpp"

namespace boxstream::fuzz {
namespace {

struct Pipe : std::stringbuf {
  using std::stringbuf::stringbuf;
  pos_type seekoff(off_type, std::ios::seekdir, std::ios::openmode) override { return pos_type(off_type(-1)); }
};

struct Reading {
  aabbs::Header header;
  std::vector<std::vector<Aabb>> frames;
  std::string complaint;
};

Reading read(const std::string& bytes, bool seekable) {
  std::stringbuf file(bytes);
  Pipe pipe(bytes);
  std::istream in(seekable ? &file : static_cast<std::streambuf*>(&pipe));
  Reading reading;
  try {
    aabbs::Reader reader(in);
    reading.header = reader.header();
    std::vector<Aabb> boxes;
    while (reader.next(boxes)) {
      promise(boxes.size() == reading.header.objects, "a frame with another number of boxes");
      reading.frames.push_back(boxes);
    }
    promise(reader.frames_read() == reading.frames.size(), "number of frames");
  } catch (const aabbs::AabbsError& error) {
    promise_one_line(error.what());
    reading.complaint = error.what();
  }
  return reading;
}

bool same_bits(const std::vector<Aabb>& a, const std::vector<Aabb>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(Aabb)) == 0);
}

void check_writer(const Reading& reading) {
  std::ostringstream out;
  aabbs::Writer writer(out, reading.header);
  for (const auto& boxes : reading.frames) writer.frame(boxes);
  // A file without the frame at the start is read, but not written.
  if (reading.frames.size() == reading.header.steps) writer.frame(reading.frames.back());
  writer.finish();
  const Reading again = read(out.str(), true);
  promise(again.complaint.empty(), "what was written cannot be read: " + again.complaint);
  promise(again.header.scene == reading.header.scene && again.header.type == reading.header.type, "texts");
  for (std::size_t i = 0; i < reading.frames.size(); ++i)
    promise(same_bits(again.frames[i], reading.frames[i]), "a box is another one after writing");
}

}  // namespace
}  // namespace boxstream::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace boxstream::fuzz;
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  const Reading file = read(bytes, true), pipe = read(bytes, false);
  promise(file.complaint.empty() == pipe.complaint.empty(),
          "good as a file or as a pipe only: " + file.complaint + pipe.complaint);
  if (file.complaint.empty()) {
    promise(file.frames.size() == pipe.frames.size(), "another number of frames from a pipe");
    check_writer(file);
  }
  return 0;
}
