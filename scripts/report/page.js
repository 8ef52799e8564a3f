// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
"use strict";
// Plots of the page: decodes the series, draws linked panels, writes CSV files. The 3D view is in scene.js.

const page = JSON.parse(document.getElementById("page-data").textContent);

function bytes(text) {
  const raw = atob(text);
  const result = new Uint8Array(raw.length);
  for (let i = 0; i < raw.length; ++i) result[i] = raw.charCodeAt(i);
  return result.buffer;
}
const floats = (text) => new Float32Array(bytes(text));
const doubles = (text) => new Float64Array(bytes(text));
// What single precision holds of a number, without the digits that follow from it alone.
const held_digits = (value) => Number(value.toPrecision(7));

function save(name, text) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([text], {type: "text/csv"}));
  link.download = name + ".csv";
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}
// A field with a comma or a quote is quoted (RFC 4180).
const field = (text) => /[",\n]/.test(text) ? '"' + text.replace(/"/g, '""') + '"' : text;
const csv = (rows) => rows.map((row) => row.map((cell) => field(String(cell))).join(",")).join("\n") + "\n";
const table_csv = (table) => csv(Array.from(table.rows, (row) => Array.from(row.cells, (cell) => cell.textContent.trim())));

function button(text, act, label) {
  const made = document.createElement("button");
  made.type = "button";
  made.textContent = text;
  if (label) made.setAttribute("aria-label", label);
  made.addEventListener("click", act);
  return made;
}

const grid_colour = () => getComputedStyle(document.documentElement).getPropertyValue("--line").trim();

// One table of time and every series of some panels.
function panels_csv(panels, time) {
  const lines = panels.flatMap((panel) => panel.series.map((line) => ({...line, name: `${panel.title}: ${line.label} [${panel.unit}]`})));
  const columns = lines.map((line) => floats(line.values));
  const rows = [["time [s]", ...lines.map((line) => line.name)]];
  for (let i = 0; i < time.length; ++i)
    rows.push([time[i], ...columns.map((column) => Number.isNaN(column[i]) ? "" : held_digits(column[i]))]);
  return csv(rows);
}

// A logarithmic axis is labelled at its decades, and at 2 and 5 between them where there are less than two.
function decades(low, high) {
  const ticks = [], least = Math.max(low, 1e-9), parts = high < 100 * least ? [1, 2, 5] : [1];
  for (let power = Math.floor(Math.log10(least)); 10 ** power <= high; ++power)
    for (const value of parts.map((part) => Number((part * 10 ** power).toPrecision(1))))
      if (least <= value && value <= high) ticks.push({v: value, label: String(value)});
  return ticks;
}

const MARK_SIZE = 3.5;  // pixels

// Dygraphs begins its pattern anew at every point, which leaves none of it in a dense line.
const dashed = (pattern, steps) => ({drawingContext, color, strokeWidth, points}) => {
  drawingContext.save();
  drawingContext.setLineDash(pattern);
  drawingContext.strokeStyle = color;
  drawingContext.lineWidth = strokeWidth;
  drawingContext.beginPath();
  let last = NaN;
  for (const {canvasx, canvasy} of points) {
    if (Number.isNaN(last)) drawingContext.moveTo(canvasx, canvasy);
    else if (steps) drawingContext.lineTo(canvasx, last);
    drawingContext.lineTo(canvasx, canvasy);
    last = canvasy;
  }
  drawingContext.stroke();
  drawingContext.restore();
};

// A thin dashed line across a plot, with its name at the left end.
function draw_limit(canvas, area, y, label) {
  const colour = getComputedStyle(document.documentElement).getPropertyValue("--soft").trim();
  canvas.save();
  canvas.strokeStyle = canvas.fillStyle = colour;
  canvas.setLineDash([5, 4]);
  canvas.beginPath();
  canvas.moveTo(area.x, y);
  canvas.lineTo(area.x + area.w, y);
  canvas.stroke();
  canvas.font = "12px system-ui, sans-serif";
  canvas.fillText(label, area.x + 6, y - 5);
  canvas.restore();
}

function draw_panel(place, number, panel, time, last) {
  const result = page.results[number];
  const columns = panel.series.map((line) => floats(line.values));
  const rows = Array.from(time, (t, i) => [t, ...columns.map((column) => Number.isNaN(column[i]) ? null : column[i])]);
  const box = document.createElement("div");
  box.className = "panel";
  box.innerHTML = '<div class="head"><b></b><span class="legend"></span></div><div class="plot"></div>';
  box.querySelector("b").textContent = `${panel.title} [${panel.unit === "us" ? "\u00b5s" : panel.unit}]`;
  box.querySelector(".head").append(
      button("Download CSV", () => save(`${result.name}-${panel.id}`, panels_csv([panel], time))));
  place.append(box);
  const looks = {};
  for (const line of panel.series)
    looks[line.label] = {color: line.colour, stepPlot: !!line.steps, ...(line.dash && {plotter: dashed(line.dash, !!line.steps)}),
                         ...(line.marks ? {strokeWidth: 0, drawPoints: true, pointSize: MARK_SIZE} : {strokeWidth: 1.2})};
  // What is known at some frames only keeps its last value in the legend.
  const last_known = (k, row) => {
    for (let i = row; i >= 0; --i) if (!Number.isNaN(columns[k][i])) return String(Number(columns[k][i].toPrecision(4)));
    return undefined;
  };
  const row_at = (x) => { let row = -1; while (row + 1 < time.length && time[row + 1] <= x) ++row; return row; };
  return new Dygraph(box.querySelector(".plot"), rows, {
    labels: ["time [s]", ...panel.series.map((line) => line.label)],
    series: looks,
    labelsDiv: box.querySelector(".legend"),
    legend: "always",
    legendFormatter: (data) => {
      const row = data.x === undefined ? -1 : row_at(data.x);
      return data.series.map((line, k) => {
        const value = line.yHTML === undefined ? last_known(k, row) : line.yHTML;
        return `<span class="key${panel.series[k].dash ? " dashed" : ""}" style="--key: ${line.color}">${line.labelHTML}${value === undefined ? "" : ": " + value}</span>`;
      }).join("") + (data.xHTML ? `at ${data.xHTML}` : "");
    },
    underlayCallback: (canvas, area, plot) => { if (panel.limit) draw_limit(canvas, area, plot.toDomYCoord(panel.limit.value), panel.limit.label); },
    xlabel: last ? "time [s]" : null,
    logscale: !!panel.log,
    includeZero: !panel.log,
    axisLineColor: grid_colour(),
    gridLineColor: grid_colour(),
    digitsAfterDecimal: 4,
    axes: {x: {valueFormatter: (value) => `${value.toFixed(3)} s`}, y: {axisLabelWidth: 56, pixelsPerLabel: 22, valueRange: panel.range || null, ...(panel.log && {ticker: decades})}},
    clickCallback: (event, x) => page.views[number] && page.views[number].go_to(x),
  });
}

// What dragging does with a mouse, for the keyboard: shares of the window that both ends move by.
const ZOOMS = [["+", "nearer", 0.25, -0.25], ["\u2212", "farther", -0.5, 0.5], ["\u2190", "earlier", -0.25, -0.25],
               ["\u2192", "later", 0.25, 0.25]];

function zoom_buttons(place, plots) {
  const bar = document.createElement("p");
  bar.className = "tools";
  const [first, last] = plots[0].xAxisExtremes();
  for (const [sign, meaning, left, right] of ZOOMS)
    bar.append(button(sign, () => {
      const [low, high] = plots[0].xAxisRange();
      const window = [Math.max(first, low + left * (high - low)), Math.min(last, high + right * (high - low))];
      if (window[1] > window[0]) for (const plot of plots) plot.updateOptions({dateWindow: window});
    }, `${meaning} in time`));
  bar.append(button("all", () => { for (const plot of plots) plot.resetZoom(); }, "the whole time"));
  place.prepend(bar);
}

function draw_plots() {
  page.plots = [];
  for (const place of document.querySelectorAll(".panels")) {
    const number = Number(place.dataset.result);
    const result = page.results[number];
    const time = doubles(result.time);
    const plots = result.panels.map((panel, i) => draw_panel(place, number, panel, time, i === result.panels.length - 1));
    if (plots.length > 1) Dygraph.synchronize(plots, {selection: true, zoom: true, range: false});
    zoom_buttons(place, plots);
    page.plots.push(plots);
  }
}

function connect_buttons() {
  for (const made of document.querySelectorAll("[data-csv-table]"))
    made.addEventListener("click", () => save(made.dataset.name, table_csv(document.getElementById(made.dataset.csvTable))));
  for (const made of document.querySelectorAll("[data-csv-text]"))
    made.addEventListener("click", () => save(made.dataset.csvText, page.tables[made.dataset.csvText]));
  for (const made of document.querySelectorAll("[data-csv-result]")) {
    const result = page.results[Number(made.dataset.csvResult)];
    made.addEventListener("click", () => save(`${result.name}-frames`, panels_csv(result.panels, doubles(result.time))));
  }
  document.querySelectorAll(".study table").forEach((table, i) => {
    const study = table.closest(".study").id;
    const bar = document.createElement("p");
    bar.className = "tools";
    bar.append(button("Download CSV", () => save(`${study}-${i}`, table_csv(table))));
    const wide = document.createElement("div");
    wide.className = "wide";
    table.replaceWith(wide);
    wide.append(table);
    wide.after(bar);
  });
  const menu = document.getElementById("menu"), header = document.querySelector("header");
  const open_menu = (open) => { header.classList.toggle("open", open); menu.setAttribute("aria-expanded", String(open)); };
  menu.addEventListener("click", () => open_menu(!header.classList.contains("open")));
  document.getElementById("sections").addEventListener("click", () => open_menu(false));
  document.getElementById("theme").addEventListener("click", () => {
    const root = document.documentElement;
    const dark = root.dataset.theme ? root.dataset.theme === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
    root.dataset.theme = dark ? "light" : "dark";
    for (const plots of page.plots)
      for (const plot of plots) plot.updateOptions({axisLineColor: grid_colour(), gridLineColor: grid_colour()});
    for (const view of page.views) if (view) view.render();
  });
}

// A link to a folded section unfolds it.
function unfold() {
  const target = location.hash && document.getElementById(decodeURIComponent(location.hash.slice(1)));
  const folded = target && target.querySelector(":scope > details");
  if (folded) {
    folded.open = true;
    target.scrollIntoView();
  }
}

draw_plots();
connect_buttons();
addEventListener("hashchange", unfold);
unfold();
