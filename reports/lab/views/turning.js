// SPDX-License-Identifier: GPL-3.0-or-later
// Pointers on a picture. One drags; two come nearer, or shift; the wheel comes
// nearer. All of it goes to `act`, in shares of the picture's height.

// act: { press(point, event), drag(dx, dy, event), drop(),
// click(point, event), zoom(factor), shift(dx, dy) }.
export function pointers(element, act) {
  const down = new Map(); // pointer -> where it is
  let began = null, moved = false, wheel = 0;
  const box = () => element.getBoundingClientRect();
  const pointOf = (e) => {
    const { left, top, width, height } = box();
    return { x: (e.clientX - left) / width, y: (e.clientY - top) / height };
  };
  const spread = () => {
    const [p, q] = [...down.values()];
    return { far: Math.hypot(p.x - q.x, p.y - q.y) || 1,
      x: (p.x + q.x) / 2, y: (p.y + q.y) / 2 };
  };

  element.addEventListener("pointerdown", (e) => {
    if (e.button > 0 && e.button !== 2) return;
    try {
      element.setPointerCapture(e.pointerId);
    } catch { /* a pointer that is gone already */ }
    down.set(e.pointerId, { x: e.clientX, y: e.clientY });
    if (down.size === 1) {
      began = { x: e.clientX, y: e.clientY };
      moved = false;
      act.press(pointOf(e), e);
    }
  });
  element.addEventListener("pointermove", (e) => {
    const last = down.get(e.pointerId);
    if (!last) return;
    const height = box().height || 1;
    if (down.size === 2) {
      const before = spread();
      down.set(e.pointerId, { x: e.clientX, y: e.clientY });
      const after = spread();
      moved = true;
      act.zoom(before.far / after.far);
      return act.shift((after.x - before.x) / height, (after.y - before.y) / height);
    }
    if (!moved && Math.hypot(e.clientX - began.x, e.clientY - began.y) < 4) return;
    moved = true;
    down.set(e.pointerId, { x: e.clientX, y: e.clientY });
    act.drag((e.clientX - last.x) / height, (e.clientY - last.y) / height, e);
  });
  const up = (e) => {
    if (!down.delete(e.pointerId) || down.size) return;
    if (!moved && e.type === "pointerup") act.click(pointOf(e), e);
    act.drop();
  };
  element.addEventListener("pointerup", up);
  element.addEventListener("pointercancel", up);
  element.addEventListener("contextmenu", (e) => e.preventDefault());
  element.addEventListener("wheel", (e) => {
    e.preventDefault();
    act.zoom(Math.exp(Math.max(-0.5, Math.min(0.5, e.deltaY / 500))));
    clearTimeout(wheel);
    wheel = setTimeout(act.drop, 250);
  }, { passive: false });
}
