// The tree of the scene, its processors and their local environments (RR-3008, Figure 8). Selecting an entry shows
// only that part of the scene.

class Tree {
  constructor(state) {
    this.state = state;
    this.root = byId("tree");
    this.root.addEventListener("click", (event) => this.click(event));
    this.root.addEventListener("keydown", (event) => this.key(event));
    state.onChange((names) => {
      if (names.has("run")) this.build();
      if (names.has("run") || names.has("selection")) this.mark();
    });
  }

  build() {
    const { run } = this.state;
    const scene = item("scene", 0, `${run.scene.name}: ${run.scene.patches.toLocaleString("en")} patches`);
    const processors = group(scene);
    for (let node = 0; node < run.computeNodes; node++) {
      const processor = item("processor", node, `processor ${node}`);
      const environments = group(processor);
      for (const environment of run.environmentsOf(node)) {
        const patches = run.scene.patchStarts[environment + 1] - run.scene.patchStarts[environment];
        environments.append(item("environment", environment, `environment ${environment}: ${patches} patches`));
      }
      processor.setAttribute("aria-expanded", run.computeNodes === 1);
      processors.append(processor);
    }
    scene.setAttribute("aria-expanded", true);
    this.root.replaceChildren(scene);
  }

  get items() {
    return [...this.root.querySelectorAll("[role=treeitem]")];
  }

  get visible() {
    return this.items.filter((entry) => !entry.parentElement.closest("[aria-expanded=false]"));
  }

  mark() {
    const { kind, number } = this.state.selection;
    for (const entry of this.items) {
      const isSelected = entry.dataset.kind === kind && (kind === "scene" || Number(entry.dataset.number) === number);
      entry.setAttribute("aria-selected", isSelected);
      entry.tabIndex = isSelected ? 0 : -1;
      const hidden = isSelected && entry.parentElement.closest("[aria-expanded=false]");
      if (hidden) hidden.setAttribute("aria-expanded", true);
      if (isSelected) reveal(this.root, entry.firstElementChild);
    }
  }

  click(event) {
    const entry = event.target.closest("[role=treeitem]");
    if (!entry) return;
    if (event.target.classList.contains("twig")) return toggle(entry);
    this.select(entry);
  }

  select(entry) {
    this.state.set({ selection: { kind: entry.dataset.kind, number: Number(entry.dataset.number) } });
    entry.focus({ preventScroll: true });
  }

  key(event) {
    const entry = event.target.closest("[role=treeitem]");
    const visible = this.visible;
    const at = visible.indexOf(entry);
    const open = entry?.getAttribute("aria-expanded");
    const to = {
      ArrowDown: () => visible[at + 1],
      ArrowUp: () => visible[at - 1],
      Home: () => visible[0],
      End: () => visible[visible.length - 1],
      ArrowRight: () => (open === "false" ? toggle(entry) : visible[at + 1]),
      ArrowLeft: () => (open === "true" ? toggle(entry) : entry.parentElement.closest("[role=treeitem]")),
      Enter: () => entry,
      " ": () => entry,
    }[event.key];
    if (!entry || !to) return;
    event.preventDefault();
    event.stopPropagation();
    const next = to();
    if (next) this.select(next);
  }
}

function item(kind, number, text) {
  const entry = document.createElement("li");
  entry.setAttribute("role", "treeitem");
  Object.assign(entry.dataset, { kind, number });
  const line = document.createElement("span");
  line.className = "line";
  const twig = document.createElement("span");
  twig.className = "twig";
  twig.setAttribute("aria-hidden", true);
  line.append(twig, text);
  entry.append(line);
  return entry;
}

function group(entry) {
  const list = document.createElement("ul");
  list.setAttribute("role", "group");
  entry.append(list);
  return list;
}

function toggle(entry) {
  const open = entry.getAttribute("aria-expanded");
  if (open) entry.setAttribute("aria-expanded", open === "false");
}

/** Scrolls a list, but not the page, to one of its lines. */
function reveal(list, line) {
  const [outer, inner] = [list.getBoundingClientRect(), line.getBoundingClientRect()];
  if (inner.top < outer.top) list.scrollTop -= outer.top - inner.top;
  if (inner.bottom > outer.bottom) list.scrollTop += inner.bottom - outer.bottom;
}
