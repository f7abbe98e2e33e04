// PhysX (package physx-js-webidl) on the protocol of `forceshade conform simulator`.
import {readFileSync} from 'node:fs';
import {simulate, version, xyz} from './simulator.mjs';
import load from 'physx-js-webidl';

// The loader was built for browsers and refuses to run where it sees node's version.
Object.defineProperty(process, 'versions', {value: {}});
globalThis.window = globalThis;
const wasm = new URL('node_modules/physx-js-webidl/physx-js-webidl.wasm', import.meta.url);
const PhysX = await load({wasmBinary: readFileSync(wasm)});
const px = PhysX.PxTopLevelFunctions.prototype, pair = PhysX.PxPairFlagEnum;
const foundation = px.CreateFoundation(px.PHYSICS_VERSION, new PhysX.PxDefaultAllocator(), new PhysX.PxDefaultErrorCallback());
const vector = (numbers) => new PhysX.PxVec3(...numbers);
const pose = (position) => Object.assign(new PhysX.PxTransform(PhysX.PxIDENTITYEnum.PxIdentity), {p: vector(position)});

function mesh(tolerances, {vertices, triangles}) {
  const points = new PhysX.PxArray_PxVec3(), indices = new PhysX.PxArray_PxU32();
  for (const at of vertices) points.pushBack(vector(at));
  for (const index of triangles.flat()) indices.pushBack(index);
  const description = new PhysX.PxTriangleMeshDesc();
  Object.assign(description.points, {count: vertices.length, stride: 12, data: points.begin()});
  Object.assign(description.triangles, {count: triangles.length, stride: 12, data: indices.begin()});
  const made = px.CreateTriangleMesh(new PhysX.PxCookingParams(tolerances), description);
  return new PhysX.PxTriangleMeshGeometry(made);
}

let physics;
function open({units_per_metre, rate_Hz, gravity, friction, ground, sphere}) {
  const tolerances = new PhysX.PxTolerancesScale();
  tolerances.length = units_per_metre;
  tolerances.speed = 10 * units_per_metre;
  physics ??= px.CreatePhysics(px.PHYSICS_VERSION, foundation, tolerances);
  const description = new PhysX.PxSceneDesc(tolerances);
  let contacts, ball;
  const listener = new PhysX.PxSimulationEventCallbackImpl();
  listener.onConstraintBreak = listener.onWake = listener.onSleep = listener.onTrigger = () => {};
  listener.onContact = (header, pairs, count) => {
    const points = new PhysX.PxArray_PxContactPairPoint(64);
    for (let k = 0; k < count; ++k) {
      const one = PhysX.NativeArrayHelpers.prototype.getContactPairAt(PhysX.wrapPointer(pairs, PhysX.PxContactPair), k);
      const found = one.extractContacts(points.begin(), 64);  // the first shape's normal: the one on it
      const sign = PhysX.compare(one.get_shapes(0), ball) ? 1 : -1;
      for (let i = 0; i < found; ++i) {
        const impulse = xyz(points.get(i).impulse), normal = xyz(points.get(i).normal);
        contacts.push([...normal.map((n) => sign * n), impulse.reduce((sum, component, axis) => sum + component * normal[axis], 0)]);
      }
    }
    PhysX.destroy(points);
  };
  description.gravity = vector(gravity);
  description.cpuDispatcher = px.DefaultCpuDispatcherCreate(0);
  description.simulationEventCallback = listener;
  description.filterShader = px.DefaultFilterShader();
  const scene = physics.createScene(description);
  const material = physics.createMaterial(friction, friction, 0);
  const reported = pair.eNOTIFY_TOUCH_FOUND | pair.eNOTIFY_TOUCH_PERSISTS | pair.eNOTIFY_CONTACT_POINTS;
  const shape = (geometry) => {
    const made = physics.createShape(geometry, material, true);
    made.setSimulationFilterData(new PhysX.PxFilterData(1, 1, reported, 0));
    return made;
  };
  const floor = physics.createRigidStatic(pose(ground.box?.centre ?? [0, 0, 0]));
  floor.attachShape(shape(ground.box ? new PhysX.PxBoxGeometry(...ground.box.half) : mesh(tolerances, ground)));
  const body = physics.createRigidDynamic(pose(sphere.position));
  ball = shape(new PhysX.PxSphereGeometry(sphere.radius));
  body.attachShape(ball);
  PhysX.PxRigidBodyExt.prototype.setMassAndUpdateInertia(body, sphere.mass_kg);
  body.setLinearVelocity(vector(sphere.velocity));
  body.setAngularDamping(0);
  body.setSleepThreshold(0);
  const {eLOCK_ANGULAR_X, eLOCK_ANGULAR_Y, eLOCK_ANGULAR_Z} = PhysX.PxRigidDynamicLockFlagEnum;
  if (!sphere.turns) for (const flag of [eLOCK_ANGULAR_X, eLOCK_ANGULAR_Y, eLOCK_ANGULAR_Z]) body.setRigidDynamicLockFlag(flag, true);
  scene.addActor(floor);
  scene.addActor(body);
  return {
    free: () => scene.release(),
    step(force) {
      contacts = [];
      body.addForce(vector(force));
      scene.simulate(1 / rate_Hz);
      scene.fetchResults(true);
      return {position: xyz(body.getGlobalPose().p), velocity: xyz(body.getLinearVelocity()), contacts};
    },
  };
}

const engine = [24, 16, 8].map((bits) => px.PHYSICS_VERSION >> bits & 255).join('.');
await simulate({name: 'PhysX', version: `${engine} (physx-js-webidl ${version('physx-js-webidl')})`, reports: 'impulse',
  constraint: 'hard', binary: 32, sides: 'one',
  smallest_radius_m: 0.02, speed_cap_m_per_s: null,
  settings: 'the scene and contact offsets that PhysX begins with, PxTolerancesScale of the unit of the scene; damping 0, sleeping off'},
open);
