// SPDX-License-Identifier: MIT
// The picture: grains as instances of their base shapes, walls, force chains, contact points, and the
// hand that pulls a grain. It draws what the buffers of view.hpp contain; x to the right, z up.
import {
  AmbientLight, BackSide, BoxGeometry, BufferAttribute, BufferGeometry, Color, ColorManagement,
  CylinderGeometry, DirectionalLight, DoubleSide, DynamicDrawUsage, EdgesGeometry, Group, InstancedMesh,
  LineBasicMaterial, LineSegments, Matrix4, Mesh, MeshBasicMaterial, MeshLambertMaterial,
  OrthographicCamera, PerspectiveCamera, Plane, Quaternion, Raycaster, Scene, SphereGeometry, Vector2,
  Vector3, WebGLRenderer, LinearSRGBColorSpace,
} from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { scaleColour, stoneColour } from "./colours.js";

// Colours are given and shown as they are, without conversion.
ColorManagement.enabled = false;

const edgeColour = 0x30343b;
const background = 0xf3f4f6, wallColour = 0x8a93a0, movingColour = 0x2f6fb3;
const heldColour = new Color(0xf06595);
const stickColour = new Color(0x1f4e79), slideColour = new Color(0xe07b00);

export class View {
  constructor(canvas) {
    this.canvas = canvas;
    this.forceLabel = document.createElement("span");
    this.forceLabel.className = "force";
    this.forceLabel.hidden = true;
    canvas.parentElement.append(this.forceLabel);
    this.renderer = new WebGLRenderer({ canvas, antialias: true, preserveDrawingBuffer: true });
    this.renderer.outputColorSpace = LinearSRGBColorSpace;
    this.renderer.setClearColor(background);
    this.scene = new Scene();
    this.scene.add(new AmbientLight(0xffffff, 1.7));
    const sun = new DirectionalLight(0xffffff, 1.9);
    sun.position.set(0.5, -1, 1.6);
    this.scene.add(sun);
    this.options = { chains: true, contacts: false, normals: false, boxes: false, colour: "size" };
    this.quality = 1; // pixels along a side, relative to those of the screen
    this.colourMax = 0; // upper end of the colour scale
    this.moved = false; // whether the user has moved the camera
    this.stale = false; // whether the camera or the hand has moved since the picture was drawn
    this.meshes = [];
    this.rims = []; // the contours of round grains in space
    this.makeWalls();
    this.makeSegments();
    this.makeHand();
    this.normals = this.makeLines(0x1f7a3d);
    this.boxes = this.makeLines(0x7048b6);
    this.setSpace(true);
    // Before the controls of the camera, which do not see a pointer that holds a grain.
    canvas.parentElement.addEventListener("pointerdown", (event) => this.grab(event), { capture: true });
    window.addEventListener("pointermove", (event) => this.drag(event));
    for (const name of ["pointerup", "pointercancel", "blur"])
      window.addEventListener(name, (event) => this.letLoose(event));
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement);
  }

  /** Called with the grain and the point to which it is pulled, and when the hand opens. */
  onPull = () => {};
  onRelease = () => {};
  /** Called before onRelease with the velocity of a grain that is thrown [m/s]. */
  onThrow = () => {};

  setSpace(isSpace) {
    this.isSpace = isSpace;
    this.controls?.dispose();
    this.camera = isSpace ? new PerspectiveCamera(32, 1, 0.01, 100) : new OrthographicCamera(-1, 1, 1, -1, 0, 100);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.enableRotate = isSpace;
    this.controls.screenSpacePanning = true;
    // In the plane every button moves the picture.
    if (!isSpace) this.controls.mouseButtons = { LEFT: 2, MIDDLE: 1, RIGHT: 2 };
    this.controls.zoomSpeed = 1.5;
    this.moved = false;
    let byUser = false;
    this.controls.addEventListener("start", () => (byUser = true));
    this.controls.addEventListener("end", () => (byUser = false));
    this.controls.addEventListener("change", () => {
      this.moved ||= byUser;
      this.stale = true;
    });
  }

  /** Takes a new scene: meshes of the shapes, placements of the grains, bounds. */
  load({ meshes, mesh, scale }, description, isSpace, ground) {
    this.letLoose();
    for (const old of [...this.meshes, ...this.rims]) {
      this.scene.remove(old);
      old.geometry.dispose();
      old.material.dispose();
      old.dispose();
    }
    if (isSpace !== this.isSpace) this.setSpace(isSpace);
    this.bounds = description.bounds;
    this.count = mesh.length;
    this.scaleOf = scale;
    this.slotOf = new Uint32Array(this.count); // place of a grain among the instances of its mesh
    this.meshOf = mesh;
    const numbers = new Uint32Array(meshes.length);
    for (let k = 0; k < this.count; ++k) this.slotOf[k] = numbers[mesh[k]]++;
    this.grainsOf = meshes.map((_, m) => new Uint32Array(numbers[m]));
    for (let k = 0; k < this.count; ++k) this.grainsOf[mesh[k]][this.slotOf[k]] = k;
    this.meshes = meshes.map((shape, m) => this.makeGrains(shape, numbers[m]));
    this.rims = isSpace && meshes[0].isRound ? this.meshes.map((grains) => this.makeRim(grains)) : [];
    this.cornersOf = meshes.map(({ triangles }) => cornersOf(triangles));
    this.makeGround(ground);
    this.sizeOf = meshes.map(({ triangles }) => triangles.reduce((most, x) => Math.max(most, Math.abs(x)), 0));
    this.grainSize = 1e9; // of the smallest grain
    for (let k = 0; k < this.count; ++k)
      this.grainSize = Math.min(this.grainSize, scale[k] * this.sizeOf[mesh[k]]);
    this.makeOutlines(meshes);
    this.colourMax = 0;
    this.meanForce = this.fullForce = 0;
    this.isPlaced = false;
    this.arrowUnit = this.bounds[3] - this.bounds[0];
    if (this.quality !== 1) {
      this.quality = 1;
      this.resize();
    }
    // The user's camera is kept if the same scene begins anew.
    if (!this.moved || this.framedFor !== `${isSpace} ${this.bounds}`) this.frameScene();
    this.framedFor = `${isSpace} ${this.bounds}`;
  }

  makeGrains(shape, count) {
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(shape.triangles, 3));
    const shades = new Float32Array(shape.triangles.length).fill(1);
    // Round grains show how they roll: dark and light octants.
    if (shape.isRound && this.isSpace) shadeOctants(shape.triangles, shades);
    geometry.setAttribute("color", new BufferAttribute(shades, 3));
    if (this.isSpace) geometry.computeVertexNormals();
    const material = this.isSpace
      ? new MeshLambertMaterial({
          flatShading: !shape.isRound, vertexColors: true, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1,
        })
      : new MeshBasicMaterial({ side: DoubleSide });
    if (shape.isRound && this.isSpace) smoothNormals(geometry);
    const grains = new InstancedMesh(geometry, material, Math.max(1, count));
    grains.count = count;
    grains.instanceMatrix.setUsage(DynamicDrawUsage);
    grains.frustumCulled = false;
    for (let k = 0; k < count; ++k) grains.setColorAt(k, new Color(1, 1, 1));
    grains.visible = false; // until the first frame says where the grains are
    grains.instanceColor?.setUsage(DynamicDrawUsage);
    this.scene.add(grains);
    return grains;
  }
  /** The contour of round grains: dark balls a little larger, of which the side away from the eye is drawn. */
  makeRim(grains) {
    const rim = new InstancedMesh(grains.geometry.clone().scale(1.05, 1.05, 1.05), new MeshBasicMaterial({ color: edgeColour, side: BackSide }), grains.instanceMatrix.count);
    rim.instanceMatrix = grains.instanceMatrix;
    rim.count = grains.count;
    rim.frustumCulled = false;
    rim.visible = false;
    this.scene.add(rim);
    return rim;
  }
  /** The wall of triangles of a scene, which does not move. */
  makeGround(triangles) {
    if (this.ground) {
      this.scene.remove(this.ground);
      this.ground.geometry.dispose();
      this.ground.material.dispose();
    }
    this.ground = null;
    if (!triangles?.length) return;
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(triangles, 3));
    geometry.computeVertexNormals();
    this.ground = new Mesh(geometry, this.isSpace
      ? new MeshLambertMaterial({ color: 0x9aa5b8, side: DoubleSide, flatShading: true })
      : new MeshBasicMaterial({ color: wallColour, side: DoubleSide }));
    this.scene.add(this.ground);
  }
  /** All outlines are one set of lines, which is computed anew for every frame. */
  makeOutlines(meshes) {
    if (this.outlines) {
      this.scene.remove(this.outlines);
      this.outlines.geometry.dispose();
    }
    this.outlines = null;
    if (this.isSpace && meshes[0].isRound) return; // these have rims
    this.outlineOf = meshes.map((shape) => visibleOutline(shape, this.isSpace));
    let numbers = 0;
    for (let k = 0; k < this.count; ++k) numbers += this.outlineOf[this.meshOf[k]].length;
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(new Float32Array(numbers), 3).setUsage(DynamicDrawUsage));
    this.outlines = new LineSegments(geometry, new LineBasicMaterial({ color: edgeColour }));
    this.outlines.frustumCulled = false;
    this.outlines.visible = false;
    this.scene.add(this.outlines);
  }
  makeWalls() {
    this.walls = new Group();
    this.scene.add(this.walls);
    this.box = new BoxGeometry(1, 1, 1);
    this.edges = new EdgesGeometry(this.box);
    this.arrow = new Group();
    const paint = new MeshBasicMaterial({ color: 0xc0392b });
    const shaft = new Mesh(new CylinderGeometry(0.012, 0.012, 1, 12), paint);
    const head = new Mesh(new CylinderGeometry(0, 0.035, 0.09, 16), paint);
    shaft.name = "shaft", head.name = "head";
    this.arrow.add(shaft, head);
    this.arrow.visible = false;
    this.scene.add(this.arrow);
  }
  makeSegments() {
    this.chains = this.makeInstances(new CylinderGeometry(1, 1, 1, 8, 1), 1024);
    this.points = this.makeInstances(new SphereGeometry(1, 8, 6), 1024);
  }
  makeInstances(geometry, capacity) {
    const instances = new InstancedMesh(geometry, new MeshLambertMaterial(), capacity);
    instances.frustumCulled = false;
    instances.instanceMatrix.setUsage(DynamicDrawUsage);
    instances.setColorAt(0, new Color(1, 1, 1));
    instances.instanceColor.setUsage(DynamicDrawUsage);
    instances.count = 0;
    instances.renderOrder = 2;
    this.scene.add(instances);
    return instances;
  }
  /** Instances with room for that many; the room grows in large steps and is kept. */
  withRoom(instances, count) {
    if (instances.instanceMatrix.count >= count) return instances;
    this.scene.remove(instances);
    instances.dispose();
    instances.material.dispose();
    return this.makeInstances(instances.geometry, 2 * count);
  }
  makeLines(color) {
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(new Float32Array(0), 3));
    const lines = new LineSegments(geometry, new LineBasicMaterial({ color }));
    lines.frustumCulled = false;
    lines.visible = false;
    lines.renderOrder = 3;
    this.scene.add(lines);
    return lines;
  }
  /** The array of lines with room for so many ends; it is kept. */
  endsOf(lines, count) {
    let { position } = lines.geometry.attributes;
    if (position.count < count) {
      lines.geometry.dispose();
      position = new BufferAttribute(new Float32Array(6 * count), 3).setUsage(DynamicDrawUsage);
      lines.geometry.setAttribute("position", position);
    }
    lines.geometry.setDrawRange(0, count);
    lines.visible = count > 0;
    position.needsUpdate = true;
    return position.array;
  }
  makeHand() {
    const paint = new MeshBasicMaterial({ color: 0xd6336c, depthTest: false, transparent: true });
    this.hand = new Group();
    this.handLine = new Mesh(new CylinderGeometry(1, 1, 1, 8), paint);
    this.handEnd = new Mesh(new SphereGeometry(1, 12, 8), paint);
    this.handLine.renderOrder = this.handEnd.renderOrder = 5;
    this.hand.add(this.handLine, this.handEnd);
    this.hand.visible = false;
    this.scene.add(this.hand);
  }

  /** Takes other bounds of the scene that is shown. */
  setBounds(bounds) {
    if (bounds.every((x, k) => x === this.bounds[k])) return;
    this.bounds = bounds;
    if (!this.moved) this.frameScene();
  }
  /** Puts the camera where it sees the whole scene. */
  frameScene() {
    if (!this.bounds) return;
    this.moved = false;
    this.applyAspect();
    const b = this.bounds;
    const centre = new Vector3((b[0] + b[3]) / 2, (b[1] + b[4]) / 2, (b[2] + b[5]) / 2);
    const size = new Vector3(b[3] - b[0], b[4] - b[1], b[5] - b[2]);
    const aspect = this.aspect || 1;
    this.controls.target.copy(centre);
    if (this.isSpace) {
      // From the right, the front and above; of a long scene, more from the front.
      const isLong = size.x > 2.5 * size.z;
      const way = new Vector3(isLong ? 0.16 : 0.42, -1, isLong ? 0.3 : 0.5).normalize();
      let low = 0.1 * size.length(), high = 20 * size.length();
      for (let k = 0; k < 30; ++k) {
        const distance = Math.sqrt(low * high);
        this.lookFrom(centre, way, distance);
        if (this.showsBounds()) high = distance;
        else low = distance;
      }
      this.lookFrom(centre, way, high);
    } else {
      const half = 0.6 * Math.max(size.z, size.x / aspect);
      this.half = half;
      this.camera.zoom = 1;
      this.camera.position.set(centre.x, -10, centre.z);
    }
    this.applyAspect();
    this.controls.update();
  }
  lookFrom(centre, way, distance) {
    this.camera.position.copy(centre).addScaledVector(way, distance);
    this.camera.near = distance / 50;
    this.camera.far = distance * 20;
    this.camera.lookAt(centre);
    this.camera.updateProjectionMatrix();
    this.camera.updateMatrixWorld();
  }
  showsBounds() {
    const b = this.bounds, corner = scratch.position;
    for (let k = 0; k < 8; ++k) {
      corner.set(b[k & 1 ? 3 : 0], b[k & 2 ? 4 : 1], b[k & 4 ? 5 : 2]).project(this.camera);
      if (!(Math.abs(corner.x) < 0.94 && corner.y < 0.84 && corner.y > -0.9 && corner.z < 1)) return false;
    }
    return true;
  }
  applyAspect() {
    if (this.camera.isPerspectiveCamera) {
      this.camera.aspect = this.aspect || 1;
    } else if (this.half) {
      Object.assign(this.camera, {
        left: -this.half * this.aspect, right: this.half * this.aspect, top: this.half, bottom: -this.half,
      });
    }
    this.camera.updateProjectionMatrix();
  }
  resize() {
    const { clientWidth: width, clientHeight: height } = this.canvas.parentElement;
    if (width < 2 || height < 2) return;
    this.aspect = width / height;
    this.renderer.setPixelRatio(this.quality * Math.min(2, window.devicePixelRatio));
    this.renderer.setSize(width, height, false);
    this.applyAspect();
    if (!this.moved) this.frameScene();
    this.render();
  }

  /** Fewer pixels, for a machine that draws slowly. */
  coarsen() {
    if (this.quality < 0.6) return;
    this.quality *= 0.75;
    this.renderer.setPixelRatio(this.quality * Math.min(2, window.devicePixelRatio));
    this.render(); // the canvas is empty after a change of its size
  }

  /** Takes the buffers of a frame. `force` is f(t) [N] and its largest value, or null; `passed` is the simulated time
   *  since the last frame [s]. */
  update({ poses, colours, walls, segments, segmentCount, wallCount }, force, passed) {
    this.isPlaced = true;
    this.passed = passed;
    this.updateGrains(poses, colours);
    this.updateWalls(walls, wallCount, force);
    this.updateSegments(segments, segmentCount);
    this.updateHand();
  }
  updateGrains(poses, colours) {
    const { position, turn, size, matrix } = scratch;
    const which = { speed: 0, force: 1, residual: 2 }[this.options.colour];
    let most = 0;
    if (which !== undefined) {
      for (let k = 0; k < this.count; ++k) {
        const value = colours[3 * k + which];
        if (Number.isFinite(value)) most = Math.max(most, value);
      }
      // The scale follows slowly, so that colours do not flicker.
      this.colourMax = this.colourMax === 0 ? most : Math.max(0.8 * most, this.colourMax + 0.03 * (most - this.colourMax));
    }
    for (let k = 0; k < this.count; ++k) {
      const mesh = this.meshes[this.meshOf[k]], slot = this.slotOf[k], p = 7 * k;
      position.set(poses[p], poses[p + 1], poses[p + 2]);
      turn.set(poses[p + 3], poses[p + 4], poses[p + 5], poses[p + 6]);
      size.setScalar(this.scaleOf[k]);
      matrix.compose(position, turn, size).toArray(mesh.instanceMatrix.array, 16 * slot);
      const out = mesh.instanceColor.array;
      if (k === this.held?.grain) heldColour.toArray(out, 3 * slot);
      else if (which === undefined) stoneColour(k, out, 3 * slot);
      else scaleColour(this.colourMax > 0 ? colours[3 * k + which] / this.colourMax : 0, out, 3 * slot);
    }
    // In the plane what is shown lies in front of the grains; in space they let it be seen.
    const { chains, contacts, normals } = this.options, clear = this.isSpace && (chains || contacts || normals);
    // Colours that mean something are faded less.
    const opacity = !clear ? 1 : which === undefined ? 0.33 : 0.6;
    for (const mesh of this.meshes) {
      mesh.visible = true;
      mesh.instanceMatrix.needsUpdate = true;
      mesh.instanceColor.needsUpdate = true;
      if (mesh.material.opacity !== opacity) {
        mesh.material.opacity = opacity;
        mesh.material.transparent = clear;
        mesh.material.depthWrite = !clear;
        mesh.material.needsUpdate = true;
      }
    }
    for (const rim of this.rims) rim.visible = !clear;
    if (this.outlines && clear && this.count > 50) this.outlines.visible = false; // among many grains in the way
    else if (this.outlines) this.updateOutlines();
    this.updateBoxes();
  }
  /** The box around each grain with axes parallel to the world. */
  updateBoxes() {
    const edges = this.isSpace ? boxEdges : boxEdges.slice(0, 4);
    const out = this.endsOf(this.boxes, this.options.boxes ? 2 * edges.length * this.count : 0);
    if (!this.options.boxes) return;
    const { position, matrix, low, high } = scratch;
    let at = 0;
    for (let k = 0; k < this.count; ++k) {
      const m = this.meshOf[k], corners = this.cornersOf[m];
      matrix.fromArray(this.meshes[m].instanceMatrix.array, 16 * this.slotOf[k]);
      low.setScalar(Infinity), high.setScalar(-Infinity);
      for (let i = 0; i < corners.length; i += 3) {
        position.fromArray(corners, i).applyMatrix4(matrix);
        low.min(position), high.max(position);
      }
      for (const edge of edges)
        for (const end of edge) {
          out[at++] = end & 1 ? high.x : low.x;
          out[at++] = this.isSpace ? (end & 4 ? high.y : low.y) : -0.03;
          out[at++] = end & 2 ? high.z : low.z;
        }
    }
  }
  updateOutlines() {
    const out = this.outlines.geometry.attributes.position.array;
    let at = 0;
    const { position, matrix } = scratch, front = this.isSpace ? 0 : -0.001;
    for (let k = 0; k < this.count; ++k) {
      const m = this.meshOf[k], outline = this.outlineOf[m];
      matrix.fromArray(this.meshes[m].instanceMatrix.array, 16 * this.slotOf[k]);
      for (let i = 0; i < outline.length; i += 3) {
        position.fromArray(outline, i).applyMatrix4(matrix);
        out[at++] = position.x;
        out[at++] = position.y + front;
        out[at++] = position.z;
      }
    }
    this.outlines.geometry.attributes.position.needsUpdate = true;
    this.outlines.visible = true;
  }
  updateWalls(walls, count, force) {
    while (this.walls.children.length > count) this.removeWall(this.walls.children[this.walls.children.length - 1]);
    this.arrow.visible = false;
    for (let k = 0; k < count; ++k) {
      const w = walls.subarray(8 * k, 8 * k + 8), isDrum = w[0] === 1;
      let wall = this.walls.children[k];
      if (!wall || wall.userData.isDrum !== isDrum || (isDrum && wall.userData.radius !== w[4]) ||
          wall.userData.moves !== (w[7] !== 0) || wall.userData.isSpace !== this.isSpace) {
        if (wall) while (this.walls.children.length > k) this.removeWall(this.walls.children[this.walls.children.length - 1]);
        wall = isDrum ? this.makeDrum(w) : this.makeWall(w);
        this.walls.add(wall);
      }
      if (isDrum) {
        wall.position.set(w[1], w[2], w[3]);
        wall.rotation.set(0, -w[6], 0);
        continue;
      }
      wall.position.set(w[1], w[2], w[3]);
      const thick = this.isSpace ? 0 : 0.05;
      wall.scale.set(2 * w[4], Math.max(2 * w[5], thick), 2 * w[6]);
      // The free wall of the box has the largest x: the arrow shows the force on it.
      if (w[7] !== 0 && force !== null && w[4] < w[6]) {
        const unit = this.arrowUnit, length = 0.2 * unit * Math.min(1, force.now / force.most);
        this.forceLabel.textContent = `f = ${Number(force.now.toPrecision(2))} N`;
        this.arrow.visible = length > 0.01 * unit;
        this.arrow.position.set(w[1] + w[4] + 0.06 * unit, w[2], w[3]);
        this.arrow.rotation.set(0, 0, Math.PI / 2);
        this.arrow.getObjectByName("shaft").scale.set(unit, length, unit);
        this.arrow.getObjectByName("shaft").position.y = -0.03 * unit - length / 2;
        this.arrow.getObjectByName("head").scale.setScalar(unit);
        this.arrow.getObjectByName("head").position.y = 0;
      }
    }
  }
  makeWall(w) {
    const moves = w[7] !== 0;
    const colour = moves ? movingColour : wallColour;
    const wall = new Group();
    const solid = new Mesh(this.box, new MeshBasicMaterial({
      color: colour, transparent: this.isSpace, opacity: this.isSpace ? (moves ? 0.3 : 0.07) : 1, depthWrite: !this.isSpace,
    }));
    solid.renderOrder = 1;
    wall.add(solid, new LineSegments(this.edges, new LineBasicMaterial({ color: colour })));
    wall.userData = { isDrum: false, moves, isSpace: this.isSpace };
    return wall;
  }
  makeDrum(w) {
    const drum = new Group(), half = Math.max(w[5], 0.0005), radius = w[4];
    const rim = (scale) => new CylinderGeometry(radius * scale, radius * scale, 2 * half, 96, 1, true);
    const shell = new Mesh(rim(1), new MeshBasicMaterial({
      color: movingColour, side: DoubleSide, transparent: true, opacity: 0.1, depthWrite: false,
    }));
    shell.renderOrder = 1;
    // Circles at both ends, and marks on the rim that show how the drum turns.
    const corners = [];
    const add = (angle, scale, y) => corners.push(radius * scale * Math.cos(angle), y, radius * scale * Math.sin(angle));
    const count = 144;
    for (const y of this.isSpace ? [-half, half] : [0])
      for (const scale of this.isSpace ? [1] : [1, 1.004, 1.008, 1.012, 1.016])
        for (let k = 0; k < count; ++k)
          for (const end of [k, k + 1]) add((2 * Math.PI * end) / count, scale, y);
    for (let k = 0; k < 12; ++k)
      for (const y of [-half, half])
        for (const scale of [1, 1.05]) add((2 * Math.PI * k) / 12, scale, y);
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(new Float32Array(corners), 3));
    drum.add(shell, new LineSegments(geometry, new LineBasicMaterial({ color: movingColour })));
    drum.userData = { isDrum: true, radius, moves: w[7] !== 0, isSpace: this.isSpace };
    return drum;
  }
  removeWall(wall) {
    this.walls.remove(wall);
    for (const part of wall.children) {
      part.material.dispose();
      if (part.geometry !== this.box && part.geometry !== this.edges) part.geometry.dispose();
    }
  }

  updateSegments(segments, count) {
    this.chains.count = this.points.count = 0;
    if (this.options.chains) this.updateChains(segments, count);
    if (this.options.contacts) this.updatePoints(segments, count);
    this.updateNormals(segments, this.options.normals ? count : 0);
  }
  /** From each contact point, the normal: from the first body to the second. */
  updateNormals(segments, count) {
    const out = this.endsOf(this.normals, 2 * count);
    const length = 0.6 * this.grainSize, front = this.isSpace ? 0 : -0.04;
    for (let k = 0; k < count; ++k)
      for (let c = 0; c < 3; ++c) {
        const x = segments[14 * k + 6 + c] + (c === 1 ? front : 0);
        out[6 * k + c] = x;
        out[6 * k + 3 + c] = x + length * segments[14 * k + 11 + c];
      }
  }
  updateChains(segments, count) {
    const { position, size, turn, matrix, way, colour } = scratch;
    this.chains = this.withRoom(this.chains, count);
    let sum = 0;
    for (let k = 0; k < count; ++k) sum += segments[14 * k + 9];
    const mean = count > 0 ? sum / count : 0;
    // The mean over about 0.05 s of simulated time. The scale is held until it is wrong by a factor of 2.
    this.meanForce = this.meanForce === 0 ? mean : this.meanForce + (1 - Math.exp(-this.passed / 0.05)) * (mean - this.meanForce);
    const wanted = 6 * this.meanForce;
    if (!(wanted < 2 * this.fullForce && wanted > this.fullForce / 2)) this.fullForce = Number(wanted.toPrecision(2));
    const most = this.fullForce, front = this.isSpace ? 0 : -0.02;
    let shown = 0;
    for (let k = 0; k < count; ++k) {
      const s = 14 * k, strength = Math.min(1, segments[s + 9] / most);
      if (!(strength > 0.01)) continue;
      way.set(segments[s + 3] - segments[s], segments[s + 4] - segments[s + 1], segments[s + 5] - segments[s + 2]);
      const length = way.length();
      if (!(length > 0)) continue;
      position.set(
        (segments[s] + segments[s + 3]) / 2, (segments[s + 1] + segments[s + 4]) / 2 + front, (segments[s + 2] + segments[s + 5]) / 2);
      turn.setFromUnitVectors(upright, way.divideScalar(length));
      // Short rods, of a grain that lies at a wall, are not thicker than a third of their length.
      const radius = Math.min(this.grainSize * (0.03 + 0.25 * strength), length / 3);
      matrix.compose(position, turn, size.set(radius, length, radius)).toArray(this.chains.instanceMatrix.array, 16 * shown);
      // From orange to dark red.
      colour.setRGB(0.95 - 0.4 * strength, 0.55 * (1 - strength) * (1 - 0.4 * strength), 0.12 * (1 - strength));
      colour.toArray(this.chains.instanceColor.array, 3 * shown);
      ++shown;
    }
    this.chains.count = shown;
    this.chains.instanceMatrix.needsUpdate = this.chains.instanceColor.needsUpdate = true;
  }
  updatePoints(segments, count) {
    const { position, size, turn, matrix } = scratch;
    this.points = this.withRoom(this.points, count);
    const front = this.isSpace ? 0 : -0.05;
    turn.identity();
    size.setScalar(Math.max(0.14 * this.grainSize, 2.2 * this.pixel()));
    for (let k = 0; k < count; ++k) {
      const s = 14 * k;
      position.set(segments[s + 6], segments[s + 7] + front, segments[s + 8]);
      matrix.compose(position, turn, size).toArray(this.points.instanceMatrix.array, 16 * k);
      (segments[s + 10] !== 0 ? slideColour : stickColour).toArray(this.points.instanceColor.array, 3 * k);
    }
    this.points.count = count;
    this.points.instanceMatrix.needsUpdate = this.points.instanceColor.needsUpdate = true;
  }

  /** The size of a pixel in the middle of the picture [m]. */
  pixel() {
    const height = this.canvas.parentElement.clientHeight || 1, { camera } = this;
    if (!this.isSpace) return (2 * this.half) / camera.zoom / height;
    const distance = camera.position.distanceTo(this.controls.target);
    return (2 * distance * Math.tan((camera.fov * Math.PI) / 360)) / height;
  }

  // The hand. A grain is held at the point that the pointer has hit; it moves in the plane through this
  // point that faces the camera.
  ray(event) {
    const frame = this.canvas.getBoundingClientRect();
    const at = new Vector2(
      ((event.clientX - frame.left) / frame.width) * 2 - 1, 1 - ((event.clientY - frame.top) / frame.height) * 2);
    const caster = new Raycaster();
    caster.setFromCamera(at, this.camera);
    return caster;
  }
  /** The grain that is seen under the pointer and the point of it, or null: the first that the ray meets; else the
   *  one that it misses least, by 6 pixels at most. */
  hit(caster) {
    for (const mesh of this.meshes) mesh.computeBoundingSphere();
    const [first] = caster.intersectObjects(this.meshes, false);
    if (first) return { grain: this.grainsOf[this.meshes.indexOf(first.object)][first.instanceId], point: first.point };
    const reach = 6 * this.pixel();
    let best = null, least = reach;
    for (let k = 0; k < this.count; ++k) {
      const centre = this.centreOf(k), near = caster.ray.closestPointToPoint(centre, new Vector3());
      const miss = near.distanceTo(centre) - this.scaleOf[k] * this.sizeOf[this.meshOf[k]];
      if (miss < least) (least = miss), (best = { grain: k, point: near });
    }
    return best;
  }
  /** The grain under the pointer, or -1. */
  grainAt(event) {
    return this.isPlaced && event.target === this.canvas ? (this.hit(this.ray(event))?.grain ?? -1) : -1;
  }
  grab(event) {
    if (event.target !== this.canvas || event.button !== 0 || !this.isPlaced || event.shiftKey) return;
    const caster = this.ray(event), hit = this.hit(caster);
    if (!hit) return;
    const { grain, point } = hit;
    event.stopPropagation();
    event.preventDefault();
    const normal = this.camera.getWorldDirection(new Vector3());
    const centre = this.centreOf(grain);
    this.held = {
      grain,
      plane: new Plane().setFromNormalAndCoplanarPoint(normal, point),
      offset: point.clone().sub(centre),
      target: centre,
    };
    this.canvas.style.cursor = "grabbing";
    this.drag(event);
  }
  drag(event) {
    if (!this.held) return;
    const point = this.ray(event).ray.intersectPlane(this.held.plane, new Vector3());
    if (!point) return;
    this.held.target = point.sub(this.held.offset);
    const now = performance.now(), trace = (this.held.trace ??= []);
    trace.push({ now, x: this.held.target.clone() });
    while (now - trace[0].now > 100) trace.shift();
    this.onPull(this.held.grain, this.held.target);
    this.stale = true;
    this.updateHand();
  }
  /** Opens the hand. A grain that the pointer was moving flies on with the velocity of the pointer. */
  letLoose(event) {
    if (!this.held) return;
    const trace = this.held.trace ?? [], first = trace[0], last = trace[trace.length - 1];
    if (event?.type === "pointerup" && trace.length > 2 && performance.now() - last.now < 60) {
      const velocity = last.x.clone().sub(first.x).divideScalar(Math.max(0.02, (last.now - first.now) / 1000));
      if (velocity.length() > 0.5) this.onThrow(velocity);
    }
    this.held = null;
    this.canvas.style.cursor = "";
    this.hand.visible = false;
    this.onRelease();
  }
  centreOf(grain) {
    const { array } = this.meshes[this.meshOf[grain]].instanceMatrix;
    return new Vector3().fromArray(array, 16 * this.slotOf[grain] + 12);
  }
  updateHand() {
    this.hand.visible = Boolean(this.held);
    if (!this.held || !this.isPlaced) return;
    const { way } = scratch, front = this.isSpace ? 0 : -0.1;
    const centre = this.centreOf(this.held.grain), { target } = this.held;
    way.copy(target).sub(centre);
    const length = way.length(), thick = 0.1 * this.grainSize;
    this.handLine.visible = length > 0;
    if (length > 0) this.handLine.quaternion.setFromUnitVectors(upright, way.divideScalar(length));
    this.handLine.position.set((centre.x + target.x) / 2, (centre.y + target.y) / 2 + front, (centre.z + target.z) / 2);
    this.handLine.scale.set(thick, length, thick);
    this.handEnd.position.set(target.x, target.y + front, target.z);
    this.handEnd.scale.setScalar(3 * thick);
  }

  render() {
    this.stale = false;
    this.renderer.render(this.scene, this.camera);
    this.forceLabel.hidden = !this.arrow.visible;
    if (!this.arrow.visible) return;
    // Above the middle of the arrow, within the picture.
    const { clientWidth: width, clientHeight: height } = this.canvas.parentElement, at = scratch.position;
    at.copy(this.arrow.position);
    at.x += 0.09 * this.arrowUnit, at.z += 0.05 * this.arrowUnit;
    at.project(this.camera);
    const x = Math.min(((at.x + 1) / 2) * width, width - 80), y = ((1 - at.y) / 2) * height - 18;
    this.forceLabel.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)`;
  }
}

const upright = new Vector3(0, 1, 0);
const scratch = {
  position: new Vector3(), turn: new Quaternion(), size: new Vector3(), matrix: new Matrix4(),
  way: new Vector3(), colour: new Color(), low: new Vector3(), high: new Vector3(),
};
/** Edges of a box between corners whose bits say which end of x (1), z (2) and y (4); first those of the plane. */
const boxEdges = [[0, 1], [1, 3], [3, 2], [2, 0], [4, 5], [5, 7], [7, 6], [6, 4], [0, 4], [1, 5], [2, 6], [3, 7]];

/** The corners of triangles, each once. */
function cornersOf(triangles) {
  const seen = new Map();
  for (let k = 0; k < triangles.length; k += 3) {
    const x = triangles.subarray(k, k + 3);
    seen.set(Array.from(x, (c) => c.toFixed(6)).join(), x);
  }
  return Float32Array.from([...seen.values()].flatMap((x) => [...x]));
}

function shadeOctants(triangles, shades) {
  for (let k = 0; k < triangles.length; k += 9) {
    let sign = 1;
    for (let axis = 0; axis < 3; ++axis)
      sign *= triangles[k + axis] + triangles[k + 3 + axis] + triangles[k + 6 + axis] >= 0 ? 1 : -1;
    if (sign < 0) shades.fill(0.78, k, k + 9);
  }
}
/** Of a ball, the normal is the direction from the centre. */
function smoothNormals(geometry) {
  const { position, normal } = geometry.attributes;
  const direction = new Vector3();
  for (let k = 0; k < position.count; ++k) {
    direction.fromBufferAttribute(position, k).normalize();
    normal.setXYZ(k, direction.x, direction.y, direction.z);
  }
}
/** The outline of a shape in the plane, without the seams between the parts of a concave grain; of a
 *  disk with a radius, which shows how it rolls. In space, each edge once. */
function visibleOutline({ outline, isRound }, isSpace) {
  if (isRound) return Float32Array.from([...outline, 0, 0, 0, outline[0], outline[1], outline[2]]);
  const key = (k) => `${outline[k].toFixed(5)} ${outline[k + 1].toFixed(5)} ${outline[k + 2].toFixed(5)}`;
  const name = (k) => [key(k), key(k + 3)].sort().join();
  const count = new Map();
  for (let k = 0; k < outline.length; k += 6) count.set(name(k), (count.get(name(k)) ?? 0) + 1);
  const kept = [], seen = new Set();
  for (let k = 0; k < outline.length; k += 6) {
    if (isSpace ? seen.has(name(k)) : count.get(name(k)) > 1) continue;
    seen.add(name(k));
    kept.push(...outline.subarray(k, k + 6));
  }
  return Float32Array.from(kept);
}
