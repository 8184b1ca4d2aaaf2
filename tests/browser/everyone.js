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

  /** How light a colour is, as contrast counts it (WCAG 2), and how far it covers. */
  const lightness = (color) => {
    const parts = color.match(/-?[\d.]+/g).map(Number);
    const unit = color.startsWith("color(") ? 1 : 255;
    const [red, green, blue] = parts
      .slice(0, 3)
      .map((part) => part / unit)
      .map((part) => (part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4));
    return { value: 0.2126 * red + 0.7152 * green + 0.0722 * blue, alpha: parts[3] ?? 1 };
  };

  /** The ground of an element: that of the next one around it which has one. */
  const ground = (node) => {
    for (let own = node; own !== null; own = own.parentElement) {
      const { value, alpha } = lightness(getComputedStyle(own).backgroundColor);
      if (alpha > 0.5) return value;
    }
    return 1;
  };

  /** Texts in sight that are hardly told from their ground, by the colours that are really used. */
  const faint = () => {
    const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
    const found = [];
    while (walker.nextNode()) {
      const { data, parentElement: own } = walker.currentNode;
      if (data.trim() === "" || !own.checkVisibility() || own.closest("svg, script, style, option, :disabled"))
        continue;
      const levels = [lightness(getComputedStyle(own).color).value, ground(own)].sort((a, b) => b - a);
      if ((levels[0] + 0.05) / (levels[1] + 0.05) < 4.5) found.push(`${own.className} ${data.trim().slice(0, 30)}`);
    }
    return found;
  };

  /** Names written from right to left: what comes first in them is at their right. */
  const RIGHT_TO_LEFT = /^[^\p{L}]*[\p{Script=Hebrew}\p{Script=Arabic}]/u;

  /** Texts in sight that run out of their box, that end there without a sign of it, or of which the beginning is cut. */
  const cut = () => {
    const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
    const found = [];
    const range = document.createRange();
    while (walker.nextNode()) {
      const { data, parentElement: own } = walker.currentNode;
      if (data.trim() === "" || !own.checkVisibility({ visibilityProperty: true })) continue;
      if (own.closest("svg, script, style, select, .unseen")) continue;
      range.selectNodeContents(walker.currentNode);
      const { left, right, top, bottom, width } = range.getBoundingClientRect();
      if (width === 0) continue;
      let box = own;
      while (["inline", "contents"].includes(getComputedStyle(box).display)) box = box.parentElement;
      const outside = (node) => {
        const around = node.getBoundingClientRect();
        return right > around.right + 2 || left < around.left - 2;
      };
      const above = (node) => {
        const around = node.getBoundingClientRect();
        return top < around.top - 2 || bottom > around.bottom + 2;
      };
      let clip = box;
      while (clip !== document.body) {
        const { overflowX, writingMode } = getComputedStyle(clip);
        const out = writingMode.startsWith("vertical") ? above(clip) : outside(clip);
        if (overflowX !== "visible" && out) break;
        clip = clip.parentElement;
      }
      const { overflowX, textOverflow, direction, maskImage } = getComputedStyle(clip);
      const told = `${clip.tagName}.${clip.className} ${data.trim().slice(0, 30)}`;
      if (clip === document.body) {
        if (outside(box)) found.push(`runs out of ${told}`);
      } else if (overflowX === "hidden" || overflowX === "clip") {
        if (textOverflow !== "ellipsis" && maskImage === "none") found.push(`ends without a sign ${told}`);
        else if (RIGHT_TO_LEFT.test(clip.textContent) && direction !== "rtl")
          found.push(`without its beginning ${told}`);
      }
    }
    return found;
  };

  window.everyone = { focused, missed, enlargeText, faint, cut };
})();
