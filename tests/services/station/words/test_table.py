"""The one table of words: all of it is said, nothing else is, and another language is another file."""

import json
import re
from html.parser import HTMLParser
from string import Formatter

import msgspec
import pytest

from services.station.page.document import document
from services.station.words.table import HERE, Speech, speech
from tests.services.station.browser import VIEW

STATION = HERE.parent
ENGLISH = msgspec.toml.decode((HERE / "en.toml").read_bytes())
NAMES = {f"{section}.{name}" for section, named in ENGLISH.items() for name in named}
LANGUAGES = sorted(file.stem for file in HERE.glob("*.toml"))
SECTIONS = "|".join(ENGLISH)
BY_NAME = re.compile(rf"""(?:["'`]|\${{)((?:{SECTIONS})\.[a-z0-9_]+)["'`}}]""")
BY_BEGINNING = re.compile(rf"""["'`]((?:{SECTIONS})\.[a-z0-9_]*)\$?{{""")
"""Of names that are put together where they are said."""

BY_SECTION = re.compile(r"""section\("(\w+)"\)""")

MARK = "¿"
"""Before and behind every word of the made-up language."""

NOT_WORDS = re.compile(r"^[\W\d]*$|^robot1$|^[A-Z]$|^[+−][xyz]$")


def sources():
    """All that says something: Python, scripts, parts of the page."""
    files = [*STATION.rglob("*.py"), *STATION.rglob("*.js"), *STATION.rglob("*.html")]
    return "\n".join(file.read_text(encoding="utf-8") for file in files)


@pytest.fixture
def marked(tmp_path):
    """The process speaks a language in which every word is marked."""
    lines = []
    for section, named in ENGLISH.items():
        lines.append(f"[{section}]")
        lines += [f"{name} = {json.dumps(MARK + words + MARK)}" for name, words in named.items()]
    (tmp_path / "xx.toml").write_text("\n".join(lines), encoding="utf-8")
    speech.speak("xx", tmp_path)
    yield
    speech.speak("en")


class Texts(HTMLParser):
    """The texts of a page that a person reads, or has read out."""

    def __init__(self):
        super().__init__()
        self.texts = []
        self.unread = 0

    def handle_starttag(self, tag, attrs):
        self.unread += tag in {"script", "style"}
        read_out = ("aria-label", "title", "alt", "placeholder", "data-confirm", "data-confirm-yes", "data-question")
        self.texts += [value for name, value in attrs if name in read_out]

    def handle_endtag(self, tag):
        self.unread -= tag in {"script", "style"}

    def handle_data(self, data):
        if not self.unread:
            self.texts.append(data.strip())


def test_every_word_that_is_said_is_in_the_table():
    said = set(BY_NAME.findall(sources()))
    assert len(said) > 100
    assert said <= NAMES


def test_every_word_of_the_table_is_said():
    text = sources()
    said = set(BY_NAME.findall(text))
    beginnings = (*BY_BEGINNING.findall(text), *(f"{section}." for section in BY_SECTION.findall(text)))
    assert {name for name in NAMES - said if not name.startswith(beginnings)} == set()


@pytest.mark.usefixtures("marked")
def test_nothing_on_the_page_stands_outside_the_table():
    parser = Texts()
    parser.feed(document("robot1", VIEW))
    assert len(parser.texts) > 50
    assert [text for text in parser.texts if not NOT_WORDS.match(text) and MARK not in text] == []


@pytest.mark.usefixtures("marked")
def test_the_page_names_its_language():
    assert '<html lang="xx">' in document("robot1", VIEW)


def test_the_scripts_write_no_words_of_their_own():
    written = re.compile(r"""(?:textContent|title|innerText|ariaLabel)\s*=\s*["'`][^"'`]*[A-Za-z]{2,}""")
    scripts = [*(STATION / "page" / "assets" / "js").rglob("*.js")]
    assert {file.name: written.findall(file.read_text(encoding="utf-8")) for file in scripts} == {
        file.name: [] for file in scripts
    }


@pytest.mark.parametrize("language", LANGUAGES)
def test_a_language_that_comes_with_it_has_every_word_and_fills_in_the_same_facts(language):
    def facts(words):
        return {fact for _, fact, _, _ in Formatter().parse(words) if fact is not None}

    english, spoken = Speech(), msgspec.toml.decode((HERE / f"{language}.toml").read_bytes())
    assert {f"{section}.{name}" for section, named in spoken.items() for name in named} == NAMES
    for section, named in spoken.items():
        for name, words in named.items():
            assert words.strip(), f"{section}.{name} is empty"
            assert facts(words) == facts(english.words[f"{section}.{name}"]), f"{section}.{name}"


def test_german_is_one_of_the_languages():
    german = Speech()
    german.speak("de")
    assert (german.language, german.say("light.red")) == ("de", "Zuschauen")


def test_a_word_that_a_language_lacks_stays_english(tmp_path):
    (tmp_path / "nl.toml").write_text('[light]\nred = "Kijk"\n', encoding="utf-8")
    dutch = Speech()
    dutch.speak("nl", tmp_path)
    assert (dutch.say("light.red"), dutch.say("light.amber")) == ("Kijk", "Wait")


def test_a_language_without_a_table_is_refused_by_name():
    with pytest.raises(LookupError, match="no words in 'xx', only in de, en"):
        Speech().speak("xx")


def test_what_stands_in_braces_is_filled_in():
    assert speech.say("workflow.taken", who="ann") == "ann commands the robot."
