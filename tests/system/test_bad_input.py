"""What a person gets wrong is one line: what, where, and what would be right."""

import socket
from contextlib import ExitStack

import pytest

from services.process.exit_codes import Exit
from tests.system.harness import Command, Witness, configured, free_endpoint

pytestmark = [pytest.mark.system, pytest.mark.zenoh]

WITHIN_S = 60.0
NOT_A_DATABASE = b"this was a database once" * 100


def complaint(*arguments, folder, environment=None, code=Exit.BAD_INPUT):
    """The only line on standard error of a command that has to fail with this code; what it warned of stands before."""
    with Command(*arguments, folder=folder, environment=environment) as command:
        assert command.ended(WITHIN_S) == code, command.tail()
        assert command.left() == []
    assert "Traceback" not in command.out + command.err
    lines = [line for line in command.err.splitlines() if not line.startswith("WARNING ")]
    assert len(lines) == 1, command.tail()
    return lines[0]


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ((), ("COMMAND",)),
        (("frobnicate",), ("'frobnicate'", "station")),
        (("up", "--frobnicate"), ("--frobnicate", "--help")),
        (("up", "--seed", "many"), ("--seed", "whole number", "'many'")),
        (("up", "--seed", "-1"), ("--seed", "at least 0", "'-1'")),
        (("up", "--only", "robot,ghost"), ("--only", "'ghost'", "perception")),
        (("up", "--json", "nowhere/out.json"), ("--json", "nowhere", "does not exist")),
        (("up", "--json", "."), ("--json", "folder")),
        (("up", "--robot", "robot/one"), ("'robot/one'", "letters")),
        (("up", "--robot", "**"), ("'**'", "letters")),
        (("master", "--robot", ""), ("''", "letters")),
        (("echo", "**", "--count", "0"), ("--count", "0")),
        (("top", "--once", "--connect", "tcp://192.0.2.1:7447"), ("slash", "tcp/192.0.2.1:7447")),
        (("up", "--connect", "tcp/192.0.2.1"), ("no port", "tcp/192.0.2.1:7447")),
        (("up", "--listen", "tcp/0.0.0.0:7447"), ("tls/0.0.0.0:7447", "certs", "--insecure")),
        (("stop", "--connect", "tcp/192.0.2.1:7447"), ("tls/192.0.2.1:7447", "--insecure")),
        (("up", "--listen", "tls/0.0.0.0:7447", "--tls", "nowhere"), ("nowhere", "'retouch certs --help'")),
        (("certs", "issue", "king.anna", "--folder", "nowhere"), ("nowhere", "certs init")),
        (("stop", "--connect", "tcp/192.0.2.1:99999"), ("99999", "65535")),
        (("master", "--insecure", "--connect", "tcp/no-such-host.invalid:7447"), ("no-such-host.invalid", "not known")),
        (("echo", "**", "--connect", "foo/robot:7447"), ("'foo'", "tcp/robot:7447")),
        (("teach", "--connect", ""), ("empty", "tcp/")),
        (("router", "--listen", "nonsense"), ("nonsense", "no protocol", "tcp/nonsense:7447")),
        (("up", "--config", "missing.toml"), ("missing.toml", "No such file")),
        (("teach", "--waypoints", "missing.csv", "--object", "0.85,0,0.55"), ("missing.csv", "No such file")),
        (("teach", "--waypoints", "notes.rrd", "--object", "0.85,0,0.55"), ("notes.rrd", "x,y,z,qw,qx,qy,qz")),
        (("teach", "--waypoints", "reach.csv"), ("--waypoints", "--object X,Y,Z")),
        (("teach", "--object", "0.85,0,0.55"), ("--object", "--waypoints FILE")),
        (("replay", "missing.rrd"), ("missing.rrd", "No such file")),
        (("replay", "notes.rrd"), ("notes.rrd", "not a Rerun recording")),
    ],
    ids=lambda value: (
        "-".join(value)[:40] if isinstance(value, tuple) and all(isinstance(v, str) for v in value) else None
    ),
)
def test_wrong_arguments_are_named(tmp_path, arguments, words):
    (tmp_path / "notes.rrd").write_text("no recording")
    line = complaint(*arguments, folder=tmp_path)
    assert line.startswith("retouch")
    for word in words:
        assert word in line


@pytest.mark.parametrize(
    ("content", "words"),
    [
        ("[robot]\nscence = 'table'\n", ("scence", "robot")),
        ("[station]\nport = 'http'\n", ("[station] port", "whole number")),
        ("[station]\nport = 70000\n", ("[station] port", "65535")),
        ("[robot]\nhold_after_s = -1.0\n", ("[robot] hold_after_s",)),
        ("[robot]\nhold_after_s = nan\n", ("[robot] hold_after_s",)),
        ("[model]\nkind = 'magic'\n", ("[model] kind", "adaptive, promp")),
        ("[master.device]\nkind = 'mouse'\n", ("[master.device] kind", "mouse", "page, keyboard, gamepad")),
        ("[robot\n", ("line 1",)),
    ],
    ids=["key", "type", "value", "negative", "nan", "kind", "device", "syntax"],
)
def test_a_wrong_configuration_is_named_with_file_and_key(tmp_path, content, words):
    (tmp_path / "mine.toml").write_text(content)
    line = complaint("up", "--headless", "--config", "mine.toml", folder=tmp_path)
    for word in ("mine.toml", *words):
        assert word in line
    assert not (tmp_path / "runs").exists(), "nothing half-made is left"


@pytest.mark.parametrize("command", [("up", "--no-browser"), ("station",)], ids=["up", "station"])
def test_a_page_that_others_would_reach_unasked_is_not_opened(tmp_path, router, command):
    path = configured(tmp_path, free_endpoint(), station='host = "0.0.0.0"\n')
    environment = {"XDG_CONFIG_HOME": str(tmp_path / "config")}
    arguments = (*command, "--config", path, *(("--connect", router) if command == ("station",) else ()))

    def refused():
        return complaint(*arguments, folder=tmp_path, environment=environment)

    assert "'retouch accounts add NAME'" in refused()
    typed = "<<< 'correct horse'"
    with Command("accounts", "add", "anna", folder=tmp_path, environment=environment, shell=typed) as add:
        assert add.ended(WITHIN_S) == Exit.DONE, add.tail()
    assert "'retouch certs issue page.NAME --host HOST" in refused()
    assert not (tmp_path / "runs").exists(), "nothing half-made is left"


@pytest.mark.sim
def test_an_unknown_scene_ends_the_start(tmp_path):
    configuration = configured(tmp_path, free_endpoint())
    line = complaint("up", "--scene", "kitchen", "--headless", "--config", configuration, folder=tmp_path)
    assert "'kitchen'" in line
    assert "dishwasher, table" in line


@pytest.fixture
def taken():
    """A port where another program listens."""
    with socket.create_server(("127.0.0.1", 0)) as server:
        yield server.getsockname()[1]


def test_a_routers_port_in_use_is_named(tmp_path, taken):
    endpoint = f"tcp/127.0.0.1:{taken}"
    for line in (
        complaint("router", "--listen", endpoint, folder=tmp_path, code=Exit.ENVIRONMENT),
        complaint("up", "--headless", "--only", "master", "--listen", endpoint, folder=tmp_path, code=Exit.ENVIRONMENT),
    ):
        assert endpoint in line
        assert "--listen" in line


@pytest.mark.parametrize(
    ("process", "section", "key"),
    [("station", "station", "port"), ("viewer", "viewer", "web_port"), ("viewer", "viewer", "stream_port")],
)
def test_a_pages_port_in_use_is_named_with_its_setting(tmp_path, taken, process, section, key):
    path = configured(tmp_path, free_endpoint())
    lines = [f"{key} = {taken}" if line.startswith(f"{key} =") else line for line in path.read_text().splitlines()]
    path.write_text("\n".join(lines))
    line = complaint("up", "--no-browser", "--only", process, "--config", path, folder=tmp_path, code=Exit.ENVIRONMENT)
    assert f"127.0.0.1:{taken}" in line
    assert f"[{section}] {key}" in line


@pytest.mark.parametrize("command", [("model",), ("up", "--headless", "--only", "model")], ids=["model", "up"])
def test_a_corrupt_database_is_named_and_left_as_it_is(tmp_path, router, command):
    database = tmp_path / "model.sqlite"
    database.write_bytes(NOT_A_DATABASE)
    path = configured(tmp_path, router, model=f'database = "{database}"')
    line = complaint(*command, "--config", path, "--connect", router, folder=tmp_path)
    assert str(database) in line
    assert "restore" in line
    assert database.read_bytes() == NOT_A_DATABASE


@pytest.mark.sim
def test_a_second_robot_of_the_same_name_is_refused(tmp_path, router):
    with Command("robot", "--connect", router, folder=tmp_path), Witness(router) as witness:
        first = witness.next_beats({"robot"}, 30.0)["robot"]
        line = complaint("robot", "--connect", router, folder=tmp_path, code=Exit.ENVIRONMENT)
        assert "'robot1'" in line
        assert "--robot" in line
        assert witness.next_beats({"robot"})["robot"].pid == first.pid


def test_a_network_that_is_not_there_is_named(tmp_path):
    endpoint = free_endpoint()
    with ExitStack() as stack:
        commands = [
            stack.enter_context(Command(*arguments, "--connect", endpoint, folder=tmp_path))
            for arguments in (
                ("top", "--once"),
                ("stop", "--timeout", "2"),
                ("stop", "--release", "--timeout", "2"),
                ("echo", "**"),
            )
        ]
        remedies = ("--connect", "its own emergency stop", "what is stopped stays so", "--connect")
        for command, remedy in zip(commands, remedies, strict=True):
            assert command.ended(WITHIN_S) == Exit.ENVIRONMENT, command.tail()
            *waiting, line = command.err.splitlines()
            assert waiting
            assert all(f"waiting for a router at {endpoint}: connection refused" in told for told in waiting)
            assert endpoint in line
            assert remedy in line


def test_a_key_expression_that_is_none_is_named(tmp_path, router):
    assert "'retouch//state'" in complaint("echo", "retouch//state", "--connect", router, folder=tmp_path)


@pytest.mark.sim
def test_a_camera_that_cannot_draw_says_what_to_install(tmp_path, router):
    # The loader finds these first, and they are no libraries.
    libraries = tmp_path / "libraries"
    libraries.mkdir()
    for name in ("libEGL.so.1", "libGL.so.1", "libOSMesa.so.8"):
        (libraries / name).write_text("no library")
    environment = {"LD_LIBRARY_PATH": str(libraries)}
    line = complaint("camera", "--connect", router, folder=tmp_path, environment=environment, code=Exit.ENVIRONMENT)
    assert "cannot draw without a display" in line
    assert "apt install" in line
