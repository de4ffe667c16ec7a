"""What an object has computed once is not computed again, and is never taken for the answer of another method."""

from __future__ import annotations

from collections.abc import Callable

from deltaq.language.memory import cached_method


class Above:
    def __init__(self) -> None:
        self.computed: list[str] = []

    @cached_method
    def f(self, number: int = 0) -> str:
        self.computed.append(f"above {number}")
        return f"above {number}"


class Below(Above):
    @cached_method
    def f(self, number: int = 0) -> str:
        self.computed.append(f"below {number}")
        return f"below {number} and {super().f(number)}"


class Lowest(Below):
    def f(self, number: int = 0) -> str:
        return f"lowest and {super().f(number)}"


def test_an_answer_is_computed_once_for_each_object_and_argument() -> None:
    one, other = Above(), Above()
    assert [one.f(1), one.f(1), one.f(2), one.f(number=1), one.f(number=1), other.f(1)] == [
        f"above {number}" for number in (1, 1, 2, 1, 1, 1)
    ]
    assert (one.computed, other.computed) == (["above 1", "above 2", "above 1"], ["above 1"])


def test_a_class_above_answers_for_itself_whoever_was_asked_first() -> None:
    """By its name alone an answer of the class below would be found for the class above, or the other way round."""
    below = Below()
    assert [below.f(3), below.f(3), super(Below, below).f(3)] == [
        "below 3 and above 3",
        "below 3 and above 3",
        "above 3",
    ]
    assert below.computed == ["below 3", "above 3"]
    first_above = Lowest()
    assert super(Below, first_above).f(3) == "above 3"
    assert first_above.f(3) == "lowest and below 3 and above 3"


def test_functions_of_one_name_in_two_modules_keep_apart() -> None:
    """Functions that take the object are kept with it, too."""
    functions = [cached_method(_named("f", module, module)) for module in ("one", "other")]
    subject = Above()
    assert [function(subject) for function in functions * 2] == ["one", "other"] * 2


def _named(name: str, module: str, answer: str) -> Callable[[object], str]:
    def function(_subject: object) -> str:
        return answer

    function.__qualname__, function.__module__ = name, module
    return function
