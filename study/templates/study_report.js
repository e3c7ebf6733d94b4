"use strict";

// Columns with their values, and rows of [case, numbers]; a word is the number of its place in the column's list.
const { columns, rows } = JSON.parse(document.getElementById("data").textContent);
const element = (id) => document.getElementById(id);
const words = (column) => column.values.words;
const range = (column) => words(column) ? [0, Math.max(1, words(column).length - 1)] : column.values.numbers;
const varies = (column) => words(column) ? words(column).length > 1 : range(column)[0] < range(column)[1];

// Logarithmic where all numbers are positive and spread over more than a decade and a half.
for (const column of columns) {
  const [low, high] = range(column);
  column.canBeLog = !words(column) && low > 0;
  column.isLog = column.canBeLog && high > 30 * low;
  column.kept = null;
}

// The place of a value on an axis, from 0 to 1.
const place = (column, value) => {
  const [low, high] = range(column);
  if (low === high) return 0.5;
  return column.isLog ? Math.log(value / low) / Math.log(high / low) : (value - low) / (high - low);
};
const valueAt = (column, part) => {
  const [low, high] = range(column);
  return column.isLog ? low * Math.pow(high / low, part) : low + part * (high - low);
};
const text = (column, value) => {
  if (value === null) return "none";
  if (words(column)) return words(column)[value];
  const size = Math.abs(value);
  return size !== 0 && (size < 1e-2 || size >= 1e5) ? String(Number(value.toPrecision(3)).toExponential()) : String(Number(value.toPrecision(4)));
};
const short = (letters) => letters.length > 12 ? letters.slice(0, 11) + "…" : letters;

// Columns at first: the keys that vary, and what contact problems are asked for.
const hasForce = columns.some((column) => column.is_key && column.name.startsWith("load."));
const wanted = [hasForce ? "" : "force", "penetration", "max pressure", "contact area", "contact stiffness"];
const isWanted = (column) => varies(column) && (column.is_key || wanted.some((name) => column.name.replace(/ \[.*/, "") === name));
let shown = columns.filter(isWanted).slice(0, 10);
if (shown.length < 2) shown = columns.filter(varies).slice(0, 10);
for (const column of columns.filter(varies)) {
  const label = document.createElement("label");
  const box = document.createElement("input");
  box.type = "checkbox";
  box.checked = shown.includes(column);
  box.addEventListener("change", () => {
    shown = columns.filter((other) => other === column ? box.checked : shown.includes(other));
    column.kept = null;
    show();
  });
  label.append(box, " " + column.name);
  element("shown").append(label);
}

function choose(id, at) {
  const select = element(id);
  columns.forEach((column, i) => select.append(new Option(column.name, i)));
  select.value = Math.max(0, columns.indexOf(at));
  select.addEventListener("change", show);
  return () => columns[select.value];
}
const results = shown.filter((column) => !column.is_key);
const colour = choose("colour", results.find((column) => column.name.startsWith("penetration")) ?? shown[shown.length - 1]);
const across = choose("across", shown.find((column) => column.is_key) ?? shown[0]);
const up = choose("up", results.find((column) => column.name.startsWith("penetration")) ?? results[0] ?? shown[1]);

// Words take colours that the colour-blind tell apart (Okabe and Ito), numbers a part of viridis.
const palette = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#1e1e1e", "#999999"];
const viridis = [[68, 1, 84], [59, 82, 139], [33, 145, 140], [94, 201, 98], [220, 210, 50]];
function colourOf(column, value) {
  if (value === null) return "#999999";
  if (words(column)) return palette[value % palette.length];
  const at = Math.min(1, Math.max(0, place(column, value))) * (viridis.length - 1);
  const i = Math.min(viridis.length - 2, Math.floor(at));
  const mixed = viridis[i].map((low, k) => Math.round(low + (at - i) * (viridis[i + 1][k] - low)));
  return `rgb(${mixed.join(",")})`;
}

const indices = new Map(columns.map((column, i) => [column, i]));
const value = (row, column) => row[1][indices.get(column)];
const isKept = (row) => shown.every((column) => {
  if (!column.kept) return true;
  const found = value(row, column);
  if (found === null) return false;
  const at = place(column, found);
  return at >= column.kept[0] && at <= column.kept[1];
});

// A canvas in the pixels of the screen; drawing is in those of the page.
function begin(id, ratio) {
  const canvas = element(id);
  const width = canvas.clientWidth, height = Math.round(width * ratio), scale = window.devicePixelRatio || 1;
  canvas.width = width * scale;
  canvas.height = height * scale;
  const pen = canvas.getContext("2d");
  pen.setTransform(scale, 0, 0, scale, 0, 0);
  pen.font = "12px 'DejaVu Sans', Verdana, sans-serif";
  pen.fillStyle = "#1e1e1e";
  return { pen, width, height };
}

const top_ = 64, bottom = 30, left = 70, right = 70;
let axes = [];

function drawParallel(kept, others) {
  const { pen, width, height } = begin("parallel", 0.45);
  const gap = shown.length > 1 ? (width - left - right) / (shown.length - 1) : 0;
  axes = shown.map((column, i) => ({ column, x: left + i * gap, top: top_, bottom: height - bottom }));
  const y = (axis, found) => axis.bottom - place(axis.column, found) * (axis.bottom - axis.top);
  const draw = (row) => {
    pen.beginPath();
    let isOn = false;
    for (const axis of axes) {
      const found = value(row, axis.column);
      if (found === null) { isOn = false; continue; }
      if (isOn) pen.lineTo(axis.x, y(axis, found)); else pen.moveTo(axis.x, y(axis, found));
      isOn = true;
    }
    pen.stroke();
  };
  pen.lineWidth = 1;
  pen.globalAlpha = others.length > 500 ? 0.1 : 0.3;
  pen.strokeStyle = "#bbbbbb";
  others.forEach(draw);
  pen.globalAlpha = Math.min(0.9, Math.max(0.12, 150 / kept.length));
  for (const row of kept) {
    pen.strokeStyle = colourOf(colour(), value(row, colour()));
    draw(row);
  }
  pen.globalAlpha = 1;
  axes.forEach((axis, i) => drawAxis(pen, axis, i, y));
}

function drawAxis(pen, axis, i, y) {
  const { column, x } = axis;
  pen.strokeStyle = "#1e1e1e";
  pen.beginPath();
  pen.moveTo(x, axis.top);
  pen.lineTo(x, axis.bottom);
  pen.stroke();
  if (column.kept) {
    const [from, to] = column.kept.map((part) => axis.bottom - part * (axis.bottom - axis.top));
    pen.fillStyle = "#0072b240";
    pen.fillRect(x - 6, to, 12, from - to);
    pen.strokeStyle = "#0072b2";
    pen.strokeRect(x - 6, to, 12, from - to);
  }
  pen.fillStyle = "#1e1e1e";
  pen.textAlign = "center";
  // Neighbours at two heights, so that long names have room.
  const line = i % 2 ? 36 : 14;
  const name = column.name + (column.isLog ? " (log)" : "");
  const room = Math.min(2 * x, 2 * (pen.canvas.clientWidth - x));
  const fits = (letters) => pen.measureText(letters).width <= room;
  let letters = name;
  while (letters.length > 4 && !fits(letters)) letters = "…" + letters.slice(2);
  pen.fillText(letters, x, line);
  for (const at of ticks(column)) {
    const label = short(text(column, at));
    pen.lineWidth = 3;
    pen.strokeStyle = "#ffffffd0";
    pen.textAlign = "left";
    pen.strokeText(label, x + 6, y(axis, at) + 4);
    pen.fillText(label, x + 6, y(axis, at) + 4);
    pen.lineWidth = 1;
    pen.strokeStyle = "#1e1e1e";
    pen.beginPath();
    pen.moveTo(x - 3, y(axis, at));
    pen.lineTo(x + 3, y(axis, at));
    pen.stroke();
  }
}

// Places and ends of an axis that have labels.
function ticks(column) {
  const [low, high] = range(column);
  if (words(column)) {
    const every = Math.ceil(words(column).length / 12);
    return words(column).map((_, i) => i).filter((i) => i % every === 0);
  }
  if (low === high) return [low];
  return [0, 0.25, 0.5, 0.75, 1].map((part) => valueAt(column, part));
}

let points = [];

function drawScatter(kept) {
  const { pen, width, height } = begin("scatter", 0.5);
  const [a, b] = [across(), up()];
  const x = (found) => 90 + place(a, found) * (width - 130);
  const y = (found) => height - 50 - place(b, found) * (height - 90);
  pen.strokeStyle = "#1e1e1e";
  pen.strokeRect(80, 30, width - 110, height - 70);
  pen.textAlign = "center";
  for (const at of ticks(a)) pen.fillText(short(text(a, at)), x(at), height - 24);
  pen.fillText(a.name + (a.isLog ? " (log)" : ""), width / 2, height - 6);
  pen.textAlign = "right";
  for (const at of ticks(b)) pen.fillText(short(text(b, at)), 74, y(at) + 4);
  pen.textAlign = "left";
  pen.fillText(b.name + (b.isLog ? " (log)" : ""), 80, 20);
  points = [];
  pen.globalAlpha = kept.length > 1000 ? 0.5 : 0.85;
  for (const row of kept) {
    const [i, j] = [value(row, a), value(row, b)];
    if (i === null || j === null) continue;
    points.push([x(i), y(j), row]);
    pen.fillStyle = colourOf(colour(), value(row, colour()));
    pen.beginPath();
    pen.arc(x(i), y(j), kept.length > 1000 ? 2 : 3.5, 0, 2 * Math.PI);
    pen.fill();
  }
  pen.globalAlpha = 1;
}

function show() {
  const kept = rows.filter(isKept);
  const others = rows.filter((row) => !isKept(row));
  drawParallel(kept, others);
  drawScatter(kept);
  element("selected").textContent = `${kept.length} of ${rows.length} rows`;
}

const parallel = element("parallel");
const pointer = (event) => {
  const box = event.target.getBoundingClientRect();
  return [event.clientX - box.left, event.clientY - box.top];
};
const part = (axis, y) => Math.min(1, Math.max(0, (axis.bottom - y) / (axis.bottom - axis.top)));
let drag = null;
parallel.addEventListener("pointerdown", (event) => {
  const [x, y] = pointer(event);
  const nearest = axes.reduce((a, b) => Math.abs(a.x - x) <= Math.abs(b.x - x) ? a : b);
  if (y < top_ - 16) {
    nearest.column.isLog = nearest.column.canBeLog && !nearest.column.isLog;
    nearest.column.kept = null;
    show();
    return;
  }
  parallel.setPointerCapture(event.pointerId);
  drag = { axis: nearest, from: part(nearest, y) };
  nearest.column.kept = null;
  show();
});
parallel.addEventListener("pointermove", (event) => {
  if (!drag) return;
  const to = part(drag.axis, pointer(event)[1]);
  const isDrag = Math.abs(to - drag.from) > 0.01;
  drag.axis.column.kept = isDrag ? [Math.min(drag.from, to), Math.max(drag.from, to)] : null;
  requestAnimationFrame(show);
});
parallel.addEventListener("pointerup", () => { drag = null; });

element("scatter").addEventListener("pointermove", (event) => {
  const [x, y] = pointer(event);
  let best = null, distance = 400;
  for (const point of points) {
    const d = (point[0] - x) ** 2 + (point[1] - y) ** 2;
    if (d < distance) { distance = d; best = point[2]; }
  }
  const cells = (row) => [...new Set([...columns.filter((column) => column.is_key), across(), up()])]
    .map((column) => `${column.name}: ${text(column, value(row, column))}`);
  element("nearest").textContent = best ? `case ${best[0]}; ${cells(best).join("; ")}` : "";
});
window.addEventListener("resize", show);
show();
