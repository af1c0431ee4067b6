"""What the supervisor hears and keeps."""

from protocol.messages import Recording
from protocol.topics import RECORDING
from services.bus.memory import MemoryNetwork
from services.commands.up.network import Watch
from services.process.clock import ManualClock


def test_a_recording_that_broke_off_is_remembered_when_it_goes_on():
    network = MemoryNetwork(ManualClock())
    watch = Watch(network.bus())
    viewer = network.bus()
    for fault in ("", "no space left on device", ""):
        viewer.publish(RECORDING, Recording(path="a.rrd", viewer_url="", recording_id="a", fault=fault))
        watch.update()
    assert watch.recording_fault == "no space left on device"
