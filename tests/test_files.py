from __future__ import annotations

from pathlib import Path

import pytest

from planformer.errors import InvalidParameter
from planformer.files import remove_unfinished, whole_file, write_files


@pytest.mark.parametrize("error", [RuntimeError, KeyboardInterrupt])
def test_a_failed_write_leaves_the_old_file(tmp_path, error):
    path = tmp_path / "file"
    path.write_bytes(b"old")

    def write_half() -> None:
        with whole_file(path) as file:
            file.write(b"half")
            raise error

    with pytest.raises(error):
        write_half()
    assert path.read_bytes() == b"old"
    assert [p.name for p in tmp_path.iterdir()] == ["file"]


def test_what_a_killed_process_left_can_be_removed(tmp_path):
    (tmp_path / "kept.tmp").touch()
    with whole_file(tmp_path / "file") as file:  # as good as killed: it never ends
        assert len(list(tmp_path.iterdir())) == 2
        remove_unfinished(tmp_path)
        assert [p.name for p in tmp_path.iterdir()] == ["kept.tmp"]
        (tmp_path / Path(file.name).name).touch()


def test_several_files_are_replaced_only_together(tmp_path):
    first, blocked = tmp_path / "first", tmp_path / "folder"
    first.write_bytes(b"old")
    blocked.mkdir()
    (blocked / "inside").touch()
    with pytest.raises(InvalidParameter, match="folder"):
        write_files({first: b"new", blocked / "inside" / "file": b"new"})
    assert first.read_bytes() == b"old"
    assert {p.name for p in tmp_path.iterdir()} == {"first", "folder"}
