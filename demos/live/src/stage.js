// SPDX-License-Identifier: MIT
import { Color, Scene, WebGLRenderer } from "three";
import { Boxes } from "./boxes.js";
import { Camera } from "./camera.js";
import { watchClicks } from "./pick.js";

/** What there is to see: the boxes of the last frame, or what they share. */
export class Stage {
  constructor(canvas, onPick) {
    this.canvas = canvas;
    this.renderer = new WebGLRenderer({ canvas, antialias: true, powerPreference: "high-performance" });
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    this.scene = new Scene();
    this.scene.background = new Color();
    this.boxes = new Boxes(this.scene);
    this.shared = new Boxes(this.scene);
    this.shared.uniforms.shared.value = 1;
    this.shared.uniforms.edges.value = 0;
    this.camera = new Camera(canvas);
    this.frame = null;
    this.drawn = 0;
    this.camera.controls.addEventListener("change", () => (this.stale = true));
    watchClicks(canvas, this.camera.lens, () => this.frame?.boxes ?? [], onPick);
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement);
    this.repaint();
    this.resize();
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.canvas.parentElement;
    const head = this.canvas.parentElement.querySelector("header");
    this.renderer.setSize(width, height, false);
    this.camera.resize(width, height, head.offsetWidth > 0.8 * width ? head.offsetHeight : 0);
    this.stale = true;
  }

  /** Takes the colours of the theme. */
  repaint() {
    const style = getComputedStyle(this.canvas);
    const colour = (name) => style.getPropertyValue(name).trim();
    const colours = { touching: ["--touching-1", "--touching-2", "--touching-3"].map(colour), idle: colour("--idle"), fog: colour("--sky"), chosen: colour("--chosen") };
    this.scene.background.set(colours.fog);
    for (const boxes of [this.boxes, this.shared]) boxes.paint(colours);
    this.stale = true;
  }

  /** `view`: of settings.js. Returns the frame before, whose arrays are free. */
  show(frame, view, selected) {
    const before = this.frame;
    this.frame = frame;
    if (frame.frame === 1) this.camera.fit(frame.boxes, frame.drift);
    this.camera.follow(frame.drift);
    this.boxes.set(frame.boxes, frame.marks);
    this.boxes.uniforms.glowing.value = Number(view === "begun");
    this.boxes.uniforms.dimmed.value = Number(view === "overlaps" || selected >= 0);
    this.shared.mesh.visible = Boolean(frame.overlaps?.length);
    if (this.shared.mesh.visible) this.shared.set(frame.overlaps);
    this.stale = true;
    return before;
  }

  fit() {
    if (this.frame) this.camera.fit(this.frame.boxes, this.frame.drift);
  }

  /** Draws, if there is anything new to see. */
  draw() {
    this.camera.controls.update();
    if (!this.stale) return;
    this.stale = false;
    const reach = this.camera.distance;
    for (const boxes of [this.boxes, this.shared]) boxes.uniforms.reach.value = reach;
    this.renderer.render(this.scene, this.camera.lens);
    ++this.drawn;
  }
}
