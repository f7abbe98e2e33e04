// cannon-es on the protocol of `forceshade conform simulator`.
import * as CANNON from 'cannon-es';
import {simulate, version, xyz} from './simulator.mjs';

const {Body, Box, ContactMaterial, Material, Sphere, Trimesh, Vec3, World} = CANNON;

function open({rate_Hz, gravity, friction, ground, sphere}) {
  const world = new World({gravity: new Vec3(...gravity)});
  const material = new Material();
  world.addContactMaterial(new ContactMaterial(material, material, {friction, restitution: 0}));
  const floor = new Body({mass: 0, material});
  if (ground.box) floor.addShape(new Box(new Vec3(...ground.box.half)), new Vec3(...ground.box.centre));
  else floor.addShape(new Trimesh(ground.vertices.flat(), ground.triangles.flat()));
  const ball = new Body({mass: sphere.mass_kg, material, shape: new Sphere(sphere.radius), position: new Vec3(...sphere.position),
    velocity: new Vec3(...sphere.velocity), fixedRotation: !sphere.turns, linearDamping: 0, angularDamping: 0});
  world.addBody(floor);
  world.addBody(ball);
  return {
    free: () => {},
    step(force) {
      ball.applyForce(new Vec3(...force));
      world.step(1 / rate_Hz);
      const contacts = world.contacts.filter((equation) => equation.enabled).map(
        (equation) => [...xyz(equation.ni).map((n) => equation.bi === ball ? -n : n), equation.multiplier]);
      return {position: xyz(ball.position), velocity: xyz(ball.velocity), contacts};
    },
  };
}

await simulate({name: 'cannon-es', version: version('cannon-es'), reports: 'force', constraint: 'soft', binary: 64, sides: 'two',
  smallest_radius_m: 0.001, speed_cap_m_per_s: null,
  settings: 'the GSSolver and the stiffness 1e7 and relaxation 3 of contacts that a World begins with; damping 0, sleeping not allowed'},
open);
