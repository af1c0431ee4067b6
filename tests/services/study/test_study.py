"""A study's folder: made, frozen, opened; what changes afterwards is told, and written down with its reason."""

import datetime
import shutil

import pytest

from services.study import freezing
from services.study.events import Deviated, Enrolled, Opened
from services.study.exceptions import FrozenAlready, Mixed, NoStudy, NotFrozen, StudyFrozen, StudyInUse, StudyThere
from services.study.protocols import SHIPPED
from services.study.study import new_study, open_study

NOW = datetime.datetime(2026, 1, 1, tzinfo=datetime.UTC)


def now():
    return NOW


@pytest.fixture
def study(tmp_path):
    return new_study(tmp_path / "study", SHIPPED["thesis"])


def test_a_new_study_wants_a_folder_of_its_own(study):
    with pytest.raises(StudyThere):
        new_study(study.folder, SHIPPED["thesis"])
    with pytest.raises(NoStudy, match="retouch study new"):
        open_study(study.folder / "raw")
    assert open_study(study.folder) == study


def test_people_take_part_only_once_it_is_frozen(study):
    with pytest.raises(NotFrozen):
        study.journal(now, synthetic=False)
    study.freeze(NOW.isoformat())
    with study.journal(now, synthetic=False) as journal:
        assert isinstance(journal.entries[0].event, Opened)


def test_it_is_frozen_anew_until_it_has_begun(study):
    study.freeze(NOW.isoformat())
    with (study.folder / "protocol.toml").open("a", encoding="utf-8") as file:
        file.write("# changed\n")
    anew = study.freeze(NOW.isoformat())
    assert study.frozen() == anew == study.now(NOW.isoformat())
    assert anew.files["protocol.toml"] in (study.folder / "preregistration.md").read_text(encoding="utf-8")
    study.journal(now, synthetic=False).close()
    with pytest.raises(FrozenAlready, match="--deviation"):
        study.freeze(NOW.isoformat())
    assert study.frozen() == anew


def test_the_preregistration_names_hypotheses_orders_and_digests(study):
    frozen = study.freeze(NOW.isoformat())
    text = (study.folder / "preregistration.md").read_text(encoding="utf-8")
    for hypothesis in study.protocol.analysis.hypotheses:
        assert hypothesis.name in text
    assert frozen.files["protocol.toml"] in text
    assert "2. OnKey, OffStyl, OnStyl, OffKey" in text


@pytest.mark.parametrize(("models", "said"), [(1, "one model is adapted"), (3, "3 identical models are adapted")])
def test_the_preregistration_is_for_people_to_read(study, models, said):
    path = study.folder / "protocol.toml"
    path.write_text(path.read_text(encoding="utf-8").replace("models = 3", f"models = {models}"), encoding="utf-8")
    open_study(study.folder).freeze(NOW.isoformat())
    text = (study.folder / "preregistration.md").read_text(encoding="utf-8")
    assert "- OnKey: prediction, keyboard. You correct the robot's motion with the keys while it runs." in text
    assert said in text
    assert "without who failed to adapt a model or a training in any method" in text
    assert not set("{}") & set(text)


@pytest.mark.parametrize("what", ["protocol.toml", "instruments/own.toml"])
def test_what_changes_after_freezing_is_refused_until_somebody_says_why(study, what):
    own = study.folder / "instruments" / "own.toml"
    own.write_text("", encoding="utf-8")
    study.freeze(NOW.isoformat())
    with (study.folder / what).open("a", encoding="utf-8") as file:
        file.write("# changed\n")
    changed = open_study(study.folder)
    with pytest.raises(StudyFrozen, match=what.replace(".", r"\.")):
        changed.journal(now, synthetic=False)
    assert changed.entries() == []
    changed.journal(now, synthetic=False, deviation="the board asked for it").close()
    changed.journal(now, synthetic=False).close()  # said once is said
    deviations = [entry.event for entry in changed.entries() if isinstance(entry.event, Deviated)]
    assert [(list(one.changed), one.reason) for one in deviations] == [([what], "the board asked for it")]


@pytest.mark.parametrize("what", ["ranks.py", "report.html.jinja"])
def test_all_of_the_analysis_is_in_its_digest(tmp_path, monkeypatch, what):
    copy = tmp_path / "analysis"
    shutil.copytree(freezing._ANALYSIS, copy)
    monkeypatch.setattr(freezing, "_ANALYSIS", copy)
    before = freezing.analysis()
    (copy / what).write_bytes((copy / what).read_bytes() + b"\n")
    assert freezing.analysis() != before


def test_another_change_wants_another_reason(study):
    study.freeze(NOW.isoformat())
    path = study.folder / "protocol.toml"
    for reason in ("first", "second"):
        path.write_text(path.read_text(encoding="utf-8") + "# more\n", encoding="utf-8")
        with pytest.raises(StudyFrozen):
            study.journal(now, synthetic=False)
        study.journal(now, synthetic=False, deviation=reason).close()


@pytest.mark.parametrize("synthetic", [True, False])
def test_people_and_simulated_participants_are_never_in_one_study(study, synthetic):
    study.freeze(NOW.isoformat())
    with study.journal(now, synthetic=synthetic) as journal:
        journal.add(Enrolled(participant=1, order=(), group=0, language="en", synthetic=synthetic))
    with pytest.raises(Mixed):
        study.journal(now, synthetic=not synthetic)
    study.journal(now, synthetic=synthetic).close()


def test_two_consoles_on_one_study_are_refused(study):
    study.freeze(NOW.isoformat())
    with study.journal(now, synthetic=False), pytest.raises(StudyInUse):
        study.journal(now, synthetic=False)
