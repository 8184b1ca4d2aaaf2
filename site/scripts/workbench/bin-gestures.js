// Pointer, wheel, fingers and keys on the bars.

const CLICK = 4;
const LEAP = 10;

export class BinGestures {
  #pointers = new Map();
  #drag = null;

  /** `plot` is the BinPlot; `chart` is asked to point, to mark a range and to choose. */
  constructor(plot, chart) {
    this.plot = plot;
    this.chart = chart;
    const { surface } = plot;
    surface.addEventListener("pointerdown", (event) => this.#down(event));
    surface.addEventListener("pointermove", (event) => this.#move(event));
    surface.addEventListener("pointerup", (event) => this.#up(event));
    surface.addEventListener("pointercancel", (event) => this.#release(event));
    surface.addEventListener("pointerleave", (event) => event.pointerType === "mouse" && chart.point(null));
    surface.addEventListener("wheel", (event) => this.#wheel(event), { passive: false });
    surface.addEventListener("keydown", (event) => this.#key(event));
    surface.addEventListener("blur", () => this.#letGo());
  }

  #x(event) {
    return event.clientX - this.plot.surface.getBoundingClientRect().left;
  }

  #down(event) {
    if (event.button === 2) return;
    const x = this.#x(event);
    this.#pointers.set(event.pointerId, x);
    this.plot.surface.setPointerCapture(event.pointerId);
    if (this.#pointers.size === 2) {
      const [a, b] = [...this.#pointers.values()];
      const { scale } = this.plot;
      this.#drag = { kind: "pinch", spread: Math.abs(a - b), place: scale.placeOf((a + b) / 2), step: scale.step };
      this.chart.mark(null);
      return;
    }
    // One choice on the page says what dragging does, on the maps and here.
    const moves = this.plot.surface.closest("[data-drag='move']") !== null || event.button === 1;
    this.#drag = { kind: "press", becomes: moves ? "move" : "select", start: x, last: x, place: this.plot.at(x, true) };
  }

  #move(event) {
    const { plot, chart } = this;
    const x = this.#x(event);
    if (this.#pointers.has(event.pointerId)) this.#pointers.set(event.pointerId, x);
    const drag = this.#drag;
    if (!drag) {
      if (event.pointerType === "mouse") chart.point(this.#columnAt(x));
      return;
    }
    if (drag.kind === "pinch") this.#stretch(drag);
    if (drag.kind === "press" && Math.abs(x - drag.start) > CLICK) {
      drag.kind = drag.becomes;
      chart.point(null);
    }
    if (drag.kind === "move") plot.pan(drag.last - x);
    drag.last = x;
    if (drag.kind === "select" && plot.places.length > 0) {
      if (x < 0 || x > plot.width) plot.pan(x < 0 ? x : x - plot.width);
      chart.mark([drag.place, plot.at(x, true)]);
    }
  }

  #up(event) {
    const drag = this.#drag;
    const x = this.#x(event);
    this.#release(event);
    if (drag?.kind === "select") this.chart.apply(this.chart.marked);
    if (drag?.kind !== "press" || event.button === 1) return;
    const column = this.#columnAt(x);
    if (column === null) return;
    // A finger cannot point without touching, so its first touch points and the next one chooses.
    if (event.pointerType === "mouse" || this.chart.pointed === column) this.chart.toggle(column);
    else this.chart.point(column);
  }

  #release(event) {
    this.#pointers.delete(event.pointerId);
    this.#drag = null;
    if (event.type === "pointercancel") this.chart.mark(null);
  }

  #columnAt(x) {
    const place = this.plot.at(x);
    return place === null ? null : this.plot.places[place];
  }

  #stretch(drag) {
    const [a, b] = [...this.#pointers.values()];
    // What was between the fingers stays between them.
    this.plot.hold(drag.place, (a + b) / 2, (drag.step * Math.abs(a - b)) / Math.max(drag.spread, 1));
  }

  #wheel(event) {
    const lines = event.deltaMode === 1 ? 18 : 1;
    const sideways = event.shiftKey ? event.deltaX || event.deltaY : event.deltaX;
    if (event.shiftKey || Math.abs(event.deltaX) > Math.abs(event.deltaY)) {
      if (this.plot.scale.whole) return;
      this.plot.pan(sideways * lines);
    } else {
      // Where the page itself scrolls, the wheel belongs to it unless the reader asks for zoom.
      const scrolls = document.documentElement.scrollHeight > window.innerHeight + 1;
      if (scrolls && !event.ctrlKey && !event.metaKey) return;
      this.plot.zoom(Math.exp((-event.deltaY * lines * (event.ctrlKey ? 4 : 1)) / 500), this.#x(event));
    }
    event.preventDefault();
    this.chart.point(null);
  }

  #key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const { plot, chart } = this;
    const leap = Math.max(LEAP, Math.floor(plot.span / 10));
    const steps = {
      ArrowLeft: -1,
      ArrowRight: 1,
      PageUp: -leap,
      PageDown: leap,
      Home: -plot.places.length,
      End: plot.places.length,
    };
    if (event.key in steps) this.#walk(steps[event.key], event.shiftKey);
    else if (event.key === "Enter" || event.key === " ") {
      if (chart.range) chart.apply(chart.marked);
      else if (chart.pointed !== null) chart.toggle(chart.pointed);
    } else if (event.key === "Delete" || event.key === "Backspace") {
      chart.giveUp(chart.range ? chart.marked : [chart.pointed]);
    } else if (event.key === "+" || event.key === "=") plot.zoom(1.5);
    else if (event.key === "-") plot.zoom(1 / 1.5);
    else if (event.key === "0") plot.lookAtAll();
    else if (event.key === "Escape" && (chart.range || chart.pointed !== null)) this.#letGo();
    else return;
    event.preventDefault();
  }

  #walk(number, extend) {
    const { plot, chart } = this;
    const { places, placeOf } = plot;
    if (!extend || chart.pointed === null) {
      if (chart.range) chart.mark(null);
      chart.step(number);
      return;
    }
    const [from, to] = chart.range ?? [placeOf[chart.pointed], placeOf[chart.pointed]];
    const end = Math.min(Math.max(to + number, 0), places.length - 1);
    plot.reveal(end);
    chart.point(places[end]);
    chart.mark([from, end]);
    chart.announce(`${chart.marked.length} bins marked, to ${chart.bins.names[places[end]]}`);
  }

  #letGo() {
    this.chart.mark(null);
    this.chart.point(null);
  }
}
