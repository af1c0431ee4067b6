"""What holds for all tests."""

import gc
import shutil

import pytest
from hypothesis import settings

# Few examples, always the same ones: the unmarked tests are to take seconds, and a failure is to come again.
settings.register_profile("quick", max_examples=12, deadline=None, derandomize=True)
settings.load_profile("quick")


def pytest_sessionstart():
    """What is collected is kept: nothing of it is garbage."""
    gc.disable()


def pytest_collection_finish():
    """Thousands of tests are not to be looked through for garbage again and again."""
    gc.freeze()
    gc.enable()


CHROMIUM_FLAGS = (
    "--no-sandbox",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    # Draws in three dimensions without a graphics card; all else is drawn as browsers draw it without one.
    "--enable-unsafe-swiftshader",
)


@pytest.fixture(scope="session")
def browser():
    """A headless Chromium."""
    playwright = pytest.importorskip("playwright.sync_api")
    executable = shutil.which("chromium")
    if executable is None:
        pytest.skip("no chromium in PATH")
    with playwright.sync_playwright() as started:
        chromium = started.chromium.launch(executable_path=executable, args=list(CHROMIUM_FLAGS))
        yield chromium
        chromium.close()
