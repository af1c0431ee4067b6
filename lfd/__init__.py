"""Learning from demonstration: the mathematics. Arrays in, arrays out; no process, no message, no clock.

A library of its own: it needs NumPy, and SciPy where a model is fitted; Numba, where it is installed, aligns long
motions faster. What stands here is public and loaded when it is first asked for, so that `import lfd` costs next to
nothing; every error is an `LfdError` (`lfd.exceptions`), with its facts as attributes.

Its words, and what else they are called: a *condition* is a task parameter or context; the *situation* a condition with
the start pose; a *correction* a newer demonstration that overrules older ones near its condition (residual regression);
a *refinement* the corrected execution that it comes from; an *encoding* the basis-function weights of a motion; the
*origin* the frame's origin that a motion is learnt relative to. Units are SI, angles radians, quaternions unit and
scalar first (w, x, y, z), all poses in one frame, the base frame.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from lfd.exceptions import LfdError
    from lfd.models.adaptive.adaptation import AdaptiveOptions, AdaptiveProMP
    from lfd.models.basis import GaussianBasis
    from lfd.models.distribution import MotionDistribution, blend
    from lfd.models.dmp import DMP, DmpOptions, Scaling
    from lfd.models.model import MovementModel, Prediction, Way
    from lfd.models.promp import ConditionedProMP, PrompOptions
    from lfd.models.via_point import ViaPoint
    from lfd.motion.alignment import Selection, align
    from lfd.motion.demonstration import Demonstration, Situation
    from lfd.motion.departure import Departure
    from lfd.motion.dtw import Alignment, dtw
    from lfd.motion.provenance import Method, Provenance
    from lfd.motion.recording import (
        demonstration_from_arrays,
        demonstrations_from_arrays,
        situation_from_arrays,
    )
    from lfd.motion.refinement import joined, refine
    from lfd.motion.resampling import Interpolation, along_the_way, from_samples, resample
    from lfd.motion.trajectory import Trajectory
    from lfd.motion.waypoints import Passing, through_waypoints
    from lfd.store.database import DemonstrationStore
    from lfd.store.model_file import load, save
    from lfd.store.recording_file import Recording, read_demonstration, read_recording
    from lfd.store.stored import Binding, Purpose, StoredDemonstration, Turn

_MODULES = {
    "exceptions": ("LfdError",),
    "models.adaptive.adaptation": ("AdaptiveOptions", "AdaptiveProMP"),
    "models.basis": ("GaussianBasis",),
    "models.distribution": ("MotionDistribution", "blend"),
    "models.dmp": ("DMP", "DmpOptions", "Scaling"),
    "models.model": ("MovementModel", "Prediction", "Way"),
    "models.promp": ("ConditionedProMP", "PrompOptions"),
    "models.via_point": ("ViaPoint",),
    "motion.alignment": ("Selection", "align"),
    "motion.demonstration": ("Demonstration", "Situation"),
    "motion.departure": ("Departure",),
    "motion.dtw": ("Alignment", "dtw"),
    "motion.provenance": ("Method", "Provenance"),
    "motion.recording": ("demonstration_from_arrays", "demonstrations_from_arrays", "situation_from_arrays"),
    "motion.refinement": ("joined", "refine"),
    "motion.resampling": ("Interpolation", "along_the_way", "from_samples", "resample"),
    "motion.trajectory": ("Trajectory",),
    "motion.waypoints": ("Passing", "through_waypoints"),
    "store.database": ("DemonstrationStore",),
    "store.model_file": ("load", "save"),
    "store.recording_file": ("Recording", "read_demonstration", "read_recording"),
    "store.stored": ("Binding", "Purpose", "StoredDemonstration", "Turn"),
}
_HOMES = {name: module for module, names in _MODULES.items() for name in names}

__all__ = [
    "DMP",
    "AdaptiveOptions",
    "AdaptiveProMP",
    "Alignment",
    "Binding",
    "ConditionedProMP",
    "Demonstration",
    "DemonstrationStore",
    "Departure",
    "DmpOptions",
    "GaussianBasis",
    "Interpolation",
    "LfdError",
    "Method",
    "MotionDistribution",
    "MovementModel",
    "Passing",
    "Prediction",
    "PrompOptions",
    "Provenance",
    "Purpose",
    "Recording",
    "Scaling",
    "Selection",
    "Situation",
    "StoredDemonstration",
    "Trajectory",
    "Turn",
    "ViaPoint",
    "Way",
    "align",
    "along_the_way",
    "blend",
    "demonstration_from_arrays",
    "demonstrations_from_arrays",
    "dtw",
    "from_samples",
    "joined",
    "load",
    "read_demonstration",
    "read_recording",
    "refine",
    "resample",
    "save",
    "situation_from_arrays",
    "through_waypoints",
]


if not TYPE_CHECKING:  # a type checker knows the names from above, and what is none

    def __getattr__(name: str) -> Any:
        """A public name, from its module (PEP 562)."""
        if name not in _HOMES:
            raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
        try:
            module = import_module(f"{__name__}.{_HOMES[name]}")
        except ModuleNotFoundError as error:
            needs = f"{__name__}.{name} needs the package {error.name!r}: install retouch[lfd]"
            raise ModuleNotFoundError(needs, name=error.name) from error
        value = globals()[name] = getattr(module, name)
        return value


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
