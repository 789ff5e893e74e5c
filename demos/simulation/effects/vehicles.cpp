// SPDX-License-Identifier: MIT
#include "simulation/effects/effects.hpp"
#include "simulation/effects/find.hpp"
#include "simulation/effects/scene_instance.hpp"
#include "simulation/engine/convert.hpp"
#include "simulation/engine/world_recipe.hpp"

namespace boxstream::effects {
namespace {

using namespace scenes;

std::optional<Call> calls_for_vehicles(const Subject& subject) {
  return first_of(subject.scene.vehicles, "/vehicles", "a vehicle");
}

void prepare_vehicles(const Subject&, WorldRecipe& recipe) {
  recipe.collide = true;
}

void add(SceneInstance& instance, const Vehicle& description) {
  btRigidBody& chassis = *instance.bodies[description.chassis];
  // Wheels are described as the chassis is, and Bullet has them where it has the body.
  const btTransform seen = instance.frame(description.chassis).inverse();
  Car& car = instance.cars.emplace_back();
  btRaycastVehicle::btVehicleTuning tuning;
  tuning.m_suspensionStiffness = real(description.stiffness);
  tuning.m_frictionSlip = real(description.grip);
  // Stiffness is for each kilogram, so heavy vehicles need more than Bullet's default of 6000 N.
  tuning.m_maxSuspensionForce = BT_LARGE_FLOAT;
  car.raycaster = std::make_unique<btDefaultVehicleRaycaster>(&instance.world.world());
  car.vehicle = std::make_unique<btRaycastVehicle>(tuning, &chassis, car.raycaster.get());
  car.vehicle->setCoordinateSystem(0, 1, 2);  // x to the side, y up, z ahead
  for (const Wheel& wheel : description.wheels) {
    car.vehicle->addWheel(seen * vector(wheel.at), seen.getBasis() * btVector3(0, -1, 0),
                          seen.getBasis() * btVector3(-1, 0, 0), real(description.suspension), real(wheel.radius),
                          tuning, wheel.steered);
    const int index = car.vehicle->getNumWheels() - 1;
    if (wheel.driven) car.vehicle->applyEngineForce(real(description.engine), index);
    if (wheel.steered) car.vehicle->setSteeringValue(real(description.steer), index);
    // Bullet takes it for an impulse in each of its own steps, which are substeps here.
    car.vehicle->setBrake(real(description.brake / instance.scene.time.substeps), index);
  }
  // Wheels are no bodies: nothing wakes a chassis that sleeps.
  chassis.setActivationState(DISABLE_DEACTIVATION);
  instance.world.world().addAction(car.vehicle.get());
}

void start_vehicles(SceneInstance& instance) {
  for (const Vehicle& description : instance.scene.vehicles) add(instance, description);
}

std::uint64_t count_wheels_on_ground(const SceneInstance& instance) {
  std::uint64_t count = 0;
  for (const Car& car : instance.cars)
    for (int i = 0; i < car.vehicle->getNumWheels(); ++i)
      count += car.vehicle->getWheelInfo(i).m_raycastInfo.m_isInContact;
  return count;
}

}  // namespace

const Effect vehicles{"vehicles",
                      "bodies on wheels that are rays",
                      "btRaycastVehicle, an action of the world, for each",
                      calls_for_vehicles,
                      {.prepare = prepare_vehicles, .start = start_vehicles},
                      {"wheels on the ground", count_wheels_on_ground}};

}  // namespace boxstream::effects
