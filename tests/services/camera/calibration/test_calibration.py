"""From corners without noise everything comes out as it is; from too little comes one line that says what to add."""

import numpy as np
import pytest

from services.camera.calibration.hand_eye import hand_eye
from services.camera.calibration.intrinsics import intrinsics
from services.camera.exceptions import CalibrationImpossible
from tests.services.camera.calibration.eyes import BOARD, MOUNTING, OPTICS, angle, corners, links, placed, poses


@pytest.fixture
def boards():
    return poses(np.random.default_rng(4), 12)


def test_corners_without_noise_give_the_camera_as_it_is(boards):
    found = intrinsics([corners(board) for board in boards], OPTICS.width, OPTICS.height)
    assert found.error < 1e-3
    np.testing.assert_allclose(found.optics.matrix, OPTICS.matrix, atol=0.02)
    np.testing.assert_allclose(found.optics.distortion, OPTICS.distortion, atol=2e-4)
    np.testing.assert_allclose(found.boards, boards, atol=2e-5)


@pytest.mark.parametrize("seed", range(5))
def test_poses_without_noise_give_the_mounting_as_it_is_wherever_the_board_stands(seed):
    rng = np.random.default_rng(seed)
    boards = poses(rng, 8)
    mounting, stands = (placed(rng.uniform(-1.5, 1.5, 3), rng.uniform(-1, 1, 3)) for _ in range(2))
    found = hand_eye(links(boards, mounting, stands), boards)
    np.testing.assert_allclose(found.mounting, mounting, atol=1e-9)
    assert found.spread < 1e-9


def test_noise_of_the_hand_is_shared_out_by_the_poses(boards):
    rng = np.random.default_rng(5)
    shaken = [link @ placed(rng.normal(0.0, 1e-3, 3), rng.normal(0.0, 1e-3, 3)) for link in links(boards)]
    found = hand_eye(np.array(shaken), boards)
    assert np.linalg.norm(found.mounting[:3, 3] - MOUNTING[:3, 3]) < 3e-3
    assert angle(found.mounting, MOUNTING) < 3e-3
    assert 1e-4 < found.spread < 3e-3


def test_too_few_pictures_say_how_many_more(boards):
    with pytest.raises(CalibrationImpossible, match="3 pictures show the board: take 5 more"):
        intrinsics([corners(board) for board in boards[:3]], OPTICS.width, OPTICS.height)


def test_a_board_that_is_seen_from_one_side_only_is_to_be_tilted():
    flat = poses(np.random.default_rng(6), 10, tilt=0.02)
    with pytest.raises(CalibrationImpossible, match="from the same side in all 10 pictures: tilt it"):
        intrinsics([corners(board) for board in flat], OPTICS.width, OPTICS.height)


@pytest.mark.parametrize(
    ("turns", "said"),
    [
        (np.zeros((8, 3)), "is not turned in these 8 poses"),
        (np.outer(np.linspace(-0.6, 0.6, 8), (0.0, 0.0, 1.0)), "is turned about one axis only"),
    ],
)
def test_a_hand_that_is_turned_too_little_is_to_be_turned(turns, said):
    boards = np.array([placed(turn, (0.01 * n, 0.0, 0.5)) for n, turn in enumerate(turns)])
    with pytest.raises(CalibrationImpossible, match=f"{said}.*: turn it by 20 degrees"):
        hand_eye(links(boards), boards)


def test_too_few_poses_say_how_many_more(boards):
    with pytest.raises(CalibrationImpossible, match="2 poses of the robot with the board in sight: take 4 more"):
        hand_eye(links(boards[:2]), boards[:2])


def test_the_printed_board_is_found_where_it_is_and_a_part_of_it_too():
    picture, pixel = BOARD.picture(), BOARD.square / 120
    whole = BOARD.find(picture)
    assert len(whole.places) == (BOARD.columns - 1) * (BOARD.rows - 1)
    np.testing.assert_allclose((whole.pixels + 0.5) * pixel - BOARD.rim, whole.places[:, :2], atol=0.5 * pixel)
    part = BOARD.find(np.ascontiguousarray(picture[:, : picture.shape[1] // 2]))
    assert 6 <= len(part.places) < len(whole.places)
    assert BOARD.find(np.full((100, 100), 255, np.uint8)) is None


def test_the_boards_file_says_how_large_it_is():
    at = BOARD.png().index(b"pHYs")
    per_metre = int.from_bytes(BOARD.png()[at + 4 : at + 8], "big")
    height, width = BOARD.picture().shape
    assert (width / per_metre, height / per_metre) == pytest.approx(BOARD.size)
