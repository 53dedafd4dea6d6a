from __future__ import annotations

import pytest
import typer
from hypothesis import given
from hypothesis import strategies as st

from planformer.cli.states import join_states, parse_state

numbers = st.floats(allow_nan=False, allow_infinity=False).map(repr)
states = st.lists(numbers, min_size=2, max_size=3)


@given(start=states, goal=states)
def test_all_numbers_after_an_option_are_its_state(start, goal):
    args = join_states(["room.yaml", "--start", *start, "--goal", *goal, "--json"])
    assert len(args) == 4
    assert (args[0], args[3]) == ("room.yaml", "--json")
    assert parse_state(args[1].partition("=")[2], "--start") == tuple(map(float, start))
    assert parse_state(args[2].partition("=")[2], "--goal") == tuple(map(float, goal))


@pytest.mark.parametrize(
    "args",
    [
        ["--start", "1", "-2"],
        ["--start=1", "-2"],
        ["--start=1,-2"],
        ["--start", "1,-2"],
        ["--start", "1,", "-2"],
        ["--start", "1 -2"],
        ["--start=1 -2"],
    ],
)
def test_spaces_and_commas_separate(args):
    joined = join_states(args)
    assert len(joined) == 1
    assert parse_state(joined[0].removeprefix("--start="), "--start") == (1.0, -2.0)


def test_other_arguments_pass_unchanged():
    args = ["room.yaml", "--seed", "3", "--exploration", "0.5", "--", "--start", "1", "2"]
    assert join_states(args) == args


@pytest.mark.parametrize("text", ["", " ", "1", "1 2 3 4", "1 x", "x", ","])
def test_anything_but_two_or_three_numbers_is_refused(text):
    with pytest.raises(typer.BadParameter, match=r"X Y \[YAW\]"):
        parse_state(text, "--start")
