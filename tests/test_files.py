from __future__ import annotations

import pytest

from planformer.errors import InvalidParameter
from planformer.files import whole_file, write_files


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


def test_several_files_are_replaced_only_together(tmp_path):
    first, blocked = tmp_path / "first", tmp_path / "folder"
    first.write_bytes(b"old")
    blocked.mkdir()
    (blocked / "inside").touch()
    with pytest.raises(InvalidParameter, match="folder"):
        write_files({first: b"new", blocked / "inside" / "file": b"new"})
    assert first.read_bytes() == b"old"
    assert {p.name for p in tmp_path.iterdir()} == {"first", "folder"}
