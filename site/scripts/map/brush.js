// A box on a plot selects what is in it, as on the maps of all other pages. A mouse draws one; a finger scrolls the page.

import { svg } from "../base/dom.js";
import { toggled } from "../database/selection.js";

const REACH = 14;
const CLICK = 4;

/** Let a plot in its surface show the selection of the state, and change it; other clicks are left to others. */
export function watchBrush(surface, plot, state) {
  const box = svg("rect", { class: "brush" });
  surface.append(svg("svg", { class: "overlay", "aria-hidden": "true" }, box));
  let start = null;
  let drawn = false;
  let before = null;

  surface.addEventListener("pointerdown", (event) => {
    drawn = false;
    if (event.pointerType !== "mouse" || event.button !== 0) return;
    start = placeOn(surface, event);
    before = event.shiftKey ? state.get("selection") : new Set();
    surface.setPointerCapture(event.pointerId);
  });
  surface.addEventListener("pointermove", (event) => {
    if (start === null) return;
    const [x, y] = placeOn(surface, event);
    drawn ||= Math.hypot(x - start[0], y - start[1]) > CLICK;
    if (!drawn) return;
    const [left, right] = [Math.min(x, start[0]), Math.max(x, start[0])];
    const [top, bottom] = [Math.min(y, start[1]), Math.max(y, start[1])];
    for (const [name, value] of Object.entries({ x: left, y: top, width: right - left, height: bottom - top }))
      box.setAttribute(name, value);
    box.classList.add("shown");
    state.set({ brushing: true, selection: new Set([...before, ...plot.inside(left, top, right, bottom)]) });
  });
  const end = () => {
    start = null;
    box.classList.remove("shown");
    state.set({ brushing: false });
  };
  surface.addEventListener("pointerup", end);
  surface.addEventListener("pointercancel", end);
  const click = (event) => {
    const index = plot.at(...placeOn(surface, event), REACH);
    if (!drawn && index !== null && !event.shiftKey) return;
    event.stopImmediatePropagation();
    if (drawn) return;
    state.set({ selection: index === null ? new Set() : toggled(state.get("selection"), index) });
  };
  surface.addEventListener("click", click, { capture: true });
  let frame = null;
  const draw = () => {
    frame = null;
    plot.draw();
  };
  state.listen((changed) => {
    if (changed.has("selection") && frame === null) frame = requestAnimationFrame(draw);
  });
}

function placeOn(surface, { clientX, clientY }) {
  const { left, top } = surface.getBoundingClientRect();
  return [clientX - left, clientY - top];
}
