// The eye of the view in 3D: it looks at a point from a distance, and turns around it. Metres and radians; z is up.

const multiplied = (a, b) => { // of 4 x 4 matrices by columns
  const product = new Float32Array(16);
  for (let column = 0; column < 4; ++column)
    for (let row = 0; row < 4; ++row)
      for (let i = 0; i < 4; ++i) product[4 * column + row] += a[4 * i + row] * b[4 * column + i];
  return product;
};

export class Orbit {
  constructor() {
    this.middle = [0, 0, 0];
    this.distance = 10;
    this.turn = -0.7; // about z
    this.rise = 0.9; // above the floor
  }

  rotate(dx, dy) {
    this.turn -= dx * 0.008;
    this.rise = Math.min(1.57, Math.max(0.05, this.rise + dy * 0.008));
  }

  /** Moves over the floor by pixels of a view of that height. */
  move(dx, dy, height) {
    const scale = this.distance / height, sine = Math.sin(this.turn), cosine = Math.cos(this.turn);
    this.middle[0] += (-dx * cosine + dy * -sine) * scale;
    this.middle[1] += (-dx * sine + dy * cosine) * scale;
  }

  zoom(factor) {
    this.distance = Math.min(1000, Math.max(0.5, this.distance / factor));
  }

  /** From the map to the screen, for a width divided by a height. */
  matrix(aspect) {
    const focal = 1.5, near = this.distance / 50, far = this.distance * 20;
    const perspective = new Float32Array([focal / Math.max(aspect, 1), 0, 0, 0, 0, focal * Math.min(aspect, 1), 0, 0,
      0, 0, (far + near) / (near - far), -1, 0, 0, (2 * far * near) / (near - far), 0]);
    const sine = Math.sin(this.turn), cosine = Math.cos(this.turn), up = Math.sin(this.rise), along = Math.cos(this.rise);
    const right = [cosine, sine, 0], top = [-sine * up, cosine * up, along], back = [sine * along, -cosine * along, up];
    const shift = (axis) => -axis.reduce((sum, each, i) => sum + each * this.middle[i], 0);
    const look = new Float32Array([right[0], top[0], back[0], 0, right[1], top[1], back[1], 0, right[2], top[2], back[2], 0,
      shift(right), shift(top), shift(back) - this.distance, 1]);
    return multiplied(perspective, look);
  }
}
