"""Everything around a station's workflow, answering as a healthy system does."""

from dataclasses import replace

import msgspec
import pytest

from protocol import messages, queries
from protocol.messages import EpisodeResult, Mode, Outcome, Verdict
from services.bus.arrays import motion_to_wire, to_wire
from services.bus.bus import Failed
from services.station.press import Press
from services.station.workflow.settings import Settings
from services.station.workflow.state import Phase, Place, Workflow
from services.station.workflow.view import Answer, View
from services.station.workflow.workflow import advance

POSE = messages.Pose((0.5, 0.0, 0.5), (1.0, 0.0, 0.0, 0.0))
MOTION = motion_to_wire([[0.5, 0.0, 0.5], [0.8, 0.0, 0.6]], [[1.0, 0.0, 0.0, 0.0]] * 2, 7.0)
REACHED = Outcome(reached=True, kicked_over=False, collision=False)
COLLIDED = Outcome(reached=False, kicked_over=False, collision=True)
MISSED = Outcome(reached=False, kicked_over=False, collision=False)

BY_HAND = Settings(
    holder="station",
    operator="ann",
    autonomous_s=10.0,
    refine_s=20.0,
    refinements_allowed=10,
    updates_allowed=8,
    adapt=queries.Adapt.NEXT,
    alpha=1.0,
    variant="",
    scripted=False,
    once=False,
)
SCRIPTED = replace(BY_HAND, scripted=True, once=True, refinements_allowed=3, updates_allowed=2)
STOPPED = messages.SafetyState(emergency_stop=True, by="bob", reason="it burns", at="10:00", standing=True)
RELEASED = messages.SafetyState(emergency_stop=False, released_by="eve", at="10:05", standing=True)
IDLE, RAMP, EXECUTE, HOLD = messages.Phase.IDLE, messages.Phase.RAMP, messages.Phase.EXECUTE, messages.Phase.HOLD
UNANSWERED = object()
"""Given instead of an answer: none comes."""


class Site:
    """A run is a list of verdicts; a step takes a second unless told, a question is answered in the next one."""

    def __init__(self, settings, verdicts=()):
        self.settings = settings
        self.verdicts = list(verdicts)
        self.state = Workflow()
        self.now_s = 100.0
        self.epoch = 7
        self.version = 2
        self.learnt = []
        self.asked = []
        self.numbers = 0
        self.instead = {}
        self.certainty = {}
        self.view = View(
            now_s=0.0,
            number=0,
            robot=messages.RobotState(measured=POSE, reference=POSE, phase=IDLE, publisher=1),
            authority=messages.AuthorityState(holder="", epoch=self.epoch, expires_in=0.0),
            safety=messages.SafetyState(emergency_stop=False),
            scene=messages.SceneState(
                name="dishwasher",
                variant="b2",
                boxes=(),
                object_size=(0.05, 0.05, 0.1),
                ellipsoid_radii=(0.05, 0.05, 0.05),
                kicked_over_thresholds=(0.1, 0.1, 0.1),
                start=POSE,
                object_region=((0.8, 0.0, 0.5), (0.9, 0.1, 0.5)),
                variants=("b0", "b1", "b2"),
            ),
            model=messages.ModelState(kind="adaptive", version=2, demonstrations=2, updates=0, scene="dishwasher"),
            seen=messages.ObjectPose(pose=messages.Pose((0.85, 0.05, 0.5), (1.0, 0.0, 0.0, 0.0)), tag=1, pictures=9),
            drawn=Place((0.85, 0.05, 0.5)),
        )

    def step(self, *actions, seconds=1.0, argument="", **seen):
        """Advance in time; `argument` is what is said with the presses, `seen` what is different in this step only."""
        self.now_s += seconds
        self.numbers += 1
        before = self.state.phase
        now = {"now_s": self.now_s, "seen_s": self.now_s, "scene_s": self.now_s, "number": self.numbers}
        now["presses"] = tuple(Press(action.value, argument) for action in actions)
        step = advance(self.state, replace(self.view, **(now | seen)), self.settings)
        self.state = step.state
        if step.ask is not None:
            self.asked.append(step.ask)
            outcome = self.instead.pop(step.ask.query.name, None) or self.answer(step.ask)
            if outcome is not UNANSWERED:
                self.view = replace(self.view, answer=Answer(step.ask.number, outcome))
        elif self.state.phase is Phase.EXECUTING and before is Phase.EXECUTING and self.verdicts:
            self.end(self.verdicts.pop(0))
        return step

    def answer(self, ask):
        match ask.query:
            case queries.ACQUIRE:
                self.epoch += 1
                holder = messages.AuthorityState(holder=ask.request.holder, epoch=self.epoch, expires_in=1.0)
                self.view = replace(self.view, authority=holder)
                return queries.AuthorityGranted(self.epoch, 1.0)
            case queries.PREDICT | queries.PLAN:
                return self.motion_for(ask.request)
            case queries.ADD_DEMONSTRATION | queries.UNDO | queries.REDO:
                return self.change(ask)
            case queries.CHOOSE_SKILL:
                return self.choose(ask.request)
            case queries.EXECUTE | queries.TELEOPERATE:
                episode = self.view.robot.episode + 1
                self.robot(phase=EXECUTE, mode=getattr(ask.request, "mode", Mode.TEACH), episode=episode)
                return queries.EpisodeStarted(episode)
            case queries.FINISH:
                self.robot(phase=IDLE)
            case queries.RELEASE_STOP:
                self.sees(safety=RELEASED)
        return queries.Accepted()

    def change(self, ask):
        """As the model does what changes it; its updates are called by the versions that they made."""
        self.version += 1
        entry = getattr(ask.request, "entry", 0) or (self.learnt[-1] if ask.query is queries.UNDO else self.version)
        if ask.query is queries.UNDO:
            self.learnt.remove(entry)
        else:
            self.learnt.append(entry)
        first = getattr(ask.request, "purpose", None) is messages.Purpose.INITIAL
        demonstrations, updates = self.view.model.demonstrations + first, len(self.learnt)
        changes = {"demonstrations": demonstrations} if first else {"updates": updates}
        model = msgspec.structs.replace(self.view.model, version=self.version, **changes)
        self.sees(model=model)
        return queries.Learnt(model, entry, messages.Purpose.INITIAL if first else messages.Purpose.UPDATE)

    def choose(self, request):
        """As the model does what uses another skill: that has learnt nothing where it is new."""
        self.version, self.learnt = (0, []) if request.new else (7, [7])
        held = {"skill": request.name, "version": self.version, "updates": len(self.learnt)}
        model = msgspec.structs.replace(self.view.model, demonstrations=len(self.learnt), **held)
        self.sees(model=model)
        return queries.Learnt(model)

    def motion_for(self, request):
        """What the model process answers to who wants a motion."""
        return queries.Predicted(
            messages.Prediction(
                id=len(self.asked),
                motion=getattr(request, "motion", None) or MOTION,
                deviations=to_wire([[0.0] * 3] * 2),
                model_version=self.version,
                object_position=request.object_position,
                origin=getattr(request, "origin", messages.Origin.MODEL),
                **self.certainty,
            )
        )

    def fail(self, query, outcome=None):
        """Let the next question of this kind go wrong; without an answer where nothing else is said."""
        self.instead[query.name] = outcome if outcome is not None else Failed("nobody answers")

    def sees(self, **seen):
        """What is different from now on."""
        self.view = replace(self.view, **seen)

    def robot(self, **changes):
        """What the robot says of itself from now on."""
        self.sees(robot=msgspec.structs.replace(self.view.robot, **changes))

    def end(self, outcome, **changes):
        """The robot ends the episode that runs."""
        self.sees(result=self.result(outcome, **changes))
        self.robot(phase=IDLE, waiting=False)

    def result(self, outcome, **changes):
        result = EpisodeResult(
            episode=self.view.robot.episode,
            request=self.state.episode.request,
            mode=self.state.mode,
            completed=True,
            reason="",
            prediction=self.state.prediction.id if self.state.prediction is not None else 0,
            refined=changes.get("commanded", MOTION),
            commanded=MOTION,
            measured=MOTION,
            verdict=Verdict(reached=outcome.reached, kicked_over=outcome.kicked_over, collision=outcome.collision),
            operator_input=self.state.mode is Mode.REFINE,
            clamped=0,
            held=0.0,
            duration=10.0,
        )
        return msgspec.structs.replace(result, **changes)

    def run_to(self, phase, limit=400, **seen):
        for _ in range(limit):
            if self.state.phase is phase:
                return
            self.step(**seen)
        pytest.fail(f"never came to {phase}; is in {self.state.phase}: {self.state.event} {self.state.notice}")

    def press(self, action, phase):
        """Once the operator is asked, press, and run to where it leads."""
        self.run_to(Phase.DECIDING)
        self.step(action)
        self.run_to(phase)

    def stay(self, seconds=5, **seen):
        """Let time pass; the queries that were asked meanwhile, by name."""
        before = len(self.asked)
        for _ in range(seconds):
            self.step(**seen)
        return self.names()[before:]

    def names(self):
        return [ask.query.name for ask in self.asked]

    def requests(self, query):
        return [ask.request for ask in self.asked if ask.query is query]


def authority(holder, epoch, operator=""):
    return messages.AuthorityState(holder=holder, epoch=epoch, operator=operator, expires_in=1.0)


def lose_authority(site):
    """As after a link that was cut for longer than the lease."""
    site.epoch += 50
    site.sees(authority=authority("", site.epoch))
    site.step()
