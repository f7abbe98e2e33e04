// Reads the lines that `forceshade conform simulator` writes (docs/conformance-protocol.md) and answers with those of an engine.
// open(scene) builds a world, {step(force), free()}; step gives the state after the step: {position, velocity, contacts}, arrays.
// JSON has no number that is not finite: null stands for NaN, both ways.
import {createInterface} from 'node:readline';
import {readFileSync} from 'node:fs';

console.log = console.error;  // an engine's output is no line of the protocol

export const option = (name) => process.argv.includes(name);
export const version = (name) => JSON.parse(readFileSync(new URL(`node_modules/${name}/package.json`, import.meta.url))).version;
export const xyz = ({x, y, z}) => [x, y, z];

export async function simulate(about, open) {
  const hello = {forceshade: 'conform 1', kind: 'simulator', ...about};
  let scene, world;
  const begin = () => (world?.free(), world = open(scene));
  for await (const line of createInterface({input: process.stdin})) {
    const asked = JSON.parse(line, (_, value) => value ?? NaN);
    if (asked.goodbye) break;
    let answer;
    if (asked.scene) {
      scene = asked.scene;
      try {
        begin();
        answer = hello;
      } catch (error) {
        answer = {...hello, accepts: false, reason: String(error)};
      }
    } else {
      if (asked.reset) begin();
      answer = {motion: asked.applied.map((force) => world.step(force))};
    }
    process.stdout.write(JSON.stringify(answer) + '\n');
  }
}
