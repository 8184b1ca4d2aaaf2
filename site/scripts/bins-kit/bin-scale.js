// Where on the screen every place in the row of bars is. Chosen bars stay wide enough to be seen among thousands.

/** Pixels a bar: with few bars, and zoomed in as far as it goes. */
const WIDEST = 36;
const CLOSEST = 48;
/** Pixels that a chosen bar keeps, as long as all of them together take no more than a share of the width. */
const KEPT = 6;
const KEPT_SHARE = 1 / 3;

export class BinScale {
  #before = new Int32Array(1);
  #start = 0;

  /** The place at the left edge, and the pixels a bar that is not chosen has. */
  left = 0;
  step = 0;
  count = 0;
  width = 1;

  /** Pixels that a chosen bar keeps, and those of a bar when all are shown and zoomed in as far as it goes. */
  kept = KEPT;
  least = 0;
  most = CLOSEST;

  /**
   * Lay out bars on so many pixels; `chosen` holds the rising places of the chosen ones. All is shown if it was.
   * @param {number} count
   * @param {ArrayLike<number> & Iterable<number>} chosen
   * @param {number} width
   */
  fit(count, chosen, width) {
    const { whole } = this;
    this.#before = new Int32Array(count + 1);
    for (const place of chosen) this.#before[place + 1] = 1;
    for (let place = 0; place < count; place += 1) this.#before[place + 1] += this.#before[place];
    this.count = count;
    this.width = width;
    this.kept = Math.min(KEPT, (width * KEPT_SHARE) / Math.max(chosen.length, 1));
    this.least = Math.min(this.#stepFor(0, count), WIDEST);
    this.most = Math.max(this.least, CLOSEST);
    this.look(this.left, whole ? 0 : this.step);
  }

  get whole() {
    return this.count === 0 || this.step <= this.least;
  }

  /**
   * Show the bars from a place on with so many pixels each, or as near to that as there are bars.
   * @param {number} left
   * @param {number} step
   */
  look(left, step) {
    this.step = Math.min(Math.max(step, this.least), this.most);
    const last = this.#placeAt(this.#lengthTo(this.count) - this.width);
    this.left = Math.min(Math.max(left, 0), Math.max(last, 0));
    this.#start = this.#lengthTo(this.left);
  }

  /**
   * Show a place at a point of the screen.
   * @param {number} place
   * @param {number} x
   * @param {number} [step]
   */
  hold(place, x, step = this.step) {
    this.step = Math.min(Math.max(step, this.least), this.most);
    this.look(this.#placeAt(this.#lengthTo(place) - x), this.step);
  }

  /**
   * Show what lies between two places; where the zoom ends, one end stays: the first, or with `last` the other.
   * @param {number} from
   * @param {number} to
   * @param {boolean} [last]
   */
  frame(from, to, last) {
    const step = this.#stepFor(from, to);
    if (last) this.hold(to, this.width, step);
    else this.hold(from, 0, step);
  }

  /** @param {number} place */
  xOf(place) {
    return this.#lengthTo(place) - this.#start;
  }

  /**
   * The place at a point of the screen, with its fraction.
   * @param {number} x
   */
  placeOf(x) {
    return this.#placeAt(this.#start + x);
  }

  /** Pixels a chosen bar. */
  get chosenWidth() {
    return Math.max(this.step, this.kept);
  }

  /**
   * The step at which the bars between two places fill the width.
   * @param {number} from
   * @param {number} to
   */
  #stepFor(from, to) {
    const chosen = this.#chosenBefore(to) - this.#chosenBefore(from);
    const even = this.width / Math.max(to - from, 1e-6);
    if (even >= this.kept || to - from <= chosen) return even;
    return (this.width - chosen * this.kept) / (to - from - chosen);
  }

  /** @param {number} place */
  #chosenBefore(place) {
    const whole = Math.min(Math.max(Math.floor(place), 0), this.count);
    const chosen = this.#before[whole];
    return whole < this.count ? chosen + (place - whole) * (this.#before[whole + 1] - chosen) : chosen;
  }

  /**
   * Pixels from the first bar to a place.
   * @param {number} place
   */
  #lengthTo(place) {
    return place * this.step + this.#chosenBefore(place) * (this.chosenWidth - this.step);
  }

  /** @param {number} length */
  #placeAt(length) {
    let [low, high] = [0, this.count];
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (this.#lengthTo(middle) <= length) low = middle;
      else high = middle - 1;
    }
    const wide = low < this.count && this.#before[low + 1] > this.#before[low];
    return low + (length - this.#lengthTo(low)) / (wide ? this.chosenWidth : this.step || 1);
  }
}
