"""What the supervisor hears and keeps."""

from protocol.messages import Attempt, Light, Mode, Outcome, Recording, TeachingState
from protocol.topics import RECORDING, TEACHING_STATE
from services.bus.memory import MemoryNetwork
from services.commands.up.network import Narrator, Watch
from services.process.clock import ManualClock


def test_a_recording_that_broke_off_is_remembered_when_it_goes_on():
    network = MemoryNetwork(ManualClock())
    watch = Watch(network.bus())
    viewer = network.bus()
    for fault in ("", "no space left on device", ""):
        viewer.publish(RECORDING, Recording(path="a.rrd", viewer_url="", recording_id="a", fault=fault))
        watch.update()
    assert watch.recording_fault == "no space left on device"


def attempts(*numbers):
    missed = Outcome(reached=False, kicked_over=False, collision=False)
    one = ("s", (0.8, 0.0, 0.5), 2, False, missed, 10.0, "b2", Mode.AUTONOMOUS)
    return TeachingState(
        phase="deciding",
        text="",
        light=Light.GREEN,
        attempts=tuple(Attempt(*one, number=number) for number in numbers),
    )


def test_every_episode_is_told_once_though_only_the_newest_are_heard_and_a_new_station_counts_anew():
    network = MemoryNetwork(ManualClock())
    watch = Watch(network.bus())
    lines = []
    narrator = Narrator(lambda _, line: lines.append(line), 0.0)
    first, restarted = network.bus(), network.bus()
    for station, numbers in ((first, (1, 2)), (first, (2, 3)), (first, (2, 3)), (restarted, (1,)), (restarted, (1, 2))):
        station.publish(TEACHING_STATE, attempts(*numbers))
        narrator.tell(watch)
    assert [line.split(".")[0] for line in lines if "prediction" in line] == ["1", "2", "3", "4", "5"]
    assert len(narrator.attempts) == 5


def test_what_a_run_says_again_and_again_is_told_a_few_times():
    network = MemoryNetwork(ManualClock())
    watch = Watch(network.bus())
    lines = []
    narrator = Narrator(lambda _, line: lines.append(line), 0.0)
    station = network.bus()
    for number in range(50):
        phase = ("waiting", "acquiring")[number % 2]
        station.publish(
            TEACHING_STATE, TeachingState(phase=phase, text="", event="The authority was lost.", light=Light.AMBER)
        )
        narrator.tell(watch)
    assert lines == ["The authority was lost."] * 3
