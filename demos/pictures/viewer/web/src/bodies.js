// SPDX-License-Identifier: MIT
import { BufferAttribute, BufferGeometry, Color, DoubleSide, DynamicDrawUsage, FrontSide, InstancedBufferAttribute, InstancedMesh, Mesh, MeshStandardMaterial, Sphere } from "three";
import { geometryOf, groupsOf } from "./solids.js";

// Bodies that fewer than this many share the picture with throw shadows.
const mostWithShadows = 12000;

/** One draw call: all items of one geometry. */
class Group {
  constructor({ form, items }, run, transparent) {
    const smooth = items.every((item) => run.states[item.object] === 0);
    this.items = items;
    this.objects = Uint32Array.from(items, (item) => item.object);
    // Most items stand where their object does.
    this.local = items.map(({ place, rotation }) => (place.some((x) => x !== 0) || rotation[3] !== 1 ? [...place, ...rotation] : null));
    // Terrain is often open, and then has a back.
    const side = smooth && form.kind === "triangles" ? DoubleSide : FrontSide;
    const material = new MeshStandardMaterial({ roughness: 0.72, metalness: 0, side });
    if (transparent) Object.assign(material, { transparent: true, opacity: 0.22, depthWrite: false });
    this.mesh = new InstancedMesh(geometryOf(form, items.length, smooth), material, items.length);
    this.mesh.instanceMatrix.setUsage(DynamicDrawUsage);
    this.mesh.instanceColor = new InstancedBufferAttribute(new Float32Array(3 * items.length), 3).setUsage(DynamicDrawUsage);
    this.mesh.frustumCulled = false;
    this.mesh.boundingSphere = new Sphere(undefined, Infinity); // of picking
    this.mesh.castShadow = run.parts.length <= mostWithShadows && !transparent && form.kind !== "plane";
    this.mesh.receiveShadow = run.parts.length <= mostWithShadows && !transparent;
    this.mesh.userData.objects = this.objects;
  }

  place(poses) {
    const out = this.mesh.instanceMatrix.array;
    for (let i = 0; i < this.objects.length; ++i) compose(out, 16 * i, poses, this.objects[i], this.items[i].scale, this.local[i]);
    this.mesh.instanceMatrix.needsUpdate = true;
  }

  paint(colours) {
    const out = this.mesh.instanceColor.array;
    for (let i = 0; i < this.objects.length; ++i) {
      const from = 3 * this.objects[i];
      out[3 * i] = colours[from];
      out[3 * i + 1] = colours[from + 1];
      out[3 * i + 2] = colours[from + 2];
    }
    this.mesh.instanceColor.needsUpdate = true;
  }
}

/** Writes the matrix of a part: its object's pose, then its own, then its scale. */
function compose(out, at, poses, object, scale, local) {
  const { places: p, rotations: q } = poses;
  let x = q[4 * object];
  let y = q[4 * object + 1];
  let z = q[4 * object + 2];
  let w = q[4 * object + 3];
  let px = p[3 * object];
  let py = p[3 * object + 1];
  let pz = p[3 * object + 2];
  if (local) {
    const [lx, ly, lz, rx, ry, rz, rw] = local;
    const cx = 2 * (y * lz - z * ly);
    const cy = 2 * (z * lx - x * lz);
    const cz = 2 * (x * ly - y * lx);
    px += lx + w * cx + y * cz - z * cy;
    py += ly + w * cy + z * cx - x * cz;
    pz += lz + w * cz + x * cy - y * cx;
    const [ox, oy, oz, ow] = [x, y, z, w];
    x = ow * rx + ox * rw + oy * rz - oz * ry;
    y = ow * ry - ox * rz + oy * rw + oz * rx;
    z = ow * rz + ox * ry - oy * rx + oz * rw;
    w = ow * rw - ox * rx - oy * ry - oz * rz;
  }
  // What is not in the world has no size.
  const there = poses.visible[object];
  const sx = scale[0] * there;
  const sy = scale[1] * there;
  const sz = scale[2] * there;
  out[at] = (1 - 2 * (y * y + z * z)) * sx;
  out[at + 1] = 2 * (x * y + z * w) * sx;
  out[at + 2] = 2 * (x * z - y * w) * sx;
  out[at + 3] = 0;
  out[at + 4] = 2 * (x * y - z * w) * sy;
  out[at + 5] = (1 - 2 * (x * x + z * z)) * sy;
  out[at + 6] = 2 * (y * z + x * w) * sy;
  out[at + 7] = 0;
  out[at + 8] = 2 * (x * z + y * w) * sz;
  out[at + 9] = 2 * (y * z - x * w) * sz;
  out[at + 10] = (1 - 2 * (x * x + y * y)) * sz;
  out[at + 11] = 0;
  out[at + 12] = there ? px : 0;
  out[at + 13] = there ? py : 0;
  out[at + 14] = there ? pz : 0;
  out[at + 15] = 1;
}

const sensor = 5;

/** All bodies but soft ones. `reach`: half the size of planes, which have no end. */
export class Bodies {
  constructor(run, scene, reach, isWall) {
    const groups = [];
    for (const { form, items } of groupsOf(run)) {
      if (form.kind === "plane") for (const item of items) item.scale = [reach, 1, reach];
      const sensors = items.filter((item) => run.states[item.object] === sensor);
      const rest = items.filter((item) => run.states[item.object] !== sensor);
      // Walls can be in the way, and then are hidden one by one.
      const walls = rest.filter((item) => isWall(form, item));
      const others = rest.filter((item) => !isWall(form, item));
      if (others.length) groups.push(new Group({ form, items: others }, run, false));
      if (sensors.length) groups.push(new Group({ form, items: sensors }, run, true));
      for (const wall of walls) {
        const group = new Group({ form, items: [wall] }, run, false);
        group.wall = wall;
        groups.push(group);
      }
    }
    this.groups = groups;
    this.walls = groups.filter((group) => group.wall);
    scene.add(...groups.map((group) => group.mesh));
  }

  place(poses) {
    for (const group of this.groups) group.place(poses);
  }
  paint(colours) {
    for (const group of this.groups) group.paint(colours);
  }
  /** For picking. */
  meshes() {
    return this.groups.filter((group) => group.mesh.visible).map((group) => group.mesh);
  }
}

/** Soft bodies: surfaces whose vertices come with each frame. */
export class SoftBodies {
  constructor(run, scene) {
    this.parts = run.softParts.map((part) => {
      const geometry = new BufferGeometry();
      geometry.setAttribute("position", new BufferAttribute(new Float32Array(3 * part.count), 3).setUsage(DynamicDrawUsage));
      geometry.setIndex(part.triangles.flat());
      const mesh = new Mesh(geometry, new MeshStandardMaterial({ roughness: 0.8, side: DoubleSide }));
      mesh.frustumCulled = false;
      mesh.castShadow = mesh.receiveShadow = true;
      mesh.userData.objects = [part.object];
      scene.add(mesh);
      return { mesh, first: 3 * (run.states.length + part.first), object: part.object };
    });
  }

  place(poses) {
    for (const { mesh, first, object } of this.parts) {
      const position = mesh.geometry.getAttribute("position");
      position.array.set(poses.places.subarray(first, first + position.array.length));
      position.needsUpdate = true;
      mesh.geometry.computeVertexNormals();
      mesh.geometry.boundingSphere = null;
      mesh.visible = poses.visible[object] === 1;
    }
  }

  paint(colours) {
    for (const { mesh, object } of this.parts) mesh.material.color = new Color().fromArray(colours, 3 * object);
  }

  meshes() {
    return this.parts.map(({ mesh }) => mesh);
  }
}
