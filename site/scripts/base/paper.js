// A page as on paper: by day, whatever its theme; and, on a sheet, laid out for that.

import { chartsAtRest } from "./chart.js";
import { element, remeasure, said } from "./dom.js";
import { withSymbols } from "./figures.js";
import { drawnWithin, toldOnPaper } from "./snapshot.js";
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

/** What is folded on the screen, for nothing can be unfolded on a sheet; but for what would be too long there. */
const FOLDED = "main details:not([open], .save-figure, .long)";

/**
 * Lay the page out for a sheet of paper before it is printed. Nothing of it may take time: the browser waits for no frame
 * and no file, only for promises that can be kept at once, between one listener and the next.
 */
export function watchPaper() {
  const root = document.documentElement;
  /** @type {Element[]} */
  let drawn = [];
  /**
   * @param {Found} below
   * @param {string} text
   */
  const tell = (below, text) => {
    if (text === "" || below.clientWidth === 0) return;
    const node = element("p", { class: "paper-note" }, withSymbols(text));
    below.append(node);
    drawn.push(node);
  };
  /** @type {Found[]} */
  let unfolded = [];
  window.addEventListener("beforeprint", () => {
    root.dataset.paper = "page";
    unfolded = [...document.querySelectorAll(FOLDED)];
    for (const part of unfolded) {
      part.open = true;
      // The browser tells it only after the sheet is taken; some draw what they hold when they are told.
      part.dispatchEvent(new Event("toggle"));
    }
    for (const picture of document.querySelectorAll("img[loading]")) picture.removeAttribute("loading");
    restyle();
  });
  // Now all has the colours of a sheet.
  window.addEventListener("beforeprint", () => {
    remeasure();
    drawn = drawnWithin(document.body).map(({ node, drawing }) => {
      drawing.classList.add("on-paper");
      if (node instanceof HTMLCanvasElement) node.after(drawing);
      else {
        drawing.classList.add("whole");
        node.append(drawing);
      }
      return drawing;
    });
    for (const figure of document.querySelectorAll("[data-figure]")) tell(figure, toldOnPaper(figure));
    tell(document.getElementById("content"), said("source"));
  });
  window.addEventListener("afterprint", () => {
    for (const drawing of drawn) drawing.remove();
    for (const part of unfolded) part.open = false;
    delete root.dataset.paper;
    restyle();
    remeasure();
  });
}
