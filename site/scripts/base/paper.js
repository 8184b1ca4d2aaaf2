// A page as on paper: by day, whatever its theme; and, on a sheet, laid out for that.

import { chartsAtRest } from "./chart.js";
import { remeasure } from "./dom.js";
import { drawnWithin } from "./snapshot.js";
import { currentTheme, restyle } from "./theme.js";

/**
 * Do something while the page has the colours that it has on paper.
 * @template Result
 * @param {() => Result} work
 */
export async function onPaper(work) {
  const root = document.documentElement;
  const dark = currentTheme() === "dark";
  root.dataset.paper = "figure";
  try {
    if (dark) {
      restyle();
      await chartsAtRest();
    }
    return work();
  } finally {
    delete root.dataset.paper;
    if (dark) restyle();
  }
}

/** Lay the page out for a sheet of paper before it is printed. Nothing of it may take time: the browser does not wait. */
export function watchPaper() {
  /** @type {Element[]} */
  let drawn = [];
  window.addEventListener("beforeprint", () => {
    document.documentElement.dataset.paper = "page";
    remeasure();
    for (const picture of document.querySelectorAll("img[loading]")) picture.removeAttribute("loading");
    drawn = drawnWithin(document.body).map(({ node, drawing }) => {
      drawing.classList.add("on-paper");
      if (node instanceof HTMLCanvasElement) {
        drawing.setAttribute("width", `${node.clientWidth}`);
        drawing.setAttribute("height", `${node.clientHeight}`);
        node.after(drawing);
      } else {
        drawing.classList.add("whole");
        node.append(drawing);
      }
      return drawing;
    });
  });
  window.addEventListener("afterprint", () => {
    for (const drawing of drawn) drawing.remove();
    delete document.documentElement.dataset.paper;
    remeasure();
  });
}
