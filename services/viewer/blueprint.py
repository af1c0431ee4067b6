"""How the recording is laid out: the scene large, cameras and numbers beside it, below it what holds and happened."""

from __future__ import annotations

from collections.abc import Sequence

import rerun as rr
import rerun.blueprint as rrb

from services.viewer import entities, palette
from sim.tasks.scene import Eye

_WINDOW_S = 20.0


def blueprint(eye: Eye, cameras: Sequence[str]) -> rrb.Blueprint:
    """The layout of every recording; the panels around it are hidden, the time line is collapsed.

    Args:
        eye: from where the scene is seen at first.
        cameras: their names.
    """
    return rrb.Blueprint(
        rrb.Horizontal(
            rrb.Vertical(
                _scene(eye),
                rrb.Horizontal(
                    _states("Operator and robot", entities.STATES_LOOP),
                    rrb.Vertical(
                        _states("Teaching", entities.STATES_TEACHING),
                        rrb.Tabs(
                            _journal(),
                            rrb.TextDocumentView(origin=entities.ATTEMPTS, name="Attempts"),
                            active_tab=0,
                        ),
                        row_shares=[1.3, 1],
                    ),
                    column_shares=[1.1, 1],
                ),
                row_shares=[1.4, 1],
            ),
            rrb.Vertical(
                rrb.Tabs(
                    rrb.Grid(*(_camera(name) for name in cameras), grid_columns=2, name="Cameras"),
                    rrb.Spatial2DView(origin=entities.DEPTH, name="Depth", background=palette.BACKGROUND),
                    active_tab=0,
                ),
                rrb.Tabs(
                    _series("Hand", entities.MASTER_DISPLACEMENT),
                    _series("Rotation", entities.MASTER_ROTATION),
                    _series("Force", entities.MASTER_FORCE),
                    _series("Axes", entities.INPUT),
                    active_tab=0,
                ),
                rrb.Tabs(
                    _series("Correction", entities.CORRECTION_OFFSET),
                    _series("Turn", entities.CORRECTION_TURN),
                    _series("Commanded, measured", entities.SERIES_FOLLOWING),
                    _series("Joints", entities.JOINTS),
                    _series("Gripper", entities.OPENING),
                    active_tab=0,
                ),
                rrb.Tabs(
                    _series("Error", entities.POSITION_ERROR),
                    _series("Of orientation", entities.ORIENTATION_ERROR),
                    _series("Of the object as seen", entities.OBJECT_ERROR),
                    active_tab=0,
                ),
                rrb.Tabs(
                    _series("Self-distance", entities.SELF_DISTANCE),
                    _series("Latency", entities.SERIES_LATENCY),
                    active_tab=0,
                ),
                row_shares=[1.3, 1, 1, 1, 0.8],
            ),
            column_shares=[1.9, 1],
        ),
        rrb.TimePanel(state="collapsed", timeline=entities.TIMELINE, play_state="following"),
        rrb.BlueprintPanel(state="collapsed"),
        rrb.SelectionPanel(state="collapsed"),
        auto_layout=False,
        auto_views=False,
    )


def _scene(eye: Eye) -> rrb.Spatial3DView:
    return rrb.Spatial3DView(
        origin=entities.WORLD,
        contents=["$origin/**", f"{entities.ROBOT}/**", f"- {entities.COLLISION_SHAPES}/**"],
        name="Robot and scene",
        background=palette.BACKGROUND,
        line_grid=rrb.LineGrid3D(visible=True, spacing=0.5, color=0x242A33FF),
        spatial_information=rrb.SpatialInformation(
            target_frame=f"tf#{entities.WORLD}", show_axes=False, show_bounding_box=False
        ),
        eye_controls=rrb.EyeControls3D(
            kind=rrb.Eye3DKind.Orbital, position=eye.position, look_target=eye.target, eye_up=(0, 0, 1)
        ),
    )


def _camera(name: str) -> rrb.Spatial2DView:
    return rrb.Spatial2DView(
        origin=f"{entities.CAMERAS}/{name}", name=f"{name.capitalize()} camera", background=palette.BACKGROUND
    )


def _states(name: str, origin: str) -> rrb.StateTimelineView:
    window = rrb.TimeRange(
        start=rrb.TimeRangeBoundary.cursor_relative(seconds=-_WINDOW_S), end=rrb.TimeRangeBoundary.cursor_relative()
    )
    return rrb.StateTimelineView(
        origin=origin,
        name=name,
        time_ranges=_window(),
        time_view=rrb.archetypes.TimeAxis(view_range=window),
    )


def _journal() -> rrb.TextLogView:
    return rrb.TextLogView(
        origin=entities.JOURNAL,
        name="Journal",
        columns=rrb.TextLogColumns(timeline_columns=[entities.TIMELINE], text_log_columns=["loglevel", "body"]),
    )


def _series(name: str, origin: str) -> rrb.TimeSeriesView:
    return rrb.TimeSeriesView(
        origin=origin,
        name=name,
        time_ranges=_window(),
        plot_legend=rrb.PlotLegend(rr.blueprint.Corner2D.LeftTop),
    )


def _window() -> rrb.VisibleTimeRange:
    return rrb.VisibleTimeRange(
        entities.TIMELINE,
        start=rrb.TimeRangeBoundary.cursor_relative(seconds=-_WINDOW_S),
        end=rrb.TimeRangeBoundary.cursor_relative(),
    )
