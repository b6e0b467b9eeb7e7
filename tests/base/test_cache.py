"""What is executed or loaded from the cache is as it was written, the user's own, and nobody else's to write."""

import os
import random
import subprocess
import sys
import tempfile
from pathlib import Path

import pytest

from meshwright.base import cache, first_use, library

pytestmark = pytest.mark.skipif(os.name == "nt", reason="a profile's folders are the user's own")

KEY = "declarations"


@pytest.fixture
def folder(tmp_path, monkeypatch):
    place = tmp_path / "cache"
    place.mkdir(cache.PRIVATE)
    monkeypatch.setenv(cache.CACHE, str(place))
    return place


def _loaded(folder):
    """What a process of its own says on standard error when it reads the interface, which must be right."""
    code = "from meshwright.base.library import ffi; assert ffi.sizeof('mw_info') > 0"
    environment = os.environ | {cache.CACHE: str(folder)}
    done = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, (done.returncode, done.stderr)
    return done.stderr


def test_a_flipped_bit_is_found(tmp_path):
    """Anywhere in the file, its seal included; a file cut short or of other declarations too."""
    place, content = tmp_path / "interface.sealed", library.Path(library.__file__).read_bytes()
    cache.write_sealed(place, KEY, content)
    assert cache.read_sealed(place, KEY) == content
    written, chance = place.read_bytes(), random.Random(1)
    for _ in range(300):
        changed = bytearray(written)
        changed[chance.randrange(len(changed) if chance.random() < 0.5 else 65)] ^= 1 << chance.randrange(8)
        place.write_bytes(changed if chance.random() < 0.9 else changed[: chance.randrange(len(changed))])
        with pytest.raises(ValueError, match="damaged"):
            cache.read_sealed(place, KEY)
    place.write_bytes(written)
    with pytest.raises(ValueError, match="damaged"):
        cache.read_sealed(place, "other declarations")


def test_planted_and_damaged_files_are_made_anew_and_said(folder):
    assert not _loaded(folder) and not _loaded(folder)
    (kept,) = folder.glob("interface-*")
    whole = kept.read_bytes()
    for planted in (b"raise SystemExit(3)", b"import os\nos._exit(3)", whole[:65] + b"import os\nos._exit(3)\n", b""):
        kept.write_bytes(planted)
        said = _loaded(folder)
        assert "damaged; made anew" in said and str(kept) in said
        assert kept.read_bytes() == whole and not _loaded(folder)
    kept.chmod(0o666)
    assert "writable by other users; made anew" in _loaded(folder)
    assert kept.stat().st_mode & 0o777 == 0o600


@pytest.mark.parametrize("kind", ["group", "others", "owner"])
def test_a_cache_that_others_may_write_is_not_used(folder, kind):
    if kind == "owner" and os.geteuid() != 0:
        pytest.skip("only root gives a folder away")
    _loaded(folder)
    (kept,) = folder.glob("interface-*")
    before = kept.read_bytes()
    if kind == "owner":
        os.chown(folder, 12345, -1)
    else:
        folder.chmod(0o770 if kind == "group" else 0o707)
    said = _loaded(folder)
    reason = "of another user" if kind == "owner" else "writable by other users"
    assert said.startswith(f"meshwright: {folder}: {reason}")
    assert cache.CACHE in said and kept.read_bytes() == before
    assert not list(Path(tempfile.gettempdir()).glob(f"meshwright-*/{kept.name}"))


@pytest.mark.parametrize("seed", range(12))
def test_a_kept_folder_is_whole_and_the_users_own_or_made_anew(folder, seed, capsys):
    """Bits flipped, files added, taken away, given to others or replaced by links, at random."""
    chance = random.Random(seed)

    def make(place):
        (place / "include").mkdir()
        for name in ("drive.so", "drive.json", "include/drive.h"):
            (place / name).write_bytes(b"made of " + name.encode() * 20)

    place = first_use._kept("drive-1", "compiling drive", make)
    assert "first use" in capsys.readouterr().err and first_use._kept("drive-1", "", make) == place
    whole = {path: path.read_bytes() for path in place.rglob("*") if path.is_file()}
    hit = chance.choice(sorted(whole))
    match seed % 6:
        case 0:
            content = bytearray(whole[hit])
            content[chance.randrange(len(content))] ^= 1 << chance.randrange(8)
            hit.write_bytes(content)
        case 1:
            hit.with_name("planted.so").write_bytes(b"planted")
        case 2:
            hit.unlink()
        case 3:
            chance.choice([hit, place / "include", place]).chmod(0o777)
        case 4:
            hit.rename(folder / "elsewhere")
            hit.symlink_to(folder / "elsewhere")
        case 5:
            place.rename(folder / "elsewhere")
            place.symlink_to(folder / "elsewhere")
    assert first_use._kept("drive-1", "compiling drive", make) == place
    assert "damaged or not yours alone: made anew" in capsys.readouterr().err
    assert {path: path.read_bytes() for path in place.rglob("*") if path.is_file()} == whole
    assert not place.is_symlink() and first_use._whole(place)
