// A field that finds as one types, with a list to choose from below it: bins by name, shapes by name.

import { element } from "./dom.js";
import { grouped } from "./words.js";

/** @import { Children } from "./dom.js" */

const MOST = 12;

/**
 * @template Value
 * @typedef {object} Finding
 * @property {(text: string) => Value[]} find best first
 * @property {(value: Value) => Children} label the content of a line
 * @property {(value: Value) => void} choose is told of the chosen one
 * @property {() => Promise<unknown>} [prepare] brings what else can be found, when the reader comes to the field
 * @property {() => string} [none] what is said where nothing is found
 */

/** @template Value */
export class Finder {
  /**
   * @param {string} field id of the field
   * @param {string} list id of the list below it
   * @param {Finding<Value>} finding
   */
  constructor(field, list, { find, label, choose, prepare = async () => {}, none = () => "none found" }) {
    this.find = find;
    this.prepare = prepare;
    this.label = label;
    this.choose = choose;
    this.none = none;
    this.field = document.getElementById(field);
    this.list = document.getElementById(list);
    /** @type {Value[]} */
    this.found = [];
    this.at = 0;
    this.more = 0;
    for (const [key, value] of Object.entries({
      role: "combobox",
      "aria-autocomplete": "list",
      "aria-controls": this.list.id,
      "aria-expanded": "false",
    })) {
      this.field.setAttribute(key, value);
    }
    this.field.addEventListener("input", () => this.#look());
    this.field.addEventListener("focus", () => this.#look());
    this.field.addEventListener("blur", () => this.#close());
    this.field.addEventListener("keydown", (event) => this.#key(event));
    // A press would take the focus, and with it the list.
    this.list.addEventListener("pointerdown", (event) => event.preventDefault());
    this.list.addEventListener("click", (event) => {
      const line = event.target.closest("li[data-place]");
      if (line) this.#choose(Number(line.dataset.place));
    });
  }

  /** Whether all that can be found is there. */
  #prepared = false;

  /** @type {Promise<void> | null} */
  #preparing = null;

  async #bring() {
    await this.prepare();
    this.#prepared = true;
    // What has come may be what the reader looks for.
    if (!this.list.hidden) this.#look(this.found[this.at]);
  }

  /** @param {Value} [held] is chosen by Enter if it is found, else the first */
  #look(held) {
    this.#preparing ??= this.#bring();
    const text = this.field.value.trim();
    if (text === "") {
      this.#close();
      return;
    }
    const all = this.find(text);
    this.found = all.slice(0, MOST);
    this.at = held === undefined ? 0 : Math.max(this.found.indexOf(held), 0);
    this.more = all.length - this.found.length;
    this.#render();
    this.list.scrollIntoView({ block: "nearest" });
  }

  #render() {
    const lines = this.found.map((value, place) =>
      element(
        "li",
        {
          role: "option",
          id: `${this.list.id}-${place}`,
          "data-place": place,
          "aria-selected": String(place === this.at),
        },
        this.label(value),
      ),
    );
    const none = this.#prepared ? this.none() : "searching …";
    const rest = this.found.length === 0 ? none : this.more > 0 ? `and ${grouped(this.more)} more` : null;
    this.list.replaceChildren(
      ...lines,
      ...(rest ? [element("li", { class: "quiet", role: "presentation" }, rest)] : []),
    );
    this.list.hidden = false;
    this.field.setAttribute("aria-expanded", "true");
    if (this.found.length > 0) this.field.setAttribute("aria-activedescendant", `${this.list.id}-${this.at}`);
    else this.field.removeAttribute("aria-activedescendant");
  }

  #close() {
    this.list.hidden = true;
    this.found = [];
    this.field.setAttribute("aria-expanded", "false");
    this.field.removeAttribute("aria-activedescendant");
  }

  /** @param {number} place */
  #choose(place) {
    const value = this.found[place];
    if (value === undefined) return;
    this.field.value = "";
    this.#close();
    this.choose(value);
  }

  /** @param {KeyboardEvent} event */
  #key(event) {
    const open = this.found.length > 0;
    if (event.key === "Enter") this.#choose(this.at);
    else if (event.key === "Escape" && !this.list.hidden) {
      this.#close();
      // One press takes back one thing.
      event.stopPropagation();
    } else if (open && (event.key === "ArrowDown" || event.key === "ArrowUp")) {
      this.at = (this.at + (event.key === "ArrowDown" ? 1 : this.found.length - 1)) % this.found.length;
      this.#render();
      this.list.children[this.at].scrollIntoView({ block: "nearest" });
    } else return;
    event.preventDefault();
  }
}
