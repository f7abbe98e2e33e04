// Rapier on the protocol of `forceshade conform simulator`: node rapier.mjs VERSION [--fix-internal-edges]
// [--force-events], VERSION one of 0.11, 0.14, 0.19, 0.21. It reports the impulse of each contact of a manifold, or what the events of
// contact forces say.
import {option, simulate, version, xyz} from './simulator.mjs';

const name = `rapier-${process.argv[2]}`;
const {default: RAPIER} = await import(name);
await RAPIER.init();
const [fix, events] = [option('--fix-internal-edges'), option('--force-events')];
const settings = [fix && 'FIX_INTERNAL_EDGES', events && 'force events'].filter((set) => set);

function open({units_per_metre, rate_Hz, gravity, friction, ground, sphere}) {
  const {ActiveEvents, ColliderDesc, CoefficientCombineRule, EventQueue, RigidBodyDesc, TriMeshFlags, World} = RAPIER;
  const vector = ([x, y, z]) => ({x, y, z});
  const world = new World(vector(gravity));
  world.timestep = 1 / rate_Hz;
  if ('lengthUnit' in world) world.lengthUnit = units_per_metre;
  const floor = ground.box ? ColliderDesc.cuboid(...ground.box.half).setTranslation(...ground.box.centre)
    : ColliderDesc.trimesh(new Float32Array(ground.vertices.flat()), new Uint32Array(ground.triangles.flat()),
                           fix ? TriMeshFlags.FIX_INTERNAL_EDGES : undefined);
  const body = world.createRigidBody(RigidBodyDesc.dynamic().setTranslation(...sphere.position).setLinvel(...sphere.velocity)
    .setCanSleep(false));
  if (!sphere.turns) body.lockRotations(true, true);
  const [fixed, ball] = [world.createCollider(floor), world.createCollider(ColliderDesc.ball(sphere.radius).setMass(sphere.mass_kg), body)];
  for (const collider of [fixed, ball]) {
    collider.setFriction(friction);
    collider.setRestitution(0);
    collider.setFrictionCombineRule(CoefficientCombineRule.Min);
  }
  ball.setActiveEvents(ActiveEvents.CONTACT_FORCE_EVENTS);
  ball.setContactForceEventThreshold(0);
  const queue = new EventQueue(true);
  return {
    free: () => (queue.free(), world.free()),
    step(force) {
      body.resetForces(true);
      body.addForce(vector(force), true);
      world.step(queue);
      const contacts = [];
      if (events) queue.drainContactForceEvents((event) => {
        const total = xyz(event.totalForce()), size = Math.hypot(...total);
        if (size > 0) contacts.push([...total.map((component) => component / size), size]);
      });
      else world.contactPair(ball, fixed, (manifold, flipped) => {
        const normal = xyz(manifold.normal()).map((n) => flipped ? n : -n);
        for (let k = 0; k < manifold.numContacts(); ++k) contacts.push([...normal, manifold.contactImpulse(k)]);
      });
      return {position: xyz(body.translation()), velocity: xyz(body.linvel()), contacts};
    },
  };
}

await simulate({name: ['Rapier', ...settings].join(', '), version: version(name), reports: events ? 'force' : 'impulse', constraint: 'soft',
  binary: 32, sides: fix ? 'one' : 'two', smallest_radius_m: 0.001, speed_cap_m_per_s: null,
  settings: 'the integration parameters that a World begins with, lengthUnit where the version has it; sleeping not allowed'},
open);
