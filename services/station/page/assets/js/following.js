// Keys that follow the view: where the person asks for it, forward is forward as s/he sees it, in whichever view is the
// large one. The station's device turns its axes once everything was let go.

const STEP = 0.01; // [rad]

export class Following {
  // liveView: that tells which way one looks in it.
  constructor(liveView) {
    this.liveView = liveView;
    this.scene = document.querySelector(".scene");
    this.button = document.querySelector(".follow");
    this.button.addEventListener("click", ({ detail }) => {
      this.button.setAttribute("aria-pressed", String(!this.isOn));
      if (detail > 0) this.button.blur();
    });
  }

  get isOn() {
    return this.button.getAttribute("aria-pressed") === "true";
  }

  // By how much the person's axes are turned to the left of the robot's [rad].
  get yaw() {
    if (!this.isOn) return 0;
    const { main } = this.scene.dataset;
    const yaw = main === "live" ? this.liveView.yaw : Number(document.querySelector(`[data-camera="${main}"]`).dataset.yaw);
    return Math.round(yaw / STEP) * STEP;
  }
}
