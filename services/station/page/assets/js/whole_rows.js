// A list that scrolls is as high as whole rows are: none is cut through where there are more than there is room for.

export class WholeRows {
  // scroller: shows the rows; selector: of a row in it.
  constructor(scroller, selector) {
    Object.assign(this, { scroller, selector });
    new ResizeObserver(() => this.fit()).observe(scroller.parentElement);
    new MutationObserver(() => this.fit()).observe(scroller, { childList: true, subtree: true });
  }

  fit() {
    const { scroller } = this;
    scroller.style.maxHeight = "";
    const room = scroller.clientHeight;
    if (scroller.scrollHeight <= room + 1) return;
    const { top } = scroller.getBoundingClientRect();
    const ends = [...scroller.querySelectorAll(this.selector)]
      .map((row) => row.getBoundingClientRect().bottom - top + scroller.scrollTop)
      .filter((end) => end <= room + 1);
    if (ends.length > 0) scroller.style.maxHeight = `${Math.ceil(ends.at(-1))}px`;
  }
}
