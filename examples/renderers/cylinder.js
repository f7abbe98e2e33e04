#!/usr/bin/env node
// The law cylinder in JavaScript, in binary64, for `forceshade conform` (docs/conformance-protocol.md). It takes no care: where terms
// cancel, its forces are some units in the last place off.
'use strict';
const bytes = new DataView(new ArrayBuffer(4));
const number = (hex) => (bytes.setUint32(0, parseInt(hex, 16)), bytes.getFloat32(0));
const hex = (value) => (bytes.setFloat32(0, value), bytes.getUint32(0).toString(16).padStart(8, '0'));

let force;  // of the scene

// A cylinder of radius R, whose axis lies d below the plane, from which it cuts the width w.
function cylinder({radius_mm: R, width_mm: w, stiffness_N_per_mm: K}) {
  const d = Math.sqrt(R * R - w * w / 4);
  return (x, y, z) => {
    if (![x, y, z].every((coordinate) => Math.abs(coordinate) <= 1e4)) return [0, 0, 0];
    const distance = Math.hypot(x, z + d), depth = R - distance;
    return depth > 0 ? [K * depth * x / distance, 0, K * depth * (z + d) / distance] : [0, 0, 0];
  };
}

function answer(asked) {
  if (asked.scene) {
    const about = {
      forceshade: 'conform 1', kind: 'renderer', name: 'a cylinder in JavaScript', version: '1', memory: 'none', answers: 'force',
      claims: 'definition', length_unit: 'mm', force_unit: 'N', frame: ['x', 'y', 'z'], domain_mm: 10000, rate_Hz: null,
      loop_energy_mJ: 0,
    };
    if (asked.scene.name !== 'cylinder') return {...about, accepts: false, reason: 'it renders the law cylinder alone'};
    force = cylinder(asked.scene.parameters);
    return about;
  }
  return {answers: asked.positions.map((at) => force(number(at.slice(0, 8)), number(at.slice(8, 16)), number(at.slice(16))).map(hex).join(''))};
}

require('readline').createInterface({input: process.stdin}).on('line', (line) => {
  const asked = JSON.parse(line);
  if (asked.goodbye) process.exit(0);
  console.log(JSON.stringify(answer(asked)));
});
