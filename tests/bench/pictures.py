"""The simulated cameras' pictures during a refinement, as H.264 and as JPEG files that are as good: bytes and time."""

import argparse
import sys
import time
from pathlib import Path
from typing import NamedTuple

import cv2
import numpy as np

from lfd.motion.resampling import at_phases, from_samples
from protocol.messages import Coding
from services.bus.picture_stream import Group
from services.camera.coding import H264Coder, jpeg
from services.camera.wishes import Wish
from services.offline.rollout import rollout
from services.process.config import CameraSection
from services.robot.assembly import simulated_arm
from services.robot.correction import Correction
from services.video.decoder import Decoder
from sim.robots.description import prepare
from sim.robots.robot import USUAL_CAMERAS
from sim.tasks import DISHWASHER
from sim.world.cameras import Cameras
from tests.bench.support.results import Result, report

DURATION_S = 20.0
RATE_HZ = CameraSection().rate_hz
QUALITY = CameraSection().quality
SIZES = ((320, 240), (640, 480))
GOAL = 0.35
"""Of the bytes of JPEG files."""


class Coded(NamedTuple):
    """What became of a film: median time [ms], mean size [B] and mean peak signal-to-noise ratio [dB] of a picture."""

    time_ms: float
    size: float
    psnr: float


def refinement():
    """The world's states, as a camera draws them, while a prediction that no longer fits is corrected."""
    place, (known, changed) = DISHWASHER.training_positions[0], DISHWASHER.variants[:2]
    arm = simulated_arm(DISHWASHER, known, prepare())
    prediction, wanted = (corridor(variant, place) for variant in (known, changed))
    states = []

    def operator(view):
        if view.time * RATE_HZ >= len(states):
            states.append(np.array(arm.observation.world))
        phases = np.array([0.0, min(1.0, view.progress + 1 / 74)])
        offset = at_phases(wanted, phases).positions[1] - at_phases(prediction, phases).positions[1]
        return Correction(offset, np.zeros(3))

    rollout(arm, prediction, place, variant=changed, operator=operator)
    return states


def corridor(variant, place):
    """The way that a variant of the scene leaves free, as long as a refinement takes."""
    ways = DISHWASHER.corridor(variant, place)
    steps = np.linalg.norm(np.diff(DISHWASHER.corridor(DISHWASHER.variants[0], place).positions, axis=0), axis=1)
    return from_samples(np.concatenate([[0.0], np.cumsum(steps)]) / np.sum(steps) * DURATION_S, *ways[:2], n=75)


def films(states, width, height):
    """What each camera sees of it."""
    cameras = Cameras(DISHWASHER, prepare(), width, height)
    cameras.show(DISHWASHER.variants[1])
    drawn = {name: [np.ascontiguousarray(cameras.render(name, state)) for state in states] for name in USUAL_CAMERAS}
    cameras.close()
    return drawn


def as_h264(film):
    """As the camera sends it where nothing is lost, a key picture a second."""
    height, width, _ = film[0].shape
    coder = H264Coder(CameraSection(codec=Coding.H264, width=width, height=height))
    decoder, group, told = Decoder(), Group(0, Coding.H264, ()), []
    for index, picture in enumerate(film):
        began = time.perf_counter()
        coded = coder.encode(picture, QUALITY, round(index / RATE_HZ * 1e9), Wish())
        took_ms = 1e3 * (time.perf_counter() - began)
        before = group.pictures if coded.after_key else ()
        group = Group(group.number + (coded.after_key == 0), Coding.H264, (*before, coded.data))
        told.append((took_ms, len(coded.data), cv2.PSNR(picture, decoder.rgb(group))))
    return summary(told)


def as_jpeg(film, quality):
    """As the camera sends it with a quality."""
    told = []
    for picture in film:
        began = time.perf_counter()
        data = jpeg(picture, quality)
        took_ms = 1e3 * (time.perf_counter() - began)
        seen = cv2.cvtColor(cv2.imdecode(np.frombuffer(data, np.uint8), cv2.IMREAD_COLOR), cv2.COLOR_BGR2RGB)
        told.append((took_ms, len(data), cv2.PSNR(picture, seen)))
    return summary(told)


def summary(told):
    """Of all pictures of a film."""
    times, sizes, psnrs = zip(*told, strict=True)
    return Coded(float(np.median(times)), float(np.mean(sizes)), float(np.mean(psnrs)))


def as_good(film, psnr):
    """The files of the quality that comes closest."""
    return min((as_jpeg(film, quality) for quality in range(30, 100, 2)), key=lambda files: abs(files.psnr - psnr))


def compared(name, film):
    """The figures of a film."""
    print(f"bench: {name}", file=sys.stderr)
    video = as_h264(film)
    files = as_good(film, video.psnr)
    yield Result(f"{name}: H.264, bytes a picture", video.size, "B")
    yield Result(f"{name}: JPEG, as good, bytes a picture", files.size, "B")
    yield Result(f"{name}: H.264, share of JPEG's bytes", video.size / files.size, "1", GOAL)
    yield Result(f"{name}: H.264, signal to noise", video.psnr, "dB")
    yield Result(f"{name}: JPEG, signal to noise", files.psnr, "dB")
    yield Result(f"{name}: H.264, time to encode a picture", video.time_ms, "ms")
    yield Result(f"{name}: JPEG, time to encode a picture", files.time_ms, "ms")


def main(arguments=None):
    parser = argparse.ArgumentParser(prog="deploy/bench pictures", description=__doc__)
    parser.add_argument("--json", type=Path, metavar="FILE", help="write the figures as JSON")
    options = parser.parse_args(arguments)
    if options.json is not None and not options.json.parent.is_dir():
        parser.error(f"--json: the folder {options.json.parent} does not exist")
    cv2.setNumThreads(1)
    print("bench: about two minutes", file=sys.stderr)
    states, results = refinement(), []
    for width, height in SIZES:
        for name, film in films(states, width, height).items():
            results += compared(f"{name} camera, {width} x {height}", film)
    report(results, options.json)


if __name__ == "__main__":
    main()
