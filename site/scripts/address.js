// The state of the view in the address, so that a link reproduces it. Shapes and classes by name, not by number:
// a link stays good when the database grows.

const LARGEST_SELECTION = 60;

export function readAddress(model) {
  const query = new URLSearchParams(window.location.hash.slice(1));
  const method = model.methods.findIndex(({ key }) => key === query.get("map"));
  const known = (name) => query.getAll(name).map((id) => model.indexOfId.get(id)).filter((index) => index !== undefined);
  const groups = new Map(model.classes.map((name, group) => [name, group]));
  const hidden = query.getAll("hide").map((name) => groups.get(name)).filter((group) => group !== undefined);
  if (query.has("hide-unlabelled")) hidden.push(-1);
  const camera = (query.get("at") ?? "").split(",").map(Number);
  return {
    method: Math.max(method, 0),
    view: ["class", "hit", "thumbnail"].includes(query.get("view")) ? query.get("view") : "class",
    hidden: new Set(hidden),
    selection: new Set(known("select")),
    opened: known("open")[0] ?? null,
    query: query.get("find") ?? "",
    camera: camera.length === 3 && camera.every(Number.isFinite) ? { x: camera[0], y: camera[1], zoom: camera[2] } : null,
  };
}

export function writeAddress(model, state) {
  const query = new URLSearchParams();
  if (state.get("method") !== 0) query.set("map", model.methods[state.get("method")].key);
  if (state.get("view") !== "class") query.set("view", state.get("view"));
  for (const group of state.get("hidden")) {
    if (group < 0) query.set("hide-unlabelled", "");
    else query.append("hide", model.classes[group]);
  }
  if (state.get("selection").size <= LARGEST_SELECTION) {
    for (const index of state.get("selection")) query.append("select", model.ids[index]);
  }
  if (state.get("opened") !== null) query.set("open", model.ids[state.get("opened")]);
  if (state.get("query") !== "") query.set("find", state.get("query"));
  const camera = state.get("camera");
  if (camera) query.set("at", [camera.x, camera.y, camera.zoom].map((value) => Number(value.toPrecision(5))).join(","));
  const hash = query.toString();
  window.history.replaceState(null, "", hash === "" ? window.location.pathname + window.location.search : `#${hash}`);
}
