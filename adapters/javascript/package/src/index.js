// SPDX-License-Identifier: MIT
export { Detector, findPairs } from "./detector.js";
export { simdTarget } from "./module.js";
export { World } from "./world.js";
