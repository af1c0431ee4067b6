"""A task file of a person's own, outside the project, by its path: the loop closes in it with any robot."""

import pytest

from services.commands.task.new import EXAMPLE
from tests.system.harness import Command, configured, free_endpoint

pytestmark = [pytest.mark.system, pytest.mark.zenoh, pytest.mark.sim, pytest.mark.alone, pytest.mark.long]

WITHIN_S = 240.0


@pytest.mark.parametrize("robot", ["tiago", "panda"])
def test_the_loop_closes_in_a_task_that_lies_anywhere(tmp_path, robot):
    path = tmp_path / "elsewhere" / "mine.toml"
    path.parent.mkdir()
    path.write_text(EXAMPLE.read_text(encoding="utf-8"))
    up = ("up", "--fresh", "--headless", "--once", "--task", str(path), "--robot-model", robot)
    with Command(*up, "--config", configured(tmp_path, free_endpoint()), folder=tmp_path) as command:
        assert command.ended(WITHIN_S) == 0, command.tail()
    assert "in mine wall" in command.out, "it goes by the name that its file says"
