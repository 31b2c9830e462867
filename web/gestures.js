// Moves and zooms the plan by a mouse, fingers, the wheel and keys, and tells it what is touched.

export class Gestures {
  constructor(plan) {
    this.plan = plan;
    this.pointers = new Map();
    this.moved = false;
    this.listen(plan.canvas);
  }

  listen(canvas) {
    const at = (event) => {
      const box = canvas.getBoundingClientRect();
      return [event.clientX - box.left, event.clientY - box.top];
    };
    canvas.addEventListener('pointerdown', (event) => {
      canvas.setPointerCapture(event.pointerId);
      this.pointers.set(event.pointerId, at(event));
      this.moved = this.pointers.size > 1;
    });
    canvas.addEventListener('pointermove', (event) => this.drag(event.pointerId, at(event)));
    canvas.addEventListener('pointerup', (event) => {
      const isTouch = this.pointers.size === 1 && !this.moved;
      this.pointers.delete(event.pointerId);
      if (isTouch) this.plan.touch(at(event));
    });
    canvas.addEventListener('pointercancel', (event) => this.pointers.delete(event.pointerId));
    canvas.addEventListener('wheel', (event) => {
      event.preventDefault();
      this.plan.zoom(Math.exp(-event.deltaY * 0.0015), at(event));
    }, { passive: false });
    canvas.addEventListener('keydown', (event) => this.key(event));
  }

  drag(id, now) {
    const before = this.pointers.get(id), { scale } = this.plan;
    if (!before) return;
    const others = [...this.pointers].filter(([other]) => other !== id).map(([, point]) => point);
    if (others.length > 0) {
      const [other] = others;
      const spread = (point) => Math.hypot(point[0] - other[0], point[1] - other[1]);
      if (spread(before) > 0) this.plan.zoom(spread(now) / spread(before), other);
    } else if (this.moved || Math.hypot(now[0] - before[0], now[1] - before[1]) > 4) {
      this.moved = true;
      this.plan.move([(before[0] - now[0]) / scale, (now[1] - before[1]) / scale]);
    } else {
      return;
    }
    this.pointers.set(id, now);
  }

  key(event) {
    const step = 60 / this.plan.scale;
    const moves = { ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, step], ArrowDown: [0, -step] };
    if (moves[event.key]) this.plan.move(moves[event.key]);
    else if (event.key === '+' || event.key === '=') this.plan.zoom(1.25);
    else if (event.key === '-') this.plan.zoom(0.8);
    else if (event.key === '0') this.plan.showAll();
    else return;
    event.preventDefault();
  }
}
