// ammo.js (Bullet as WebAssembly, package ammojs-typed) on the protocol of `forceshade conform simulator`.
import load from 'ammojs-typed';
import {simulate, version} from './simulator.mjs';

const Ammo = await load.call({});

function open({rate_Hz, gravity, friction, ground, sphere}) {
  const vector = (numbers) => new Ammo.btVector3(...numbers);
  const array = (v) => [v.x(), v.y(), v.z()];
  const configuration = new Ammo.btDefaultCollisionConfiguration();
  const dispatcher = new Ammo.btCollisionDispatcher(configuration);
  const world = new Ammo.btDiscreteDynamicsWorld(dispatcher, new Ammo.btDbvtBroadphase(), new Ammo.btSequentialImpulseConstraintSolver(),
                                                 configuration);
  world.setGravity(vector(gravity));
  const body = (shape, mass, position) => {
    const pose = new Ammo.btTransform();
    pose.setIdentity();
    pose.setOrigin(vector(position));
    const inertia = vector([0, 0, 0]);
    if (mass) shape.calculateLocalInertia(mass, inertia);
    const made = new Ammo.btRigidBody(new Ammo.btRigidBodyConstructionInfo(mass, new Ammo.btDefaultMotionState(pose), shape, inertia));
    made.setFriction(mass ? friction : 1);  // Bullet multiplies them
    made.setRestitution(0);
    world.addRigidBody(made);
    return made;
  };
  const soup = () => {
    const mesh = new Ammo.btTriangleMesh();
    for (const corners of ground.triangles) mesh.addTriangle(...corners.map((corner) => vector(ground.vertices[corner])));
    return new Ammo.btBvhTriangleMeshShape(mesh, true);
  };
  body(ground.box ? new Ammo.btBoxShape(vector(ground.box.half)) : soup(), 0, ground.box?.centre ?? [0, 0, 0]);
  const ball = body(new Ammo.btSphereShape(sphere.radius), sphere.mass_kg, sphere.position);
  ball.setLinearVelocity(vector(sphere.velocity));
  ball.setActivationState(4);  // DISABLE_DEACTIVATION
  if (!sphere.turns) ball.setAngularFactor(vector([0, 0, 0]));
  const pushed = vector([0, 0, 0]);
  return {
    free: () => {},
    step(force) {
      pushed.setValue(...force);
      ball.applyCentralForce(pushed);
      world.stepSimulation(1 / rate_Hz, 0);
      const contacts = [];
      for (let k = 0; k < dispatcher.getNumManifolds(); ++k) {
        const manifold = dispatcher.getManifoldByIndexInternal(k);
        const sign = Ammo.compare(Ammo.castObject(manifold.getBody0(), Ammo.btRigidBody), ball) ? 1 : -1;
        for (let i = 0; i < manifold.getNumContacts(); ++i) {
          const point = manifold.getContactPoint(i);
          contacts.push([...array(point.get_m_normalWorldOnB()).map((n) => sign * n), point.getAppliedImpulse()]);
        }
      }
      return {position: array(ball.getWorldTransform().getOrigin()), velocity: array(ball.getLinearVelocity()), contacts};
    },
  };
}

await simulate({name: 'ammo.js', version: `ammojs-typed ${version('ammojs-typed')}`, reports: 'impulse', constraint: 'soft',
  binary: 32, sides: 'two',
  smallest_radius_m: 0.02, speed_cap_m_per_s: null,
  settings: 'the default configuration and btSequentialImpulseConstraintSolver; a step of the world for each step of the scene; ' +
    'deactivation off'},
open);
