// What the type checker cannot know. Only it reads this file.

/** Every page's scripts are written with its template: what they look up is there, and of the kind they expect. */
type Found = {
  readonly children: HTMLCollectionOf<Found>;
  readonly firstElementChild: Found;
  readonly parentElement: Found;
} & HTMLElement &
  Record<string, any>;
interface Document {
  getElementById(id: string): Found;
}
interface ParentNode {
  querySelector(selectors: string): Found;
  querySelectorAll(selectors: string): NodeListOf<Found>;
}
interface Element {
  closest(selectors: string): Found | null;
  setAttribute(name: string, value: string | number): void;
}

/** What listens to elements is told of elements. */
interface Targeted {
  target: Found;
  currentTarget: Found;
}
type Handler<Event> = (event: Event & Targeted) => unknown;
interface HTMLElement {
  addEventListener<Kind extends keyof HTMLElementEventMap>(
    kind: Kind,
    handler: Handler<HTMLElementEventMap[Kind]>,
    options?: boolean | AddEventListenerOptions,
  ): void;
}
interface SVGElement {
  addEventListener<Kind extends keyof SVGElementEventMap>(
    kind: Kind,
    handler: Handler<SVGElementEventMap[Kind]>,
    options?: boolean | AddEventListenerOptions,
  ): void;
}
interface HTMLDivElement {
  addEventListener<Kind extends keyof HTMLElementEventMap>(
    kind: Kind,
    handler: Handler<HTMLElementEventMap[Kind]>,
    options?: boolean | AddEventListenerOptions,
  ): void;
}
interface SVGSVGElement {
  addEventListener<Kind extends keyof SVGElementEventMap>(
    kind: Kind,
    handler: Handler<SVGElementEventMap[Kind]>,
    options?: boolean | AddEventListenerOptions,
  ): void;
}
interface Document {
  addEventListener<Kind extends keyof DocumentEventMap>(
    kind: Kind,
    handler: Handler<DocumentEventMap[Kind]>,
    options?: boolean | AddEventListenerOptions,
  ): void;
}

interface Array<T> {
  filter(predicate: BooleanConstructor): Exclude<T, null | undefined | false | "" | 0>[];
  /** The last of a list that has one: as with brackets, nothing is assumed to be missing. */
  at(place: -1): T;
}
interface Float64Array {
  at(place: -1): number;
}

/** Values of attributes by name, as `element` of base/dom.js takes them; "onclick" is a handler of "click". */
type Handlers = { [Kind in keyof HTMLElementEventMap as `on${Kind}`]?: Handler<HTMLElementEventMap[Kind]> };
interface Attributes extends Handlers {
  [name: string]: string | number | boolean | null | undefined | ((event: any) => unknown);
}

/**
 * The values that the engine works on: one column after the other, each a number of steps of which `most` lead from the
 * lowest to the highest of its feature; the feature of each column, and what features count.
 */
interface FeatureValues {
  rows: number;
  columns: number;
  steps: Uint16Array | Float32Array;
  most: number;
  low: number[];
  high: number[];
  blocks: Int32Array;
  weights: number[];
  scaling: "balanced" | "plain";
}

/** Two groups of rows that are to be told apart. */
interface Contest {
  positive: Int32Array;
  negative: Int32Array;
}

/** Work of the engine in slices: between two of them it says how far it is, with what there is to see already. */
type Steps<Result, Partial = any> = Generator<{ progress: number; partial?: Partial }, Result, any>;

interface Window {
  /** What the script in the head makes for all others. */
  shapeviz: {
    handed: Map<string, { kind: "json" | "columns" | "stored" | "bytes"; length: number; holder: () => void }>;
    scripts: Map<string, () => void>;
    receive(name: string, kind: "json" | "columns" | "stored" | "bytes", length: number, holder: () => void): void;
    startWorker?(): Promise<Worker>;
    modules?: { define(modules: object): void; use(name: string): object };
  };
  vega: any;
  trustedTypes?: any;
}
