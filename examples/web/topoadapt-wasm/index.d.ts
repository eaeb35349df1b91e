// SPDX-License-Identifier: MIT
// topoadapt-wasm: topology changes of moving triangle meshes. topoadapt.h has the contract of every call.

export type Source = BufferSource | WebAssembly.Module | Response | URL | string;

/** Compiles the module: without an argument that of the package, otherwise from its bytes or its address. */
export function load(source?: Source | LoadOptions): Promise<Topoadapt>;

export interface LoadOptions {
  /** topoadapt.wasm; with threads, topoadapt-threads.wasm. Default: those of the package. */
  source?: Source;
  /** Threads of each mesh, the calling thread among them. 1 where the page is not cross-origin isolated. Default 1. */
  threads?: number;
}

export interface Topoadapt {
  readonly version: string;
  readonly buildInfo: string;
  /** Threads of each mesh. */
  readonly threads: number;
  /** A mesh in a memory of its own, which the garbage collector frees with it, and so it ends the mesh's workers. */
  mesh(options?: MeshOptions): Mesh;
}

/** The limits and settings of tpa_config. */
export interface MeshOptions {
  /** Default 16384. */
  maxVertices?: number;
  maxTriangles?: number;
  maxContacts?: number;
  maxCutEdges?: number;
  maxEvents?: number;
  maxComponents?: number;
  maxPieces?: number;
  maxSubsteps?: number;
  /** 0: complete, 1: the paper's hash of vertices. */
  detectMode?: number;
  cellSize?: number;
  /** 0: triangles wind outward round the object, 1: they bound its outside. */
  region?: number;
  maxPasses?: number;
  maxCandidates?: number;
  smoothIterations?: number;
  smoothLambda?: number;
  smoothMu?: number;
  /** A call that reaches a limit goes on in a larger block, with the same bits. Default true. */
  grow?: boolean;
  /** The largest block to grow to. Default 2^30. */
  maxBytes?: number;
}

/** "No such element", in place of an id. */
export const NONE: number;

export type Positions = Float64Array | Float32Array;
export type Triangles = Uint32Array | Uint16Array;

export class Mesh {
  private constructor();

  /** Replaces the mesh by a closed, consistently oriented 2-manifold, which may be tangled. */
  load(positions: Positions, triangles: Triangles): void;
  readonly vertexCount: number;
  readonly triangleCount: number;
  /** Grows with every commit; equal epochs mean equal ids. */
  readonly epoch: number;

  /* Views over the memory of the library, without a copy. Take them again after a call that changes the mesh: a view of
   * before may show other numbers then, or has length 0 where the memory has grown. Do not write. */
  /** x y z of each vertex. */
  readonly positions: Float64Array;
  /** Three vertices of each triangle, counter-clockwise from outside. */
  readonly triangles: Uint32Array;
  /** Of half-edge 3 * triangle + i, from corner i to the next, the half-edge in the other triangle. */
  readonly opposites: Uint32Array;

  /** Targets for the next step: of all vertices, or of the listed ones. RangeError for another number of targets. */
  move(targets: Positions, vertices?: Uint32Array | null): void;
  dropTargets(): void;

  /** Moves, detects, adapts, checks, commits. */
  step(options?: WorkOptions): Report;
  /** A step in sub-steps, so that nothing thicker than `thickness` is crossed unseen. Wants maxSubsteps. */
  advance(thickness: number, options?: WorkOptions): Report;
  /** Makes a tangled mesh clean. */
  adapt(options?: WorkOptions): Report;
  remesh(targetLength: number, options?: RemeshOptions): Report;
  /** Taubin smoothing, of all vertices or the listed ones. */
  smooth(iterations: number, options?: WorkOptions & { vertices?: Uint32Array | null }): Report;
  /** Renumbers along a curve through space, so that near elements lie near in memory: a commit. Drops targets. */
  reorder(): void;
  /** Pairs of triangles that meet, two numbers for each. */
  detect(options?: WorkOptions): Uint32Array;
  /** Checks the mesh from its triangles alone. */
  validate(options?: WorkOptions): Validation;

  /* Results of the last commit. */
  events(): TopologyEvent[];
  readonly componentCount: number;
  components(): Component[];
  /** Also for each vertex the place of its component in the list. */
  labelledComponents(): { components: Component[]; labels: Uint32Array };
  /** Vertices that the last step left at their old positions. */
  rolledBack(): Uint32Array;
  /** Valid until the next call that changes the mesh. */
  vertexMap(): VertexMap;
  /** Valid until the next call that changes the mesh. */
  triangleMap(): TriangleMap;
  /** What to send anew to arrays that hold the mesh of before the last commit. */
  changes(options?: { gap?: number; capacity?: number }): Changes;
  /** Attributes of the vertices of before, `floats` for each, as attributes of the vertices of now. */
  carryVertices(before: Float32Array, floats: number): Float32Array;
  carryTriangles(before: Float32Array, floats: number): Float32Array;

  /* State. */
  save(): Uint8Array;
  restore(state: Uint8Array): void;
  /** Equal for equal states, on every platform. */
  digest(): bigint;
  /** Threads at work in a call. Workers need some time to start, in which the page or program has to come to rest. */
  readonly threads: number;
  /** A number in the memory of the mesh: nonzero ends calls with E_CANCELLED, until it is zero again. In a mesh with
   * threads the memory is shared, so the array may be posted to another thread, which ends a call that runs:
   * Atomics.store(cancelled, 0, 1). In a mesh without, take the array again after each call. */
  readonly cancelled: Int32Array;
  /** Ends the workers now; calls go on with the calling thread alone. */
  close(): void;
  /** Size of the memory. */
  readonly bytes: number;
}

export interface WorkOptions {
  /** Units of work that the call may spend; more is E_BUDGET. 0: no bound. */
  budget?: number;
}

export interface RemeshOptions extends WorkOptions {
  iterations?: number;
  splitRatio?: number;
  collapseRatio?: number;
  relaxation?: number;
  /** A part of the mesh; everything else stays. */
  vertices?: Uint32Array | null;
  /** For each vertex of the mesh, the edge length aimed at there, in place of targetLength. */
  lengths?: Float32Array | null;
}

/** The fields of tpa_report. */
export interface Report {
  passes: number;
  contacts: number;
  groups: number;
  handles: number[];
  caps: number;
  removedPatches: number;
  rolledBackVertices: number;
  unresolved: number;
  splits: number;
  collapses: number;
  flips: number;
  moved: number;
  vertices: number;
  triangles: number;
  approach: number;
  regionBefore: number;
  regionAfter: number;
  regionLost: number;
  regionGained: number;
  regionReach: number;
  substeps: number;
}

export interface Validation {
  components: number;
  selfIntersections: number;
  euler: number;
  genus: number;
  volume: number;
  area: number;
}

export type EventType =
  | "handle"
  | "cap"
  | "removal"
  | "rollback"
  | "merge"
  | "split"
  | "genus-up"
  | "genus-down"
  | "death";

/** `before` and `after`: components, by their smallest vertices; NONE where there is none. */
export interface TopologyEvent {
  type: EventType;
  amount: number;
  before: number;
  after: number;
  /** Of handles, caps and rollbacks; zeros for others. */
  position: number[];
}

export interface Component {
  id: number;
  before: number;
  vertices: number;
  triangles: number;
  genus: number;
  volume: number;
  area: number;
  /** Least x y z, greatest x y z. */
  box: number[];
}

export interface VertexMap {
  oldCount: number;
  newCount: number;
  oldToNew: Uint32Array;
  /** Where a vertex of now lies: weight * parents[0] + (1 - weight) * parents[1], in ids of before. */
  origin(vertex: number): { parents: [number, number]; weight: number };
}

export interface TriangleMap {
  oldCount: number;
  newCount: number;
  origins: Uint32Array;
}

export interface Range {
  first: number;
  count: number;
}

export interface Changes {
  vertices: Range[];
  triangles: Range[];
  changedVertices: number;
  changedTriangles: number;
  oldVertexCount: number;
  oldTriangleCount: number;
  vertexCount: number;
  triangleCount: number;
}

export type ErrorCode =
  | "E_ARGUMENT"
  | "E_CONFIG"
  | "E_OVERFLOW"
  | "E_ARENA"
  | "E_CONTEXT"
  | "E_STATE"
  | "E_LIMIT"
  | "E_MESH"
  | "E_TANGLED"
  | "E_ENVIRONMENT"
  | "E_BUDGET"
  | "E_CANCELLED"
  | "E_DATA"
  | "E_UNKNOWN";

/** A failed call, with the text and the fields of tpa_issue. The mesh is bit for bit as before the call. */
export class TopoadaptError extends Error {
  readonly code: ErrorCode;
  readonly status: number;
  readonly defect: number;
  readonly limit: number;
  readonly argument: number;
  readonly element: number;
  readonly other: number;
  readonly needed: number;
  readonly available: number;
}
