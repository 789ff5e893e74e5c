// SPDX-License-Identifier: MIT
#include "boxstream/simulate/states_file.hpp"

#include <fmt/format.h>

#include <iterator>

#include <btBulletDynamicsCommon.h>

#include "formats/scene_model/expand.hpp"

namespace boxstream::tool {

StatesFile::StatesFile(const std::string& path) : file_(path) {
  file_.stream() << "step,seconds,object,x,y,z,qx,qy,qz,qw,vx,vy,vz,wx,wy,wz\n";
}

void StatesFile::write(const scenes::Simulation& simulation) {
  const std::uint64_t step = simulation.steps_done();
  std::string text;
  const auto to = std::back_inserter(text);
  // Bodies come first among the objects.
  for (std::size_t i = 0; i < simulation.expanded().bodies.size(); ++i) {
    const btRigidBody& body = *btRigidBody::upcast(simulation.objects()[i]);
    if (body.isStaticObject()) continue;
    const btTransform pose = simulation.pose(i);
    const btVector3 &place = pose.getOrigin(), &v = body.getLinearVelocity(), &spin = body.getAngularVelocity();
    const btQuaternion turn = pose.getRotation();
    fmt::format_to(to, "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", step,
                   static_cast<double>(step) * simulation.scene().time.dt, i, place.x(), place.y(), place.z(), turn.x(),
                   turn.y(), turn.z(), turn.w(), v.x(), v.y(), v.z(), spin.x(), spin.y(), spin.z());
  }
  file_.stream() << text;
}

}  // namespace boxstream::tool
