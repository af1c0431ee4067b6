"""What the tests run in a page, in any browser."""

TOURED = "localStorage.setItem('retouch-tour', 'seen');"
"""The tour was seen already."""

SEATED = "sessionStorage.setItem('retouch-seat', 'the-seat-of-all-tests');"
"""The station knows the tab again: nobody inherits a seat, and no test is to wait until one is free."""

UNDRAWN = """
    const get = HTMLCanvasElement.prototype.getContext;
    HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
        return kind === "webgl2" ? null : get.call(this, kind, ...rest);
    };
"""
"""As in a browser that cannot draw in three dimensions."""

WATCHED = """
    window.pointed = [];
    for (const kind of ["pointerdown", "pointerup", "pointercancel", "click"]) {
        window.addEventListener(kind, ({ target, timeStamp }) => window.pointed.push(
            `${kind} at ${Math.round(timeStamp)} ms on ${target.closest?.("button")?.className ?? target.className}`,
        ), { capture: true });
    }
"""
TOLD = """() => ({
    link: document.body.dataset.link,
    banners: [...document.querySelectorAll(".banner")].filter((e) => e.checkVisibility()).map((e) => e.innerText),
    pointed: window.pointed.slice(-8),
    now: Math.round(performance.now()),
})"""
"""What a tab knows of presses: whether it has a link, what it told its person was not done, what was pointed at."""

VIOLATIONS = """async () => (await axe.run({ resultTypes: ["violations"] })).violations.map(
    ({ id, nodes }) => `${id}: ${nodes.map(({ target, any }) => `${target} ${any.map((a) => a.message)}`)}`)"""
"""What axe-core, once it is loaded, finds."""
