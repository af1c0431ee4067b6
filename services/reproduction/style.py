"""How the report's plots look: one restrained style, and one colour for one thing.

The hues are Okabe and Ito's, which everybody can tell apart, dark enough for a light ground. Matplotlib is imported
where something is drawn: who only computes, as every run but the first does, has no use for it.
"""

from __future__ import annotations

import io
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any

from services.reproduction.analysis import Figure

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure as Canvas

CONDITIONED = "#d55e00"  # the thesis' model
ADAPTIVE = "#0072b2"  # the default model
LED = "#6b4c9a"  # a DMP
DEMONSTRATION = "#9aa4b1"
TRUTH = "#1f2630"
REFINEMENT = "#009e73"
OBSTACLE = "#c9a227"

WIDTH = 9.9  # [inch] of the report's text
_LEGEND_LETTERS = 150  # that fit in a row
_DPI = 150

_STYLE = {
    "font.family": "sans-serif",
    "font.sans-serif": ["DejaVu Sans"],
    "font.size": 8.5,
    "axes.titlesize": 9.0,
    "axes.titlelocation": "left",
    "axes.labelsize": 8.5,
    "axes.labelcolor": "#4a5462",
    "axes.edgecolor": "#c3cad3",
    "axes.linewidth": 0.8,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.axisbelow": True,
    "grid.color": "#e9edf1",
    "grid.linewidth": 0.8,
    "xtick.color": "#6b7685",
    "ytick.color": "#6b7685",
    "xtick.labelsize": 8.0,
    "ytick.labelsize": 8.0,
    "xtick.major.size": 0.0,
    "ytick.major.size": 0.0,
    "lines.linewidth": 1.6,
    "lines.solid_capstyle": "round",
    "legend.frameon": False,
    "legend.fontsize": 8.5,
    "text.color": "#1f2630",
    "figure.facecolor": "white",
    "svg.hashsalt": "retouch",
    "path.simplify_threshold": 0.2,
}


@dataclass(frozen=True)
class Line:
    """How a line is drawn: the wide one below, the narrow one above it, so that both are seen where they agree.

    Attributes:
        color: of the line.
        linewidth: [pt].
        linestyle: as Matplotlib knows it.
    """

    color: str
    linewidth: float
    linestyle: str | tuple[float, tuple[float, float]] = "-"

    def __call__(self, label: str | None = None) -> dict[str, Any]:
        """The arguments of `Axes.plot`."""
        return {**asdict(self), "label": label}


ANCHORED_LINE = Line("#e69f00", 2.4)
FINE_LINE = Line("#cc79a7", 2.0)
COARSE_LINE = Line("#56b4e9", 1.8)
TRUE_LINE = Line(TRUTH, 1.2, (0, (2, 2)))
DEMONSTRATION_LINE = Line(DEMONSTRATION, 1.0)


@contextmanager
def _styled() -> Iterator[None]:
    import matplotlib as mpl  # noqa: PLC0415 - as above

    with mpl.rc_context(_STYLE):  # type: ignore[arg-type]  # its stub wants literal keys
        yield


def panels(
    titles: Sequence[str], height: float = 2.7, *, rows: int = 1, solid: bool = False
) -> tuple[Canvas, list[Axes]]:
    """An empty canvas of panels, left to right and then down.

    Args:
        titles: of the panels; an empty one gives no title.
        height: of a row [inch].
        rows: that the panels are laid out in.
        solid: the axes are of three dimensions.
    """
    from matplotlib.figure import Figure as Canvas  # noqa: PLC0415 - as above

    columns = -(-len(titles) // rows)
    with _styled():
        canvas = Canvas(figsize=(WIDTH, height * rows), layout="constrained")
        kind = "3d" if solid else "rectilinear"
        axes = [canvas.add_subplot(rows, columns, i + 1, projection=kind) for i in range(len(titles))]
        for one, title in zip(axes, titles, strict=True):
            one.set_title(title)
    return canvas, axes


def drawn(canvas: Canvas, name: str, caption: str, *, raster: bool = False) -> Figure:
    """The finished figure: every label of its panels once, in a legend below them.

    Args:
        canvas: of `panels`.
        name: see `Figure`.
        caption: see `Figure`.
        raster: as PNG, for what has too many points for an SVG.
    """
    with _styled():
        entries: dict[str, Artist] = {}
        for axes in canvas.axes:
            handles, labels = axes.get_legend_handles_labels()
            entries |= zip(labels, handles, strict=True)
        if entries:
            widths = [len(label) + 8 for label in entries]  # in letters, with the sign before the label
            columns = len(widths) if sum(widths) <= _LEGEND_LETTERS else max(1, _LEGEND_LETTERS // max(widths))
            canvas.legend(list(entries.values()), list(entries), loc="outside lower center", ncols=columns)
        file = io.BytesIO()
        if raster:
            canvas.savefig(file, format="png", dpi=_DPI, metadata={"Software": None})
        else:
            canvas.savefig(file, format="svg", metadata={"Date": None, "Creator": None})
    return Figure(name, caption, file.getvalue())
