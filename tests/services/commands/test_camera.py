"""`retouch camera`: what there is, the board, and calibrations from pictures that a known camera has of it."""

import cv2
import numpy as np
import pytest

from protocol.messages import CameraImage, Phase, Pose, RobotState
from protocol.topics import CAMERA_IMAGE, ROBOT_STATE
from services.bus.memory import MemoryNetwork
from services.camera.calibration.views import read_views, write_view
from services.cli import main
from services.process.calibration import load_calibration
from services.process.clock import ManualClock
from services.process.config import load
from tests.services.camera.calibration.eyes import MOUNTING, angle, links, poses
from tests.services.camera.calibration.rendered import FOCAL, HEIGHT, WIDTH, Studio

pytestmark = pytest.mark.sim

PICTURES = 12
HERE = Pose((0.5, 0.0, 0.5), (1.0, 0.0, 0.0, 0.0))


@pytest.fixture(autouse=True)
def own_data(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path / "data"))


@pytest.fixture(scope="module")
def film():
    """Placements of the board in a known camera, and what the camera sees there."""
    studio, boards = Studio(), poses(np.random.default_rng(1), PICTURES)
    fine = [cv2.IMWRITE_JPEG_QUALITY, 90]
    pictures = [cv2.imencode(".jpg", studio.picture(board), fine)[1].tobytes() for board in boards]
    studio.close()
    return boards, pictures


def said(capsys, *arguments):
    """Exit code and what was said."""
    code = main(["camera", *map(str, arguments)])
    told = capsys.readouterr()
    return code, told.out + told.err


def quaternion(rotation):
    w = np.sqrt(max(0.0, 1.0 + np.trace(rotation))) / 2
    vector = np.ravel(cv2.Rodrigues(rotation)[0])
    half = np.linalg.norm(vector) / 2
    return (w, *(np.sinc(half / np.pi) / 2 * vector).tolist())


def written(folder, film, count=PICTURES, *, with_poses=True):
    """A folder of what the camera sees of the board while a link carries it."""
    folder.mkdir()
    boards, pictures = film
    for number, (data, link) in enumerate(zip(pictures[:count], links(boards[:count]), strict=True)):
        write_view(folder, number, data, (*link[:3, 3].tolist(), *quaternion(link[:3, :3])))
    if not with_poses:
        (folder / "poses.csv").unlink()
    return folder


def test_a_camera_that_is_known_is_found_as_it_is_and_where_it_is(film, tmp_path, capsys):
    code, told = said(capsys, "calibrate", "wrist", "--from", written(tmp_path / "pictures", film))
    assert code == 0, told
    found = load_calibration("robot1", "wrist")
    assert found.focal == pytest.approx((FOCAL, FOCAL), rel=0.01)
    assert found.centre == pytest.approx(((WIDTH - 1) / 2, (HEIGHT - 1) / 2), abs=0.01 * WIDTH)
    assert found.fixed.link == "wrist_camera_frame"
    assert np.linalg.norm(np.subtract(found.fixed.position, MOUNTING[:3, 3])) < 0.005
    w, *xyz = found.fixed.orientation
    turned = cv2.Rodrigues(2 * np.arccos(np.clip(w, -1, 1)) * np.array(xyz) / np.linalg.norm(xyz))[0]
    assert angle(turned, MOUNTING) < np.radians(0.5)
    code, told = said(capsys, "list")
    assert "wrist: simulated, on wrist_camera_frame; focal length 62" in told
    assert "head: simulated, on xtion_rgb_optical_frame; nothing was measured of it" in told


def test_pictures_without_poses_say_how_a_camera_sees_and_not_where_it_is(film, tmp_path, capsys):
    folder = written(tmp_path / "pictures", film, with_poses=False)
    code, told = said(capsys, "calibrate", "head", "--from", folder)
    assert (code, load_calibration("robot1", "head").fixed) == (0, None)
    assert "where it is fixed was not measured" in told


def test_what_was_measured_is_written_over_only_where_that_is_said(film, tmp_path, capsys):
    folder = written(tmp_path / "pictures", film)
    assert said(capsys, "calibrate", "wrist", "--from", folder)[0] == 0
    code, told = said(capsys, "calibrate", "wrist", "--from", folder)
    assert (code != 0, "--replace writes over it" in told) == (True, True)
    assert said(capsys, "calibrate", "wrist", "--from", folder, "--replace")[0] == 0
    code, told = said(capsys, "calibrate", "wrist")
    assert (code != 0, "take" in told, "away" in told) == (True, True, True)


def test_what_is_not_enough_is_one_line_that_says_what_to_add(film, tmp_path, capsys):
    few = written(tmp_path / "few", film, count=3)
    for arguments, told in (
        (("calibrate", "wrist", "--from", few), "3 pictures show the board: take 5 more"),
        (("calibrate", "elbow", "--from", few), "there is no camera elbow: name one of head, wrist"),
        (("calibrate",), "which camera is meant is not said: name one of head, wrist"),
        (("calibrate", "wrist", "--from", tmp_path / "nowhere"), "there is no picture in it"),
    ):
        code, line = said(capsys, *arguments)
        assert code != 0
        assert told in line
        assert "Traceback" not in line


@pytest.mark.parametrize(
    ("line", "told"),
    [
        ("000.jpg,1,2,3", "line 2: seven numbers"),
        ("000.jpg,0,0,0,2,0,0,0", "line 2: qw, qx, qy, qz are no unit quaternion"),
    ],
)
def test_a_list_of_poses_that_is_none_is_named_with_its_line(film, tmp_path, capsys, line, told):
    folder = written(tmp_path / "pictures", film)
    (folder / "poses.csv").write_text(f"picture,x,y,z,qw,qx,qy,qz\n{line}\n")
    code, output = said(capsys, "calibrate", "wrist", "--from", folder)
    assert (code != 0, told in output) == (True, True)


def test_the_board_is_written_with_its_size(tmp_path, capsys):
    code, told = said(capsys, "board", "--out", tmp_path / "board.png", "--square", "0.03")
    assert (code, "240 by 180 mm" in told, "30.0 mm" in told) == (0, True, True)
    assert cv2.imread(str(tmp_path / "board.png")) is not None


def test_the_cameras_are_drawn_on_the_robot(tmp_path, capsys):
    bare = tmp_path / "cameras.png"
    assert said(capsys, "draw", "--out", bare)[0] == 0
    path = tmp_path / "retouch.toml"
    path.write_text('[camera]\ncameras = [{kind = "simulated", name = "side", position = [0.9, -0.9, 1.0]}]\n')
    assert said(capsys, "draw", "--config", path, "--out", tmp_path / "more.png")[0] == 0
    one, other = (cv2.imread(str(file)) for file in (bare, tmp_path / "more.png"))
    assert np.count_nonzero(np.abs(one.astype(int) - other).max(axis=2) > 30) > 50


def test_pictures_are_taken_where_the_robot_stands_in_another_pose_and_the_board_is_seen(film, tmp_path):
    from services.camera.calibration.board import Board
    from services.commands.camera.collecting import Collector
    from services.commands.camera.eyes import eyes
    from sim.robots.description import prepare
    from sim.tasks import DISHWASHER
    from sim.world.links import Links

    path = tmp_path / "retouch.toml"
    path.write_text("")
    clock, arm = ManualClock(), DISHWASHER.manipulator
    network, links_ = MemoryNetwork(clock), Links(DISHWASHER, prepare())
    robot, folder = network.bus("robot"), tmp_path / "taken"
    camera = network.bus("camera")
    folder.mkdir()
    eye, last = eyes(load(path))["wrist"], arm.joint_names[-1]
    collector = Collector(network.bus("cli"), eye, Board(), links_, last=last, folder=folder)
    assert not collector.held
    assert Collector(network.bus("cli"), eyes(load(path))["head"], Board(), links_, last=last, folder=folder).held

    def step(turned, speed, data):
        clock.advance(0.5)
        q = (*arm.home[:-1], turned)
        moves = {"joint_names": arm.joint_names, "q": q, "qd": (speed,)}
        robot.publish(ROBOT_STATE, RobotState(measured=HERE, reference=HERE, phase=Phase.IDLE, **moves))
        size = {"width": WIDTH, "height": HEIGHT, "intrinsics": (1.0,) * 4}
        image = CameraImage(camera="wrist", data=data, pose=HERE, captured_ns=clock.now_ns(), **size)
        camera.publish(CAMERA_IMAGE.of("wrist"), image)
        return collector.step(clock.now_ns())

    seen, unseen = film[1][0], cv2.imencode(".jpg", np.zeros((HEIGHT, WIDTH, 3), np.uint8))[1].tobytes()
    assert step(0.0, 0.3, seen) is None, "it moves"
    assert step(0.0, 0.0, seen) is None, "it has just come to stand"
    assert step(0.0, 0.0, unseen) is None, "the board is not seen"
    assert step(0.0, 0.0, seen) == 24
    assert step(0.0, 0.0, seen) is None, "it is taken in this pose"
    assert step(0.5, 0.3, seen) is None
    assert step(0.5, 0.0, seen) is None
    assert step(0.5, 0.0, seen) == 24
    first, second = (view.link for view in read_views(folder))
    assert angle(first, second) == pytest.approx(0.5, abs=1e-6)
