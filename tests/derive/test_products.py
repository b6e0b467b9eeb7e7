"""What of generated/ is in git, what is made on demand, the manifest of both and the archive of the latter."""

import gzip
import hashlib
import json
import shutil
import subprocess
import tarfile
from pathlib import Path

import pytest

from derive import products
from meshwright.base.compile import GENERATED as HEADERS

ROOT = products.GENERATED.parent
FILES = {
    "README.md": "words\n",
    "families.json": "{}\n",
    "c/drive.h": "int a;\n",
    "c/drive_lanes.h": "int b;\n",
    "c/drive.json": '"γ"\n',
    "audit/ledger.jsonl": "{}\n",
    "audit/checker/lines.py": "pass\n",
}
ON_DEMAND = {"c/drive_lanes.h", "c/drive.json", "audit/checker/lines.py"}


def git(*words, **options):
    return subprocess.run(["git", *words], cwd=ROOT, capture_output=True, text=True, **options).stdout


@pytest.fixture
def written(tmp_path):
    """A function that writes files and their manifest into a new folder."""

    def write(name, files=FILES, without=()):
        for path, text in (files | {"manifest.json": products.manifest(files)}).items():
            if path not in without:
                (tmp_path / name / path).parent.mkdir(parents=True, exist_ok=True)
                (tmp_path / name / path).write_text(text, encoding="utf-8")
        return tmp_path / name

    return write


def test_gitignore_says_what_the_list_says():
    lines = (ROOT / ".gitignore").read_text(encoding="utf-8").splitlines()
    assert [line for line in lines if "generated/" in line and "meshwright" not in line] == products.ignored()


def test_git_ignores_every_generated_file_that_is_not_kept_and_no_other():
    more = ("manifest.json", "benchmark/contacts.json", "benchmark/designs/any.toml", "site/a.html")
    paths = [*products.listed(), *more]
    said = git("check-ignore", "--no-index", "--stdin", input="".join(f"generated/{path}\n" for path in paths))
    assert set(said.splitlines()) == {f"generated/{path}" for path in paths if not products.kept(path)}


def test_what_git_holds_is_kept_and_small():
    held = git("ls-files", "generated").splitlines()
    if not held:
        pytest.skip("not a checkout of git")
    assert [path for path in held if not products.kept(path.removeprefix("generated/"))] == []
    assert len(held) <= 200
    assert sum((ROOT / path).stat().st_size for path in held) <= 16e6


def test_one_header_of_a_drive_is_kept():
    assert [name for name in HEADERS if products.kept(f"c/{name.format('face_worm')}")] == ["{}.h"]


def test_the_page_beside_the_files_names_every_kind():
    page = products.readme()
    kinds = {path.rpartition(".")[2] for path in products.listed()} - {"tex", "txt", "py", "html", "jsonl"}
    assert all(f".{kind}`" in page for kind in kinds)


def test_only_what_is_made_on_demand_can_be_missing(written):
    assert products.missing(written("whole")) == []
    bare = written("bare", without=ON_DEMAND)
    assert set(products.missing(bare)) == ON_DEMAND
    (bare / "c" / "drive.json").write_text("of an older run\n")
    assert set(products.missing(bare)) == ON_DEMAND
    (bare / "c" / "drive.json").write_text(FILES["c/drive.json"], encoding="utf-8")
    assert set(products.missing(bare)) == ON_DEMAND - {"c/drive.json"}


@pytest.mark.parametrize(
    ("path", "content", "words"),
    [
        ("c/drive.h", "int a; \n", "has been changed"),
        ("c/drive.h", None, "is missing"),
        ("audit/ledger.jsonl", "{}\r\n", "has been changed"),
        ("c/old.h", "", "is made by nothing"),
        ("casadi/old.casadi", "", "is made by nothing"),
    ],
)
def test_a_byte_of_what_git_keeps_and_a_stray_file_are_named(written, capsys, monkeypatch, path, content, words):
    fresh, folder = written("fresh"), written("committed", without=ON_DEMAND)
    assert list(products.differences(fresh, folder)) == []
    (folder / path).parent.mkdir(exist_ok=True)
    (folder / path).unlink(missing_ok=True)
    if content is not None:
        (folder / path).write_bytes(content.encode())
    (line,) = products.differences(fresh, folder)
    assert line.startswith(f"{path}: {words}")
    monkeypatch.setattr(products, "differences", lambda fresh: [line])
    assert products.main(["check", str(fresh)]) == 1
    assert f"generated/{line}\n" in capsys.readouterr().err


@pytest.mark.parametrize("path", FILES)
def test_a_file_that_is_made_otherwise_is_named_whether_git_keeps_it_or_not(written, path):
    folder = written("committed", without=ON_DEMAND)
    changed = written("changed", FILES | {path: FILES[path] + " "})
    assert list(products.differences(changed, folder)) == [f"{path}: is made otherwise than the manifest says"]
    fewer = written("fewer", {name: text for name, text in FILES.items() if name != path})
    assert f"{path}: is in the manifest, but not made" in products.differences(fewer, folder)
    more = written("more", FILES | {"c/new_lanes.h": ""})
    assert list(products.differences(more, folder)) == ["c/new_lanes.h: is not in the manifest"]


def test_what_was_made_elsewhere_is_taken_but_for_what_git_keeps(written):
    folder = written("committed", without=ON_DEMAND)
    (folder / "c" / "drive_lanes.h").write_text("of an older run\n")
    products.take(written("fresh", FILES | {"c/drive.h": "int other;\n"}), folder)
    assert products.missing(folder) == []
    assert (folder / "c" / "drive.h").read_text() == FILES["c/drive.h"]
    assert not [*folder.rglob("*.part")]


def test_the_archive_completes_what_git_keeps_and_is_the_one_that_the_manifest_pins(written, tmp_path):
    files = [tmp_path / "first.tar.gz", tmp_path / "again" / "second.tar.gz"]
    for file in files:
        products.pack(file, written("whole"))
    assert files[0].read_bytes() == files[1].read_bytes()
    folder = written("bare", without=ON_DEMAND)
    pinned = json.loads((folder / "manifest.json").read_text(encoding="utf-8"))["archive"]["tar_sha256"]
    assert hashlib.sha256(gzip.decompress(files[0].read_bytes())).hexdigest() == pinned
    with tarfile.open(files[0]) as packed:
        assert set(packed.getnames()) == ON_DEMAND
        packed.extractall(folder, filter="data")
    assert products.missing(folder) == []


def test_the_archive_is_the_same_in_whatever_order_files_were_made():
    assert products.manifest(FILES) == products.manifest(dict(reversed(FILES.items())))


def test_an_archive_that_is_not_pinned_is_refused_with_the_remedy(written, tmp_path):
    folder, out = written("whole"), tmp_path / "archive.tar.gz"
    for change, words in (
        (lambda found: found.pop("archive"), "pins no archive: some drives were made alone; `make generate`"),
        (lambda found: found["archive"].update(tar_sha256="0"), "is not the one that"),
        (lambda found: found["files"].update({"c/drive.json": "0"}), "`make build` makes it"),
        (lambda found: found.pop("files"), "is damaged"),
    ):
        found = json.loads(products.manifest(FILES))
        change(found)
        (folder / "manifest.json").write_text(json.dumps(found))
        with pytest.raises(products.Damaged, match=words):
            products.pack(out, folder)
    assert not out.exists()


def test_a_folder_without_a_manifest_is_named(tmp_path, capsys):
    assert products.main(["check", str(tmp_path)]) == 2
    assert f"{tmp_path / 'manifest.json'} is missing" in capsys.readouterr().err


def test_a_drive_derived_alone_leaves_a_manifest_that_lists_it_as_it_is(tmp_path):
    from derive import generated

    shutil.copy(products.GENERATED / "manifest.json", tmp_path)
    before = (tmp_path / "manifest.json").read_bytes()
    texts = {p: (products.GENERATED / p).read_text("utf-8") for p in products.listed() if p.startswith("c/spherical")}
    generated.add(tmp_path, texts)
    assert (tmp_path / "manifest.json").read_bytes() == before
    generated.add(tmp_path, {"c/own.h": ""})
    assert products.listed(tmp_path) == products.listed() | {"c/own.h": products.sha256("")}
    with pytest.raises(products.Damaged, match="pins no archive"):
        products.pack(Path(tmp_path, "a.tar.gz"), tmp_path)
