// The three maps: one in the large place, the other two beside it.

import { calm, focused } from "../base/dom.js";

/** @import { Scene } from "../map/scene.js" */

export const VIEWS = ["class", "hit", "thumbnail"];

/**
 * Put one map in the large place; the other two keep their order.
 * @param {Map<string, Found>} figures
 * @param {string} large
 */
export function arrange(figures, large) {
  const slots = ["left", "right"];
  for (const name of VIEWS) {
    const figure = figures.get(name);
    if (figure) figure.dataset.slot = name === large ? "large" : slots.shift();
  }
}

/**
 * The same, with a short movement that shows which map went where.
 * @param {Map<string, Found>} figures
 * @param {string} large
 * @param {Scene} scene
 */
export function swap(figures, large, scene) {
  const before = new Map([...figures].map(([name, node]) => [name, node.getBoundingClientRect()]));
  const held = focused().classList.contains("surface");
  arrange(figures, large);
  for (const view of scene.views) view.resize();
  if (held) figures.get(large)?.querySelector(".surface").focus({ preventScroll: true });
  if (calm()) return;
  for (const [name, node] of figures) {
    const [from, to] = [before.get(name), node.getBoundingClientRect()];
    if (!from || (from.width === to.width && from.left === to.left)) continue;
    const start = `translate(${from.left - to.left}px, ${from.top - to.top}px) scale(${from.width / to.width}, ${from.height / to.height})`;
    node.animate(
      [
        { transform: start, opacity: 0.4 },
        { transform: "none", opacity: 1 },
      ],
      { duration: 220, easing: "ease-out" },
    );
  }
}
