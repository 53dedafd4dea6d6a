from __future__ import annotations

import subprocess
import sys
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
    killed = f"""
import os, pathlib, signal
from planformer.files import whole_file
with whole_file(pathlib.Path({str(tmp_path)!r}, "lost")):
    os.kill(os.getpid(), signal.SIGKILL)
"""
    for name in ("kept.tmp", ".kept.tmp", ".kept.x.tmp"):
        (tmp_path / name).touch()
    subprocess.run([sys.executable, "-c", killed], check=False)
    with whole_file(tmp_path / "file") as file:
        assert len(list(tmp_path.iterdir())) == 5
        remove_unfinished(tmp_path)
        written = Path(file.name).name
        names = {path.name for path in tmp_path.iterdir()}
    assert names == {"kept.tmp", ".kept.tmp", ".kept.x.tmp", written}


@pytest.mark.parametrize("order", [1, -1])
@pytest.mark.parametrize("bad", ["folder", "file/inside"])
def test_several_files_are_replaced_only_together(tmp_path, bad, order):
    (tmp_path / "folder").mkdir()
    (tmp_path / "file").touch()
    good = tmp_path / "good"
    good.write_bytes(b"old")
    contents = {good: b"new", tmp_path / bad: b"new"}
    with pytest.raises(InvalidParameter, match=bad):
        write_files(dict([*contents.items()][::order]))
    assert good.read_bytes() == b"old"
    assert {path.name for path in tmp_path.iterdir()} == {"good", "folder", "file"}


def test_no_file_is_replaced_before_all_are_on_the_disk(tmp_path):
    """A limit of 4,000 bytes a file stands for a full disk."""
    limited = f"""
import pathlib, resource, signal
from planformer.files import write_files
signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
resource.setrlimit(resource.RLIMIT_FSIZE, (4000, 4000))
folder = pathlib.Path({str(tmp_path)!r})
write_files({{folder / "large": bytes(5000), folder / "small": b"new"}})
"""
    for name in ("large", "small"):
        (tmp_path / name).write_bytes(b"old")
    ended = subprocess.run([sys.executable, "-c", limited], check=False, capture_output=True)
    assert b"cannot be written: File too large" in ended.stderr
    assert {path.name: path.read_bytes() for path in tmp_path.iterdir()} == {
        "large": b"old",
        "small": b"old",
    }


def test_a_file_that_is_written_twice_at_once_is_whole(tmp_path):
    path = tmp_path / "file"
    with whole_file(path) as slow:
        slow.write(b"slow" * 1000)
        with whole_file(path) as fast:
            fast.write(b"fast")
        assert path.read_bytes() == b"fast"
    assert path.read_bytes() == b"slow" * 1000
    assert [p.name for p in tmp_path.iterdir()] == ["file"]
