"""What the tests of the protocol share."""

import pytest

from tests.protocol.filled import filled


@pytest.fixture
def fill():
    return filled
