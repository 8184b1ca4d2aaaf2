// The owner's introduction, whole, where the Overview shows its beginning.

export function watchIntroduction() {
  const dialog = document.getElementById("introduction");
  if (!dialog) return;
  document.getElementById("open-introduction").addEventListener("click", () => {
    dialog.showModal();
    dialog.scrollTop = 0;
  });
  dialog.addEventListener("click", (event) => {
    if (event.target === dialog || event.target.closest("button")) dialog.close();
  });
}
