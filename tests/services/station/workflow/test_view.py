"""What the workflow reads from the presses of one step."""

from services.station.press import Press
from services.station.workflow.action import Action
from services.station.workflow.view import View


def test_presses_of_other_parts_of_the_station_are_no_actions_of_the_workflow():
    view = View(1.0, 1, presses=(Press("stop"), Press("execute"), Press("give_input")))
    assert view.actions == {Action.EXECUTE}


def test_the_argument_is_that_of_the_newest_press():
    view = View(1.0, 1, presses=(Press("undo", "3"), Press("execute"), Press("undo", "5")))
    assert view.argument(Action.UNDO) == "5"
    assert view.argument(Action.EXECUTE) == view.argument(Action.FINISH) == ""
