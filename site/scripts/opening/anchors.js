// Links to a place on the same page move there and nothing else: the address holds the state of the view, which a plain
// anchor would replace.

export function watchAnchors() {
  document.addEventListener("click", (event) => {
    const link = event.target.closest("a[href^='#']");
    const place = link && !event.defaultPrevented && document.getElementById(link.hash.slice(1));
    if (!place) return;
    event.preventDefault();
    place.scrollIntoView();
    place.focus({ preventScroll: true });
  });
}
