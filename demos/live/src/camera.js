// SPDX-License-Identifier: MIT
import { PerspectiveCamera, Vector3 } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";

const sample = 2000;

/** The middle and the half extent of the crowd: twice the middle half of all ends of boxes, so that strays do not count. */
export function crowdOf(boxes) {
  const stride = Math.max(1, Math.floor(boxes.length / 6 / sample));
  const axis = (d) => {
    const ends = [];
    for (let i = d; i < boxes.length; i += 6 * stride) ends.push(boxes[i], boxes[i + 3]);
    ends.sort((a, b) => a - b);
    const [low, high] = [ends[ends.length >> 2], ends[(3 * ends.length) >> 2]];
    return [(low + high) / 2, Math.min(high - low, (ends.at(-1) - ends[0]) / 2)];
  };
  const axes = [0, 1, 2].map(axis);
  return { middle: new Vector3(...axes.map(([middle]) => middle)), half: Math.max(1e-6, ...axes.map(([, half]) => half)) };
}

/** A camera that turns around the crowd. */
export class Camera {
  constructor(canvas) {
    this.lens = new PerspectiveCamera(38, 1, 0.1, 1000);
    this.controls = new OrbitControls(this.lens, canvas);
    this.controls.enableDamping = true;
    this.controls.dampingFactor = 0.1;
    this.controls.autoRotateSpeed = 0.5;
    this.drift = 0;
  }

  /** Looks at the crowd; from where it was before, unless it is the first time. */
  fit(boxes, drift) {
    const { middle, half } = crowdOf(boxes);
    const { target } = this.controls;
    const from = this.size ? this.lens.position.clone().sub(target) : new Vector3(0.72, 0.42, 0.9);
    this.size = half * Math.sqrt(3);
    const room = Math.tan((this.lens.fov * Math.PI) / 360) * Math.min(this.lens.aspect, this.tall);
    target.copy(middle);
    this.lens.position.copy(middle).addScaledVector(from.normalize(), (0.97 * this.size) / Math.sin(Math.atan(room)));
    this.lens.near = this.size / 1000;
    this.lens.far = this.size * 50;
    this.lens.updateProjectionMatrix();
    this.controls.maxDistance = this.size * 20;
    this.drift = drift;
    this.controls.update();
  }

  /** Falls with what falls. */
  follow(drift) {
    const by = drift - this.drift;
    this.drift = drift;
    this.controls.target.y += by;
    this.lens.position.y += by;
  }

  /** `covered`: pixels at the top where other things stand. */
  resize(width, height, covered) {
    this.tall = 1 - covered / height;
    this.lens.aspect = width / height;
    this.lens.setViewOffset(width, height, 0, -covered / 2, width, height);
  }

  get distance() {
    return this.lens.position.distanceTo(this.controls.target);
  }
}
