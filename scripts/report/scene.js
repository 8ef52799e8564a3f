// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
"use strict";
// The 3D view: meshes, LMDs and forces of one frame, with a slider over the frames. Coordinates are the world's, in metres;
// the camera works in units of the scene's size.

const LEVELS = 65535;
const MESH_COLOURS = [0xe0b48c, 0x9fb4c7, 0xa9c7a0, 0xc7a9c2];
const LMD_COLOUR = 0xd01c8b;
// An arrow of F_max is this share of the moving mesh's size.
const ARROW_SHARE = 0.35;

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

class View {
  constructor(figure, data, colours) {
    this.data = data;
    this.colours = colours;
    this.place = figure.querySelector(".canvas");
    this.slider = figure.querySelector("input");
    this.output = figure.querySelector("output");
    this.renderer = new THREE.WebGLRenderer({antialias: true, alpha: true, preserveDrawingBuffer: true});
    this.place.append(this.renderer.domElement);
    this.scene = new THREE.Scene();
    this.bodies = data.meshes.map((mesh, i) => {
      // The moving mesh is opaque, the fixed ones let it shine through.
      const fixed = mesh.role !== "moving";
      const material = new THREE.MeshLambertMaterial({color: MESH_COLOURS[i % MESH_COLOURS.length], transparent: fixed,
                                                      opacity: fixed ? 0.6 : 1});
      const body = new THREE.Mesh(mesh_geometry(mesh, data.meshes), material);
      this.scene.add(body);
      return body;
    });
    this.moving = this.bodies[data.meshes.findIndex((mesh) => mesh.role === "moving")];
    this.size = Math.max(...this.bodies.map((body) => body.geometry.boundingSphere.radius));
    this.moving_size = this.moving.geometry.boundingSphere.radius;
    this.marks = new THREE.Group();
    this.scene.add(this.marks, new THREE.AmbientLight(0xffffff, 0.45));
    this.camera = new THREE.PerspectiveCamera(35, 1, this.size * 1e-3, this.size * 100);
    this.camera.up.set(0, 1, 0);
    const lamp = new THREE.DirectionalLight(0xffffff, 0.75);
    this.camera.add(lamp);
    lamp.position.set(0.4, 0.8, 1);
    this.scene.add(this.camera);
    this.controls = new THREE.OrbitControls(this.camera, this.place);
    this.controls.addEventListener("change", () => this.render());
    this.slider.max = String(data.frames.length - 1);
    this.slider.addEventListener("input", () => this.show(Number(this.slider.value)));
    new ResizeObserver(() => this.resize()).observe(this.place);
    const counts = data.frames.map((frame) => frame.lmds.length);
    this.slider.value = String(counts.indexOf(Math.max(...counts)));
    this.show(Number(this.slider.value));
    this.look();
    this.resize();
  }

  look() {
    const centre = new THREE.Vector3();
    for (const body of this.bodies) centre.add(body.geometry.boundingSphere.center.clone().applyMatrix4(body.matrixWorld));
    centre.divideScalar(this.bodies.length);
    this.controls.target.copy(centre);
    this.camera.position.copy(centre).add(new THREE.Vector3(0.6, 0.5, 1).normalize().multiplyScalar(this.size * 4.5));
    this.controls.update();
  }

  show(index) {
    const frame = this.data.frames[index];
    this.moving.position.fromArray(frame.position);
    this.moving.quaternion.fromArray(frame.orientation);
    this.moving.updateMatrixWorld(true);
    while (this.marks.children.length) this.marks.remove(this.marks.children[0]);
    for (const lmd of frame.lmds) this.add_lmd(lmd);
    const origin = this.moving.geometry.boundingSphere.center.clone().applyMatrix4(this.moving.matrixWorld);
    for (const [label, force] of Object.entries(frame.forces)) this.add_force(label, force, origin);
    const nearest = frame.lmds.length ? `, nearest ${(Math.min(...frame.lmds.map((lmd) => lmd[6])) * 1e3).toPrecision(4)} mm` : "";
    this.output.textContent = `frame ${frame.frame}, ${frame.time.toFixed(3)} s: ${frame.lmds.length} ${frame.lmds.length === 1 ? "LMD" : "LMDs"}${nearest}`;
    this.render();
  }

  // A pair closer than a pixel would be invisible: balls mark where it is.
  add_lmd(lmd) {
    const from = new THREE.Vector3(...lmd.slice(0, 3)), to = new THREE.Vector3(...lmd.slice(3, 6));
    const line = new THREE.BufferGeometry().setFromPoints([from, to]);
    this.marks.add(new THREE.Line(line, new THREE.LineBasicMaterial({color: LMD_COLOUR, depthTest: false})));
    const ball = new THREE.Mesh(new THREE.SphereBufferGeometry(this.size * 0.016, 12, 8),
                                new THREE.MeshBasicMaterial({color: LMD_COLOUR, depthTest: false, transparent: true, opacity: 0.85}));
    ball.position.copy(from).add(to).multiplyScalar(0.5);
    ball.renderOrder = 2;
    this.marks.add(ball);
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
  const data = page.scenes[Number(figure.dataset.result)];
  let problem = data.problem;
  if (!problem) {
    try {
      page.views.push(new View(figure, data, page.colours));
    } catch (error) {
      problem = "This browser shows no 3D graphics: " + error.message;
    }
  }
  if (problem) {
    figure.querySelector(".canvas").outerHTML = "<p class=\"notes\"></p>";
    figure.querySelector("p").textContent = problem;
    figure.querySelector("label").remove();
  }
}
