"""The page over HTTPS, as another computer opens it."""

import pytest

from tests.ports import free_port
from tests.services.station.page.self_signed import self_signed

pytestmark = pytest.mark.browser


@pytest.fixture
def secured(tmp_path):
    """A page that is served under a certificate."""
    from harness import served

    certificate, key = self_signed(tmp_path, "page")
    with served(port=free_port(), certificate=str(certificate), key=str(key)) as (page, _):
        yield page


def test_it_commands_and_draws_over_https_alone(browser, secured, eventually):
    context = browser.new_context(ignore_https_errors=True)
    page = context.new_page()
    asked = []
    page.on("request", lambda request: asked.append(request.url))
    page.goto(secured.url)
    page.wait_for_selector("body[data-link=armed]")
    page.wait_for_selector(".scene[data-view=live]")
    assert page.evaluate("isSecureContext")
    assert {url.partition(":")[0] for url in asked} <= {"https", "wss", "data", "blob"}
    eventually(lambda: secured.take_input().focused or page.wait_for_timeout(20))
    page.keyboard.press("Escape")
    presses = []
    eventually(lambda: presses.extend(secured.take_presses()) or presses or page.wait_for_timeout(20))
    assert [press.action for press in presses] == ["stop"]
    context.close()
