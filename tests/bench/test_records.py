from __future__ import annotations

import dataclasses
import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from planformer.bench.accuracy.record import Record
from planformer.bench.records import from_csv, to_csv
from planformer.errors import InvalidResults

BY_TYPE = {
    "str": st.text(st.characters(exclude_characters="\r\x00", exclude_categories=["Cs"])),
    "int": st.integers(),
    "float": st.floats(allow_nan=False),
    "bool": st.booleans(),
}
RECORDS = st.builds(Record, **{f.name: BY_TYPE[f.type] for f in dataclasses.fields(Record)})


@given(st.lists(RECORDS, max_size=3))
def test_records_survive_the_file(records):
    assert from_csv(to_csv(records, Record), Record) == records


def test_missing_numbers_survive_too():
    record = Record(
        "r", 0, "", 0, "mpt", "fixed", "", False, "died", False, *[math.nan] * 5, 0, 0, 0
    )
    (found,) = from_csv(to_csv([record], Record), Record)
    assert math.isnan(found.share)
    assert math.isnan(found.length)


@pytest.mark.parametrize(
    "damage",
    [
        lambda text: "",
        lambda text: text.replace("share", "part"),
        lambda text: text[: len(text) - 30],
        lambda text: text.replace("True", "yes"),
        lambda text: text.replace("0.25", "much"),
    ],
)
def test_damaged_tables_are_refused(damage):
    record = Record("r", 0, "", 0, "mpt", "fixed", "", True, "", True, *[0.25] * 5, 0, 0.25, 0.25)
    with pytest.raises(InvalidResults, match="no table of records"):
        from_csv(damage(to_csv([record], Record)), Record)
