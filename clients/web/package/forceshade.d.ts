// SPDX-License-Identifier: BSD-3-Clause
// The force laws of Morgenbesser and Srinivasan (RLE Technical Report 606, MIT, 1996), height maps and triangle meshes, as the C
// interface of forceshade has them. Every force is the binary32 nearest to the exact one, so that its bits are those
// of every other machine. Numbers of a position or a parameter are rounded to binary32 when they are taken.

/** Three numbers: mm of a position, x, y and z. */
export type Vector = ArrayLike<number>;
export type LawName =
  "wall" | "cylinder" | "bump-cylinder" | "bump-1p" | "bump-2p" | "bump-3p" | "bump-1p-shaded" | "bump-2p-shaded" | "bump-3p-shaded";
/** free: outside. contact: inside. invalid: a coordinate is NaN or beyond 10^4 mm; there is no force. unfinished: a contact whose
 * god-object used up the moves or looks of one tick. */
export type Status = "free" | "contact" | "invalid" | "unfinished";

/** A refusal of a call. result: the name of the C interface's result, "BAD_VALUE". */
export class ForceshadeError extends Error {
  readonly result: string;
}

export interface Force {
  /** N, three numbers. */
  force: Float32Array;
  status: Status;
}

export interface Forces {
  /** N, three numbers for each position. */
  forces: Float32Array;
  /** One for each position: 0 free, 1 contact, 2 invalid, 3 unfinished. */
  statuses: Uint8Array;
}

/** A law, height map or mesh. It has memory of the module, which close() gives back. */
export interface Subject {
  /** "law", "height map" or "mesh". */
  readonly kind: string;
  readonly name: string;
  /** "radius 15.24 mm, width 25.4 mm, stiffness 0.5 N/mm" */
  readonly parameters: string;
  /** The force of a law or a height map. That of a mesh depends on the path: "WRONG_KIND". */
  force(position: Vector): Force;
  /** Three numbers for each position. */
  forces(positions: ArrayLike<number>): Forces;
  /** At the beginning of a path. */
  session(): Session;
  close(): void;
}

/** The place of a mesh's god-object, exact. See `forceshade_state` in forceshade.h. */
export interface State {
  place: "nowhere" | "in-the-open" | "at-vertex" | "on-edge" | "in-triangle";
  side: "front" | "back";
  /** Friction has let it slip and does not hold it yet. */
  slipping: boolean;
  /** mm; in the open, and for a foot the hand. */
  position: number[];
  /** vertex: [v, 0]; edge: [a, b]; triangle: [i, 0]; triangles: [i, j]. */
  index: number[];
  /** In units of 2^-24. */
  parameter: number[];
  /** What else the place lies in, on a mesh that is not regular: FORCESHADE_MEETS_NOTHING and so on; "nothing" where it is not
   * given. */
  meeting?: "nothing" | "line" | "edge" | "triangle" | "triangles" | "foot-in-triangle" | "foot-on-edge" | "foot-on-line";
  further?: number[];
  /** With `side` the name of its cell: a triangle, and the number of a piece in it. */
  cell?: number[];
}

/** One path of the hand. */
export interface Session {
  step(position: Vector): Force;
  steps(positions: ArrayLike<number>): Forces;
  /** Back to the beginning of a path. */
  reset(): void;
  state(): State;
  /** Goes on from a state of the same subject. */
  resume(state: State): void;
  close(): void;
}

export interface Pose {
  /** mm */
  translation: Vector;
  /** A quaternion w, x, y, z of any length. */
  rotation: ArrayLike<number>;
}

/** One path of the hand through objects that move. */
export interface Scene {
  /** With a pose for each object. */
  step(position: Vector, poses: Pose[]): Force;
  /** The force of one object in the last step, in its own axes. */
  object(index: number): Force;
  close(): void;
}

/** Numbers of docs/damping.md. */
export interface DampingOptions {
  /** Hz: 1 to 2^17. A tick is a period of it. */
  rate: number;
  /** That of the new velocity in the filter, 2^-10 to 1; 1 where it is not given, which is no filter. */
  share?: number;
  /** B, N s/mm along the force: 0, or 2^-20 to 16; 0 where it is not given. */
  damping?: number;
  /** The most by which damping lengthens the force, 1 to 1024, or Infinity; 2 where it is not given. */
  most?: number;
  /** N s/mm across the force: 0, or 2^-20 to 16; 0 where it is not given. */
  drag?: number;
  /** N: the force from which on drag is full, 2^-10 to 1024; 0.25 where it is not given. */
  fullAt?: number;
}

/** All that damping remembers of a path. */
export interface DampingState {
  /** mm: the last valid one; null at the beginning. */
  position: number[] | null;
  /** mm/s */
  velocity: number[];
  /** Since that position; 17 stands for all above 16. */
  periods: number;
}

/** Damping behind the forces of any renderer along one path, from its beginning. */
export interface Damping {
  /** The damped force at the next position, where a renderer gave this answer; periods: those since the step before, 1 where it is
   * not given. */
  step(position: Vector, answer: { force: Vector; status: Status }, periods?: number): Force;
  /** Of the next positions, with a number of periods for each, or 1 each. */
  steps(positions: ArrayLike<number>, answers: { forces: ArrayLike<number>; statuses: ArrayLike<number> },
        periods?: ArrayLike<number>): Forces;
  /** Back to the beginning of a path. */
  reset(): void;
  state(): DampingState;
  /** A state that no step leaves counts as that of the beginning. */
  resume(state: DampingState): void;
}

export interface LawOptions {
  /** R, mm, in [0.1, 10^4]; 15.24 where it is not given. */
  radius?: number;
  /** w, mm, in [10^-3, 2R]; 25.4 where it is not given. */
  width?: number;
  /** K, N/mm, in [10^-3, 10^3]. */
  stiffness: number;
}

export interface HeightMapOptions {
  /** mm, columns * rows of them, row after row from the smallest y. */
  heights: ArrayLike<number>;
  columns: number;
  rows: number;
  /** mm between samples. */
  pitch: number;
  /** "cubic-spline" where it is not given. */
  interpolant?: "bilinear" | "cubic-spline";
  /** "clamp" where it is not given. */
  edge?: "clamp" | "tile";
  /** "height-map" where it is not given. */
  render?: "height-map" | "height-map-shaded" | "height-map-conservative";
  /** K, N/mm, in [10^-3, 10^3]. */
  stiffness: number;
}

export interface Material {
  /** N/mm; 0 is that of the mesh. */
  stiffness?: number;
  /** 0, infinity, or 2^-10 to 2^10; at least the dynamic one. */
  staticFriction?: number;
  dynamicFriction?: number;
}

export interface MeshOptions {
  /** mm, three numbers for each. */
  vertices: ArrayLike<number>;
  /** Three numbers of vertices, from 0, for each; (b - a) x (c - a) points to the front. */
  triangles: ArrayLike<number>;
  sides?: "front" | "both";
  shading?: "none" | "vertex" | "edge";
  contact?: "direct" | "sub-goal" | "friction";
  /** Degrees, 0 to 180; 180 where it is not given. */
  crease?: number;
  /** K, N/mm, in [10^-3, 10^3]. */
  stiffness: number;
  /** @deprecated It counts for nothing: triangles of any mesh may cross. */
  selfIntersecting?: boolean;
  materials?: Material[];
  /** The number of its material, from 0, for each triangle; all have the first where it is not given. */
  materialOfTriangle?: ArrayLike<number>;
}

export interface Library {
  readonly version: string;
  readonly laws: LawName[];
  /** "laws", "height-maps", "meshes", "states", "scenes", "damping" and the others of forceshade.h. No feature that needs files is here. */
  has(feature: string): boolean;
  /** The fault of this machine's arithmetic against IEEE 754; null where nothing was found. */
  readonly arithmeticFault: string | null;
  law(name: LawName, options: LawOptions): Subject;
  heightMap(options: HeightMapOptions): Subject;
  mesh(options: MeshOptions): Subject;
  /** 1 to 32 subjects, of which one may come several times. */
  scene(objects: Subject[]): Scene;
  damping(options: DampingOptions): Damping;
}

export const LAWS: readonly LawName[];
/** Makes the library; the module is inside the file, and nothing is requested from anywhere. */
export function load(): Promise<Library>;
