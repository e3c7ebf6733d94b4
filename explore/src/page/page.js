"use strict";

// Elements per side while a slider moves; at rest the case's own.
const SKETCH = 64;
// Milliseconds without a movement after which the hand rests.
const REST = 300;
// Positions of a slider.
const POSITIONS = 400;

const $ = (id) => document.getElementById(id);
const page = Array.from(crypto.getRandomValues(new Uint32Array(4)), (n) => n.toString(36)).join("");
let form, name, text, values, structure;
let edits = [], changes = 0;         // changes that no answer contains yet, each with its number
let shown = null, pinned = null;     // the last good result; the one to compare with
let fault = null, step = null, drawnStep = null;
let waiting = null, wanted = null, requests = 0, resting = 0, began = 0;

function make(tag, properties = {}, ...children) {
  const made = document.createElement(tag);
  for (const [key, value] of Object.entries(properties)) {
    if (key in made) made[key] = value;
    else made.setAttribute(key, value);
  }
  made.append(...children);
  return made;
}

// A sentence in parts: what stands between two grave accents is code.
function withCode(sentence) {
  const part = (text, place) => (place % 2 ? make("code", {}, text) : text);
  return sentence.split(/`([^`]*)`/).map(part);
}

// ---- Requests: one sketch at a time, so that each is shown; a newer request stops one with all elements.

function change(made, isSketch = false) {
  for (const edit of [made].flat()) {
    const last = edits.at(-1);
    if (last && last.do === edit.do && last.key === edit.key && "to" in edit) edits.pop();
    edits.push({ ...edit, number: ++changes });
  }
  began = performance.now();
  clearTimeout(resting);
  if (isSketch) resting = setTimeout(() => ask(false), REST);
  ask(isSketch);
}

function ask(isSketch) {
  wanted = { isSketch };
  if (!isSketch) clearTimeout(resting);
  if (waiting && waiting.isSketch) return;
  send();
}

async function send() {
  const sent = { ...wanted, changes };
  waiting = sent;
  wanted = null;
  document.body.dataset.busy = "true";
  const body = { page, number: ++requests, name, text, edits: edits.map(({ number, ...edit }) => edit), step };
  if (sent.isSketch) body.elements = SKETCH;
  let answer;
  try {
    const response = await fetch("solve", { method: "POST", body: JSON.stringify(body) });
    if (!response.ok) throw new Error(await response.text());
    answer = await response.json();
  } catch (error) {
    answer = { error: { sentence: `no answer: ${error.message}` } };
  }
  if (waiting !== sent) return;
  waiting = null;
  receive(answer, sent);
  if (wanted) send();
  else delete document.body.dataset.busy;
}

function receive(answer, sent) {
  if (answer.superseded) return;
  if (answer.text !== undefined) {
    text = answer.text;
    values = answer.values ?? values;
    edits = edits.filter((edit) => edit.number > sent.changes);
    // A page that is loaded again goes on from here.
    sessionStorage.setItem(location.pathname, JSON.stringify({ name, text }));
  }
  fault = answer.error ?? null;
  if (answer.result) shown = answer.result;
  showForm();
  show();
  const counts = document.body.dataset;
  counts.answers = Number(counts.answers ?? 0) + 1;
  counts.milliseconds = performance.now() - began;
}

// ---- The fields, from the declarations.

const below = (path, key) => (path ? `${path}.${key}` : key);
const words = (key) => key.replaceAll("_", " ");
const isTable = (value) => value !== null && typeof value === "object" && !Array.isArray(value);

// The form is made anew only if its fields change, so that the one with the focus stays.
function showForm() {
  const shape = (value) => (isTable(value)
    ? Object.fromEntries(Object.entries(value).map(([key, inner]) => [key, key === "kind" ? inner : shape(inner)]))
    : Array.isArray(value) ? (value.some(isTable) ? value.map(shape) : 0) : typeof value === "string" ? Number(isWord(value)) : 0);
  const now = JSON.stringify(shape(values));
  if (now !== structure) {
    const [focus, open] = [document.activeElement?.id, [...document.querySelectorAll("details[open]")].map((of) => of.id)];
    structure = now;
    $("form").replaceChildren(...tableFields(form, "", values));
    for (const id of open) if ($(id)) $(id).open = true;
    if (focus) document.getElementById(focus)?.focus();
  }
  for (const field of document.querySelectorAll("[data-path]")) field.update?.();
  showFault();
}

const isWord = (value) => !/^\s*[-+.\d]/.test(value);

function at(path) {
  return path.split(/[.[\]]+/).filter(Boolean).reduce((value, key) => value?.[key], values);
}

function tableFields(shape, path, value) {
  const fields = [], further = [];
  for (const field of shape.fields) {
    const key = below(path, field.key), own = value?.[field.key];
    const isAlternative = shape.one_of.includes(field.key) && shape.one_of.some((key) => value?.[key] !== undefined);
    const isFree = field.missing !== null || isAlternative || shape.together.includes(field.key);
    const isShown = own !== undefined || !isFree || field.is === "kinds" || value === undefined && path !== "";
    (isShown ? fields : further).push(fieldOf(field, key, own, { shape, path, isFree }));
  }
  if (further.length) {
    const id = `further-${path}`;
    fields.push(make("details", { id }, make("summary", {}, path ? "further keys" : "further tables"), ...further));
  }
  return fields;
}

function fieldOf(field, path, value, around) {
  const label = words(field.key), { isFree } = around;
  const alternatives = around.shape.one_of.filter((key) => key !== field.key);
  const isAlternative = around.shape.one_of.includes(field.key);
  const remove = isFree && value !== undefined && !isAlternative
    ? button("remove", () => change({ do: "remove", key: path }), `remove ${label}`) : "";
  if (isAlternative && value === undefined && isFree) {
    return row(field, path, button(`by ${label}`, () => alternative(around, field, alternatives)));
  }
  const variant = variantOf(field, value);
  if (variant.is === "list" && variant.item.is === "table") return layers(field, variant, path, value);
  if (variant.is === "kinds") return kinds(field, variant, path, value, remove);
  if (variant.is === "table") {
    const add = value === undefined && button("add", () => change({ do: "table", key: path }), `add ${label}`);
    // A table that needs nothing begins with the first key that is given.
    if (add && variant.fields.some((of) => of.missing === null)) return row(field, path, add);
    return group([label, choice(field, variant, path, value), add || remove], field.meaning, path, ...tableFields(variant, path, value));
  }
  const input = inputOf(field, variant, path);
  const chosen = choice(field, variant, path, value);
  return chosen && variant.is === "words" ? row(field, path, chosen) : row(field, path, ...input, ...(chosen ? [chosen] : []));
}

// Of several shapes the one that a value has.
function variantOf(field, value) {
  if (field.is !== "either") return field;
  const fits = (shape) => (Array.isArray(value) ? shape.is === "list"
    : isTable(value) ? ["table", "kinds"].includes(shape.is)
      : typeof value === "string" && isWord(value) ? shape.is === "words"
        : ["quantity", "number", "count", "text"].includes(shape.is));
  return field.of.find(fits) ?? field.of[0];
}

// A choice between the shapes of a value.
function choice(field, variant, path, value) {
  if (field.is !== "either" || value === undefined && field.missing !== null && !field.of.some((of) => of.is === "words")) return "";
  const options = [];
  for (const shape of field.of) {
    if (shape.is === "words") for (const word of shape.words) options.push([word, { do: "word", key: path, to: word }, value === word]);
    else if (["table", "kinds"].includes(shape.is)) options.push([`by ${words(shape.fields?.[0].key ?? shape.choice)}`, { do: "table", key: path }, shape === variant]);
    else options.push([{ list: "a list", count: "a number" }[shape.is] ?? "one value", { do: "set", key: path, to: shape.is === "list" ? `["${shape.item.example ?? ""}"]` : shape.example ?? "64" }, shape === variant]);
  }
  if (value === undefined) options.unshift([field.missing ?? "", null, true]);
  const select = make("select", { id: `kind-${path}`, className: "variant", ariaLabel: `what ${words(field.key)} is` },
    ...options.map(([title, , selected]) => make("option", { selected }, title)));
  select.addEventListener("change", () => options[select.selectedIndex][1] && change(options[select.selectedIndex][1]));
  return select;
}

// Another key in place of the one given: with the value of the last result, if it has one.
function alternative({ shape, path }, field, others) {
  const given = others.find((key) => at(below(path, key)) !== undefined);
  const plural = field.key.endsWith("s"), one = plural ? field.key.slice(0, -1) : field.key;
  const number = shown?.steps.at(-1).numbers.find((number) => [one, `nominal_${one}`].includes(number.key));
  const unit = shown && { force: "N", penetration: "m", pressure: "Pa" }[one];
  const isBare = number && !shown.steps[0].numbers.some((number) => number.unit === unit);
  const value = (part) => (number ? `${Number((number.value * part).toPrecision(4))}${isBare ? "" : ` ${unit}`}` : field.example ?? "1");
  const quoted = (text) => (/[a-z]/i.test(text.replace(/e[-+]?\d+$/i, "")) ? JSON.stringify(text) : text);
  const to = plural ? `{ from = ${quoted(value(0.1))}, to = ${quoted(value(1))}, count = 8 }` : value(1);
  change([{ do: "remove", key: below(path, given) }, { do: "set", key: below(path, field.key), to }]);
}

function group(heads, meaning, path, ...children) {
  const [legend, told] = [make("legend", { title: meaning }), make("p", { className: "fault", hidden: true })];
  legend.append(...heads.filter(Boolean).flatMap((head) => [head, " "]));
  return make("fieldset", { "data-path": path }, legend, told, ...children);
}

function row(field, path, ...inputs) {
  let label = make("label", { htmlFor: inputs.find((input) => input.id)?.id ?? "", title: field.meaning }, words(field.key));
  if (inputs.length > 1 && inputs.at(-1).className === "variant") label = make("span", {}, label, " ", inputs.pop());
  const broad = inputs.length === 1 && inputs[0].tagName === "INPUT" && ["list", "text"].includes(field.is) ? " broad" : "";
  return make("div", { className: `field${broad}`, "data-path": path }, label, ...inputs, make("p", { className: "fault", hidden: true }));
}

function button(title, act, label = title) {
  const made = make("button", { type: "button", className: "small", ariaLabel: label }, title);
  made.addEventListener("click", act);
  return made;
}

function kinds(field, variant, path, value, remove) {
  const kind = value?.[variant.choice] ?? variant.default;
  const own = variant.kinds.find((of) => of.word === kind);
  const select = make("select", { id: `kind-${path}`, ariaLabel: `kind of ${words(field.key)}` },
    ...(own ? [] : [make("option", { selected: true }, "")]),
    ...variant.kinds.filter((of) => of.word !== "function").map((of) => make("option", { selected: of.word === kind, value: of.word, title: of.meaning }, of.word)));
  select.addEventListener("change", () => change({ do: "kind", key: path, to: select.value }));
  const fields = own && value ? tableFields(joined(own, variant.shared), path, value) : [];
  return group([words(field.key), select, remove], field.meaning, path, ...fields);
}

const joined = (own, shared) => ({
  fields: [...own.fields, ...shared.fields], one_of: [...own.one_of, ...shared.one_of], together: [...own.together, ...shared.together],
});

function layers(field, variant, path, value) {
  const tables = (value ?? []).map((layer, i) => {
    const where = value.length === 1 ? "" : i === 0 ? ", the top" : i === value.length - 1 ? ", the lowest" : "";
    const key = `${path}[${i}]`;
    const remove = button("remove", () => change({ do: "remove", key }), `remove ${field.key} ${i + 1}`);
    return group([`${words(field.key)} ${i + 1}${where}`, remove], field.meaning, key, ...tableFields(variant.item, key, layer));
  });
  return make("div", { "data-path": path }, button(`add a ${words(field.key)} on top`, () => change({ do: "add", key: path })), ...tables);
}

// ---- The input of one value, with a slider if it is a number.

function inputOf(field, variant, path) {
  const missing = (field.missing ?? "").replaceAll('"', "");
  if (variant.is === "words" || variant.is === "switch") {
    const options = variant.words ?? ["true", "false"];
    const input = make("select", { id: `at-${path}` }, make("option", { value: "" }, missing || "choose"), ...options.map((word) => make("option", { value: word }, word)));
    input.addEventListener("change", () => change(input.value === "" ? { do: "remove", key: path } : { do: variant.is === "words" ? "word" : "set", key: path, to: input.value }));
    input.update = () => { input.value = String(at(path) ?? ""); };
    input.dataset.path = "";
    return [input];
  }
  const input = make("input", { id: `at-${path}`, type: "text", placeholder: missing, title: missing && `if empty: ${missing}` });
  input.dataset.path = "";
  let isTyped = false;
  input.update = () => { if (!isTyped) input.value = written(at(path)); };
  input.addEventListener("input", () => { isTyped = true; });
  input.addEventListener("change", () => {
    isTyped = false;
    const to = input.value.trim();
    if (to === "") change({ do: "remove", key: path });
    else change({ do: variant.is === "text" ? "word" : "set", key: path, to });
  });
  if (!["quantity", "number", "count"].includes(variant.is)) return [input];
  return [input, slider(variant, path, input)];
}

const written = (value) => (value === undefined ? "" : typeof value === "string" ? value : JSON.stringify(value));

const parsed = (value) => {
  const found = /^\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?)(\s*)(.*)$/i.exec(String(value ?? ""));
  return found && { number: Number(found[1]), gap: found[2], unit: found[3] };
};

function slider(variant, path, input) {
  const bar = make("input", { type: "range", min: 0, max: POSITIONS, step: 1, id: `slide-${path}`, ariaLabel: `${words(path)}, slider`, hidden: true });
  let scale = null;
  bar.dataset.path = "";
  bar.update = (again = false) => {
    const value = parsed(at(path));
    if (again || !scale || !value || value.unit !== scale.unit || !(value.number >= scale.from && value.number <= scale.to)) scale = value && scaleOf(variant, value);
    bar.hidden = !scale;
    if (!scale) return;
    if (document.activeElement !== bar || again) bar.value = Math.round(POSITIONS * place(scale, value.number));
    bar.setAttribute("aria-valuetext", written(at(path)));
  };
  const to = () => {
    const part = bar.value / POSITIONS;
    const number = scale.isLog ? scale.from * (scale.to / scale.from) ** part : scale.from + (scale.to - scale.from) * part;
    const short = variant.is === "count" ? Math.max(1, Math.round(number)) : Number(number.toPrecision(4));
    return `${short}${scale.gap}${scale.unit}`;
  };
  bar.addEventListener("input", () => { input.value = to(); change({ do: "set", key: path, to: input.value }, true); });
  bar.addEventListener("change", () => { if ([0, POSITIONS].includes(Number(bar.value))) bar.atEnd = true; });
  bar.addEventListener("blur", () => { if (bar.atEnd) bar.update(true); bar.atEnd = false; });
  return bar;
}

const place = (scale, number) => (scale.isLog ? Math.log(number / scale.from) / Math.log(scale.to / scale.from) : (number - scale.from) / (scale.to - scale.from));

// From the declared range, or around the value: logarithmic over what is positive or spans decades.
function scaleOf(variant, { number, gap, unit }) {
  const isLog = (from, to) => from > 0 && to / from >= 50;
  const scale = (from, to) => (from < to ? { from, to, gap, unit, isLog: isLog(from, to) } : null);
  if (variant.is === "count") return scale(Math.max(variant.from, number / 8, 4), Math.min(variant.to, number * 8));
  if (variant.from !== undefined) return scale(variant.from, variant.to);
  if (variant.angle) return scale(0, /^(deg|°)/.test(unit) ? 90 : Math.PI / 2);
  if (number === 0) return null;
  if (variant.sign === "positive") return scale(number / 10, number * 10);
  return number > 0 ? scale(0, 2 * number) : scale(2 * number, 0);
}

// ---- The error at its field; the last good result stays, greyed.

function showFault() {
  for (const place of document.querySelectorAll("#form .fault")) place.hidden = true;
  for (const input of document.querySelectorAll("[aria-invalid]")) input.removeAttribute("aria-invalid");
  document.body.classList.toggle("stale", fault !== null);
  $("error").hidden = !fault;
  if (!fault) return;
  const sentence = [fault.sentence, fault.help].filter(Boolean).join("; ");
  $("error").textContent = fault.key ? `${fault.key}: ${sentence}` : fault.line ? `line ${fault.line}: ${sentence}` : sentence;
  let path = (fault.key ?? "").replaceAll(/\.(\d+)/g, "[$1]");
  while (path) {
    const place = document.querySelector(`#form [data-path="${CSS.escape(path)}"]`);
    const told = place?.querySelector(":scope > .fault");
    if (told) {
      told.textContent = sentence;
      told.hidden = false;
      for (let box = told.closest("details"); box; box = box.parentElement.closest("details")) box.open = true;
      place.querySelector(":scope > input, :scope > select")?.setAttribute("aria-invalid", "true");
      return;
    }
    path = path.replace(/(\.[^.[]*|\[\d+\]|^[^.[]*)$/, "");
  }
}

// ---- The result.

function show() {
  if (document.activeElement !== $("toml")) $("toml").value = text;
  $("stress").setAttribute("aria-pressed", values?.stress !== undefined);
  $("stress").textContent = values?.stress === undefined ? "Stresses" : "Without stresses";
  if (!shown) return;
  document.title = $("title").textContent = shown.title;
  document.body.dataset.elements = shown.elements;
  document.body.dataset.sketch = shown.is_sketch;
  const { numbers, stresses, mark } = shown.steps[shown.step] ?? { numbers: [] };
  $("state").replaceChildren(
    shown.is_sketch ? make("span", { className: "sketch" }, "sketch, ") : "", `N = ${shown.elements}: ${shown.grid}; ${(1000 * shown.seconds).toFixed(0)} ms`);
  $("mark").hidden = !mark;
  $("mark").textContent = mark ? `${mark}: do not use these numbers.` : "";
  $("warnings").hidden = shown.warnings.length === 0;
  $("warnings").replaceChildren(...shown.warnings.map((of) => make("li", { "data-code": of.code }, ...withCode(of.message))));
  $("strip").replaceChildren(...["force", "penetration", "max_pressure", "contact_radius"].flatMap((key) => {
    const number = numbers.find((of) => of.key === key);
    return number ? [make("span", {}, make("b", {}, `${number.symbol || number.name} `), number.text)] : [];
  }));
  showSteps();
  const then = pinned && (pinned.steps[Math.min(shown.step, pinned.steps.length - 1)] ?? null);
  rows($("numbers"), ["quantity", "value", "± of the grid"], numbers, then?.numbers, (of) => [`${of.name} ${of.symbol}`.trim(), of.meaning]);
  $("inside").hidden = !stresses;
  if (stresses) rows($("stresses"), ["where", "value", "± of the grid"], stresses, then?.stresses, (of) => [`${of.place}: ${of.name}`, `at ${of.at}`], ["at", "used"]);
  $("critical").replaceChildren(...shown.critical.map((line) => make("li", {}, line)));
  if (shown.pictures) draw(shown.pictures);
}

function showSteps() {
  $("steps").hidden = shown.steps.length < 2;
  if ($("steps").hidden || document.activeElement === $("step")) return;
  $("step").replaceChildren(...shown.steps.map((of, i) =>
    make("option", { value: i, selected: i === shown.step }, `${i}: Q = ${of.numbers.find((number) => number.key === "force")?.text}`)));
}

function rows(table, heads, all, then, titles, more = []) {
  const past = pinned ? [`pinned, N = ${pinned.elements}`, "change"] : [];
  table.tHead.replaceChildren(make("tr", {}, ...[...heads, ...past, ...more].map((head) => make("th", { className: past.includes(head) ? "pinned" : "" }, head))));
  const line = (of) => {
    const [title, hint] = titles(of), old = then?.find((other) => other.key === of.key);
    const cells = [make("th", { title: hint }, title),
      make("td", { className: "number", "data-key": of.key, "data-value": JSON.stringify(of.value) }, of.text),
      make("td", { className: "note", "data-error": JSON.stringify(of.error) }, of.note)];
    if (pinned) cells.push(make("td", { className: "number pinned" }, old?.text ?? ""), make("td", { className: "number pinned" }, old ? changeOf(old.value, of.value) : ""));
    return make("tr", {}, ...cells, ...more.map((key) => make("td", {}, of[key])));
  };
  table.tBodies[0].replaceChildren(...all.map(line));
}

function changeOf(old, now) {
  if (typeof old !== "number" || typeof now !== "number" || old === 0) return "";
  const part = 100 * (now / old - 1);
  return part === 0 ? "0" : `${part > 0 ? "+" : "−"}${Number(Math.abs(part).toPrecision(3))} %`;
}

// ---- Pictures.

function draw({ map, pressure, section }) {
  drawMap(map);
  $("dashed").hidden = !pinned;
  const { scales } = shown;
  const lines = (of) => of && [{ ...of.pictures.pressure, name: of === pinned ? "then" : "now" }];
  plot($("pressure").querySelector("svg"), [...(pinned?.pictures ? lines(pinned) : []), ...lines(shown)], scales.length, scales.pressure, ["x", "p"]);
  $("curve").hidden = shown.steps.length < 2;
  if (!$("curve").hidden) {
    const curve = (of, name) => {
      const along = (key) => of.steps.map((step) => step.numbers.find((number) => number.key === key).value);
      return { x: along("penetration"), y: along("force"), name, dots: true };
    };
    plot($("curve").querySelector("svg"), [...(pinned?.steps.length > 1 ? [curve(pinned, "then")] : []), curve(shown, "now")], scales.penetration, scales.force, ["D", "Q"]);
  }
  if (section) $("section").innerHTML = `${section}<figcaption>Section along x. Depth is positive into the body.</figcaption>`;
  if (section) $("section").hidden = false;
  $("section").classList.toggle("past", !section);
}

const bytes = (text) => Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));

// Cells in rows along y: 0 is bare, 1 is relief without pressure, 2 to 65535 is a pressure up to the largest.
function drawMap({ cells, values: raw, palette, labels }) {
  const canvas = $("map").querySelector("canvas"), pen = canvas.getContext("2d");
  const [value, colours, image] = [bytes(raw), bytes(palette), new ImageData(cells, cells)];
  const style = getComputedStyle(document.documentElement);
  const [ground, relief] = ["--ground", "--relief"].map((key) => rgb(style.getPropertyValue(key).trim()));
  for (let i = 0; i < cells; i++) for (let j = 0; j < cells; j++) {
    const e = 2 * (i * cells + j), number = value[e] | (value[e + 1] << 8);
    const shade = 3 * Math.round(255 * (number - 2) / 65533);
    const colour = number > 1 ? colours.subarray(shade, shade + 3) : number === 1 ? relief : ground;
    image.data.set([...colour, 255], 4 * ((cells - 1 - j) * cells + i));
  }
  canvas.width = canvas.height = cells;
  pen.putImageData(image, 0, 0);
  const { x, y, p } = JSON.parse(labels);
  const stops = Array.from({ length: 9 }, (_, k) => `rgb(${colours.subarray(3 * Math.round(k * 255 / 8), 3 * Math.round(k * 255 / 8) + 3).join(",")})`);
  const along = ([from, to, title]) => title.replace(",", ` from ${from} to ${to}`);
  const bar = make("span", { className: "bar", role: "img", ariaLabel: "colours of the pressure" });
  bar.style.background = `linear-gradient(to right, ${stops.join(",")})`;
  $("map").querySelector("figcaption").replaceChildren("0", bar, `${p}; ${along(x)}, ${along(y)}`);
}

const rgb = (hex) => (hex.length === 4 ? [...hex.slice(1)].map((digit) => 17 * parseInt(digit, 16)) : [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16)));

// Lines over common axes, each with a class of the style.
function plot(svg, lines, xScale, yScale, names) {
  const [left, right, top, bottom] = [64, 448, 14, 278];
  const flat = (key, scale) => lines.flatMap((line) => line[key]).filter(Number.isFinite).map((value) => value / scale.divisor);
  const range = (numbers) => [Math.min(0, ...numbers), Math.max(0, ...numbers) || 1];
  const [x0, x1] = range(flat("x", xScale)), [y0, most] = range(flat("y", yScale)), y1 = most * 1.04;
  const px = (x) => left + (right - left) * (x / xScale.divisor - x0) / (x1 - x0);
  const py = (y) => bottom - (bottom - top) * (y / yScale.divisor - y0) / (y1 - y0);
  const svgNode = (tag, attributes, content = "") => {
    const node = document.createElementNS("http://www.w3.org/2000/svg", tag);
    for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
    node.textContent = content;
    return node;
  };
  const nodes = [];
  for (const x of ticks(x0, x1, 6)) {
    const at = px(x * xScale.divisor);
    nodes.push(svgNode("line", { class: "rule", x1: at, x2: at, y1: top, y2: bottom }), svgNode("text", { x: at, y: bottom + 17, "text-anchor": "middle" }, x));
  }
  for (const y of ticks(y0, y1, 5)) {
    const at = py(y * yScale.divisor);
    nodes.push(svgNode("line", { class: "rule", x1: left, x2: right, y1: at, y2: at }), svgNode("text", { x: left - 7, y: at + 4, "text-anchor": "end" }, y));
  }
  nodes.push(svgNode("path", { class: "axis", d: `M${left} ${top}V${bottom}H${right}` }));
  const title = (name, scale) => (scale.label ? `${name} (${scale.label})` : name);
  nodes.push(svgNode("text", { x: (left + right) / 2, y: bottom + 40, "text-anchor": "middle" }, title(names[0], xScale)));
  nodes.push(svgNode("text", { x: 15, y: (top + bottom) / 2, "text-anchor": "middle", transform: `rotate(-90 15 ${(top + bottom) / 2})` }, title(names[1], yScale)));
  for (const { x, y, name, dots } of lines) {
    nodes.push(svgNode("polyline", { class: name, points: x.map((at, i) => `${px(at).toFixed(2)},${py(y[i]).toFixed(2)}`).join(" ") }));
    if (dots) x.forEach((at, i) => nodes.push(svgNode("circle", { class: name, r: 3, cx: px(at), cy: py(y[i]) })));
  }
  svg.replaceChildren(...nodes);
}

function ticks(from, to, most) {
  const rough = (to - from) / most, power = 10 ** Math.floor(Math.log10(rough));
  const step = power * [1, 2, 5, 10].find((factor) => factor * power >= rough);
  const found = [];
  for (let k = Math.ceil(from / step - 1e-9); k * step <= to + 1e-9 * step; k++) found.push(Number((k * step).toPrecision(12)));
  return found;
}

// ---- The page itself.

function start(template) {
  ({ name, text } = template);
  structure = undefined;
  $("chooser").hidden = true;
  $("explorer").hidden = false;
  $("title").textContent = name;
  $("command").textContent = `pellicle run ${/\s/.test(name) ? `"${name}"` : name}`;
  began = performance.now();
  ask(false);
}

function listen() {
  $("form").addEventListener("submit", (event) => event.preventDefault());
  $("other").addEventListener("click", () => { sessionStorage.clear(); location.reload(); });
  $("pin").addEventListener("click", () => { pinned = shown; $("unpin").hidden = false; show(); });
  $("unpin").addEventListener("click", () => { pinned = null; $("unpin").hidden = true; show(); });
  $("stress").addEventListener("click", () => change({ do: values?.stress === undefined ? "table" : "remove", key: "stress" }));
  $("step").addEventListener("change", () => { step = Number($("step").value); ask(false); });
  $("toml").addEventListener("change", () => { text = $("toml").value; edits = []; changes++; ask(false); });
  $("copy").addEventListener("click", () => navigator.clipboard.writeText(text));
  $("download").addEventListener("click", () => {
    const href = URL.createObjectURL(new Blob([text], { type: "application/toml" }));
    make("a", { href, download: name.split(/[/\\]/).at(-1) }).click();
    URL.revokeObjectURL(href);
  });
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", show);
  // The open connection tells the program that the page is there.
  const open = new EventSource("open");
  open.addEventListener("error", () => { $("ended").hidden = false; });
  open.addEventListener("open", () => { $("ended").hidden = true; });
}

async function begin() {
  listen();
  const found = await (await fetch("form")).json();
  form = found.form;
  $("other").hidden = Boolean(found.case);
  const left = JSON.parse(sessionStorage.getItem(location.pathname));
  if (left ?? found.case) return start(left ?? found.case);
  $("templates").append(...found.templates.map((template) => {
    const choose = make("button", { type: "button" }, make("b", {}, template.name.replace(/\.toml$/, "")), make("span", {}, template.meaning));
    choose.addEventListener("click", () => start(template));
    return make("li", {}, choose);
  }));
  $("chooser").hidden = false;
}

begin();
