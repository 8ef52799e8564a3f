// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
"use strict";
// The 3D view: meshes, LMDs, forces and intersection polylines of one frame, with a slider over the frames. Coordinates are
// the world's, in metres.

const LEVELS = 65535;
const MESH_COLOURS = [0xe0b48c, 0x9fb4c7, 0xa9c7a0, 0xc7a9c2];
const EXACT_COLOUR = "#d01c8b";
const CURVE_COLOUR = "#b8860b";
// An arrow of F_max is this share of the moving mesh's size.
const ARROW_SHARE = 0.35;
const KEY_TURN = 0.12;  // radians a key press

function mesh_geometry(mesh, meshes) {
  const source = mesh.triangles ? mesh : meshes.find((other) => other.role === mesh.triangles_of);
  const steps = new Uint16Array(bytes(mesh.vertices));
  const vertices = new Float32Array(steps.length);
  for (let i = 0; i < steps.length; ++i) vertices[i] = mesh.low[i % 3] + (steps[i] / LEVELS) * mesh.size[i % 3];
  const buffer = bytes(source.triangles);
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(vertices, 3));
  geometry.setIndex(new THREE.BufferAttribute(source.wide ? new Uint32Array(buffer) : new Uint16Array(buffer), 1));
  geometry.computeVertexNormals();
  geometry.computeBoundingSphere();
  return geometry;
}

// Decodes what one slider steps through.
function decoded_track(track) {
  const sets = (packed) => ({offset: packed.offset, rows: floats(packed.rows)});
  const each = (object, decode) => Object.fromEntries(Object.entries(object).map(([name, value]) => [name, decode(value)]));
  return {...track, time: floats(track.time), position: floats(track.position), orientation: floats(track.orientation),
          movers: track.movers.map((mover) => ({...mover, position: floats(mover.position), orientation: floats(mover.orientation)})),
          exact: sets(track.exact), own: each(track.own, sets), forces: each(track.forces, floats)};
}
// LMDs of a frame: [point on the moving mesh, point on the fixed mesh, distance].
function lmds_of(set, index) {
  const found = [];
  for (let i = set.offset[index]; i < set.offset[index + 1]; ++i) {
    const row = set.rows.subarray(7 * i, 7 * i + 7);
    found.push([new THREE.Vector3(row[0], row[1], row[2]), new THREE.Vector3(row[3], row[4], row[5]), row[6]]);
  }
  return found;
}

class View {
  constructor(figure, number, data, colours) {
    this.number = number;
    this.data = data;
    this.colours = colours;
    this.tracks = data.tracks.map(decoded_track);
    this.track = this.tracks[0];
    this.hidden = new Set();
    this.place = figure.querySelector(".canvas");
    this.slider = figure.querySelector("input[type=range]");
    this.output = figure.querySelector("output");
    this.renderer = new THREE.WebGLRenderer({antialias: true, alpha: true, preserveDrawingBuffer: true});
    this.place.append(this.renderer.domElement);
    this.build_scene();
    this.controls = new THREE.OrbitControls(this.camera, this.place);
    this.controls.enableKeys = false;
    this.controls.addEventListener("change", () => this.render());
    this.place.addEventListener("keydown", (event) => this.key(event));
    this.slider.addEventListener("input", () => this.show(Number(this.slider.value)));
    this.offer_choices(figure.querySelector(".choices"));
    new ResizeObserver(() => this.resize()).observe(this.place);
    this.begin_track();
    this.look();
    this.resize();
  }

  build_scene() {
    this.scene = new THREE.Scene();
    this.bodies = this.data.meshes.map((mesh, i) => {
      // The moving mesh is opaque, the fixed ones let it shine through.
      const fixed = mesh.role !== "moving";
      const material = new THREE.MeshLambertMaterial({color: MESH_COLOURS[i % MESH_COLOURS.length], transparent: fixed,
                                                      opacity: fixed ? 0.6 : 1});
      const body = new THREE.Mesh(mesh_geometry(mesh, this.data.meshes), material);
      if (!mesh.role.startsWith("mover_")) this.scene.add(body);
      return body;
    });
    // The mesh of an entry of movers is drawn once a mover.
    const roles = this.data.meshes.map((mesh) => mesh.role);
    this.movers = this.tracks[0].movers.map((mover) => {
      const {geometry, material} = this.bodies[roles.indexOf(mover.role)];
      material.transparent = false;
      material.opacity = 1;
      const body = new THREE.Mesh(geometry, material);
      this.scene.add(body);
      return body;
    });
    this.moving = this.bodies[this.data.meshes.findIndex((mesh) => mesh.role === "moving")];
    this.size = Math.max(...this.bodies.map((body) => body.geometry.boundingSphere.radius));
    this.moving_size = this.moving.geometry.boundingSphere.radius;
    this.marks = new THREE.Group();
    this.scene.add(this.marks, new THREE.AmbientLight(0xffffff, 0.45));
    this.camera = new THREE.PerspectiveCamera(35, 1, this.size * 1e-3, this.size * 100);
    const lamp = new THREE.DirectionalLight(0xffffff, 0.75);
    this.camera.add(lamp);
    lamp.position.set(0.4, 0.8, 1);
    this.scene.add(this.camera);
  }

  // Everything that can be shown or hidden is a box with its colour; in a closed loop the device is chosen, too.
  offer_choices(place) {
    const box = (name, text, colour) => {
      const label = document.createElement("label");
      const input = document.createElement("input");
      input.type = "checkbox";
      input.checked = true;
      input.addEventListener("change", () => {
        if (input.checked) this.hidden.delete(name); else this.hidden.add(name);
        this.show(Number(this.slider.value));
      });
      const swatch = document.createElement("span");
      swatch.className = "swatch";
      swatch.style.background = colour;
      label.append(input, swatch, text);
      place.append(label);
    };
    if (this.tracks.length > 1) {
      const select = document.createElement("select");
      for (const track of this.tracks) select.add(new Option(`device of ${track.label}`));
      select.setAttribute("aria-label", "whose device");
      select.addEventListener("change", () => {
        this.track = this.tracks[select.selectedIndex];
        this.begin_track();
      });
      place.append(select);
    }
    box("exact", "exact LMDs", EXACT_COLOUR);
    const methods = [...new Set(this.tracks.flatMap((track) => Object.keys(track.forces)))];
    const recorded = methods.filter((label) => this.tracks.some((track) => track.own[label]));
    for (const label of recorded) box(`own ${label}`, `LMDs of ${label}`, this.colours[label]);
    for (const label of methods) box(`force ${label}`, `force of ${label}`, this.colours[label]);
    if (this.tracks.some((track) => track.polylines)) box("polylines", "intersection", CURVE_COLOUR);
    if (!recorded.length) place.append("The run recorded no LMDs of its methods (--set /record/lmds=true).");
  }

  // Starts at the frame with most to see.
  begin_track() {
    const counts = this.track.frames.map((_, i) => this.track.exact.offset[i + 1] - this.track.exact.offset[i] +
                                                   (this.track.polylines ? this.track.polylines[i].length : 0));
    this.slider.max = String(counts.length - 1);
    this.slider.value = String(counts.indexOf(Math.max(...counts)));
    this.show(Number(this.slider.value));
  }

  look() {
    const centre = new THREE.Vector3();
    for (const body of this.bodies) centre.add(body.geometry.boundingSphere.center.clone().applyMatrix4(body.matrixWorld));
    centre.divideScalar(this.bodies.length);
    this.controls.target.copy(centre);
    this.camera.position.copy(centre).add(new THREE.Vector3(0.6, 0.5, 1).normalize().multiplyScalar(this.size * 4.5));
    this.controls.update();
  }

  // Arrows turn, plus and minus come nearer or go away, 0 looks at everything again.
  key(event) {
    const away = this.camera.position.clone().sub(this.controls.target);
    const across = new THREE.Vector3().crossVectors(this.camera.up, away).normalize();
    const turn = {ArrowLeft: [this.camera.up, -KEY_TURN], ArrowRight: [this.camera.up, KEY_TURN], ArrowUp: [across, -KEY_TURN],
                  ArrowDown: [across, KEY_TURN]}[event.key];
    const zoom = {"+": 0.9, "=": 0.9, "-": 1 / 0.9}[event.key];
    if (turn) away.applyAxisAngle(turn[0], turn[1]);
    else if (zoom) away.multiplyScalar(zoom);
    else if (event.key === "0") return this.look();
    else return;
    event.preventDefault();
    this.camera.position.copy(this.controls.target).add(away);
    this.controls.update();
  }

  // Goes to the frame nearest to a time of the plots.
  go_to(time) {
    let nearest = 0;
    this.track.time.forEach((t, i) => { if (Math.abs(t - time) < Math.abs(this.track.time[nearest] - time)) nearest = i; });
    this.slider.value = String(nearest);
    this.show(nearest, false);
  }

  show(index, tell_plots = true) {
    const track = this.track;
    this.moving.position.fromArray(track.position, 3 * index);
    this.moving.quaternion.fromArray(track.orientation, 4 * index);
    this.moving.updateMatrixWorld(true);
    this.movers.forEach((body, i) => {
      body.position.fromArray(track.movers[i].position, 3 * index);
      body.quaternion.fromArray(track.movers[i].orientation, 4 * index);
    });
    for (const mark of this.marks.children) mark.traverse((part) => { if (part.geometry) part.geometry.dispose(); });
    this.marks.remove(...this.marks.children);
    const exact = lmds_of(track.exact, index);
    if (!this.hidden.has("exact")) for (const lmd of exact) this.add_lmd(lmd, EXACT_COLOUR, 0.016, 0.55);
    const counts = [];
    for (const [label, set] of Object.entries(track.own)) {
      const own = lmds_of(set, index);
      counts.push(`${label} ${own.length}`);
      if (!this.hidden.has(`own ${label}`)) for (const lmd of own) this.add_lmd(lmd, this.colours[label], 0.009, 1);
    }
    if (track.polylines && !this.hidden.has("polylines")) for (const line of track.polylines[index]) this.add_curve(line);
    const origin = this.moving.geometry.boundingSphere.center.clone().applyMatrix4(this.moving.matrixWorld);
    for (const [label, force] of Object.entries(track.forces))
      if (!this.hidden.has(`force ${label}`)) this.add_force(label, force.subarray(3 * index, 3 * index + 3), origin);
    const nearest = exact.length ? `, nearest ${(Math.min(...exact.map((lmd) => lmd[2])) * 1e3).toPrecision(4)} mm` : "";
    const own = counts.length ? `; ${counts.join(", ")}` : "";
    this.output.textContent = `frame ${track.frames[index]}, ${track.time[index].toFixed(3)} s: ${exact.length} ` +
                              `${exact.length === 1 ? "LMD" : "LMDs"}${nearest}${own}`;
    if (tell_plots && page.plots) for (const plot of page.plots[this.number] || []) plot.setSelection(track.frames[index]);
    this.render();
  }

  // A pair closer than a pixel would be invisible: balls mark where it is.
  add_lmd([from, to], colour, radius, opacity) {
    const line = new THREE.BufferGeometry().setFromPoints([from, to]);
    this.marks.add(new THREE.Line(line, new THREE.LineBasicMaterial({color: colour, depthTest: false})));
    const ball = new THREE.Mesh(new THREE.SphereBufferGeometry(this.size * radius, 12, 8),
                                new THREE.MeshBasicMaterial({color: colour, depthTest: false, transparent: true, opacity}));
    ball.position.copy(from).add(to).multiplyScalar(0.5);
    ball.renderOrder = 2;
    this.marks.add(ball);
  }

  add_curve([closed, packed]) {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(floats(packed), 3));
    const material = new THREE.LineBasicMaterial({color: CURVE_COLOUR, depthTest: false});
    const curve = closed ? new THREE.LineLoop(geometry, material) : new THREE.Line(geometry, material);
    curve.renderOrder = 1;
    this.marks.add(curve);
  }

  add_force(label, force, origin) {
    const vector = new THREE.Vector3(...force);
    const length = vector.length();
    if (!(length > 0)) return;
    const shown = this.moving_size * 2 * ARROW_SHARE * length / this.data.maximum_force;
    const arrow = new THREE.ArrowHelper(vector.clone().normalize(), origin, shown, this.colours[label], shown * 0.2, shown * 0.1);
    for (const part of [arrow.line, arrow.cone]) {
      part.material.depthTest = false;
      part.renderOrder = 3;
    }
    this.marks.add(arrow);
  }

  resize() {
    const width = this.place.clientWidth, height = this.place.clientHeight;
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    this.renderer.setSize(width, height, false);
    this.renderer.domElement.style.width = "100%";
    this.renderer.domElement.style.height = "100%";
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.render();
  }
  render() { this.renderer.render(this.scene, this.camera); }
  repaint() { this.render(); }
}

page.views = [];
for (const figure of document.querySelectorAll(".view")) {
  const number = Number(figure.dataset.result);
  const data = page.scenes[number];
  let problem = data.problem;
  if (!problem) {
    try {
      page.views[number] = new View(figure, number, data, page.colours[number]);
    } catch (error) {
      problem = "This browser shows no 3D graphics: " + error.message;
    }
  }
  if (problem) {
    figure.querySelector(".canvas").outerHTML = "<p class=\"notes\"></p>";
    figure.querySelector("p").textContent = problem;
    for (const part of figure.querySelectorAll(".step, .choices")) part.remove();
  }
}
