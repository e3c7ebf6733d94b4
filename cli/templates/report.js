"use strict";

// Drawings: drag to move, buttons or the wheel (once the figure has the focus) to zoom, double click to go back.
for (const figure of document.querySelectorAll("figure.drawing")) {
  const svg = figure.querySelector("svg");
  const whole = svg.getAttribute("viewBox").split(" ").map(Number);
  let view = [...whole];
  const show = () => svg.setAttribute("viewBox", view.join(" "));
  const reset = () => { view = [...whole]; show(); };
  const zoom = (factor, fx = 0.5, fy = 0.5) => {
    const width = Math.min(whole[2], Math.max(whole[2] / 60, view[2] / factor));
    const height = width * whole[3] / whole[2];
    view = [view[0] + fx * (view[2] - width), view[1] + fy * (view[3] - height), width, height];
    show();
  };
  const move = (dx, dy) => {
    const pixel = view[2] / svg.clientWidth;
    view[0] -= dx * pixel;
    view[1] -= dy * pixel;
    show();
  };
  control(figure, svg, { zoom, move, reset });
}

// Surfaces: drag or arrow keys to turn, zoom as above.
for (const figure of document.querySelectorAll("figure.surface")) {
  const canvas = figure.querySelector("canvas");
  const surface = read(figure.dataset);
  const standard = { turn: 0.61, rise: 0.5, size: 1 };
  let view = { ...standard };
  let waiting = false;
  const show = () => {
    if (waiting) return;
    waiting = true;
    requestAnimationFrame(() => { waiting = false; draw(canvas, surface, view); });
  };
  const reset = () => { view = { ...standard }; show(); };
  const zoom = (factor) => { view.size = Math.min(8, Math.max(0.5, view.size * factor)); show(); };
  const move = (dx, dy) => {
    view.turn += dx * 0.008;
    view.rise = Math.min(Math.PI / 2, Math.max(0.05, view.rise + dy * 0.006));
    show();
  };
  control(figure, canvas, { zoom, move, reset });
  show();
}

function control(figure, target, { zoom, move, reset }) {
  target.addEventListener("pointerdown", (event) => {
    target.setPointerCapture(event.pointerId);
    figure.focus({ preventScroll: true });
  });
  target.addEventListener("pointermove", (event) => {
    if (target.hasPointerCapture(event.pointerId)) move(event.movementX, event.movementY);
  });
  target.addEventListener("dblclick", reset);
  figure.addEventListener("wheel", (event) => {
    if (document.activeElement !== figure) return;
    event.preventDefault();
    const box = target.getBoundingClientRect();
    const fx = (event.clientX - box.left) / box.width, fy = (event.clientY - box.top) / box.height;
    zoom(Math.exp(-event.deltaY * 0.0015), fx, fy);
  }, { passive: false });
  const step = { ArrowLeft: [-30, 0], ArrowRight: [30, 0], ArrowUp: [0, -30], ArrowDown: [0, 30] };
  figure.addEventListener("keydown", (event) => {
    if (step[event.key]) { event.preventDefault(); move(...step[event.key]); }
    if (event.key === "+") zoom(1.25);
    if (event.key === "-") zoom(0.8);
    if (event.key === "0") reset();
  });
  const act = { in: () => zoom(1.4), out: () => zoom(1 / 1.4), whole: reset };
  for (const button of figure.querySelectorAll(".tools button")) {
    button.addEventListener("click", act[button.dataset.act]);
  }
}

// Cells in rows along y: 0 is bare, 1 is relief without pressure, 2 to 65535 is a pressure up to the largest.
function read({ cells, values, palette, labels }) {
  const bytes = (text) => Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  const raw = bytes(values), colours = bytes(palette), n = Number(cells);
  const heights = new Float32Array(n * n), fills = [[], [], []];
  for (let e = 0; e < n * n; e++) {
    const value = raw[2 * e] | (raw[2 * e + 1] << 8);
    heights[e] = value > 1 ? (value - 1) / 65534 : 0;
    const shade = 3 * Math.round(255 * heights[e]);
    const colour = value > 1 ? colours.subarray(shade, shade + 3) : value === 1 ? [222, 222, 222] : null;
    [1, 0.88, 0.74].forEach((light, side) => {
      fills[side].push(colour && `rgb(${Array.from(colour, (c) => Math.round(c * light))})`);
    });
  }
  return { n, heights, fills, labels: JSON.parse(labels) };
}

function draw(canvas, { n, heights, fills, labels }, { turn, rise, size }) {
  const pen = canvas.getContext("2d");
  const { width, height } = canvas;
  pen.fillStyle = "#fff";
  pen.fillRect(0, 0, width, height);
  const [sin, cos, up, flat] = [Math.sin(turn), Math.cos(turn), Math.cos(rise), Math.sin(rise)];
  const unit = 0.29 * width * size, tall = 0.32 * width * size;
  const at = (x, y, z) => [
    width / 2 + unit * (x * cos - y * sin),
    0.6 * height - unit * flat * (x * sin + y * cos) - tall * up * (z - 0.15),
  ];
  const path = (points) => {
    pen.beginPath();
    points.forEach((point) => pen.lineTo(...at(...point)));
    pen.closePath();
  };
  const face = (points, fill) => {
    path(points);
    pen.fillStyle = pen.strokeStyle = fill;
    pen.fill();
    pen.stroke();
  };
  const floor = [[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]];
  pen.lineWidth = 2;
  path(floor);
  pen.strokeStyle = "#1e1e1e";
  pen.stroke();
  pen.lineWidth = 0.6;
  face(floor, "#fafafa");
  // Columns far from the eye are drawn first; only the two sides that face it are seen.
  const order = (towards) => Array.from({ length: n }, (_, i) => (towards ? i : n - 1 - i));
  const [xs, ys] = [order(sin < 0), order(cos < 0)];
  const [di, dj] = [sin < 0 ? 1 : -1, cos < 0 ? 1 : -1];
  const end = (i) => 2 * i / n - 1;
  const seen = (i, j) => (i >= 0 && j >= 0 && i < n && j < n ? heights[i * n + j] : 0);
  for (const i of xs) for (const j of ys) {
    const e = i * n + j, z = heights[e];
    if (!fills[0][e]) continue;
    const [x0, x1, y0, y1] = [end(i), end(i + 1), end(j), end(j + 1)];
    const [low, front] = [seen(i + di, j), seen(i, j + dj)];
    const x = di > 0 ? x1 : x0, y = dj > 0 ? y1 : y0;
    if (low < z) face([[x, y0, low], [x, y1, low], [x, y1, z], [x, y0, z]], fills[2][e]);
    if (front < z) face([[x0, y, front], [x1, y, front], [x1, y, z], [x0, y, z]], fills[1][e]);
    face([[x0, y0, z], [x1, y0, z], [x1, y1, z], [x0, y1, z]], fills[0][e]);
  }
  pen.lineWidth = 1.5;
  pen.strokeStyle = "#1e1e1e";
  // The upright axis stands at the corner farthest to the left, where nothing is before it.
  const corners = [[-1, -1], [1, -1], [1, 1], [-1, 1]];
  const [cx, cy] = corners.reduce((a, b) => (at(...b, 0)[0] < at(...a, 0)[0] ? b : a));
  path([[cx, cy, 0], [cx, cy, 1]]);
  pen.stroke();
  pen.fillStyle = "#1e1e1e";
  pen.font = `${Math.round(width / 55)}px "DejaVu Sans", Verdana, sans-serif`;
  pen.textAlign = "center";
  pen.textBaseline = "middle";
  const word = (text, ...point) => pen.fillText(text, ...at(...point));
  const fx = sin < 0 ? 1 : -1, fy = cos < 0 ? 1 : -1;
  word(labels.x[0], -0.86, 1.1 * fy, 0);
  word(labels.x[1], 0.86, 1.1 * fy, 0);
  word(labels.x[2], 0, 1.22 * fy, 0);
  word(labels.y[0], 1.12 * fx, -0.86, 0);
  word(labels.y[1], 1.12 * fx, 0.86, 0);
  word(labels.y[2], 1.24 * fx, 0, 0);
  const [px, py] = at(cx, cy, 1);
  pen.fillText(labels.p, Math.max(px, pen.measureText(labels.p).width / 2 + 6), py - width / 45);
}

// One loading step at a time.
const choice = document.querySelector("#choice");
if (choice) {
  const steps = [...document.querySelectorAll("section.step")];
  const show = () => steps.forEach((step) => { step.hidden = step.id !== choice.value; });
  choice.addEventListener("change", show);
  show();
}
