// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
"use strict";
// The 3D view: meshes, LMDs, forces and intersection polylines of one frame, with a slider over the frames. Coordinates are
// the world's, in metres, from an origin in the scene: single precision holds little of what is far away.

const LEVELS = 65535;
const MOVING_COLOUR = 0xa99fd6;  // no method's: figure_style.py
const MOVER_COLOUR = 0x9ecbb4;
const FIXED_COLOURS = [0xc9c3b6, 0xb9c7b0, 0xc7b3c0];
const EXACT_COLOUR = "#d9b400";  // truth in every figure: figure_style.py
const CURVE_COLOUR = "#555555";
const BALL_SHARES = {exact: 0.011, own: 0.006};  // radius over the distance from the eye: as large from near as from far
const VIEW_SHARE = 5.8;  // distance of the eye from the contact, over the radius of the moving mesh
const ARROW_SHARE = 0.6;  // length of the longest arrow over that radius: it stays inside the view
const CREASE = Math.cos(Math.PI / 6);  // triangles that meet under more than 30 degrees meet in an edge that one sees
const KEY_TURN = 0.12;  // radians a key press

// Triangles with corners of their own, so that an edge can be sharp.
function creased(index, count) {
  const round = Array.from({length: count}, () => []);
  for (let i = 0; i < index.length; ++i) round[index[i]].push(Math.floor(i / 3));
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(3 * index.length), 3));
  geometry.setAttribute("normal", new THREE.BufferAttribute(new Float32Array(3 * index.length), 3));
  geometry.userData = {corners: index, round};
  return geometry;
}

// The vertices of a mesh's n-th shape (one that does not deform has one), with normals: smooth over a curved surface, sharp across an edge.
function set_shape(geometry, mesh, n) {
  const {corners, round} = geometry.userData, length = 3 * round.length;
  const first = n * length < mesh.steps.length ? n * length : 0;
  const at = (v) => new THREE.Vector3(...[0, 1, 2].map((k) => mesh.low[k] + (mesh.steps[first + 3 * v + k] / LEVELS) * mesh.size[k]));
  const vertices = Array.from(round, (_, v) => at(v)), normals = [], units = [], corner = new THREE.Vector3();
  for (let f = 0; f < corners.length / 3; ++f) {
    const [a, b, c] = [0, 1, 2].map((k) => vertices[corners[3 * f + k]]);
    normals.push(b.clone().sub(a).cross(c.clone().sub(a)));
    units.push(normals[f].clone().normalize());
  }
  const {position, normal} = geometry.attributes;
  for (let i = 0; i < corners.length; ++i) {
    const f = Math.floor(i / 3);
    vertices[corners[i]].toArray(position.array, 3 * i);
    corner.set(0, 0, 0);
    for (const g of round[corners[i]]) if (g === f || units[g].dot(units[f]) > CREASE) corner.add(normals[g]);
    corner.normalize().toArray(normal.array, 3 * i);
  }
  position.needsUpdate = normal.needsUpdate = true;
  geometry.computeBoundingSphere();
}

function mesh_geometry(mesh, meshes) {
  const source = mesh.triangles ? mesh : meshes.find((other) => other.role === mesh.triangles_of);
  mesh.steps = new Uint16Array(bytes(mesh.vertices));
  const buffer = bytes(source.triangles);
  const geometry = creased(source.wide ? new Uint32Array(buffer) : new Uint16Array(buffer), mesh.count);
  set_shape(geometry, mesh, 0);
  return geometry;
}

// Decodes what one slider steps through.
function decoded_track(track) {
  const sets = (packed) => ({offset: packed.offset, rows: floats(packed.rows)});
  const each = (object, decode) => Object.fromEntries(Object.entries(object).map(([name, value]) => [name, decode(value)]));
  return {...track, time: doubles(track.time), position: floats(track.position), orientation: floats(track.orientation),
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
    // One colour a mesh, however many instances.
    const source = (mesh) => mesh.triangles_of || mesh.role, fixed = this.data.meshes.filter((mesh) => mesh.role.startsWith("fixed"));
    const kinds = [...new Set(fixed.map(source))];
    this.legend = new Map();  // what a body is: its colour
    this.bodies = this.data.meshes.map((mesh) => {
      // Both let the contact between them shine through.
      const moves = !mesh.role.startsWith("fixed");
      const colour = mesh.role === "moving" ? MOVING_COLOUR : moves ? MOVER_COLOUR : FIXED_COLOURS[kinds.indexOf(source(mesh)) % FIXED_COLOURS.length];
      const which = kinds.length > 1 ? ` ${kinds.indexOf(source(mesh)) + 1}` : "";
      this.legend.set(mesh.role === "moving" ? "moving mesh" : moves ? "others that move" : `fixed mesh${which}`, colour);
      const material = new THREE.MeshLambertMaterial({color: colour, transparent: true, opacity: moves ? 0.8 : 0.6});
      const body = new THREE.Mesh(mesh_geometry(mesh, this.data.meshes), material);
      if (!mesh.role.startsWith("mover_")) this.scene.add(body);
      return body;
    });
    // The mesh of an entry of movers is drawn once a mover.
    const roles = this.data.meshes.map((mesh) => mesh.role);
    this.movers = this.tracks[0].movers.map((mover) => {
      const {geometry, material} = this.bodies[roles.indexOf(mover.role)];
      const body = new THREE.Mesh(geometry, material);
      this.scene.add(body);
      return body;
    });
    this.moving = this.bodies[this.data.meshes.findIndex((mesh) => mesh.role === "moving")];
    this.size = Math.max(...this.bodies.map((body) => body.geometry.boundingSphere.radius));
    this.moving_size = this.moving.geometry.boundingSphere.radius;
    this.largest_force = 0;
    for (const track of this.tracks)
      for (const force of Object.values(track.forces))
        for (let i = 0; i < force.length; i += 3) this.largest_force = Math.max(this.largest_force, Math.hypot(force[i], force[i + 1], force[i + 2]));
    this.marks = new THREE.Group();
    this.scene.add(this.marks, new THREE.AmbientLight(0xffffff, 0.45));
    // The eye is near a moving mesh that may be far smaller than what stands.
    this.camera = new THREE.PerspectiveCamera(35, 1, this.moving_size * 1e-3, this.size * 100);
    this.camera.up.fromArray(this.data.up);
    const lamp = new THREE.DirectionalLight(0xffffff, 0.75);
    this.camera.add(lamp, lamp.target);  // shines as one looks, wherever that is
    lamp.position.set(0.4, 0.8, 1);
    this.scene.add(this.camera);
  }

  // Everything that can be shown or hidden is a box with its colour; in a closed loop the device is chosen, too.
  offer_choices(place) {
    const swatch_of = (colour) => {
      const swatch = document.createElement("span");
      swatch.className = "swatch";
      swatch.style.background = colour;
      return swatch;
    };
    for (const [name, colour] of this.legend) {
      const key = document.createElement("span");
      key.className = "body";
      key.append(swatch_of("#" + colour.toString(16).padStart(6, "0")), name);
      place.append(key);
    }
    const box = (name, text, colour) => {
      const label = document.createElement("label");
      const input = document.createElement("input");
      input.type = "checkbox";
      input.checked = true;
      input.addEventListener("change", () => {
        if (input.checked) this.hidden.delete(name); else this.hidden.add(name);
        this.show(Number(this.slider.value));
      });
      label.append(input, swatch_of(colour), text);
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
    box("exact", "true LMDs", EXACT_COLOUR);
    const methods = [...new Set(this.tracks.flatMap((track) => Object.keys(track.forces)))];
    const recorded = methods.filter((label) => this.tracks.some((track) => track.own[label]));
    for (const label of recorded) box(`own ${label}`, `LMDs of ${label}`, this.colours[label]);
    for (const label of methods) box(`force ${label}`, `force of ${label}`, this.colours[label]);
    if (this.tracks.some((track) => track.polylines)) box("polylines", "intersection", CURVE_COLOUR);
    place.append(`longest arrow: ${this.largest_force.toPrecision(3)} N. `);
    if (!recorded.length) place.append("The run recorded no LMDs of its methods (--set /record/lmds=true).");
  }

  // Starts at the frame with most to see, of several where the meshes are nearest.
  begin_track() {
    const seen = this.track.frames.map((_, i) => {
      const exact = this.held(i), curves = this.track.polylines ? this.track.polylines[i].length : 0;
      return [exact.length + curves, -Math.min(...exact.map((lmd) => lmd[2]))];
    });
    const best = seen.reduce((most, [count, near], i) => count > seen[most][0] || (count === seen[most][0] && near > seen[most][1]) ? i : most, 0);
    this.slider.max = String(seen.length - 1);
    this.slider.value = String(best);
    this.show(best);
  }

  // True contacts of the moving mesh: where others move, too, those on its surface.
  held(index) {
    const {center, radius} = this.moving.geometry.boundingSphere, {position, orientation} = this.track;
    const middle = center.clone().applyQuaternion(new THREE.Quaternion().fromArray(orientation, 4 * index));
    middle.add(new THREE.Vector3().fromArray(position, 3 * index));
    return lmds_of(this.track.exact, index).filter(([from]) => !this.movers.length || from.distanceTo(middle) < 1.01 * radius);
  }

  // Middle of the true contacts of the frame, and the mean direction from the fixed to the moving mesh there.
  contact() {
    const middle = new THREE.Vector3(), across = new THREE.Vector3();
    const exact = this.held(Number(this.slider.value));
    for (const [moving, fixed] of exact) {
      middle.addScaledVector(moving, 0.5).addScaledVector(fixed, 0.5);
      across.add(moving.clone().sub(fixed).normalize());
    }
    if (exact.length) middle.divideScalar(exact.length);
    else middle.copy(this.moving.geometry.boundingSphere.center).applyMatrix4(this.moving.matrixWorld);
    return [middle, across.normalize()];
  }

  // At the contact, from the side of the gap and a little from above.
  look() {
    const [middle, across] = this.contact();
    const away = new THREE.Vector3().crossVectors(across, this.camera.up);
    if (away.length() < 0.3) away.fromArray(this.data.front);
    away.normalize().addScaledVector(this.camera.up, 0.45).addScaledVector(across, 0.25).normalize();
    this.controls.target.copy(middle);
    this.camera.position.copy(middle).addScaledVector(away, VIEW_SHARE * this.moving_size);
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
    this.data.meshes.forEach((mesh, i) => {
      if (mesh.steps.length > 3 * mesh.count) set_shape(this.bodies[i].geometry, mesh, index);
    });
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
    if (!this.hidden.has("exact")) for (const lmd of exact) this.add_lmd(lmd, EXACT_COLOUR, BALL_SHARES.exact, 0.75);
    const counts = [];
    for (const [label, set] of Object.entries(track.own)) {
      const own = lmds_of(set, index);
      counts.push(`${label} ${own.length}`);
      if (!this.hidden.has(`own ${label}`)) for (const lmd of own) this.add_lmd(lmd, this.colours[label], BALL_SHARES.own, 1);
    }
    if (track.polylines && !this.hidden.has("polylines")) for (const line of track.polylines[index]) this.add_curve(line);
    const [origin] = this.contact();
    Object.entries(track.forces).forEach(([label, force], i, all) => {
      if (!this.hidden.has(`force ${label}`)) this.add_force(label, force.subarray(3 * index, 3 * index + 3), origin, all.length - i);
    });
    const nearest = exact.length ? `, nearest ${(Math.min(...exact.map((lmd) => lmd[2])) * 1e3).toPrecision(4)} mm` : "";
    const own = counts.length ? `; ${counts.join(", ")}` : "";
    this.output.textContent = `frame ${track.frames[index]}, ${track.time[index].toFixed(3)} s: ${exact.length} ` +
                              `${exact.length === 1 ? "LMD" : "LMDs"}${nearest}${own}`;
    if (tell_plots && page.plots) for (const plot of page.plots[this.number] || []) plot.setSelection(track.frames[index]);
    this.render();
  }

  // A pair closer than a pixel would be invisible: balls mark where it is.
  add_lmd([from, to], colour, share, opacity) {
    const line = new THREE.BufferGeometry().setFromPoints([from, to]);
    this.marks.add(new THREE.Line(line, new THREE.LineBasicMaterial({color: colour, depthTest: false})));
    const ball = new THREE.Mesh(new THREE.SphereBufferGeometry(1, 16, 12),
                                new THREE.MeshBasicMaterial({color: colour, depthTest: false, transparent: true, opacity}));
    ball.position.copy(from).add(to).multiplyScalar(0.5);
    ball.renderOrder = 2;
    ball.userData.share = share;
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

  // Arrows that fall together stay seen: the first method's is the thickest, the last one's lies on top.
  add_force(label, force, origin, thickness) {
    const vector = new THREE.Vector3(...force);
    if (!(vector.length() > 0)) return;
    const room = this.moving_size * ARROW_SHARE, length = room * vector.length() / this.largest_force;
    const head = Math.min(0.15 * room, 0.5 * length), radius = 0.007 * room * (2 * thickness - 1);
    const material = new THREE.MeshBasicMaterial({color: this.colours[label], depthTest: false, transparent: true});
    const shaft = new THREE.Mesh(new THREE.CylinderBufferGeometry(radius, radius, length - head, 12), material);
    const cone = new THREE.Mesh(new THREE.ConeBufferGeometry(radius + 0.03 * room, head, 16), material);
    shaft.position.y = 0.5 * (length - head);
    cone.position.y = length - 0.5 * head;
    const arrow = new THREE.Group();
    for (const part of [shaft, cone]) {
      part.renderOrder = 20 - thickness;
      arrow.add(part);
    }
    arrow.position.copy(origin);
    arrow.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), vector.normalize());
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
  render() {
    for (const mark of this.marks.children)
      if (mark.userData.share) mark.scale.setScalar(mark.userData.share * this.camera.position.distanceTo(mark.position));
    this.renderer.render(this.scene, this.camera);
  }
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
