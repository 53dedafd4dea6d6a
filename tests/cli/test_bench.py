from __future__ import annotations

import json

import pytest

QUICK = ("--guide", "wavefront", "--max-vertices", 50, "--problems", 1, "--rows", "forest-360x240")


def test_accuracy_writes_prints_and_completes(cli, tmp_path):
    folder = tmp_path / "out"
    first = cli("bench", "accuracy", *QUICK, "--output", folder, "--json")
    assert first.exit_code == 0, first.output
    summary = json.loads(first.stdout)
    assert summary == json.loads((folder / "summary.json").read_text())
    assert [line["row"] for line in summary["lines"]] == ["forest-360x240"] * 2
    again = cli("bench", "accuracy", *QUICK, "--output", folder)
    assert again.exit_code == 0, again.output
    assert "forest-360x240" in again.output
    assert json.loads((folder / "summary.json").read_text()) == summary


def test_pages_take_in_the_results(cli, tmp_path):
    folder, page = tmp_path / "accuracy" / "point", tmp_path / "page.md"
    assert cli("bench", "accuracy", *QUICK, "--output", folder).exit_code == 0
    page.write_text("<!-- accuracy-point:begin -->\n<!-- accuracy-point:end -->\n")
    for _ in range(2):
        result = cli("bench", "pages", page, "--results", tmp_path)
        assert result.exit_code == 0, result.output
        table = (folder / "table.md").read_text()
        marked = f"<!-- accuracy-point:begin -->\n\n{table}\n<!-- accuracy-point:end -->\n"
        assert page.read_text() == marked


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (("--rows", "swamp"), "unknown rows swamp"),
        (("--guide", "nothing"), "unknown guide 'nothing'"),
        (("--problems", 0), "problems must be >= 1"),
        (("--real-maps", "nowhere"), "lacks the maps"),
        (("--limit", -1), "seconds must be > 0"),
    ],
)
def test_accuracy_refuses_bad_input(cli, tmp_path, options, message):
    result = cli("bench", "accuracy", *QUICK, "--output", tmp_path / "out", *options)
    assert result.exit_code == 2
    assert message in result.output
    assert not (tmp_path / "out").exists()


def test_accuracy_refuses_results_of_other_settings(cli, tmp_path):
    assert cli("bench", "accuracy", *QUICK, "--output", tmp_path / "out").exit_code == 0
    other = cli("bench", "accuracy", *QUICK, "--output", tmp_path / "out", "--seed", 1)
    assert other.exit_code == 2
    assert "other settings: seed 0 (asked for 1)" in other.output


def test_a_table_is_measured_and_printed(cli, tmp_path):
    command = ["bench", "table2", "--problems", "1", "--systems", "Lazy Theta*,A* + shortcut"]
    result = cli(*command, "--output", str(tmp_path))
    assert result.exit_code == 0, result.output
    assert "Lazy Theta*" in result.output
    assert (tmp_path / "table2" / "table.md").read_text().startswith("### maze-480, 1 problems")
    figures = [tmp_path / "table2" / f"{name}-maze-480.png" for name in ("letter_values", "solved")]
    assert all(figure.exists() for figure in figures)
    figures[0].unlink()
    assert cli("bench", "plot", tmp_path / "table2").exit_code == 0
    assert figures[0].exists()
    assert cli("bench", "plot", tmp_path).exit_code == 2


def test_an_unknown_figure_is_an_error_with_the_choices(cli, tmp_path):
    result = cli("bench", "figures", "--figures", "trees", "--output", tmp_path / "out")
    assert result.exit_code == 2
    assert "trees-forest" in result.output
    assert not (tmp_path / "out").exists()


def test_an_unknown_system_is_an_error_with_the_choices(cli, tmp_path):
    result = cli("bench", "table1", "--problems", "1", "--systems", "RRT", "--output", tmp_path)
    assert result.exit_code == 2
    assert "MPT-RRT*-EE" in " ".join(result.output.split())


def test_tables_without_the_systems_are_left_out(cli, tmp_path):
    command = ["bench", "all", "--problems", "1", "--systems", "SST", "--limit", "0.2"]
    result = cli(*command, "--output", str(tmp_path))
    assert result.exit_code == 0, result.output
    assert result.output.count("is left out: it has none of the systems") == 3
    assert [folder.name for folder in tmp_path.iterdir()] == ["table4"]


def test_a_table_without_workers_is_refused(cli, tmp_path):
    result = cli("bench", "table1", "--problems", 1, "--workers", 0, "--output", tmp_path)
    assert (result.exit_code, "workers must be >= 1" in result.output) == (2, True)
