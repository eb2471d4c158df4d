// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The page: set-up, run, plot, SPI by hand.
"use strict";

const NS_PER_M = 5.3;
const MAX_POINTS = 1000, TABLE_ROWS = 8, LOG_LINES = 50;
const BUDGET_MS = 12, REFRESH_MS = 250;
const NUMBERS = ["bits", "cable"];  // fields of the set-up that hold a number
const KEYS = {data_bits: "bits", cable_m: "cable"};  // those of a scenario
const USUAL = {master: "ic-mb4", encoder: "resolute-26", bits: 26, movement: "sine", cable: 10, ma: 10 * MHZ,
               pace: 0, fault: "silent"};
const TITLES = {"biss-c": "BiSS C", "biss-b": "BiSS B", ssi: "SSI"};

const $ = (id) => document.getElementById(id);
const html = (name, properties = {}, ...children) => {
  const element = Object.assign(document.createElement(name), properties);
  element.append(...children);
  return element;
};

let chip, registers, view, diagram, plot;
let columns = [];       // of the words of the open master
let presets = new Map();
let setup = null;       // of the open chip
let running = false;
let levels = {};        // of the lines after the last frame
let lead = null;        // of the last frame: its start after the read began, and its length, ns
let replay = null;      // a frame that is being shown slowly
let pending = null;  // the animation frame that will call tick()
let counts = {good: 0, bad: 0};
let points = {};        // the arrays of the plot
let lastRefresh = 0;
let rate = {since: 0, clocks: 0};

function problem(text) {
  $("problem").hidden = text === "";
  $("problem").textContent = text;
}

// A line for the user.
function say(text, bad) {
  $("said").textContent = text;
  $("said").classList.toggle("bad", Boolean(bad));
}

// --- set-up ----------------------------------------------------------------------------------

function encoderOf(setup) {
  const preset = presets.get(setup.encoder);
  return {...preset, data_bits: preset.data_bits || setup.bits};
}

function scenario(setup) {
  const encoder = encoderOf(setup), {clkHz, sclkHz} = MASTERS[setup.master];
  const positions = 2n ** BigInt(encoder.data_bits - encoder.flag_bits);
  const lines = [
    ...(setup.master === USUAL.master ? [] : ["[master]", `type = "${setup.master}"`, ""]),
    "[chip]", `f_clk_hz = ${clkHz}`, "",
    "[host]", ...(sclkHz ? [`sclk_hz = ${sclkHz}`] : []), `ma_hz = ${setup.ma}`, "",
    "[[channel]]", "number = 1", `cable_m = ${setup.cable}`, "",
    "[[channel.slave]]", `protocol = "${encoder.protocol}"`, `preset = "${encoder.name}"`];
  if (presets.get(setup.encoder).data_bits === 0) lines.push(`data_bits = ${setup.bits}`);
  if (setup.movement === "sine") {
    lines.push('source = "sine"', `amplitude = ${least(positions / 4n)}`,
               `offset = ${least(positions / 2n)}`, "period_us = 20000");
  } else {
    lines.push('source = "ramp"', `start = ${least(positions / 3n)}`,
               `step = ${setup.movement === "ramp" ? least(positions / 300n + 1n) : 0}`);
  }
  return lines.join("\n") + "\n";
}

// A number that TOML and the simulator take.
function least(value) {
  const most = 4n * 10n ** 18n;
  return value < most ? value : most;
}

function readControls() {
  return {master: $("master").value, encoder: $("encoder").value, bits: Number($("bits").value),
          movement: $("movement").value, cable: Number($("cable").value), ma: Number($("frequency").value), ...readChoices()};
}

// What a link keeps besides the set-up of the chip.
function readChoices() {
  return {pace: Number($("pace").value), fault: $("fault-kind").value};
}

// Offers what a master can make and read. Returns what it does not have of what was chosen; "":
// nothing.
function offer(master) {
  const {name, maHz, clkHz} = MASTERS[master];
  const chosen = $("frequency").value, text = $("frequency").selectedOptions[0]?.textContent, lost = [];
  $("frequency").replaceChildren(...(maHz ?? chip.frequencies(clkHz)).map((hz) => {
    const textContent = hz >= MHZ ? `${+(hz / MHZ).toFixed(3)} MHz` : `${+(hz / 1e3).toFixed(2)} kHz`;
    return html("option", {value: hz, textContent});
  }));
  $("frequency").value = chosen;
  if ($("frequency").selectedIndex < 0) {
    $("frequency").selectedIndex = 0;
    lost.push(`${name} does not make ${text} from its clock`);
  }
  for (const option of $("encoder").options) {
    option.title = master === USUAL.master ? "" : reason(chip.refuses(master, option.value));
    option.disabled = option.title !== "";
  }
  const [encoder] = $("encoder").selectedOptions;
  if (encoder?.disabled) {
    lost.push(`${encoder.textContent}: ${encoder.title}`);
    $("encoder").value = USUAL.encoder;
  }
  return lost.join("; ");
}

// An error of a scenario without its place.
function reason(error) {
  return error.replace(/^.*?: key '\w+': /, "").replace(/ \(in \[.*\]\)$/, "");
}

function showControls(setup) {
  $("master").value = setup.master;
  offer(setup.master);
  $("encoder").value = setup.encoder;
  $("bits-label").hidden = presets.get(setup.encoder).data_bits !== 0;
  $("bits").value = setup.bits;
  $("movement").value = setup.movement;
  $("cable").value = setup.cable;
  $("frequency").value = setup.ma;
  $("pace").value = setup.pace;
  $("fault-kind").value = setup.fault;
  for (const name of NUMBERS) mark($(name), "");
}

// Marks the numbers that cannot be used. Returns whether there are none.
function numbersAreGood(wanted) {
  let good = true;
  for (const name of NUMBERS) {
    const asked = name !== "bits" || presets.get(wanted.encoder).data_bits === 0;
    const wrong = asked ? wrongNumber($(name)) : "";
    mark($(name), wrong && `${wrong}; the chip keeps ${setup[name]}`);
    good &&= wrong === "";
  }
  return good;
}

// The address and the field with the link name the open chip and what is chosen now.
function showLink() {
  history.replaceState(null, "", fragment({...setup, ...readChoices()}));
  $("link").value = location.href;
}

function fragment(setup) {
  const {master, bits, ...rest} = setup;
  return "#" + new URLSearchParams({...(master === USUAL.master ? {} : {master}), ...rest,
                                    ...(presets.get(setup.encoder).data_bits === 0 ? {bits} : {})});
}

// The set-up of a link; what it does not name is as in `otherwise`. Throws for what the page does
// not know.
function fromFragment(text, otherwise) {
  const found = {...otherwise}, given = new URLSearchParams(text.replace(/^#/, ""));
  const master = given.get("master") ?? otherwise.master;
  if (Object.hasOwn(MASTERS, master)) offer(master);
  for (const [key, value] of given) {
    if (!Object.hasOwn(otherwise, key)) throw new Error(`link: unknown key '${key}'`);
    const known = {
      master: () => Object.hasOwn(MASTERS, value),
      encoder: () => [...$("encoder").options].some((option) => option.value === value && !option.disabled),
      movement: () => [...$("movement").options].some((option) => option.value === value),
      ma: () => [...$("frequency").options].some((option) => option.value === value),
      bits: () => /^[0-9]+$/.test(value) && Number(value) >= 3 && Number(value) <= 64,
      cable: () => value.trim() !== "" && Number.isFinite(Number(value)),
      pace: () => [...$("pace").options].some((option) => option.value === value),
      fault: () => [...$("fault-kind").options].some((option) => option.value === value),
    };
    if (!known[key]()) throw new Error(`link: ${key} '${value}' is not possible`);
    found[key] = typeof otherwise[key] === "number" ? Number(value) : value;
  }
  return found;
}

// Opens a chip with this set-up and shows its first frame. On error the chip before stays.
function open(wanted) {
  let text;
  try {
    text = scenario(wanted);
    chip.open(text);
    problem("");
  } catch (error) {
    const [, key] = /: key '(\w+)'/.exec(error.message) ?? [];
    if (setup !== null && key in KEYS) mark($(KEYS[key]), `${reason(error.message)}; the chip stays as it was`);
    else problem(error.message);
    return false;
  }
  const other = setup?.master !== wanted.master;
  setup = wanted;
  if (other) showMaster();
  replay = null;
  counts = {good: 0, bad: 0};
  lead = null;
  $("scenario").textContent = text;
  $("bits-label").hidden = presets.get(setup.encoder).data_bits !== 0;
  showLink();
  $("frames").replaceChildren();
  $("spi-log").textContent = "";
  $("rate").textContent = "–";
  points = {time: [], position: [], bad: []};
  say("");
  try {
    chip.configure();
    chip.record(true);
    takeLevels();
    rate = {since: performance.now(), clocks: chip.clocks};
    show(readFrame());
    afterStep();
  } catch (error) {
    stopFor(error);
  }
  return true;
}

// The parts of the page that differ from master to master.
function showMaster() {
  const {name, Bus, table, last, groups, register, value} = MASTERS[setup.master];
  registers = new Registers(new Bus(chip), PARTS.tables[table], last);
  view = new RegisterView(registers, groups, $("register-groups"), say);
  $("register-names").replaceChildren(
    ...Object.keys(registers.addresses).map((one) => html("option", {value: one})));
  $("register-name").value = register;
  $("register-value").value = value;
  for (const field of ["register-name", "register-value", "spi-bytes"]) mark($(field), "");
  $("registers-title").textContent = `Registers of ${Bus === SpiBus ? "the chip" : name}`;
  $("register-bus").textContent = registers.bus.name;
  $("register-unit").textContent = {byte: "Byte", word: "Word"}[registers.bus.unit];
  const spi = Bus === SpiBus;
  $("spi").hidden = $("spi-log").hidden = !spi;
  $("no-spi").hidden = spi;
  $("no-spi").textContent = `${name} has no SPI: its host is on ${registers.bus.name}, which the registers above use.`;
  columns = chip.columns();
  $("columns").replaceChildren(...["read at, µs", "slave", ...columns.map(({title}) => title), "state"].map(
    (textContent) => html("th", {textContent})));
}

// --- frames ----------------------------------------------------------------------------------

function takeLevels() {
  for (const edge of chip.taken().edges) levels[edge.place] = edge.level;
}

// The frame on MA since a time, by its edges. Masters tell a frame when MA has rested, which may be
// after the host has read it.
function lastFrame(edges, since) {
  const ma = edges.filter((edge) => edge.place === 0 && edge.time >= since);
  if (ma.length < 2) return undefined;
  const pause = 10 * (ma.at(-1).time - ma.at(-2).time);
  let first = ma.length - 1;
  while (first > 0 && ma[first].time - ma[first - 1].time < pause) --first;
  return {start_ns: ma[first].time, end_ns: ma.at(-1).time};
}

// Reads one frame as the command line does. Returns its row and its picture.
function readFrame() {
  const before = {...levels};
  const begin = chip.timeNs;
  const [[row]] = chip.read();
  const {edges, frames} = chip.taken();
  for (const edge of edges) levels[edge.place] = edge.level;
  const encoder = encoderOf(setup), {periodNs} = MASTERS[setup.master];
  const roundTrip = 2 * NS_PER_M * setup.cable;
  const frame = frames.find((one) => one.channel === 1 && one.start_ns >= begin - 1) ??
    lastFrame(edges, periodNs ? 0 : begin - 1) ??
    {start_ns: begin, end_ns: Math.max(chip.timeNs, begin + 1)};
  lead = {start: frame.start_ns - begin, length: frame.end_ns - frame.start_ns};
  const seen = frame.end_ns + roundTrip;
  const margin = (seen - frame.start_ns) * 0.04;
  const word = Object.fromEntries(columns.map(({key}, i) => [key, row.words[i]]));
  const picture = {
    edges, before, good: row.good, seen, zero: frame.start_ns, from: frame.start_ns - margin, to: seen + 2 * margin,
    brackets: brackets(edges, frame, encoder, encoder.data_bits, roundTrip),
    title: row.good ? `raw word ${word.raw}` : `no word: ${row.state}`};
  return {row, word, picture};
}

function publish({row, word}) {
  const {good, state} = row;
  counts[good ? "good" : "bad"] += 1;
  $("position").textContent = good ? word.position : "–";
  $("state").textContent = $("state").title = state;
  $("state").classList.toggle("bad", !good);
  $("good").textContent = counts.good;
  $("bad").textContent = counts.bad;
  showDial(good ? BigInt(word.position) : null);
  const cells = [row.us, row.slave, ...row.words, state];
  const line = html("tr", {className: good ? "" : "bad"},
                    ...cells.map((text) => html("td", {textContent: text})));
  $("frames").prepend(line);
  while ($("frames").rows.length > TABLE_ROWS) $("frames").lastElementChild.remove();
  points.time.push(row.us / 1000);
  points.position.push(good ? Number(word.position) : null);
  const last = points.position.findLast((position) => position !== null) ?? 0;
  points.bad.push(good ? null : last);
  for (const array of Object.values(points)) {
    if (array.length > MAX_POINTS) array.shift();
  }
}

// The position as a part of all positions; null: none, the hand stays.
function showDial(position) {
  const encoder = encoderOf(setup);
  const bits = BigInt(encoder.data_bits - encoder.flag_bits);
  $("dial").classList.toggle("old", position === null);
  if (position === null) {
    $("dial-text").textContent = "no position";
    return;
  }
  const turn = Number((position << 20n) >> bits) / 2 ** 20;
  $("hand").setAttribute("transform", `rotate(${(turn * 360).toFixed(3)})`);
  $("dial-text").textContent = `${(turn * 100).toFixed(2)} % of 2^${bits}`;
}

// Shows a frame at once.
function show(frame) {
  publish(frame);
  diagram.show(frame.picture);
  if (!document.documentElement.dataset.firstFrameMs) {
    requestAnimationFrame(() => {
      document.documentElement.dataset.firstFrameMs = Math.round(performance.now());
    });
  }
}

// Why words fail that no fault has met: what the chip is told against what the encoder is.
function showHints() {
  const hints = chip.report().hints;
  $("hints").hidden = hints.length === 0;
  $("hints").replaceChildren(...hints.map(({kind, place, text}) => {
    const item = html("li", {textContent: text});
    Object.assign(item.dataset, {kind, place});
    return item;
  }));
}

function afterStep() {
  showHints();
  plot.setData([points.time, points.position, points.bad]);
  $("time").textContent = `${(chip.timeNs / 1e6).toFixed(4)} ms`;
  view.refresh();
  lastRefresh = performance.now();
}

function stopFor(error) {
  setRunning(false);
  replay = null;
  say(error.message, true);
}

function pace() {
  return matchMedia("(prefers-reduced-motion: reduce)").matches ? 0 : Number($("pace").value);
}

function beginFrame() {
  const frame = readFrame();
  if (pace() === 0) {
    show(frame);
    return;
  }
  replay = {frame, begin: performance.now(), ms: 1000 * pace()};
}

// Draws a slow frame as far as it has come. Returns whether it is over.
function goOn(now) {
  const {frame, begin, ms} = replay;
  const part = (now - begin) / ms;
  const {from, to} = frame.picture;
  if (part < 1) {
    diagram.show(frame.picture, from + part * (to - from));
    return false;
  }
  replay = null;
  show(frame);
  afterStep();
  return true;
}

// Asks for one call of tick(), however often it is called before.
function ask() {
  pending ??= requestAnimationFrame(tick);
}

function tick() {
  pending = null;
  if (!running && replay === null) return;
  ask();
  const now = performance.now();
  try {
    if (replay !== null && !goOn(now)) return;
    if (!running) return;
    if (pace() !== 0) {
      beginFrame();
      return;
    }
    let frame;
    do {
      frame = readFrame();
      publish(frame);
    } while (performance.now() - now < BUDGET_MS);
    diagram.show(frame.picture);
    plot.setData([points.time, points.position, points.bad]);
    if (now - lastRefresh > REFRESH_MS) {
      const clocks = chip.clocks;
      $("rate").textContent = Math.round((clocks - rate.clocks) / (now - rate.since) * 1000)
        .toLocaleString("en");
      rate = {since: now, clocks};
      afterStep();
    }
  } catch (error) {
    stopFor(error);
  }
}

function setRunning(on) {
  running = on;
  $("run").textContent = on ? "Stop" : "Run";
  $("step").disabled = on;
  if (on) {
    say("");
    rate = {since: performance.now(), clocks: chip.clocks};
    ask();
  } else {
    if (replay !== null) show(replay.frame);  // the chip has read it
    replay = null;
    afterStep();
  }
}

function step() {
  if (running || replay !== null) return;
  say("");
  try {
    beginFrame();
    if (replay === null) afterStep();
    else ask();
  } catch (error) {
    stopFor(error);
  }
}

// --- faults, SPI, registers -------------------------------------------------------------------

// The table of a fault that meets the next frame.
function faultTable(kind) {
  const {start, length} = lead;
  const us = (ns) => (Math.max(ns, 1) / 1000).toFixed(3);
  // Of a master that makes frames by itself a longer one would meet two.
  const lasts = `at_us = 0\nfor_us = ${us(MASTERS[setup.master].periodNs ?? 2 * (start + length))}\n`;
  const head = `[[fault]]\nkind = "${kind}"\n`;
  switch (kind) {
    case "bit-flip": return head + "at_us = 0\nbits = [5]\n";
    case "glitch": return `${head}at_us = ${us(start + 0.6 * length)}\nwidth_ns = ${us(length * 20)}\n`;
    case "stuck": return head + lasts + "level = 0\n";
    case "jitter": return head + lasts + "jitter_ns = 60\n";
    case "clock-stop": return head + lasts;
    default: return head + lasts + "slave = 1\n";
  }
}

function fault() {
  try {
    chip.inject(faultTable($("fault-kind").value));
    say(`fault: ${$("fault-kind").selectedOptions[0].textContent}, in the next frame if it comes at once`);
  } catch (error) {
    say(error.message, true);
  }
}

function log(text) {
  const lines = `${$("spi-log").textContent}${text}\n`.split("\n");
  $("spi-log").textContent = lines.slice(-LOG_LINES - 1).join("\n");
  $("spi-log").scrollTop = $("spi-log").scrollHeight;
}

const bytesText = (bytes) =>
  [...bytes].map((byte) => byte.toString(16).toUpperCase().padStart(2, "0")).join(" ");

function sendBytes(text) {
  const words = text.trim().split(/\s+/);
  const wrong = words.find((word) => !/^(0x)?[0-9a-f]{1,2}$/i.test(word));
  if (wrong !== undefined) {
    throw new FieldError($("spi-bytes"), `SPI: '${wrong}' is no byte; example: 03 EA 00 00`);
  }
  const sent = words.map((word) => parseInt(word, 16));
  const answer = chip.spi(sent);
  log(`> ${bytesText(sent)}\n< ${bytesText(answer)}`);
}

// A handler of events: `action` uses these fields and takes effect between two frames, then the page
// follows.
function act(fields, action) {
  return (event) => {
    event?.preventDefault();
    if (!chip) return;
    say("");
    for (const name of fields) mark($(name), "");
    try {
      action();
      if (!running) afterStep();
    } catch (error) {
      say(error.message, true);
      if (error instanceof FieldError) mark(error.input, error.message);
    }
  };
}

function listen() {
  $("setup").addEventListener("change", (event) => {
    if (event.target.id === "link") return;
    const lost = event.target.id === "master" ? offer($("master").value) : "";
    const wanted = readControls();
    $("bits-label").hidden = presets.get(wanted.encoder).data_bits !== 0;
    if (!numbersAreGood(wanted) || !open(wanted)) $("link").value = location.href;
    else if (lost !== "") say(lost, true);
  });
  $("setup").addEventListener("submit", (event) => event.preventDefault());
  addEventListener("hashchange", () => openLink());
  $("copy").addEventListener("click", async () => {
    $("link").select();
    try {
      await navigator.clipboard.writeText($("link").value);
      say("the link is in the clipboard");
    } catch {
      say("the link is selected: copy it from there");
    }
  });
  $("run").addEventListener("click", () => setRunning(!running));
  $("step").addEventListener("click", step);
  $("fault").addEventListener("click", fault);
  for (const name of ["pace", "fault-kind"]) $(name).addEventListener("change", showLink);
  $("save-svg").addEventListener("click", () => save("frame.svg", "image/svg+xml", diagram.svg()));
  $("save-vcd").addEventListener("click", () => save("frame.vcd", "text/plain", vcdOf(diagram.picture)));
  $("documents").addEventListener("click", () => $("help").showModal());
  $("spi").addEventListener("submit", act(["spi-bytes"], () => sendBytes($("spi-bytes").value)));
  const inField = (name, action) => {
    try {
      return action($(name).value);
    } catch (error) {
      throw new FieldError($(name), error.message);
    }
  };
  const chosen = () => inField("register-name", (text) => registers.address(text));
  $("register").addEventListener("submit", act(["register-name", "register-value"], () => {
    const address = chosen();
    inField("register-value", (text) => registers.write(address, parseNumber(text)));
    say(`${registers.title(address)} is written`);
  }));
  $("register-read").addEventListener("click", act(["register-name", "register-value"], () => {
    const address = chosen();
    const value = registers.hexOf(registers.read(address));
    $("register-value").value = value;
    say(`${registers.title(address)} = ${value}`);
  }));
  addEventListener("keydown", (event) => {
    const typing = event.target.matches("input, select, textarea") || $("help").open;
    if (typing || event.ctrlKey || event.altKey || event.metaKey) return;
    const button = {r: "run", s: "step", f: "fault"}[event.key];
    if (button) $(button).click();
  });
}

function makePlot() {
  const colour = (name) => () =>
    getComputedStyle(document.documentElement).getPropertyValue(name).trim();
  const axis = {stroke: colour("--text"), grid: {stroke: colour("--faint"), width: 1},
                ticks: {stroke: colour("--faint"), width: 1}};
  const short = new Intl.NumberFormat("en", {notation: "compact", maximumSignificantDigits: 5});
  const size = () => ({width: $("plot").clientWidth, height: 220});
  plot = new uPlot({
    ...size(),
    scales: {x: {time: false}},
    axes: [{...axis, label: "simulated time, ms", labelSize: 20}, {...axis, size: 64, values: (_, all) => all.map((value) => short.format(value))}],
    series: [{label: "ms"},
             {label: "position", stroke: colour("--row1"), width: 1.5, points: {show: (_, __, from, to) => to - from < 60}},
             {label: "bad frame", stroke: colour("--bad"), paths: () => null,
              points: {show: true, size: 7, fill: colour("--bad")}}],
  }, [[], [], []], $("plot"));
  new ResizeObserver(() => plot.setSize(size())).observe($("plot"));
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => plot.redraw());
}

function openLink() {
  let wanted = USUAL, wrong = "";
  try {
    wanted = fromFragment(location.hash, USUAL);
  } catch (error) {
    wrong = error.message;
  }
  showControls(wanted);
  if (!open(wanted) && setup === null) {  // a link whose set-up is refused
    wrong = $("problem").textContent;
    showControls(USUAL);
    open(USUAL);
  }
  if (wrong !== "") problem(wrong);
}

async function begin() {
  try {
    chip = await Chip.load(PARTS.wasm);
  } catch (error) {
    problem(`The chip does not start in this browser: ${error.message}`);
    return;
  }
  for (const preset of chip.presets()) presets.set(preset.name, preset);
  const groups = new Map();
  for (const preset of presets.values()) {
    const title = TITLES[preset.protocol] ?? preset.protocol;
    if (!groups.has(title)) groups.set(title, html("optgroup", {label: title}));
    groups.get(title).append(html("option", {value: preset.name, 
                                           textContent: preset.description.replace(/, give data_bits$/, "")}));
  }
  $("encoder").append(...groups.values());
  $("master").append(...Object.entries(MASTERS).map(
    ([value, {name}]) => html("option", {value, textContent: name})));
  diagram = new Diagram($("diagram"));
  makePlot();
  $("version").textContent = chip.version();
  const {documents} = document.documentElement.dataset;
  if (documents) Object.assign($("all-documents"), {href: documents, hidden: false});
  listen();
  openLink();
  for (const button of ["run", "step", "fault", "save-svg", "save-vcd"]) $(button).disabled = false;
}

begin();
