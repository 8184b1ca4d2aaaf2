// What a keyboard reaches, and how that shows: for test_everyone.py.

(() => {
  const CONTROLS =
    "a[href], button, input, select, textarea, summary, [role=application], [role=button], [role=checkbox], [role=gridcell] [tabindex], [role=treeitem], [role=tab]";
  // Within these, Tab goes to one and arrow keys to the others.
  const COMPOSITES = "[role=radiogroup], [role=grid], [role=tree], [role=tablist], [role=group], [role=application]";
  const reached = new Map();

  const named = (node) =>
    `${node.tagName.toLowerCase()}#${node.id} ${(node.getAttribute("aria-label") || node.textContent || node.value || "").trim().slice(0, 40)}`;
  const ringed = (node) => {
    const { outlineStyle, outlineWidth, boxShadow } = getComputedStyle(node);
    return (outlineStyle !== "none" && parseFloat(outlineWidth) > 0) || boxShadow !== "none";
  };

  /** The element that has the focus: its number, its name, whether that shows, and whether it is in sight. */
  const focused = () => {
    const node = document.activeElement;
    if (node === document.body || node === null) return null;
    if (!reached.has(node)) reached.set(node, reached.size);
    // What a reader sees of a hidden radio button is its label.
    const seen = node.matches("input") && getComputedStyle(node).opacity === "0" ? node.closest("label") : node;
    const { left, right, top, bottom } = seen.getBoundingClientRect();
    return {
      number: reached.get(node),
      name: named(node),
      // A ring may be drawn around a part of it, or around what stands for it.
      rings: [node, seen, node.nextElementSibling, node.firstElementChild].some((other) => other && ringed(other)),
      inSight: right > Math.max(left, 0) && left < innerWidth && bottom > Math.max(top, 0) && top < innerHeight,
    };
  };

  /** Controls in sight that no Tab reached, nor one beside them from which arrow keys lead to them. */
  const missed = () => {
    const nodes = [...reached.keys()];
    return [...document.querySelectorAll(CONTROLS)]
      .filter(
        (node) =>
          !reached.has(node) &&
          !node.disabled &&
          node.checkVisibility({ visibilityProperty: true }) &&
          !node.closest("[aria-hidden=true]"),
      )
      .filter(
        (node) =>
          node.tabIndex >= 0 ||
          !node.closest(COMPOSITES) ||
          !nodes.some((other) => node.closest(COMPOSITES).contains(other)),
      )
      .filter((node) => node.type !== "radio" || !nodes.some((other) => other.name === node.name))
      .map(named);
  };

  /** Make all text of the page so many times as large, as a browser that enlarges nothing else. */
  const enlargeText = (times) => {
    const sizes = [...document.querySelectorAll("body, body *")].map((node) => [
      node,
      parseFloat(getComputedStyle(node).fontSize),
    ]);
    for (const [node, size] of sizes) node.style.fontSize = `${times * size}px`;
  };

  window.everyone = { focused, missed, enlargeText };
})();
