// SPDX-License-Identifier: MIT
export { Detector, findNeighbours, findPairs } from "./detector.js";
export { simdTarget } from "./module.js";
export { World } from "./world.js";
