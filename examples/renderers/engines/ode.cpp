// SPDX-License-Identifier: BSD-3-Clause
// ODE on the protocol of `forceshade conform --simulator`.
#include <ode/ode.h>

#include "simulator.h"

namespace {

using simulator::json;
using simulator::Motion;
using simulator::Vector;

Vector array(const dReal* v) { return {v[0], v[1], v[2]}; }

struct World {
  static constexpr int kMostContacts = 64;
  dWorldID world = dWorldCreate();
  dSpaceID space = dSimpleSpaceCreate(nullptr);
  dJointGroupID joints = dJointGroupCreate(0);
  dBodyID ball = dBodyCreate(world);
  dTriMeshDataID mesh = dGeomTriMeshDataCreate();
  std::vector<dReal> vertices;
  std::vector<dTriIndex> triangles;
  dGeomID floor, sphere;
  dReal friction, step_s;

  explicit World(const json& scene) {
    const json &ground = scene.at("ground"), &moving = scene.at("sphere");
    const Vector gravity = simulator::vector(scene.at("gravity")), position = simulator::vector(moving.at("position")),
                 velocity = simulator::vector(moving.at("velocity"));
    friction = simulator::number(scene.at("friction"));
    step_s = 1 / simulator::number(scene.at("rate_Hz"));
    dWorldSetGravity(world, gravity[0], gravity[1], gravity[2]);
    if (ground.contains("box")) {
      const Vector half = simulator::vector(ground["box"].at("half")), centre = simulator::vector(ground["box"].at("centre"));
      floor = dCreateBox(space, 2 * half[0], 2 * half[1], 2 * half[2]);
      dGeomSetPosition(floor, centre[0], centre[1], centre[2]);
    } else {
      for (const json& at : ground.at("vertices"))
        for (const dReal coordinate : simulator::vector(at)) vertices.push_back(coordinate);
      for (const json& corners : ground.at("triangles")) triangles.insert(triangles.end(), {corners[0], corners[1], corners[2]});
      dGeomTriMeshDataBuildDouble(mesh, vertices.data(), 3 * sizeof(dReal), int(vertices.size() / 3), triangles.data(),
                                  int(triangles.size()), 3 * sizeof(dTriIndex));
      floor = dCreateTriMesh(space, mesh, nullptr, nullptr, nullptr);
    }
    const dReal radius = simulator::number(moving.at("radius")), mass_kg = simulator::number(moving.at("mass_kg"));
    sphere = dCreateSphere(space, radius);
    dGeomSetBody(sphere, ball);
    dMass mass;
    dMassSetSphereTotal(&mass, mass_kg, radius);
    if (!moving.at("turns").get<bool>())
      for (const int diagonal : {0, 5, 10}) mass.I[diagonal] *= 1e12;
    dBodySetMass(ball, &mass);
    dBodySetPosition(ball, position[0], position[1], position[2]);
    dBodySetLinearVel(ball, velocity[0], velocity[1], velocity[2]);
  }
  ~World() {
    dJointGroupDestroy(joints);
    dSpaceDestroy(space);
    dWorldDestroy(world);
    dGeomTriMeshDataDestroy(mesh);
  }

  Motion step(const Vector& force) {
    dJointGroupEmpty(joints);
    std::array<dContact, kMostContacts> contacts{};
    std::array<dJointFeedback, kMostContacts> felt{};
    const int count = dCollide(sphere, floor, kMostContacts, &contacts[0].geom, sizeof(dContact));  // normals point to the sphere
    for (std::size_t k = 0; k < std::size_t(count); ++k) {
      contacts[k].surface.mode = dContactApprox1;
      contacts[k].surface.mu = friction;
      const dJointID joint = dJointCreateContact(world, joints, &contacts[k]);
      dJointAttach(joint, ball, nullptr);
      dJointSetFeedback(joint, &felt[k]);
    }
    dBodyAddForce(ball, force[0], force[1], force[2]);
    dWorldStep(world, step_s);
    Motion after{array(dBodyGetPosition(ball)), array(dBodyGetLinearVel(ball)), {}};
    for (std::size_t k = 0; k < std::size_t(count); ++k)
      after.contacts.push_back({array(contacts[k].geom.normal), dCalcVectorDot3(felt[k].f1, contacts[k].geom.normal)});
    return after;
  }
};

}  // namespace

int main() {
  dInitODE2(0);
  return simulator::simulate<World>({
      {"name", "ODE"}, {"version", ODE_VERSION}, {"reports", "force"}, {"constraint", "hard"}, {"binary", 8 * sizeof(dReal)},
      {"sides", "two"}, {"smallest_radius_m", 0.001}, {"speed_cap_m_per_s", nullptr},
      {"settings", "dWorldStep, which its manual calls the accurate one, with the ERP and CFM that a world begins with; contacts with the "
                   "friction pyramid of dContactApprox1"}});
}
