"""Which endpoint is examined: the one that is named, else that of the file, else of the file's desk."""

import pytest

from services.commands.doctor.command import add_arguments, endpoint
from services.commands.parser import Parser


@pytest.fixture
def said(tmp_path):
    """The endpoint that is examined, by the file's lines and the command's arguments."""

    def of(lines, *arguments):
        path = tmp_path / "network.toml"
        path.write_text(lines)
        parser = Parser()
        add_arguments(parser)
        return endpoint(parser.parse_args([*arguments, "--config", str(path)]))

    return of


DESK = '[desk]\nconnect = "tls/192.0.2.1:7447"\n'
OWN = 'connect = "tcp/127.0.0.1:7999"\n'


@pytest.mark.parametrize(
    ("lines", "arguments", "examined"),
    [
        (DESK, (), "tls/192.0.2.1:7447"),
        (DESK, ("tls/192.0.2.9:7447",), "tls/192.0.2.9:7447"),
        (DESK, ("--connect", "tls/192.0.2.9:7447"), "tls/192.0.2.9:7447"),
        (OWN + DESK, (), None),
        (OWN, (), None),
    ],
)
def test_what_is_named_comes_before_what_the_file_says(said, lines, arguments, examined):
    assert said(lines, *arguments) == examined
