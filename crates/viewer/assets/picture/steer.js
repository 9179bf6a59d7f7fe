// Moves the camera by pointer, wheel and keys.

/** Moves the camera of a panel. */
function steer(panel) {
  const { canvas } = panel;
  const fingers = new Map();
  let [apart, moved] = [0, 0];
  const spread = () => {
    const [a, b] = [...fingers.values()];
    return Math.hypot(a.x - b.x, a.y - b.y);
  };
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    moved = 0;
    if (fingers.size === 2) apart = spread();
  });
  canvas.addEventListener("pointermove", (event) => {
    const finger = fingers.get(event.pointerId);
    if (!finger || !panel.camera) return;
    const [dx, dy] = [event.clientX - finger.x, event.clientY - finger.y];
    moved += Math.abs(dx) + Math.abs(dy);
    Object.assign(finger, { x: event.clientX, y: event.clientY });
    if (fingers.size === 2) {
      const now = spread();
      panel.camera.zoom(apart / now);
      apart = now;
    } else if (event.shiftKey || event.buttons & 2) {
      panel.camera.step(dy / 40, -dx / 40);
    } else {
      panel.camera.turn(dx / 200, dy / 200);
    }
    panel.redraw();
  });
  const lift = (event) => {
    fingers.delete(event.pointerId);
    const box = canvas.getBoundingClientRect();
    if (event.type === "pointerup" && moved < 4 && panel.picture) {
      panel.ask(event.clientX - box.left, event.clientY - box.top);
    }
  };
  canvas.addEventListener("pointerup", lift);
  canvas.addEventListener("pointercancel", lift);
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener("wheel", (event) => {
    if (!panel.camera || !(event.ctrlKey || document.activeElement === canvas)) return;
    event.preventDefault();
    panel.camera.zoom(Math.exp(event.deltaY / 500));
    panel.redraw();
  }, { passive: false });
  canvas.addEventListener("keydown", (event) => {
    if (panel.camera && moveByKey(panel.camera, event)) {
      event.preventDefault();
      panel.redraw();
    }
  });
}

function moveByKey(camera, event) {
  if (event.ctrlKey || event.metaKey || event.altKey) return false;
  const turns = { ArrowLeft: [0.06, 0], ArrowRight: [-0.06, 0], ArrowUp: [0, 0.06], ArrowDown: [0, -0.06] };
  const steps = { w: [1, 0, 0], s: [-1, 0, 0], a: [0, -1, 0], d: [0, 1, 0], q: [0, 0, -1], e: [0, 0, 1] };
  const zooms = { "+": 0.9, "=": 0.9, "-": 1.1 };
  const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
  if (turns[key]) camera.turn(...turns[key]);
  else if (steps[key]) camera.step(...steps[key]);
  else if (zooms[key]) camera.zoom(zooms[key]);
  else return false;
  return true;
}
