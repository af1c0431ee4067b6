"""What a robot has to answer for is written down as it happens."""

import msgspec
import pytest

from protocol import queries
from protocol.messages import AuthorityEvent, Cut, Mode, Origin
from services.evidence.events import AuthorityChanged, Commanded, EpisodeBegan, EpisodeEnded, StopChanged
from services.process.config import Configuration, RobotSection
from services.robot.evidence import began
from tests.services.robot.site import Site, straight


class Listed:
    """Keeps what it is given."""

    unwritten = 0

    def __init__(self):
        self.events = []

    def add(self, event):
        msgspec.json.encode(event)
        self.events.append(event)

    def close(self):
        """Nothing is open."""

    def of(self, kind):
        return [event for event in self.events if isinstance(event, kind)]


@pytest.fixture
def ledger():
    return Listed()


@pytest.fixture
def site(ledger):
    site = Site(ledger=ledger)
    site.run(0.05)
    return site


def test_nothing_happens_and_nothing_is_written(site, ledger):
    site.run(1.0)
    assert ledger.events == []


def test_who_has_the_authority_is_written_with_how_it_came_to_be(site, ledger):
    site.acquire("ann")
    site.acquire("bob", take_over=True)
    site.run(2.0, renew=False)
    changes = [(change.event, change.holder, change.before, change.reason) for change in ledger.of(AuthorityChanged)]
    assert changes == [
        (AuthorityEvent.ACQUIRED, "ann", "", ""),
        (AuthorityEvent.TAKEN_OVER, "bob", "ann", "it burns"),
        (AuthorityEvent.EXPIRED, "", "bob", ""),
    ]
    epochs = [change.epoch for change in ledger.of(AuthorityChanged)]
    assert epochs == sorted(set(epochs))


def test_a_motion_is_written_with_who_asked_for_it_and_the_model_that_predicted_it(site, ledger):
    site.acquire()
    episode = site.execute()
    (begun,) = ledger.of(EpisodeBegan)
    assert begun == EpisodeBegan(
        episode=episode,
        epoch=site.epoch,
        operator="ann",
        mode=Mode.AUTONOMOUS,
        prediction=begun.prediction,
        origin=Origin.MODEL,
        model_version=1,
    )
    assert begun.prediction > 0


@pytest.mark.parametrize("hand", [None, (0.0, 0.03, 0.0)])
def test_an_end_is_written_with_whether_a_hand_took_part(site, ledger, hand):
    site.acquire()
    site.execute(Mode.REFINE if hand else Mode.AUTONOMOUS, straight(duration=4.0))
    site.run(0.6, master=hand and (0.0, 0.0, 0.0))
    site.run(5.4, master=hand)
    (ended,) = ledger.of(EpisodeEnded)
    assert (ended.operator, ended.corrected, ended.cut, ended.progress) == ("ann", hand is not None, None, 1.0)


def test_a_motion_that_a_hand_leads_has_no_model(site, ledger):
    site.acquire()
    site.ask(queries.TELEOPERATE, queries.Teleoperate(site.epoch))
    (begun,) = ledger.of(EpisodeBegan)
    assert (begun.mode, begun.model_version, begun.origin) == (Mode.TEACH, None, None)


def test_a_stop_and_its_release_are_written_and_so_is_what_they_end(site, ledger):
    site.acquire()
    site.execute()
    site.press("bob", "smoke")
    site.release("ann")
    assert ledger.of(StopChanged) == [
        StopChanged(latched=True, by="bob", reason="smoke", released_by=""),
        StopChanged(latched=False, by="bob", reason="smoke", released_by="ann"),
    ]
    assert [ended.cut for ended in ledger.of(EpisodeEnded)] == [Cut.STOPPED]


def test_a_stop_that_is_repeated_is_written_once(site, ledger):
    for _ in range(5):
        site.press()
    assert len(ledger.of(StopChanged)) == 1


def test_what_was_carried_out_is_written_and_what_was_refused_is_not(site, ledger):
    assert isinstance(site.finish(), queries.Refused)
    site.acquire()
    site.execute()
    site.finish()
    assert [commanded.request for commanded in ledger.of(Commanded)] == ["AcquireAuthority", "Execute", "Finish"]
    assert ledger.of(Commanded)[-1].said["epoch"] == site.epoch


def test_a_request_that_comes_twice_is_written_once(site, ledger):
    site.acquire()
    site.execute()
    for _ in range(2):
        site.ask(queries.FINISH, queries.Finish(site.epoch, request=7))
    assert [commanded.request for commanded in ledger.of(Commanded)].count("Finish") == 1


def test_the_beginning_says_under_which_settings_and_with_what_software():
    event = began(Configuration(name="kitchen", robot=RobotSection(velocity_scale=0.25)))
    assert (event.robot, event.settings["robot"]["velocity_scale"]) == ("kitchen", 0.25)
    assert {"python", "retouch", "mujoco", "eclipse-zenoh"} <= event.versions.keys()
