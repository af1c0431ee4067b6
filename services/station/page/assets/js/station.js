// The operator's page in the browser: the input state out at 50 Hz; pictures, and what to show, in.

import { Actions } from "/assets/js/actions.js";
import { Aim } from "/assets/js/aim.js";
import { Devices } from "/assets/js/devices.js";
import { Following } from "/assets/js/following.js";
import { Gripper } from "/assets/js/gripper.js";
import { Held } from "/assets/js/held.js";
import { Identity } from "/assets/js/identity.js";
import { History } from "/assets/js/history.js";
import { showInspection } from "/assets/js/inspection.js";
import { KeySetting } from "/assets/js/key_setting.js";
import { Keyboard, isSpace, isStop } from "/assets/js/keyboard.js";
import { Link } from "/assets/js/link.js";
import { CLOUD, LiveView, MOMENT } from "/assets/js/live_view.js";
import { Pictures } from "/assets/js/pictures.js";
import { Presses } from "/assets/js/presses.js";
import { Reasons } from "/assets/js/reasons.js";
import { showRobots } from "/assets/js/robots.js";
import { RoundTrip } from "/assets/js/round_trip.js";
import { Skills } from "/assets/js/skills.js";
import { swapOnPress } from "/assets/js/stages.js";
import { Tab } from "/assets/js/tab.js";
import { Timeline } from "/assets/js/timeline.js";
import { Tour } from "/assets/js/tour.js";
import { show } from "/assets/js/values.js";
import { Waypoints } from "/assets/js/waypoints.js";
import { WholeRows } from "/assets/js/whole_rows.js";

const INPUT_PERIOD_MS = 20;
const AGES_PERIOD_MS = 100;
const DRAW_PERIOD_MS = 40;
const IS_TYPED_IN = "input, textarea, select, [contenteditable]";
const STOPS = '[data-action="stop"], [data-action="stop_other"]';
const IS_PRESSED = "button, summary";

const tab = new Tab();
const presses = new Presses(tab);

// Before everything else that listens: nothing stands between a person and the stop.
window.addEventListener("keydown", stopByKey, { capture: true });
window.addEventListener("pointerdown", stopByHand, { capture: true });

const reasons = new Reasons(presses);
const actions = new Actions((button) => {
  if (button.dataset.question) reasons.ask(button);
  else presses.press(button.dataset.action, button.dataset.argument);
});
const aim = new Aim((button) => actions.ask(button), STOPS);
const waypoints = new Waypoints();
const roundTrip = new RoundTrip();
const pictures = new Pictures();
const keyboard = new Keyboard();
const keySetting = new KeySetting(keyboard, () => held.clear());
const devices = new Devices(() => changed());
const held = new Held(changed, () => devices.controllers());
const liveView = new LiveView((touch) => timeline.foresee(touch));
const following = new Following(liveView);
const timeline = new Timeline(
  (action, argument) => presses.press(action, argument),
  (part) => liveView.mark(part),
);
const gripper = new Gripper((action, argument) => presses.press(action, argument));
const history = new History(liveView, (action, argument) => presses.press(action, argument));
const skills = new Skills((action, argument) => presses.press(action, argument));
const link = new Link(tab, { onOpen, onNews, onFrame, onSilence });
presses.link = link;
const identity = new Identity(tab, link);

setInterval(say, INPUT_PERIOD_MS);
setInterval(showAges, AGES_PERIOD_MS);
setInterval(() => devices.draw(), DRAW_PERIOD_MS);
window.addEventListener("keydown", down, { capture: true });
window.addEventListener("keyup", up, { capture: true });
document.addEventListener("click", clicked);
swapOnPress();
new WholeRows(document.querySelector(".entries"), ".entry");
new WholeRows(document.querySelector(".waypoints"), ".waypoint");
new WholeRows(document.querySelector(".skills-list"), ".skills-row");
new Tour();

function onOpen() {
  pictures.restart();
  liveView.restart();
  say();
  presses.say();
}

function onNews(news) {
  presses.settle(news);
  show(news.values);
  identity.follow();
  actions.arrange();
  waypoints.show();
  devices.follow();
  timeline.follow();
  gripper.follow();
  roundTrip.hear(news.echo);
  liveView.show(news.drawing);
  history.show(news.history.listed);
  skills.show();
  showInspection();
  showRobots(tab);
  document.body.dataset.link = news.armed ? "armed" : "view-only";
  document.body.toggleAttribute("data-let-go", news.armed && news.let_go);
  document.body.toggleAttribute("data-renewed", news.version !== document.body.dataset.version);
  aim.look();
}

function onFrame(buffer) {
  const kind = new DataView(buffer).getUint8(0);
  if (kind === MOMENT) liveView.receive(buffer);
  else if (kind === CLOUD) liveView.receiveCloud(buffer);
  else pictures.receive(buffer, roundTrip.way);
}

function onSilence() {
  document.body.dataset.link = "offline";
}

function say() {
  const { drawn, clouds, wantsCloud } = liveView;
  const shown = { drawn: [drawn, clouds, ...pictures.drawn], picture_ms: pictures.age };
  const wanted = { cloud: wantsCloud, jpeg_only: pictures.jpegOnly };
  const when = { waited_ms: held.waited(), way_ms: roundTrip.told };
  link.sayHeld({ ...held.state(), ...shown, ...wanted, ...when, yaw: following.yaw });
}

function changed() {
  say();
  for (const key of document.querySelectorAll("[data-key]")) {
    key.toggleAttribute("data-held", held.keys.has(key.dataset.key));
  }
}

function stopByKey(event) {
  if (!isStop(event)) return;
  presses.press("stop");
  event.preventDefault?.();
}

// The stop counts when it is touched, not when it is let go.
function stopByHand({ target }) {
  const button = target.closest?.(STOPS);
  if (button) presses.press(button.dataset.action, button.dataset.argument);
}

function down(event) {
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  keyboard.learn(event);
  if (keySetting.takes(event)) return;
  const code = keyboard.nameOf(event);
  if (event.target?.closest?.(IS_TYPED_IN)) return;
  const pressed = event.target?.closest?.(IS_PRESSED);
  if (pressed && event.repeat && !keyboard.steers(code)) event.preventDefault?.();
  if (pressed && isSpace(event)) return;
  if (keyboard.steers(code) || isSpace(event)) event.preventDefault?.();
  if (event.repeat) return;
  if (isSpace(event)) actions.ask(document.querySelector('[data-action="finish"]'));
  if (timeline.shortcut(code) || gripper.shortcut(code)) return;
  held.press(code, event.timeStamp);
}

function up(event) {
  held.release(keyboard.nameOf(event), keyboard.placeOf(event) === "", event.timeStamp);
}

function clicked(event) {
  const figures = document.querySelector(".health");
  if (!figures.contains(event.target)) figures.open = false;
  const button = event.target.closest?.("[data-action]");
  if (!button) return;
  const byHand = event.detail > 0;
  if (!aim.hasCounted(event) && !(byHand && button.matches(STOPS))) actions.ask(button);
  // A button that was clicked does not keep the focus, so that Space is for Finish again.
  if (byHand) button.blur();
}

function showAges() {
  if (!link.alive) onSilence();
  presses.say();
  pictures.showAges();
}
