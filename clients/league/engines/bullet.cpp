// SPDX-License-Identifier: BSD-3-Clause
// Bullet on the protocol of `forceshade conform simulator`; --fix-internal-edges is for its internal edge utility.
#include <BulletCollision/CollisionDispatch/btInternalEdgeUtility.h>
#include <btBulletDynamicsCommon.h>

#include "simulator.h"

namespace {

using simulator::Motion;
using simulator::Scene;
using simulator::Vector;

bool fix_internal_edges = false;

bool adjust_contact(btManifoldPoint& point, const btCollisionObjectWrapper* sphere, int, int,
                    const btCollisionObjectWrapper* mesh, int part, int index) {
  btAdjustInternalEdgeContacts(point, mesh, sphere, part, index);
  return true;
}

struct World {  // the last member, which goes first, refers to the others
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btTriangleMesh triangles;
  btTriangleInfoMap edges;
  std::unique_ptr<btCollisionShape> floor_shape;
  btSphereShape sphere_shape;
  std::unique_ptr<btRigidBody> floor, ball;
  btScalar step_s;
  btDiscreteDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};

  static btVector3 vector(const Vector& v) { return {btScalar(v[0]), btScalar(v[1]), btScalar(v[2])}; }
  static Vector array(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

  explicit World(const Scene& scene) : sphere_shape(btScalar(scene.radius)), step_s(btScalar(1 / scene.rate_Hz)) {
    if (scene.is_box) {
      floor_shape = std::make_unique<btBoxShape>(vector(scene.half));
    } else {
      for (const Vector& at : scene.vertices) triangles.findOrAddVertex(vector(at), false);
      for (const auto& [a, b, c] : scene.triangles) triangles.addTriangleIndices(a, b, c);
      auto mesh = std::make_unique<btBvhTriangleMeshShape>(&triangles, true);
      if (fix_internal_edges) btGenerateInternalEdgeInfo(mesh.get(), &edges);
      floor_shape = std::move(mesh);
    }
    floor = std::make_unique<btRigidBody>(0, nullptr, floor_shape.get());
    floor->setWorldTransform(btTransform(btQuaternion::getIdentity(), vector(scene.centre)));
    floor->setFriction(1);  // Bullet multiplies the two bodies' friction
    if (fix_internal_edges)
      floor->setCollisionFlags(floor->getCollisionFlags() | btCollisionObject::CF_CUSTOM_MATERIAL_CALLBACK);
    const auto mass = btScalar(scene.mass_kg);
    btVector3 inertia(0, 0, 0);
    sphere_shape.calculateLocalInertia(mass, inertia);
    ball = std::make_unique<btRigidBody>(mass, nullptr, &sphere_shape, inertia);
    ball->setWorldTransform(btTransform(btQuaternion::getIdentity(), vector(scene.position)));
    ball->setLinearVelocity(vector(scene.velocity));
    ball->setFriction(btScalar(scene.friction));
    ball->setActivationState(DISABLE_DEACTIVATION);
    if (!scene.turns) ball->setAngularFactor(0);
    world.setGravity(vector(scene.gravity));
    world.addRigidBody(floor.get());
    world.addRigidBody(ball.get());
  }

  Motion step(const Vector& force) {
    ball->applyCentralForce(vector(force));
    world.stepSimulation(step_s, 0);
    Motion after{array(ball->getWorldTransform().getOrigin()), array(ball->getLinearVelocity()), {}};
    for (int k = 0; k < dispatcher.getNumManifolds(); ++k) {
      const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(k);
      for (int i = 0; i < manifold.getNumContacts(); ++i) {
        const btManifoldPoint& point = manifold.getContactPoint(i);
        after.contacts.push_back({array(manifold.getBody0() == ball.get() ? point.m_normalWorldOnB : -point.m_normalWorldOnB),
                                  point.getAppliedImpulse()});
      }
    }
    return after;
  }
};

}  // namespace

int main(int count, char** arguments) {
  fix_internal_edges = count > 1 && std::string(arguments[1]) == "--fix-internal-edges";
  if (fix_internal_edges) gContactAddedCallback = adjust_contact;
  const int version = btGetVersion();
  return simulator::simulate<World>({.name = fix_internal_edges ? "Bullet with its internal edge utility" : "Bullet",
                                     .version = std::to_string(version / 100) + "." + std::to_string(version % 100),
                                     .reports = "impulse",
                                     .constraint = "soft",
                                     .binary = 8 * sizeof(btScalar),
                                     .sides = "two",
                                     .smallest_radius_m = 0.02,
                                     .settings = "btSequentialImpulseConstraintSolver, one step each; deactivation off"});
}
