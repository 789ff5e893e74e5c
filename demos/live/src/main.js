// SPDX-License-Identifier: MIT
import { serveBeside } from "./beside_worker.js";
import { Live } from "./live.js";
import { serveSteps } from "./step_worker.js";

function showPage() {
  const live = new Live();
  const loop = (now) => {
    requestAnimationFrame(loop);
    live.tick(now);
  };
  requestAnimationFrame(loop);
  // For tests.
  window.boxstreamLive = live;
}

const parts = { steps: serveSteps, beside: serveBeside };
(parts[globalThis.document ? "" : self.name] ?? showPage)();
