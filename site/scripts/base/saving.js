// Files for the reader, made in the browser.

/**
 * Hand something to the reader as a file.
 * @param {string} name
 * @param {Blob} content
 */
export function saveFile(name, content) {
  const address = URL.createObjectURL(content);
  const link = document.createElement("a");
  link.href = address;
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(address), 10000);
}

/**
 * A name for a file that every system takes.
 * @param {...string} words
 */
export function fileName(...words) {
  return words
    .map((word) =>
      word
        .normalize("NFKD")
        .replace(/[^\p{L}\p{N}]+/gu, "-")
        .replace(/^-|-$/g, "")
        .slice(0, 60)
        .toLowerCase(),
    )
    .filter((word) => word !== "")
    .join("-");
}

/**
 * A text as XML can hold it: control characters and halves of characters have no place there, however they are written.
 * @param {string} text
 */
export function xmlText(text) {
  return text.toWellFormed().replace(/[^\t\n\r\u0020-\uD7FF\uE000-\uFFFD\u{10000}-\u{10FFFF}]/gu, "\uFFFD");
}
