"""What a person does at the pages of a study."""

QUESTION = "[data-question]"


def agree(tab):
    """Agree to the text."""
    tab.check("#agree")
    tab.click("button.go")


def answer(tab, but=()):
    """Answer every question on the page, but some."""
    tab.wait_for_selector(QUESTION)
    for question in tab.query_selector_all(QUESTION):
        if question.get_attribute("data-question") in but:
            continue
        if question.get_attribute("data-kind") in ("choice", "scale"):
            fields = question.query_selector_all("input")
            fields[len(fields) // 2].check(force=True)
        else:
            question.query_selector("input, textarea").fill("mechanical engineering")


def send(tab):
    """Press the form's button."""
    tab.click("form button.go")


def set_(tab):
    """Names of the questions that have a radio button pressed, or a text."""
    return tab.evaluate(
        """() => [...document.querySelectorAll("[data-question]")].filter((question) =>
            question.querySelector("input:checked") ||
            [...question.querySelectorAll("input:not([type=radio]), textarea")].some((field) => field.value)
        ).map((question) => question.dataset.question)"""
    )


def missing(tab):
    """Names of the questions that are marked as missing."""
    return tab.eval_on_selector_all("[data-missing]", "found => found.map((one) => one.dataset.question)")


def parts(study, count):
    """Do so many of participant 1's next trials, without a browser."""
    for _ in range(count):
        conductor = study.desk.conductor
        conductor.end(1, conductor.now(1))
