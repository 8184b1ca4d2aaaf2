// Random numbers that a seed decides, the same in every browser.

export class Random {
  /** @param {number} seed a whole number */
  constructor(seed) {
    this.state = Math.imul(seed, 0x9e3779b1) ^ 0x5bf03635;
  }

  /** A whole number below 2^32: a counter in Weyl steps, its bits mixed by multiplications and shifts. */
  next() {
    this.state = (this.state + 0x9e3779b9) | 0;
    let bits = this.state;
    bits = Math.imul(bits ^ (bits >>> 16), 0x21f0aaad);
    bits = Math.imul(bits ^ (bits >>> 15), 0x735a2d97);
    return (bits ^ (bits >>> 15)) >>> 0;
  }

  /** Evenly from [0, 1). */
  uniform() {
    return this.next() / 4294967296;
  }

  /**
   * A whole number from 0 to count - 1.
   * @param {number} count
   */
  below(count) {
    return Math.floor(this.uniform() * count);
  }

  /** From the standard normal distribution (Box and Muller). */
  normal() {
    return Math.sqrt(-2 * Math.log(1 - this.uniform())) * Math.cos(2 * Math.PI * this.uniform());
  }
}
