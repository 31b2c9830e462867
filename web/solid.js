// The map in 3D: points, surfaces, the way of the robot, names, and a box around what is chosen.
import { Orbit } from './orbit.js';
import { writeNames } from './solidNames.js';

const VERTEX = `#version 300 es
in vec3 position; in vec3 colour; uniform mat4 screen; uniform float size; out vec3 shown; out vec3 place;
void main() { gl_Position = screen * vec4(position, 1.0); gl_PointSize = size; shown = colour; place = position; }`;
const FRAGMENT = `#version 300 es
precision highp float; in vec3 shown; in vec3 place; uniform float shade; out vec4 pixel;
void main() {
  vec3 normal = normalize(cross(dFdx(place), dFdy(place)) + vec3(0.0, 0.0, 1e-9));
  float light = mix(1.0, 0.6 + 0.4 * abs(dot(normal, normalize(vec3(0.3, 0.5, 0.8)))), shade);
  pixel = vec4(shown * light, 1.0);
}`;

export class Solid {
  /** `names` is a canvas above the view, for names. */
  constructor(canvas, names) {
    this.canvas = canvas;
    this.nameCanvas = names;
    this.names = [];
    this.orbit = new Orbit();
    this.parts = [];
    this.pointers = new Map();
    this.gl = canvas.getContext('webgl2', { antialias: true });
    if (!this.gl) throw new Error('This browser has no WebGL 2, which the view in 3D needs.');
    this.program = this.compile();
    this.listen();
    new ResizeObserver(() => this.draw()).observe(canvas);
  }

  compile() {
    const { gl } = this, program = gl.createProgram();
    for (const [type, text] of [[gl.VERTEX_SHADER, VERTEX], [gl.FRAGMENT_SHADER, FRAGMENT]]) {
      const shader = gl.createShader(type);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
    return program;
  }

  /** `points` and `surfaces` as readPly() has them, or null; `walk` is a list of x, y; `names` as namesOf() has them. */
  show(points, surfaces, walk, names) {
    const { gl } = this;
    this.names = names;
    for (const part of this.parts) part.buffers.forEach((buffer) => gl.deleteBuffer(buffer));
    this.parts = [];
    if (surfaces) this.add('surfaces', gl.TRIANGLES, surfaces);
    if (points) this.add('points', gl.POINTS, points);
    this.add('walk', gl.LINE_STRIP, line(walk.map(([x, y]) => [x, y, 0.05]), [60, 120, 240]));
    this.draw();
  }

  /** Shows a box, {min, max} [m], in place of the one before; null for none. */
  choose(box) {
    this.parts = this.parts.filter((part) => part.name !== 'chosen');
    if (box) {
      this.add('chosen', this.gl.LINES, line(edgesOf(box), [220, 38, 38]));
      this.orbit.middle = box.min.map((each, i) => (each + box.max[i]) / 2);
    }
    this.draw();
  }

  add(name, mode, { positions, colours, indices }) {
    const { gl } = this;
    const bufferOf = (target, data) => {
      const buffer = gl.createBuffer();
      gl.bindBuffer(target, buffer);
      gl.bufferData(target, data, gl.STATIC_DRAW);
      return buffer;
    };
    const buffers = [bufferOf(gl.ARRAY_BUFFER, positions), bufferOf(gl.ARRAY_BUFFER, colours)];
    if (indices?.length) buffers.push(bufferOf(gl.ELEMENT_ARRAY_BUFFER, indices));
    this.parts.push({ name, mode, buffers, count: indices?.length || positions.length / 3 });
  }

  /** Looks at all of a box [least x, least y, most x, most y]. */
  showAll([x0, y0, x1, y1]) {
    this.orbit.middle = [(x0 + x1) / 2, (y0 + y1) / 2, 0.8];
    this.orbit.distance = Math.max(2, 0.75 * Math.hypot(x1 - x0, y1 - y0));
    this.draw();
  }

  zoom(factor) {
    this.orbit.zoom(factor);
    this.draw();
  }

  draw() {
    if (this.frame) return;
    this.frame = requestAnimationFrame(() => {
      this.frame = 0;
      this.paint();
    });
  }

  paint() {
    const { gl, canvas, program } = this, ratio = window.devicePixelRatio || 1;
    canvas.width = Math.max(1, canvas.clientWidth * ratio);
    canvas.height = Math.max(1, canvas.clientHeight * ratio);
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    gl.useProgram(program);
    const screen = this.orbit.matrix(canvas.width / canvas.height);
    gl.uniformMatrix4fv(gl.getUniformLocation(program, 'screen'), false, screen);
    gl.uniform1f(gl.getUniformLocation(program, 'size'), 2 * ratio);
    for (const part of this.parts) this.paintPart(part);
    writeNames(this.nameCanvas, this.names, screen);
  }

  paintPart({ mode, buffers: [positions, colours, indices], count }) {
    const { gl, program } = this;
    const attribute = (name, buffer, type, isNormalized) => {
      const place = gl.getAttribLocation(program, name);
      gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
      gl.enableVertexAttribArray(place);
      gl.vertexAttribPointer(place, 3, type, isNormalized, 0, 0);
    };
    attribute('position', positions, gl.FLOAT, false);
    attribute('colour', colours, gl.UNSIGNED_BYTE, true);
    gl.uniform1f(gl.getUniformLocation(program, 'shade'), mode === gl.TRIANGLES ? 1 : 0);
    if (!indices) return gl.drawArrays(mode, 0, count);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, indices);
    gl.drawElements(mode, count, gl.UNSIGNED_INT, 0);
  }

  listen() {
    const { canvas } = this;
    canvas.addEventListener('pointerdown', (event) => {
      canvas.setPointerCapture(event.pointerId);
      this.pointers.set(event.pointerId, [event.clientX, event.clientY]);
    });
    canvas.addEventListener('pointermove', (event) => this.drag(event));
    for (const end of ['pointerup', 'pointercancel'])
      canvas.addEventListener(end, (event) => this.pointers.delete(event.pointerId));
    canvas.addEventListener('wheel', (event) => {
      event.preventDefault();
      this.zoom(Math.exp(-event.deltaY * 0.0015));
    }, { passive: false });
    canvas.addEventListener('keydown', (event) => this.key(event));
  }

  drag(event) {
    const before = this.pointers.get(event.pointerId);
    if (!before) return;
    const now = [event.clientX, event.clientY], other = [...this.pointers].find(([id]) => id !== event.pointerId)?.[1];
    const dx = now[0] - before[0], dy = now[1] - before[1];
    if (other) {
      const spread = ([x, y]) => Math.hypot(x - other[0], y - other[1]);
      if (spread(before) > 0) this.orbit.zoom(spread(now) / spread(before));
      this.orbit.move(dx / 2, dy / 2, this.canvas.clientHeight);
    } else if (event.shiftKey || event.buttons === 2) {
      this.orbit.move(dx, dy, this.canvas.clientHeight);
    } else {
      this.orbit.rotate(dx, dy);
    }
    this.pointers.set(event.pointerId, now);
    this.draw();
  }

  key(event) {
    const turns = { ArrowLeft: [20, 0], ArrowRight: [-20, 0], ArrowUp: [0, 15], ArrowDown: [0, -15] };
    if (turns[event.key]) this.orbit.rotate(...turns[event.key]);
    else if (event.key === '+') this.orbit.zoom(1.3);
    else if (event.key === '-') this.orbit.zoom(1 / 1.3);
    else return;
    event.preventDefault();
    this.draw();
  }
}

function line(points, colour) {
  return { positions: new Float32Array(points.flat()), colours: new Uint8Array(points.flatMap(() => colour)) };
}

function edgesOf({ min, max }) {
  const corner = (i) => [0, 1, 2].map((axis) => ((i >> axis) & 1 ? max : min)[axis]);
  const edges = [];
  for (let i = 0; i < 8; ++i)
    for (const axis of [1, 2, 4]) if (!(i & axis)) edges.push(corner(i), corner(i | axis));
  return edges;
}
