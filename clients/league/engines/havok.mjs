// Havok (package @babylonjs/havok) on the protocol of `forceshade conform simulator`.
import {readFileSync} from 'node:fs';
import {simulate, version} from './simulator.mjs';
import load from '@babylonjs/havok';

const wasm = new URL('node_modules/@babylonjs/havok/lib/esm/HavokPhysics.wasm', import.meta.url);
const havok = await load({wasmBinary: readFileSync(wasm)});
const upright = [0, 0, 0, 1];

function done([result, ...values]) {
  if (result !== havok.Result.RESULT_OK) throw new Error(`Havok says ${result.value}`);
  return values[0];
}

function mesh({vertices, triangles}) {
  const [points, indices] = [new Float32Array(vertices.flat()), new Int32Array(triangles.flat())];
  const [at, which] = [havok._malloc(points.byteLength), havok._malloc(indices.byteLength)];
  havok.HEAPU8.set(new Uint8Array(points.buffer), at);
  havok.HEAPU8.set(new Uint8Array(indices.buffer), which);
  return done(havok.HP_Shape_CreateMesh(at, vertices.length, which, triangles.length));
}

function open({units_per_metre, rate_Hz, gravity, friction, ground, sphere}) {
  const {COLLISION_STARTED, COLLISION_CONTINUED} = havok.EventType;
  const {MINIMUM} = havok.MaterialCombine;
  const world = done(havok.HP_World_Create());
  havok.HP_World_SetGravity(world, gravity);
  havok.HP_World_SetIdealStepTime(world, 1 / rate_Hz);
  const [, linear, angular] = havok.HP_World_GetSpeedLimit(world);
  havok.HP_World_SetSpeedLimit(world, linear * units_per_metre, angular);
  const add = (shape, motion, position) => {
    const body = done(havok.HP_Body_Create());
    havok.HP_Shape_SetMaterial(shape, [friction, friction, 0, MINIMUM, MINIMUM]);
    havok.HP_Body_SetShape(body, shape);
    havok.HP_Body_SetMotionType(body, motion);
    havok.HP_Body_SetQTransform(body, [position, upright]);
    havok.HP_World_AddBody(world, body, false);
    return body;
  };
  const floor = ground.box ? done(havok.HP_Shape_CreateBox(ground.box.centre, upright, ground.box.half.map((half) => 2 * half)))
    : mesh(ground);
  add(floor, havok.MotionType.STATIC, [0, 0, 0]);
  const shape = done(havok.HP_Shape_CreateSphere([0, 0, 0], sphere.radius));
  const ball = add(shape, havok.MotionType.DYNAMIC, sphere.position);
  const [, , inertia] = done(havok.HP_Shape_BuildMassProperties(shape));
  havok.HP_Body_SetMassProperties(ball, [[0, 0, 0], sphere.mass_kg, sphere.turns ? inertia : [0, 0, 0], upright]);
  havok.HP_Body_SetLinearVelocity(ball, sphere.velocity);
  havok.HP_Body_SetLinearDamping(ball, 0);
  havok.HP_Body_SetAngularDamping(ball, 0);
  havok.HP_Body_SetActivationControl(ball, havok.ActivationControl.ALWAYS_ACTIVE);
  havok.HP_Body_SetEventMask(ball, COLLISION_STARTED.value | COLLISION_CONTINUED.value);
  return {
    free: () => havok.HP_World_Release(world),
    step(force) {
      const position = done(havok.HP_Body_GetPosition(ball));
      havok.HP_Body_ApplyImpulse(ball, position, force.map((component) => component / rate_Hz));
      havok.HP_World_Step(world, 1 / rate_Hz);
      const contacts = [];
      for (let [, at] = havok.HP_World_GetCollisionEvents(world); at; at = havok.HP_World_GetNextCollisionEvent(Number(world[0]), at)) {
        const [, first, , impulse] = done(havok.HP_Event_AsCollision(at));
        const isFirst = first[0][0] === ball[0];  // the normal on the first points out of it
        contacts.push([...first[4].map((n) => isFirst ? -n : n), impulse]);
      }
      return {position: done(havok.HP_Body_GetPosition(ball)), velocity: done(havok.HP_Body_GetLinearVelocity(ball)), contacts};
    },
  };
}

await simulate({name: 'Havok', version: version('@babylonjs/havok'), reports: 'impulse', constraint: 'hard', binary: 32, sides: 'two',
  smallest_radius_m: 0.01, speed_cap_m_per_s: 200,
  settings: 'the world as created, its ideal step time that of the scene; damping 0, always active, ' +
    'the speed cap of 200 m/s in units of the scene'},
open);
