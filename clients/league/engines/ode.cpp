// SPDX-License-Identifier: BSD-3-Clause
// ODE on the protocol of `forceshade conform simulator`; with --contact-surface-layer, the sphere may sink by 1 mm, as its
// manual advises against contacts that come and go.
#include <ode/ode.h>

#include "simulator.h"

namespace {

using simulator::Motion;
using simulator::Scene;
using simulator::Vector;

bool has_surface_layer = false;

Vector array(const dReal* v) {
  return {v[0], v[1], v[2]};
}

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

  explicit World(const Scene& scene) : friction(scene.friction), step_s(1 / scene.rate_Hz) {
    if (has_surface_layer) dWorldSetContactSurfaceLayer(world, 0.001 * scene.units_per_metre);
    dWorldSetGravity(world, scene.gravity[0], scene.gravity[1], scene.gravity[2]);
    if (scene.is_box) {
      floor = dCreateBox(space, 2 * scene.half[0], 2 * scene.half[1], 2 * scene.half[2]);
      dGeomSetPosition(floor, scene.centre[0], scene.centre[1], scene.centre[2]);
    } else {
      for (const Vector& at : scene.vertices) vertices.insert(vertices.end(), at.begin(), at.end());
      for (const auto& corners : scene.triangles) triangles.insert(triangles.end(), corners.begin(), corners.end());
      dGeomTriMeshDataBuildDouble(mesh, vertices.data(), 3 * sizeof(dReal), int(scene.vertices.size()), triangles.data(),
                                  int(triangles.size()), 3 * sizeof(dTriIndex));
      floor = dCreateTriMesh(space, mesh, nullptr, nullptr, nullptr);
    }
    sphere = dCreateSphere(space, scene.radius);
    dGeomSetBody(sphere, ball);
    dMass mass;
    dMassSetSphereTotal(&mass, scene.mass_kg, scene.radius);
    if (!scene.turns)
      for (const int diagonal : {0, 5, 10}) mass.I[diagonal] *= 1e12;
    dBodySetMass(ball, &mass);
    dBodySetPosition(ball, scene.position[0], scene.position[1], scene.position[2]);
    dBodySetLinearVel(ball, scene.velocity[0], scene.velocity[1], scene.velocity[2]);
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
    const int count =
        dCollide(sphere, floor, kMostContacts, &contacts[0].geom, sizeof(dContact));  // normals point to the sphere
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

int main(int count, char** arguments) {
  has_surface_layer = count > 1 && std::string(arguments[1]) == "--contact-surface-layer";
  dInitODE2(0);
  return simulator::simulate<World>(
      {.name = has_surface_layer ? "ODE with a contact surface layer" : "ODE",
       .version = ENGINE_VERSION,
       .reports = "force",
       .constraint = "hard",
       .binary = 8 * sizeof(dReal),
       .sides = "one",
       .smallest_radius_m = 0.001,
       .settings = "dWorldStep, which its manual calls the accurate one; ERP and CFM as a world begins with; dContactApprox1"});
}
