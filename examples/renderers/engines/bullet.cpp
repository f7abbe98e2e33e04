// SPDX-License-Identifier: BSD-3-Clause
// Bullet on the protocol of `forceshade conform --simulator`: bullet [--fix-internal-edges], which uses Bullet's internal edge utility.
#include <BulletCollision/CollisionDispatch/btInternalEdgeUtility.h>
#include <btBulletDynamicsCommon.h>

#include <cstring>

#include "simulator.h"

namespace {

using simulator::json;
using simulator::Motion;
using simulator::Vector;

bool fix_internal_edges = false;

btScalar scalar(const json& value) { return btScalar(simulator::number(value)); }
btVector3 vector(const Vector& v) { return {btScalar(v[0]), btScalar(v[1]), btScalar(v[2])}; }
btVector3 vector(const json& value) { return vector(simulator::vector(value)); }
Vector array(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

bool adjust_contact(btManifoldPoint& point, const btCollisionObjectWrapper* first, int, int, const btCollisionObjectWrapper* second,
                    int part, int index) {
  btAdjustInternalEdgeContacts(point, second, first, part, index);
  return true;
}

struct World {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};
  btTriangleMesh triangles;
  btTriangleInfoMap edges;
  std::unique_ptr<btCollisionShape> floor_shape;
  std::unique_ptr<btSphereShape> sphere_shape;
  std::unique_ptr<btRigidBody> floor, ball;
  btScalar step_s;

  explicit World(const json& scene) : step_s(1 / scalar(scene.at("rate_Hz"))) {
    const json &ground = scene.at("ground"), &sphere = scene.at("sphere");
    btVector3 centre(0, 0, 0), inertia(0, 0, 0);
    if (ground.contains("box")) {
      floor_shape = std::make_unique<btBoxShape>(vector(ground["box"].at("half")));
      centre = vector(ground["box"].at("centre"));
    } else {
      for (const json& at : ground.at("vertices")) triangles.findOrAddVertex(vector(at), false);
      for (const json& corners : ground.at("triangles")) triangles.addTriangleIndices(corners[0], corners[1], corners[2]);
      auto mesh = std::make_unique<btBvhTriangleMeshShape>(&triangles, true);
      if (fix_internal_edges) btGenerateInternalEdgeInfo(mesh.get(), &edges);
      floor_shape = std::move(mesh);
    }
    floor = std::make_unique<btRigidBody>(0, nullptr, floor_shape.get());
    floor->setWorldTransform(btTransform(btQuaternion::getIdentity(), centre));
    floor->setFriction(1);  // Bullet multiplies the two bodies' friction
    if (fix_internal_edges) floor->setCollisionFlags(floor->getCollisionFlags() | btCollisionObject::CF_CUSTOM_MATERIAL_CALLBACK);
    sphere_shape = std::make_unique<btSphereShape>(scalar(sphere.at("radius")));
    sphere_shape->calculateLocalInertia(scalar(sphere.at("mass_kg")), inertia);
    ball = std::make_unique<btRigidBody>(scalar(sphere.at("mass_kg")), nullptr, sphere_shape.get(), inertia);
    ball->setWorldTransform(btTransform(btQuaternion::getIdentity(), vector(sphere.at("position"))));
    ball->setLinearVelocity(vector(sphere.at("velocity")));
    ball->setFriction(scalar(scene.at("friction")));
    ball->setActivationState(DISABLE_DEACTIVATION);
    if (!sphere.at("turns").get<bool>()) ball->setAngularFactor(0);
    world.setGravity(vector(scene.at("gravity")));
    world.addRigidBody(floor.get());
    world.addRigidBody(ball.get());
  }
  ~World() {
    world.removeRigidBody(ball.get());
    world.removeRigidBody(floor.get());
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
  fix_internal_edges = count > 1 && std::strcmp(arguments[1], "--fix-internal-edges") == 0;
  if (fix_internal_edges) gContactAddedCallback = adjust_contact;
  const int version = btGetVersion();
  return simulator::simulate<World>({
      {"name", fix_internal_edges ? "Bullet with its internal edge utility" : "Bullet"},
      {"version", std::to_string(version / 100) + "." + std::to_string(version % 100)},
      {"reports", "impulse"}, {"constraint", "soft"}, {"binary", 8 * sizeof(btScalar)}, {"sides", "two"}, {"smallest_radius_m", 0.02},
      {"speed_cap_m_per_s", nullptr},
      {"settings", "the default configuration and btSequentialImpulseConstraintSolver; one step of the world for each of the scene; "
                   "deactivation off"}});
}
