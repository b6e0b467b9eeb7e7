"""Results reach the file, link, pipe or device that was named, and leave it what it was."""

import os
import threading

import pytest

from meshwright.base.errors import UsageError
from meshwright.base.files import write_text


def test_a_link_stays_a_link_and_its_file_is_replaced(tmp_path):
    target, link = tmp_path / "target", tmp_path / "link"
    target.write_text("old", encoding="utf-8")
    link.symlink_to(target)
    write_text(str(link), "new")
    assert link.is_symlink() and target.read_text(encoding="utf-8") == "new"


def test_a_file_keeps_its_mode_and_a_new_one_follows_the_mask(tmp_path):
    old, new = tmp_path / "old", tmp_path / "new"
    old.touch()
    old.chmod(0o600)
    mask = os.umask(0o027)
    try:
        write_text(str(old), "text")
        write_text(str(new), "text")
    finally:
        os.umask(mask)
    assert old.stat().st_mode & 0o777 == 0o600
    assert new.stat().st_mode & 0o777 == 0o640


def test_the_mask_of_the_process_is_left_alone_and_a_failed_write_leaves_nothing(tmp_path, monkeypatch):
    """Files that other threads make meanwhile would be open to everybody."""
    monkeypatch.setattr(os, "umask", lambda _: pytest.fail("the mask was changed"))
    write_text(str(tmp_path / "new"), "text")
    monkeypatch.setattr(os, "replace", lambda *_: (_ for _ in ()).throw(OSError(5, "broken")))
    with pytest.raises(UsageError, match="broken"):
        write_text(str(tmp_path / "other"), "text")
    assert [path.name for path in tmp_path.iterdir()] == ["new"]


def test_a_pipe_is_written_to(tmp_path):
    pipe, read = tmp_path / "pipe", []
    os.mkfifo(pipe)
    reader = threading.Thread(target=lambda: read.append(pipe.read_text(encoding="utf-8")))
    reader.start()
    write_text(str(pipe), "text")
    reader.join(timeout=10)
    assert read == ["text"] and pipe.is_fifo()


def test_a_device_stays_a_device():
    write_text(os.devnull, "text")
    assert not os.path.isfile(os.devnull)


def test_a_folder_is_refused(tmp_path):
    with pytest.raises(UsageError, match="a folder; name a file in it"):
        write_text(str(tmp_path), "text")
