// MuJoCo (package mujoco-js) on the protocol of `forceshade conform simulator`. A ground of triangles is a rigid flex, since a mesh
// would be replaced by its convex hull.
import load from 'mujoco-js';
import {simulate, version} from './simulator.mjs';

const mujoco = await load();
const flexRadius_m = 1e-6;  // a flex of triangles has to be thicker than 0

function floor({vertices, triangles, box}, units_per_metre, attributes) {
  if (box) return `<geom name="floor" type="box" size="${box.half.join(' ')}" pos="${box.centre.join(' ')}" ${attributes}/>`;
  const radius = flexRadius_m * units_per_metre;
  return `<flexcomp name="floor" type="direct" dim="2" rigid="true" radius="${radius}" point="${vertices.flat().join(' ')}"
    element="${triangles.flat().join(' ')}"><contact selfcollide="none" ${attributes}/></flexcomp>`;
}

function loaded(xml) {
  mujoco.FS.writeFile('scene.xml', xml);
  const model = mujoco.MjModel.loadFromXML('scene.xml');
  if (!model) throw new Error('MuJoCo refuses the scene');
  return model;
}

function open({units_per_metre, rate_Hz, gravity, friction, ground, sphere}) {
  const attributes = `condim="${friction ? 3 : 1}" friction="${friction} 0.005 0.0001"`;
  const joints = sphere.turns ? '<freejoint/>' : ['1 0 0', '0 1 0', '0 0 1'].map((axis) => `<joint type="slide" axis="${axis}"/>`).join('');
  const model = loaded(`<mujoco><option timestep="${1 / rate_Hz}" gravity="${gravity.join(' ')}"
    integrator="implicitfast"/><worldbody>${floor(ground, units_per_metre, attributes)}
    <body pos="${sphere.position.join(' ')}">${joints}
      <geom type="sphere" size="${sphere.radius}" mass="${sphere.mass_kg}" ${attributes}/></body>
    </worldbody></mujoco>`);
  const data = new mujoco.MjData(model);
  sphere.velocity.forEach((component, axis) => data.qvel[axis] = component);
  const felt = new mujoco.DoubleBuffer(6);
  return {
    free: () => [felt, data, model].forEach((object) => object.delete()),
    step(force) {
      force.forEach((component, axis) => data.qfrc_applied[axis] = component);
      mujoco.mj_step(model, data);
      const contacts = [];
      for (let k = 0; k < data.ncon; ++k) {
        const contact = data.contact.get(k);
        mujoco.mj_contactForce(model, data, k, felt);
        const sign = contact.geom[0] === model.ngeom - 1 ? -1 : 1;  // the normal points out of the first geom
        contacts.push([...[0, 1, 2].map((axis) => sign * contact.frame[axis]), felt.GetView()[0]]);
      }
      const start = sphere.turns ? [0, 0, 0] : sphere.position;
      return {position: start.map((at, axis) => at + data.qpos[axis]), velocity: [0, 1, 2].map((axis) => data.qvel[axis]), contacts};
    },
  };
}

await simulate({name: 'MuJoCo', version: `${mujoco.mj_versionString()} (mujoco-js ${version('mujoco-js')})`, reports: 'force',
  constraint: 'soft', binary: 64, sides: 'two',
  smallest_radius_m: 0.001, speed_cap_m_per_s: null,
  settings: 'the solver, solref and solimp that a model begins with, and the integrator implicitfast, which its manual recommends'},
open);
