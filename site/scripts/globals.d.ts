// What the type checker cannot know. Only it reads this file.

/** Every page's scripts are written with its template: what they look up is there, and of the kind they expect. */
interface Document {
  getElementById(id: string): any;
}
interface ParentNode {
  querySelector(selectors: string): any;
  querySelectorAll(selectors: string): NodeListOf<any>;
}
interface EventTarget {
  closest?: any;
  matches?: any;
  value?: any;
  elements?: any;
  reset?: any;
}

/** The values that the engine works on: one column after the other, and the feature of each column. */
interface FeatureValues {
  rows: number;
  columns: number;
  values: Float32Array;
  blocks: Int32Array;
  scaling: "balanced" | "plain";
}

/** Work of the engine in slices: between two of them it says how far it is, with what there is to see already. */
type Steps<Result, Partial = any> = Generator<{ progress: number; partial?: Partial }, Result, any>;

interface Window {
  /** What the script in the head makes for all others. */
  shapeviz: {
    packed: Map<string, { kind: "json" | "bytes"; text: string }>;
    scripts: Map<string, () => void>;
    receive(name: string, kind: "json" | "bytes", text: string): void;
    startWorker?(): Promise<Worker>;
    modules?: { define(modules: object): void; use(name: string): object };
  };
  vega: any;
  vegaLite: any;
  vegaEmbed: any;
  trustedTypes?: any;
}
