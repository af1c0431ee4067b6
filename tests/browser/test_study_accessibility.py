"""The study's pages are for everybody: no violation that axe knows, dark and light."""

import pytest
from study_person import agree, answer, parts, send

pytest.importorskip("axe_playwright_python")
pytest.importorskip("uvicorn")

pytestmark = pytest.mark.browser


@pytest.mark.parametrize("scheme", ["dark", "light"])
def test_axe_finds_nothing_at_the_participants_page(study, visit, axe, scheme):
    tab = visit(study.page.participant_url(1), color_scheme=scheme, bypass_csp=True, reduced_motion="reduce")
    found = {}

    def look(name):
        found[name] = axe(tab)

    tab.wait_for_selector("#agree")
    look("consent")
    agree(tab)
    tab.wait_for_selector("[data-question=gender]")
    send(tab)
    look("form with what is missing")
    answer(tab)
    send(tab)
    tab.wait_for_selector(".method")
    look("before a training")
    tab.click("#withdraw")
    look("withdrawal")
    tab.keyboard.press("Escape")
    parts(study, 3)
    tab.wait_for_selector("[data-question=mental]")
    look("scales")
    answer(tab)
    send(tab)
    tab.wait_for_selector(".card")
    look("cards")
    parts(study, 2)
    tab.wait_for_selector(".countdown")
    look("break")
    assert found == {name: [] for name in found}


@pytest.mark.parametrize("scheme", ["dark", "light"])
def test_axe_finds_nothing_at_the_console(study, visit, axe, scheme):
    tab = visit(study.page.console_url, color_scheme=scheme, bypass_csp=True, reduced_motion="reduce")
    study.desk.conductor.consent(1, "en")
    parts(study, 4)
    study.desk.conductor.invalid(1, "participant", "a test", repeat=False)
    tab.click(".person[data-number='1']")
    tab.wait_for_selector(".part")
    found = {"session": axe(tab)}
    for name in ("notes", "allocation"):
        tab.click(f"[data-tab={name}]")
        found[name] = axe(tab)
    assert found == {name: [] for name in found}
