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

const text_colour = () => getComputedStyle(document.documentElement).getPropertyValue("--soft").trim();
const grid_colour = () => getComputedStyle(document.documentElement).getPropertyValue("--line").trim();

function panel_csv(panel, time, columns) {
  const rows = [["time [s]", ...panel.series.map((line) => `${line.label} [${panel.unit}]`)]];
  for (let i = 0; i < time.length; ++i)
    rows.push([time[i], ...columns.map((column) => Number.isNaN(column[i]) ? "" : column[i])]);
  return csv(rows);
}

function draw_panel(place, result, panel, time) {
  const columns = panel.series.map((line) => floats(line.values));
  const rows = Array.from(time, (t, i) => [t, ...columns.map((column) => Number.isNaN(column[i]) ? null : column[i])]);
  const box = document.createElement("div");
  box.className = "panel";
  box.innerHTML = '<div class="head"><b></b><span class="legend"></span></div><div class="plot"></div>';
  box.querySelector("b").textContent = `${panel.title} [${panel.unit === "us" ? "\u00b5s" : panel.unit}]`;
  const button = document.createElement("button");
  button.type = "button";
  button.textContent = "Download CSV";
  button.addEventListener("click", () => save(`${result.name}-${panel.id}`, panel_csv(panel, time, columns)));
  box.querySelector(".head").append(button);
  place.append(box);
  const looks = {};
  for (const line of panel.series)
    looks[line.label] = {color: line.colour, stepPlot: !!line.steps, connectSeparatedPoints: !!line.points};
  return new Dygraph(box.querySelector(".plot"), rows, {
    labels: ["time [s]", ...panel.series.map((line) => line.label)],
    series: looks,
    labelsDiv: box.querySelector(".legend"),
    legend: "always",
    logscale: !!panel.log,
    includeZero: !panel.log,
    strokeWidth: 1.2,
    axisLineColor: grid_colour(),
    gridLineColor: grid_colour(),
    digitsAfterDecimal: 4,
    axes: {x: {valueFormatter: (value) => `${value.toFixed(3)} s`}, y: {axisLabelWidth: 56}},
  });
}

function draw_plots() {
  page.plots = [];
  for (const place of document.querySelectorAll(".panels")) {
    const result = page.results[Number(place.dataset.result)];
    const time = floats(result.time);
    const plots = result.panels.map((panel) => draw_panel(place, result, panel, time));
    if (plots.length > 1) Dygraph.synchronize(plots, {selection: true, zoom: true, range: false});
    page.plots.push(plots);
  }
}

function connect_buttons() {
  for (const button of document.querySelectorAll("[data-csv-table]"))
    button.addEventListener("click", () => {
      const table = document.getElementById(button.dataset.csvTable);
      save(button.dataset.name, csv(Array.from(table.rows, (row) => Array.from(row.cells, (cell) => cell.textContent))));
    });
  for (const button of document.querySelectorAll("[data-csv-text]"))
    button.addEventListener("click",
        () => save(button.dataset.csvText, document.getElementById("csv-" + button.dataset.csvText).textContent));
  document.getElementById("theme").addEventListener("click", () => {
    const root = document.documentElement;
    const dark = root.dataset.theme ? root.dataset.theme === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
    root.dataset.theme = dark ? "light" : "dark";
    for (const plots of page.plots)
      for (const plot of plots) plot.updateOptions({axisLineColor: grid_colour(), gridLineColor: grid_colour()});
    for (const view of page.views || []) view.repaint();
  });
}

draw_plots();
connect_buttons();
