// The closest point of a mesh by three-mesh-bvh as a renderer for `forceshade conform`: what a program feels that takes the nearest
// point of the surface each time, and remembers nothing. Behind the face that it is nearest to, the hand is in contact.
import {createInterface} from 'node:readline';
import {BufferAttribute, BufferGeometry, Triangle, Vector3} from 'three';
import {MeshBVH} from 'three-mesh-bvh';
import {version} from './simulator.mjs';

const hello = {forceshade: 'conform 1', kind: 'renderer', name: 'the closest point of three-mesh-bvh', version: version('three-mesh-bvh'),
  memory: 'none', answers: 'closest point', claims: 'invariants', length_unit: 'mm', force_unit: 'N', frame: ['x', 'y', 'z'],
  domain_mm: 10000, rate_Hz: null, loop_energy_mJ: 0, sides: ['front'], shading: ['none'], proxy_radius_mm: 0};
const bytes = new DataView(new ArrayBuffer(4));
const number = (hex) => (bytes.setUint32(0, parseInt(hex, 16)), bytes.getFloat32(0));
const hex = (value) => (bytes.setFloat32(0, value), bytes.getUint32(0).toString(16).padStart(8, '0'));

// The number that a text in the C language's hexadecimal notation stands for.
function hexfloat(text) {
  const [, sign, whole, part = '', power] = /^(-?)0x([0-9a-f]+)(?:\.([0-9a-f]*))?p([+-]\d+)$/.exec(text);
  return (sign ? -1 : 1) * parseInt(whole + part, 16) * 2 ** (Number(power) - 4 * part.length);
}

function nearest({vertices_mm, triangles}) {
  const vertices = vertices_mm.map((at) => new Vector3(...at.map(hexfloat)));
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(new Float64Array(vertices.flatMap((at) => at.toArray())), 3));
  geometry.setIndex(triangles.flat());
  const tree = new MeshBVH(geometry, {indirect: true});  // keeps the order of the triangles
  const normals = triangles.map((corners) => new Triangle(...corners.map((corner) => vertices[corner])).getNormal(new Vector3()));
  return (position) => {
    if (!position.every((coordinate) => Math.abs(coordinate) <= 1e4)) return position;
    const at = new Vector3(...position), found = tree.closestPointToPoint(at);
    return at.sub(found.point).dot(normals[found.faceIndex]) < 0 ? found.point.toArray() : position;
  };
}

let closest;
for await (const line of createInterface({input: process.stdin})) {
  const asked = JSON.parse(line);
  if (asked.goodbye) process.exit(0);
  let answer = hello;
  if (asked.scene) {
    if (asked.scene.mesh) closest = nearest(asked.scene.mesh);
    else answer = {...hello, accepts: false, reason: 'it renders meshes alone'};
  } else {
    const position = (at) => [at.slice(0, 8), at.slice(8, 16), at.slice(16)].map(number);
    answer = {answers: asked.positions.map((at) => closest(position(at)).map(hex).join(''))};
  }
  process.stdout.write(JSON.stringify(answer) + '\n');
}
