// What dragging on the maps of a page does, as its reader chooses: a box, a lasso, or to move them; and, where there is no
// Shift to hold down, what an area does to the selection.

/** @import { State } from "../base/state.js" */

/** @param {State} state */
export function watchDragging(state) {
  const choices = /** @type {const} */ (["drag", "join"]).map((name) => ({
    name,
    inputs: document.querySelectorAll(`#${name} input`),
  }));
  const show = () => {
    for (const { name, inputs } of choices) {
      for (const input of inputs) input.checked = input.value === state.get(name);
    }
    document.body.dataset.drag = state.get("drag");
  };
  for (const { name, inputs } of choices) {
    for (const input of inputs) input.addEventListener("change", () => state.set({ [name]: input.value }));
  }
  state.listen((changed) => (changed.has("drag") || changed.has("join")) && show());
  show();
}
