// SPDX-License-Identifier: MIT
import { Beside } from "./beside.js";
import { History } from "./history.js";
import { watchKeys } from "./keys.js";
import { Panel, element } from "./panel.js";
import { Plot, budget } from "./plot.js";
import { RaceTable, raceNames } from "./race_table.js";
import { Report, sayChecked, sayUnchecked, sayWaiting, showAlarm, showFailure, showObject } from "./report.js";
import { fragmentOf, peers, settingsOf } from "./settings.js";
import { Stage } from "./stage.js";
import { Steps } from "./steps.js";
import { applyTheme, themeOf, watchSystemTheme } from "./theme.js";

const ofBoxes = ["n", "input", "motion", "seed"]; // settings that make other boxes
const ofFrames = ["size", "engine", "view"]; // settings that show in the next frame

/** The page: settings in, frames out. */
export class Live {
  constructor() {
    this.settings = settingsOf(location.hash);
    applyTheme(this.settings.theme);
    this.selected = -1;
    this.due = 0;
    this.history = new History(raceNames);
    this.report = new Report();
    this.stage = new Stage(element("scene"), (box) => this.select(box));
    this.plot = new Plot(element("plot"), this.history, Object.fromEntries(raceNames.map((name) => [name, { dots: peers.includes(name) }])));
    this.steps = new Steps((frame) => this.receive(frame), (message) => this.fail(message));
    this.beside = new Beside((result) => this.checked(result), () => this.gaveUp());
    this.table = new RaceTable(this, this.history);
    this.panel = new Panel(this);
    this.watch();
    this.begin();
    this.follow();
  }

  watch() {
    watchKeys(this);
    watchSystemTheme(() => this.follow());
    addEventListener("hashchange", () => this.change(settingsOf(location.hash)));
    const actions = {
      pause: () => this.change({ paused: !this.settings.paused }),
      next: () => this.single(),
      fit: () => this.stage.fit(),
      turn: () => this.change({ turn: !this.settings.turn }),
      theme: () => this.otherTheme(),
      share: () => this.share(),
      help: () => element("helptext").showModal(),
      closehelp: () => element("helptext").close(),
      all: () => this.race(),
      spoil: () => this.spoil(),
      dismiss: () => this.dismiss(),
    };
    for (const [id, act] of Object.entries(actions)) element(id).addEventListener("click", act);
  }

  /** Some settings, as controls, keys and the address change them. */
  change(some) {
    const before = this.settings;
    this.settings = { ...before, ...some };
    history.replaceState(null, "", fragmentOf(this.settings));
    const changed = (name) => this.settings[name] !== before[name];
    if (changed("size")) this.beside.forgive();
    if (ofBoxes.some(changed)) this.begin();
    else if (ofFrames.some(changed)) this.single();
    this.follow();
  }

  /** Other boxes. */
  begin() {
    this.select(-1);
    this.steps.begin(this.settings);
    this.beside.reset();
    this.lastCheck = null;
    this.history.clear();
    this.report.clear();
    this.single();
    sayWaiting();
  }

  /** Brings everything that does not depend on boxes in line with the settings. */
  follow() {
    const { settings, stage } = this;
    applyTheme(settings.theme);
    stage.repaint();
    stage.camera.controls.autoRotate = settings.turn && !settings.paused;
    this.panel.update();
    this.table.update();
  }

  single() {
    this.once = true;
  }

  select(box) {
    this.selected = box;
    element("object").hidden = box < 0;
    this.single();
  }

  /** Lets a package race, or stops it; without a name, all of them. */
  race(name) {
    const { peers: racing } = this.settings;
    const all = name === undefined;
    const next = all ? (racing.length === peers.length ? [] : peers) : racing.includes(name) ? racing.filter((one) => one !== name) : [...racing, name];
    this.change({ peers: peers.filter((one) => next.includes(one)) });
  }

  spoil() {
    this.spoiling = true;
    this.beside.hurry();
    this.single();
  }

  otherTheme() {
    this.change({ theme: themeOf(this.settings.theme) === "dark" ? "light" : "dark" });
  }

  async share() {
    await navigator.clipboard?.writeText(location.href).catch(() => {});
    element("share").textContent = "Copied";
    setTimeout(() => (element("share").textContent = "Link"), 1500);
  }

  /** Once for each picture of the display. */
  tick(now) {
    // A display may be faster than 60 pictures a second; the boxes are not.
    const running = !this.settings.paused && now >= this.due - 4;
    if ((running || this.once) && !this.steps.busy && element("alarm").hidden) this.ask(now);
    this.stage.draw();
    this.report.show(now, this.settings);
    this.plot.draw(now);
    if (now - (this.tabled ?? 0) > 250) this.table.update((this.tabled = now));
  }

  ask(now) {
    this.due = Math.max(this.due + budget, now);
    this.once = false;
    const { engine, size, view, n, peers: racing } = this.settings;
    const name = this.beside.next(now, n, racing);
    if (!name && !this.beside.checker(n)) sayUnchecked();
    this.job = { name, spoiled: Boolean(name && this.spoiling) };
    if (name) this.spoiling = false;
    this.steps.ask({ engine, size, selected: this.selected, overlaps: view === "overlaps", snapshot: Boolean(name), spoil: this.job.spoiled });
  }

  receive(frame) {
    const now = performance.now();
    element("loading").hidden = true;
    this.steps.recycle(this.stage.show(frame, this.settings.view, this.selected));
    this.frames = (this.frames ?? 0) + 1;
    this.report.add(frame, now);
    if (frame.times.world) this.history.add("World", now, frame.times.world);
    if (frame.times.search) this.history.add("findPairs", now, frame.times.search);
    showObject(this.selected, frame);
    if (frame.snapshot) this.compare(frame);
  }

  compare({ frame, snapshot }) {
    this.beside.start(this.job.name, snapshot, { frame, spoiled: this.job.spoiled });
  }

  checked(result) {
    this.lastCheck = result;
    if (peers.includes(result.name) && this.settings.peers.includes(result.name)) this.history.add(result.name, performance.now(), result.time);
    sayChecked(result);
    if (result.missing + result.extra > 0) showAlarm({ ...result, ...this.settings });
  }

  gaveUp() {
    this.table.update();
  }

  fail(message) {
    showFailure(message);
    this.change({ paused: true });
    this.steps.restart();
  }

  dismiss() {
    element("alarm").hidden = true;
    sayWaiting();
  }
}
