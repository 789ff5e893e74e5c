// SPDX-License-Identifier: MIT
// The contests in a browser, whose results go back to the server of the page.
import * as boxstream from "boxstream";
import { contest } from "./contest.js";

const wanted = await (await fetch("/wanted.json")).json();
const send = (path, body) => fetch(path, { method: "POST", body: JSON.stringify(body) });
try {
  for (const name of wanted.data) for (const n of wanted.sizes) await send("/result", contest(boxstream, name, n, wanted.seconds, () => performance.now()));
  await send("/end", { agent: navigator.userAgent });
} catch (error) {
  await send("/end", { error: String(error) });
}
