// SPDX-License-Identifier: MIT
import { CanvasTexture, CircleGeometry, Color, DirectionalLight, Fog, Group, HemisphereLight, Mesh, MeshBasicMaterial, MeshStandardMaterial, RepeatWrapping, Scene, Vector3 } from "three";

/** A number of squares from side to side: a texture, since lines are no wider near than far. */
function squares(cells) {
  const size = 256;
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = size;
  const context = canvas.getContext("2d");
  context.fillRect(0, 0, size, size);
  context.strokeStyle = "#ffffff";
  context.lineWidth = 4;
  context.strokeRect(0, 0, size, size);
  const texture = new CanvasTexture(canvas);
  texture.wrapS = texture.wrapT = RepeatWrapping;
  texture.repeat.set(cells, cells);
  texture.anisotropy = 8;
  return texture;
}

/** Light, sky and ground around a world. */
export class Stage {
  /** `bounds`: of what there is to see; `floor`: the height to stand on; `isDrawn`: something in the scene is that floor. */
  constructor(bounds, floor, isDrawn) {
    this.scene = new Scene();
    this.size = bounds.getSize(new Vector3()).length();
    const middle = bounds.getCenter(new Vector3());
    this.scene.background = new Color();
    this.scene.fog = new Fog(0, this.size * 2.2, this.size * 6);
    this.light = new HemisphereLight(0xf4f8ff, 0xa39c90, 1.7);
    this.scene.add(this.light, ...this.sun(middle), this.ground(this.size * 6, middle, floor, isDrawn));
  }

  sun(middle) {
    const { size } = this;
    const sun = new DirectionalLight(0xfff4e5, 2.4);
    sun.castShadow = true;
    sun.shadow.mapSize.set(2048, 2048);
    sun.shadow.bias = -0.0006;
    sun.shadow.normalBias = size / 2500;
    sun.position.copy(middle).addScaledVector(new Vector3(0.45, 1, 0.3).normalize(), size);
    sun.target.position.copy(middle);
    Object.assign(sun.shadow.camera, { left: -size * 0.6, bottom: -size * 0.6, right: size * 0.6, top: size * 0.6, near: size * 0.1, far: size * 2.2 });
    sun.shadow.camera.updateProjectionMatrix();
    return [sun, sun.target];
  }

  ground(radius, middle, height, isDrawn) {
    const group = new Group();
    this.disc = new MeshStandardMaterial({ roughness: 1 });
    const disc = new Mesh(new CircleGeometry(radius, 64).rotateX(-Math.PI / 2), this.disc);
    disc.receiveShadow = true;
    disc.visible = !isDrawn;
    const cell = 10 ** Math.floor(Math.log10(this.size / 6));
    this.lines = new MeshBasicMaterial({ opacity: 0.4, alphaMap: squares((2 * radius) / cell), transparent: true, depthWrite: false });
    const grid = new Mesh(disc.geometry, this.lines);
    grid.position.y = radius / 20000;
    group.add(disc, grid);
    group.position.set(Math.round(middle.x / cell) * cell, height - (isDrawn ? 0 : radius / 20000), Math.round(middle.z / cell) * cell);
    return group;
  }

  /** Colours that the page has too. */
  paint({ sky, ground, grid, dark }) {
    this.scene.background.set(sky);
    this.scene.fog.color.set(sky);
    this.disc.color.set(ground);
    this.lines.color.set(grid);
    this.light.intensity = dark ? 1.1 : 1.7;
  }
}
