// The shape itself: its picture, and in 3D where a reader asks for it, as plain clay.

import { chunk, modelBytes } from "../chunks.js";
import { Paint } from "../viewer/paint.js";
import { Stage } from "../viewer/stage.js";

export class Portrait {
  constructor(model, state, { models }) {
    Object.assign(this, { model, state });
    const load = models ? async (shape) => modelBytes((await chunk("selection")).models[shape]) : null;
    this.stage = new Stage(document.getElementById("stage"), { model, load, keys: "turn-keys" });
    state.listen((changed) => {
      if (changed.has("shape")) this.render();
    });
  }

  render() {
    const shape = this.state.get("shape");
    if (shape === null) return;
    this.stage.show(shape, {
      label: `${this.model.names[shape]} in 3D`,
      paint: async (solid) => {
        this.paint ??= new Paint(await chunk("selection"));
        return this.paint.plain(solid);
      },
    });
  }
}
