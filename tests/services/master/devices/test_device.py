"""What passes between a device and the process that owns it."""

from dataclasses import FrozenInstanceError, fields

import pytest

from services.master.devices.device import Moment, Sample


@pytest.mark.parametrize("value", [Moment(0, 0.01, None, None, commands=False), Sample()])
def test_what_was_handed_over_does_not_change_afterwards(value):
    for field in fields(value):
        with pytest.raises(FrozenInstanceError):
            setattr(value, field.name, None)


def test_a_device_that_says_nothing_of_a_hand_has_none_on_it():
    sample = Sample()
    assert not sample.engaged
    assert sample.displacement == sample.velocity == sample.rotation == sample.force == (0.0, 0.0, 0.0)
