// Jolt (package jolt-physics) on the protocol of `forceshade conform simulator`: node jolt.mjs [--fix-internal-edges].
import load from 'jolt-physics';
import {option, simulate, version} from './simulator.mjs';

const Jolt = await load();
const fix = option('--fix-internal-edges');
const array = (v) => [v.GetX(), v.GetY(), v.GetZ()];
const vector = ([x, y, z]) => new Jolt.Vec3(x, y, z);
const place = ([x, y, z]) => new Jolt.RVec3(x, y, z);

function settings() {
  const made = new Jolt.JoltSettings();
  const pairs = new Jolt.ObjectLayerPairFilterTable(2);
  pairs.EnableCollision(0, 1);
  const layers = new Jolt.BroadPhaseLayerInterfaceTable(2, 2);
  for (const layer of [0, 1]) layers.MapObjectToBroadPhaseLayer(layer, new Jolt.BroadPhaseLayer(layer));
  made.mObjectLayerPairFilter = pairs;
  made.mBroadPhaseLayerInterface = layers;
  made.mObjectVsBroadPhaseLayerFilter = new Jolt.ObjectVsBroadPhaseLayerFilterTable(layers, 2, pairs, 2);
  return made;
}

function mesh({vertices, triangles}) {
  const [corners, indices] = [new Jolt.VertexList(), new Jolt.IndexedTriangleList()];
  for (const at of vertices) corners.push_back(new Jolt.Float3(...at));
  for (const triangle of triangles) indices.push_back(new Jolt.IndexedTriangle(...triangle, 0));
  const made = new Jolt.MeshShapeSettings(corners, indices, new Jolt.PhysicsMaterialList()).Create();
  if (made.HasError()) throw made.GetError().c_str();
  return made.Get();
}

function open({units_per_metre, rate_Hz, gravity, friction, ground, sphere}) {
  const jolt = new Jolt.JoltInterface(settings());
  const system = jolt.GetPhysicsSystem(), bodies = system.GetBodyInterface();
  system.SetGravity(vector(gravity));
  const add = (shape, position, motion, layer, adjust) => {
    const body = new Jolt.BodyCreationSettings(shape, place(position), Jolt.Quat.prototype.sIdentity(), motion, layer);
    body.mFriction = friction;  // Jolt takes the geometric mean of the two
    adjust?.(body);
    const made = bodies.CreateBody(body);
    bodies.AddBody(made.GetID(), Jolt.EActivation_Activate);
    return made;
  };
  if (ground.box) add(new Jolt.BoxShape(vector(ground.box.half)), ground.box.centre, Jolt.EMotionType_Static, 0);
  else add(mesh(ground), [0, 0, 0], Jolt.EMotionType_Static, 0);
  const ball = add(new Jolt.SphereShape(sphere.radius), sphere.position, Jolt.EMotionType_Dynamic, 1, (body) => {
    body.mOverrideMassProperties = Jolt.EOverrideMassProperties_CalculateInertia;
    body.mMassPropertiesOverride.mMass = sphere.mass_kg;
    body.mLinearVelocity = vector(sphere.velocity);
    body.mLinearDamping = body.mAngularDamping = 0;
    body.mMaxLinearVelocity *= units_per_metre;
    body.mAllowSleeping = false;
    body.mEnhancedInternalEdgeRemoval = fix;
    if (!sphere.turns) body.mAllowedDOFs = Jolt.EAllowedDOFs_TranslationX | Jolt.EAllowedDOFs_TranslationY | Jolt.EAllowedDOFs_TranslationZ;
  });
  let contacts;
  const listener = new Jolt.ContactListenerJS();
  const added = (first, second, manifold) => {
    const isFirst = Jolt.wrapPointer(first, Jolt.Body).GetID().GetIndex() === ball.GetID().GetIndex();
    const normal = array(Jolt.wrapPointer(manifold, Jolt.ContactManifold).mWorldSpaceNormal);  // moves the second body out of the first
    contacts.push([...normal.map((n) => isFirst ? -n : n), NaN]);
  };
  listener.OnContactValidate = () => Jolt.ValidateResult_AcceptAllContactsForThisBodyPair;
  listener.OnContactAdded = listener.OnContactPersisted = added;
  listener.OnContactRemoved = () => {};
  system.SetContactListener(listener);
  return {
    free: () => Jolt.destroy(jolt),
    step(force) {
      contacts = [];
      bodies.AddForce(ball.GetID(), vector(force), Jolt.EActivation_Activate);
      jolt.Step(1 / rate_Hz, 1);
      return {position: array(ball.GetPosition()), velocity: array(ball.GetLinearVelocity()), contacts};
    },
  };
}

await simulate({name: `Jolt${fix ? ' with enhanced internal edge removal' : ''}`, 
  version: `jolt-physics ${version('jolt-physics')}`, reports: 'nothing',
  constraint: 'hard', binary: 32, sides: 'one', smallest_radius_m: 0.05, speed_cap_m_per_s: 500,
  settings: 'the PhysicsSettings that a system begins with, one collision step a step; damping 0, sleeping not ' +
    'allowed, the speed cap of 500 m/s in units of the scene'},
open);
