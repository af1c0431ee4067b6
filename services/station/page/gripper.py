"""The page's region of the gripper, where it takes part: what is asked of it, what was measured, what it holds."""

from __future__ import annotations

from services.station.gripper import may_be_asked
from services.station.page.readout import length
from services.station.page.values import Values
from services.station.page.view import Shown
from services.station.words.table import say

_HALF = 0.5


def gripper(shown: Shown) -> Values:
    """Everything that is shown of it; where it takes no part it is not there."""
    view = shown.view
    robot, wide = view.robot, view.wide_open
    if robot is None or wide <= 0.0:
        return {"gripper@hidden": True}
    measured, told = (_share(opening, wide) for opening in (robot.opening, robot.opening_reference))
    stands = told if view.opening is None else view.opening
    able = view.authority_is_mine and may_be_asked(robot)
    does = "close" if stands > _HALF else "open"
    return {
        "gripper@hidden": False,
        "gripper@data-share": f"{stands:.3f}",
        "gripper@data-asked": "no" if view.opening is None else "yes",
        "gripper@data-holds": "yes" if robot.grasped else "no",
        "gripper-measured@--at": f"{measured:.3f}",
        "action-grip@disabled": not able,
        "action-grip@title": say(f"gripper.{does}_key"),
        "action-opening@disabled": not able,
        "gripper-does": say(f"gripper.{does}"),
        "gripper-text": _words(view.opening, wide, robot.opening, holds=robot.grasped),
    }


def _share(opening: float, wide: float) -> float:
    return min(max(opening / wide, 0.0), 1.0)


def _words(asked: float | None, wide: float, measured: float, *, holds: bool) -> str:
    """What was asked beside what was measured."""
    is_ = length(max(measured, 0.0))
    words = say("gripper.moves", measured=is_)
    if asked is not None:
        words = say("gripper.asked", asked=length(asked * wide), measured=is_)
    return say("gripper.holds", words=words) if holds else words
