// Stopping to take part: two steps, at any moment.

import { ask } from "/assets/js/dialog.js";
import { say } from "/assets/js/words.js";

export function askToWithdraw(link) {
  const withdraw = (remove) => async () => (await link.act({ act: "withdraw", delete: remove })).refused;
  const second = () =>
    ask({
      heading: say("withdraw.data"),
      about: say("withdraw.data_text"),
      buttons: [
        [say("withdraw.go_on"), ""],
        [say("withdraw.keep"), "", withdraw(false)],
        [say("withdraw.delete"), "danger", withdraw(true)],
      ],
    });
  ask({
    heading: say("withdraw.heading"),
    about: say("withdraw.text"),
    buttons: [
      [say("withdraw.go_on"), ""],
      [say("withdraw.stop"), "danger", async () => void second()],
    ],
  });
}
