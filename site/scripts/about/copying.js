// Texts that readers take along, such as a citation, beside a button that copies them.

export function watchCopying() {
  for (const button of document.querySelectorAll("button.copy")) {
    const words = button.textContent;
    button.addEventListener("click", async () => {
      const text = button.parentElement.firstElementChild;
      const copied = await copy(text);
      button.textContent = copied ? "Copied" : "Selected";
      document.getElementById("live").textContent = copied ? "Copied" : "Selected, to be copied by the keyboard";
      setTimeout(() => {
        button.textContent = words;
      }, 2000);
    });
  }
}

/**
 * Whether the browser let a page copy; if not, the text is selected, so that one press of the reader does.
 * @param {Element} node
 */
async function copy(node) {
  try {
    await navigator.clipboard.writeText(node.textContent);
    return true;
  } catch {
    window.getSelection()?.selectAllChildren(node);
    return false;
  }
}
