// SPDX-License-Identifier: MIT
// Robots of any numbers: what our reader makes of the model that urdfdom parsed is a fragment that loads as a scene, or
// a complaint. The text is always good XML, because urdfdom itself is not ours; in the product it runs in a child
// process.
//
// Input: byte 0: bit 0 a fixed base, bit 1 a density is given, bit 2 motors hold, bit 3 y is up. Then elements, by a
// code modulo 3: a joint (type, parent, child, bits for what it has, numbers),
// else a link (bit 0 a mass, bits 1 and 2 how many shapes, numbers). Numbers as in bytes.hpp, names from a short list.
#include <unistd.h>

#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "bytes.hpp"
#include "finding.hpp"
#include "formats/import/geometry.hpp"
#include "formats/import/import_file.hpp"
#include "loads_as_scene.hpp"

namespace boxstream::fuzz {
namespace {

constexpr int most_elements = 24;

/// Written with <<, whose operands come in order: other ways to put texts together leave to the compiler which number
/// is read first.
class Robot {
 public:
  explicit Robot(Bytes& in) : in_(in) {}

  std::string text() {
    out_ << "<robot name=\"r\">";
    for (int i = 0; i < most_elements && !in_.empty(); ++i)
      if (in_.below(3) == 0)
        joint();
      else
        link();
    out_ << "</robot>";
    return out_.str();
  }

 private:
  std::string number() {
    char text[40];
    std::snprintf(text, sizeof text, "%.9g", in_.number<double>());
    return text;
  }
  std::string attribute(const char* name) { return std::string(" ") + name + "=\"" + number() + '"'; }
  std::string three(const char* name) {
    std::ostringstream text;
    text << ' ' << name << "=\"" << number() << ' ' << number() << ' ' << number() << '"';
    return text.str();
  }

  void origin() {
    if (in_.below(2) == 1) out_ << "<origin" << three("xyz") << three("rpy") << "/>";
  }
  std::string some_name() {
    static const char* const odd[] = {"world", "", "a/b", "&quot;", "\xc3\xa4", "j"};
    const unsigned choice = in_.byte();
    return choice < 0xf0 ? "l" + std::to_string(choice % (links_ + 1)) : odd[choice % 6];
  }
  void shape() {
    switch (in_.below(5)) {
      case 0:
        out_ << "<box" << three("size") << "/>";
        break;
      case 1:
        out_ << "<sphere" << attribute("radius") << "/>";
        break;
      case 2:
        out_ << "<cylinder" << attribute("radius") << attribute("length") << "/>";
        break;
      case 3:
        out_ << "<mesh filename=\"package://nowhere/none.stl\"" << three("scale") << "/>";
        break;
      default:
        out_ << "<box size=\"1 2 3\"/>";
    }
  }
  void link() {
    const unsigned how = in_.byte();
    out_ << "<link name=\"" << (how < 0xf0 ? "l" + std::to_string(links_++) : some_name()) << "\">";
    if ((how & 1) != 0) {
      out_ << "<inertial>";
      origin();
      out_ << "<mass" << attribute("value") << "/><inertia" << attribute("ixx") << " ixy=\"0\" ixz=\"0\""
           << attribute("iyy") << " iyz=\"0\" izz=\"1\"/></inertial>";
    }
    for (unsigned left = how >> 1 & 3; left > 0; --left) {
      out_ << "<collision>";
      origin();
      out_ << "<geometry>";
      shape();
      out_ << "</geometry></collision>";
    }
    out_ << "</link>";
  }
  void joint() {
    static const char* const types[] = {"revolute", "continuous", "prismatic", "fixed", "floating", "planar", "other"};
    out_ << "<joint name=\"j" << joints_++ << "\" type=\"" << types[in_.below(7)] << "\"><parent link=\"" << some_name()
         << "\"/><child link=\"" << some_name() << "\"/>";
    origin();
    const unsigned how = in_.byte();
    if ((how & 1) != 0) out_ << "<axis" << three("xyz") << "/>";
    if ((how & 2) != 0)
      out_ << "<limit" << attribute("lower") << attribute("upper") << attribute("effort") << attribute("velocity")
           << "/>";
    if ((how & 4) != 0) out_ << "<dynamics" << attribute("damping") << attribute("friction") << "/>";
    if ((how & 8) != 0) out_ << "<mimic joint=\"j0\"" << attribute("multiplier") << "/>";
    out_ << "</joint>";
  }

  Bytes& in_;
  std::ostringstream out_;
  unsigned links_ = 0;
  unsigned joints_ = 0;
};

/// The reader takes a path.
const std::string& scratch_file() {
  static const std::string path =
      (std::filesystem::temp_directory_path() / ("boxstream-fuzz-" + std::to_string(getpid()) + ".urdf")).string();
  return path;
}

void run(Bytes& in) {
  const unsigned flags = in.byte();
  imports::ImportOptions options;
  options.fixed_base = (flags & 1) != 0;
  if ((flags & 2) != 0) options.density = 500;
  options.hold = (flags & 4) != 0;
  const imports::Quat upright{0, 0, 0, 1}, turned{-0.5, 0.5, 0.5, 0.5};
  imports::Fragment fragment{imports::Frame{{1, 2, 3}, (flags & 8) != 0 ? upright : turned}};
  std::ofstream(scratch_file(), std::ios::binary) << Robot(in).text();
  try {
    read_urdf(scratch_file(), options, fragment);
    bodies_as_scene(fragment);
  } catch (const std::exception& error) {
    promise(*error.what() != '\0', "an empty complaint");
  }
  std::remove(scratch_file().c_str());
}

}  // namespace
}  // namespace boxstream::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  boxstream::fuzz::Bytes in(data, size);
  boxstream::fuzz::run(in);
  return 0;
}
