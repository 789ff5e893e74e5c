// SPDX-License-Identifier: MIT
// Files of every kind with bytes changed, lost and repeated: whatever the libraries that read them make of it, there is
// a fragment of a scene or one line that names the file.
#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>
#include <random>

#include "formats/import/import_file.hpp"
#include "formats/scene_model/scene_error.hpp"
#include "mesh_files.hpp"
#include "sanitized.hpp"
#include "scratch_directory.hpp"

#ifdef BOXSTREAM_HAS_BULLET_IMPORTER
#include "original.hpp"
#endif

namespace boxstream::import_test {
namespace {

// A child process takes its time under sanitizers.
constexpr unsigned most_files = tests::sanitized ? 6 : 24;

struct Kind {
  std::string name;
  std::string file;
  std::string (*bytes)();
};

std::ostream& operator<<(std::ostream& out, const Kind& kind) {
  return out << kind.name;
}

std::string robot() {
  return R"(<robot name="r"><link name="a"><inertial><mass value="2"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0"
    izz="1"/></inertial><collision><geometry><box size="1 1 1"/></geometry></collision></link>
    <joint name="j" type="revolute"><parent link="a"/><child link="b"/><origin xyz="0 0 1" rpy="0 0.5 0"/>
    <axis xyz="0 1 0"/><limit lower="-1" upper="1" effort="3" velocity="2"/></joint>
    <link name="b"><inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
    <collision><origin xyz="0 0 1"/><geometry><cylinder radius="0.5" length="2"/></geometry></collision></link></robot>)";
}

#ifdef BOXSTREAM_HAS_BULLET_IMPORTER
std::string bullet_world() {
  Original original;
  auto& box = original.shape<btBoxShape>(btVector3(1, 1, 1));
  auto& ball = original.shape<btSphereShape>(btScalar(1));
  btRigidBody& a = original.body(1, box, btVector3(0, 0, 0));
  btRigidBody& b = original.body(2, ball, btVector3(0, 3, 0));
  original.join(std::make_unique<btPoint2PointConstraint>(a, b, btVector3(0, 1, 0), btVector3(0, -2, 0)));
  return original.bytes();
}
#endif

const Kind kinds[] = {
#ifdef BOXSTREAM_HAS_ASSIMP
    {"Obj", "m.obj", [] { return as_obj(ell()); }},
    {"StlText", "m.stl", [] { return as_ascii_stl(ell()); }},
    {"StlBytes", "m.stl", [] { return as_binary_stl(ell()); }},
    {"Ply", "m.ply", [] { return as_ply(ell()); }},
    {"Gltf", "m.gltf", [] { return gltf_json(ell(), "m.bin"); }},
    {"Glb", "m.glb", [] { return as_glb(ell()); }},
#endif
#ifdef BOXSTREAM_HAS_BULLET_IMPORTER
    {"Bullet", "w.bullet", bullet_world},
#endif
#ifdef BOXSTREAM_HAS_URDFDOM
    {"Urdf", "r.urdf", robot},
#endif
};

/// One to four changes; distributions of the standard library give other numbers elsewhere. Every fourth file has only
/// another digit somewhere: most of these can still be read.
std::string mutated(std::string bytes, unsigned seed) {
  std::mt19937 random(seed);
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random()) % n; };
  if (const std::size_t digit = bytes.find_first_of("0123456789", below(bytes.size()));
      seed % 4 == 0 && digit != std::string::npos) {
    bytes[digit] = static_cast<char>('0' + below(10));
    return bytes;
  }
  for (std::size_t left = 1 + below(4); left > 0 && !bytes.empty(); --left) {
    const std::size_t at = below(bytes.size());
    switch (below(6)) {
      case 0:
        bytes[at] = static_cast<char>(random());
        break;
      case 1:
        bytes[at] = static_cast<char>(bytes[at] ^ 1 << below(8));
        break;
      case 2:  // a count that is too large
        for (std::size_t i = at; i < std::min(bytes.size(), at + 4); ++i) bytes[i] = '\xff';
        break;
      case 3:
        bytes[at] = "0123456789-.e\"<>/ "[below(18)];
        break;
      case 4: {
        const std::size_t from = below(bytes.size());
        bytes.insert(at, bytes.substr(from, 1 + below(40)));
        break;
      }
      default:
        bytes.erase(at, left == 1 ? 1 + below(40) : 1);
    }
  }
  return bytes;
}

class MutatedFile : public testing::TestWithParam<Kind> {};

TEST_P(MutatedFile, IsReadOrRefusedInOneLine) {
  const Kind& kind = GetParam();
  const tool_test::ScratchDirectory scratch;
  const std::string good = kind.bytes();
  scratch.write("m.bin", gltf_buffer(ell()));
  ASSERT_NO_THROW(imports::import_file(scratch.write(kind.file, good), {}));
  unsigned read = 0, refused = 0;
  for (unsigned seed = 0; seed < most_files; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const std::string path = scratch.write(kind.file, mutated(good, seed));
    try {
      const auto blocks = nlohmann::json::parse(imports::import_file(path, {}), nullptr, false);
      ASSERT_TRUE(blocks.is_object());
      EXPECT_FALSE(blocks["bodies"].empty());
      ++read;
    } catch (const scenes::SceneError& error) {
      const std::string line = error.what();
      EXPECT_TRUE(line.starts_with(path + ": ")) << line;
      EXPECT_GT(line.size(), path.size() + 2);
      EXPECT_EQ(line.find('\n'), std::string::npos) << line;
      ++refused;
    }
  }
  EXPECT_EQ(read + refused, most_files);
  if (most_files > 20) {
    EXPECT_GT(read, 0u);
    EXPECT_GT(refused, 0u);
  }
}

INSTANTIATE_TEST_SUITE_P(Import, MutatedFile, testing::ValuesIn(kinds),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace boxstream::import_test
