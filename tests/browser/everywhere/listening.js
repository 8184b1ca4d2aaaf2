// Keeps what a browser complains of while a page is open, before anything of the page runs.

(() => {
  const complaints = [];
  window.complaints = complaints;
  for (const level of ["warn", "error", "assert"]) {
    const say = console[level];
    console[level] = (...words) => {
      if (level !== "assert" || !words[0]) complaints.push(`${level}: ${words.join(" ")}`);
      say.apply(console, words);
    };
  }
  window.addEventListener("unhandledrejection", ({ reason }) => complaints.push(`rejected: ${reason}`));
  document.addEventListener("securitypolicyviolation", ({ effectiveDirective, blockedURI }) =>
    complaints.push(`refused: ${effectiveDirective} ${blockedURI}`),
  );
  // An error that does not bubble is heard on its way down: of a file that is not there.
  window.addEventListener(
    "error",
    ({ message, target }) => {
      const address = target.src ?? target.href?.baseVal ?? target.href;
      if (message || address) complaints.push(message ?? `not found: ${address}`);
    },
    true,
  );
})();
