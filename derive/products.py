"""What of ``generated/`` is kept in git, and what is made on demand in the same places, shipped in the wheel and packed
into one archive. Needs the standard library alone.

As a program::

    python -m derive.products missing        exit status 1 if any of the latter is missing, or of another manifest
    python -m derive.products check FOLDER   compare what derive has made in FOLDER; take the latter from there
    python -m derive.products pack FILE      write the archive, which must be the one that the manifest pins
"""

import argparse
import gzip
import hashlib
import io
import json
import os
import shutil
import sys
import tarfile
from fnmatch import fnmatchcase
from pathlib import Path

GENERATED = Path(__file__).resolve().parent.parent / "generated"
MANIFEST = "manifest.json"

#: Files that git keeps, by their kind → what for. A person copies them, reviews them or tests against them.
KEPT = {
    "c/*.h": "to embed a drive: one header of C99 and C++11 that needs `sqrt` and nothing else",
    "descriptions/*.json": "to review what a changed page changes; read by checkers and programs of others",
    "families.json": "to review: families, their drives, keys and words",
    "audit/ledger.jsonl": "to review: sources, definitions, statements and verdicts of the audit record",
    "benchmark/*": "to test other programs against: certified contacts, by `make benchmark`",
    "README.md": "this page",
    MANIFEST: "to compare: SHA-256 of every file that `python -m derive` makes, and of the archive",
}
#: Files that are made on demand, by their kind → what for. One of both kinds, by its name, is made on demand.
MADE = {
    "c/*_lanes.h": "several instances of a drive at once",
    "c/*_sensitivity.h": "derivatives by the design",
    "c/*_certify.h": "the proof of a contact: beside the drive's own header, and no library",
    "c/*_bounded.h": "edges and limits, for the drive's shared object",
    "c/*_certified.h": "tables of operations for enclosures, for the drive's shared object",
    "c/*.json": "names, units, shapes, equations and a self-test of each header; read by the runtime",
    "casadi/*.casadi": "functions for CasADi, to load without `derive`",
    "audit/": "certificates, pages (`audit/index.html`) and checkers that need Python alone (`audit/check*.py`)",
}
#: Folders that other commands make here, beside what derive makes.
BESIDE = ("benchmark", "site")


class Damaged(ValueError):
    """A manifest that cannot be read; says which."""


def kept(path):
    """Whether git keeps a file, by its path below ``generated/``."""
    return any(fnmatchcase(path, kind) for kind in KEPT) and not any(fnmatchcase(path, kind) for kind in MADE)


def ignored():
    """The lines of ``.gitignore`` that say the same."""
    lines = ["/generated/*"]
    for kind in KEPT:
        folder, _, _ = kind.rpartition("/")
        lines += [f"!/generated/{folder}/", f"/generated/{folder}/*"] if folder else []
        lines.append(f"!/generated/{kind}")
    return [*lines, *(f"/generated/{kind}" for kind in MADE if any(fnmatchcase(kind, wider) for wider in KEPT))]


def readme():
    """``generated/README.md``."""

    def table(heading, kinds):
        named = {kind.replace("*.", "<drive>.").replace("*_", "<drive>_").rstrip("*"): kinds[kind] for kind in kinds}
        return "\n".join([f"| {heading} | for |", "|---|---|", *(f"| `{name}` | {named[name]} |" for name in named)])

    return f"""# What `python -m derive` makes

Nothing here is edited: a page below `derive/` is, and `make generate` makes all of this anew. `make check` makes it
elsewhere and fails on any byte of difference. `make help` lists what else there is.

{table("in git", KEPT)}

The rest is made in its places by `make setup build`, and is in no commit:

{table("made on demand", MADE)}

An installed package has the headers in `meshwright/_generated/include`, JSON and CasADi files beside that folder.
`make dist` packs all that is made on demand into `dist/generated.tar.gz`, for those who have no Python: unpack it here.
The manifest pins it by the SHA-256 of the tar inside (`gunzip -c dist/generated.tar.gz | sha256sum`), which is the same
on every machine; how well it is compressed may not be.
"""


def hashes(files):
    """SHA-256 of generated files by their path."""
    return {path: sha256(text) for path, text in files.items()}


def sha256(content):
    """SHA-256 of a text or of bytes."""
    return hashlib.sha256(content.encode() if isinstance(content, str) else content).hexdigest()


def manifest(files):
    """The list of all generated files, path → text, with their hashes and that of their archive."""
    texts = {path: text for path, text in files.items() if path != MANIFEST}
    return manifest_of(hashes(texts), sha256(archive(texts)))


def manifest_of(hashes, archive=None):
    """The list of files with these hashes; the hash of their archive is left out where not all files are known."""
    pinned = {} if archive is None else {"archive": {"tar_sha256": archive}}
    listed = {"schema": "meshwright.manifest/1", **pinned, "files": dict(sorted(hashes.items()))}
    return json.dumps(listed, indent=1) + "\n"


def archive(texts):
    """A tar of those of the files (path → text or bytes) that git does not keep, the same on every machine."""
    packed = io.BytesIO()
    with tarfile.open(fileobj=packed, mode="w", format=tarfile.USTAR_FORMAT) as tar:
        for path in sorted(path for path in texts if not kept(path)):
            content = texts[path].encode() if isinstance(texts[path], str) else texts[path]
            entry = tarfile.TarInfo(path)
            entry.size, entry.mode = len(content), 0o644
            tar.addfile(entry, io.BytesIO(content))
    return packed.getvalue()


def listed(folder=GENERATED):
    """Path → hash of the files that a folder's manifest lists."""
    return _manifest(folder)["files"]


def _manifest(folder):
    path = folder / MANIFEST
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
        if not all(isinstance(word, str) for pair in found["files"].items() for word in pair):
            raise ValueError("files: no hashes of paths")
    except FileNotFoundError:
        raise Damaged(f"{path} is missing: `python -m derive` makes it") from None
    except (ValueError, KeyError, TypeError, AttributeError) as error:
        raise Damaged(f"{path} is damaged ({error}): remove it, and `python -m derive` makes it anew") from error
    if outside := [name for name in found["files"] if Path(name).is_absolute() or ".." in Path(name).parts]:
        raise Damaged(f"{path} names {outside[0]}, which is outside its folder: remove it")
    return found


def made(folder=GENERATED):
    """Paths of the listed files that are made on demand."""
    return [path for path in listed(folder) if not kept(path)]


def absent(folder=GENERATED):
    """Those of them that are not there, whatever the others are."""
    return [path for path in made(folder) if not (folder / path).exists()]


def missing(folder=GENERATED):
    """Those of them that are not there, or not as listed."""
    hashes = listed(folder)
    return [path for path in made(folder) if not _is(folder / path, hashes[path])]


def _is(path, hash_):
    return path.is_file() and sha256(path.read_bytes()) == hash_


def differences(fresh, folder=GENERATED):
    """What of ``folder`` is not as in ``fresh``, where derive has just made everything: lines in words.

    By the two manifests and, of what git keeps, byte for byte; other files that lie in ``folder`` are strays.
    """
    new, old = listed(fresh), listed(folder)
    for path in sorted(new.keys() | old.keys()):
        if path not in old or path not in new:
            yield f"{path}: {'is not in the manifest' if path in new else 'is in the manifest, but not made'}"
        elif new[path] != old[path]:
            yield f"{path}: is made otherwise than the manifest says"
        elif kept(path) and not _is(folder / path, new[path]):
            yield f"{path}: {'has been changed' if (folder / path).exists() else 'is missing'}"
    if new == old and (fresh / MANIFEST).read_bytes() != (folder / MANIFEST).read_bytes():
        yield f"{MANIFEST}: is made otherwise"
    there = (path.relative_to(folder) for path in folder.rglob("*") if path.is_file())
    strays = (path.as_posix() for path in there if path.parts[0] not in BESIDE and path.parent.name != "__pycache__")
    for path in sorted({*strays} - new.keys() - old.keys() - {MANIFEST}):
        yield f"{path}: is made by nothing; remove it"


def take(fresh, folder=GENERATED):
    """Move what git does not keep from ``fresh`` into ``folder``, one file after the other, each whole."""
    for path in made(fresh):
        place = folder / path
        place.parent.mkdir(parents=True, exist_ok=True)
        part = place.with_name(f".{place.name}.part")
        shutil.copyfile(fresh / path, part)
        os.replace(part, place)


def pack(out, folder=GENERATED):
    """Write the archive as ``.tar.gz``; an error unless it is the one that the manifest pins."""
    pinned = _manifest(folder).get("archive", {}).get("tar_sha256")
    if pinned is None:
        raise Damaged(f"{folder / MANIFEST} pins no archive: some drives were made alone; `make generate` makes all")
    if lacking := missing(folder):
        raise Damaged(f"{folder / lacking[0]} is not as the manifest says: `make build` makes it")
    packed = archive({path: (folder / path).read_bytes() for path in made(folder)})
    if sha256(packed) != pinned:
        raise Damaged(f"the archive is not the one that {folder / MANIFEST} pins: `make generate` pins it anew")
    out.parent.mkdir(parents=True, exist_ok=True)
    with open(out, "wb") as file, gzip.GzipFile("", "wb", fileobj=file, mtime=0) as compressed:
        compressed.write(packed)


def main(arguments=None):
    """Exit status 0, or 1 if anything is missing or differs, or 2 for a manifest that cannot be believed."""
    parser = argparse.ArgumentParser(prog="python -m derive.products", description=__doc__.partition("\n\n")[0])
    commands = parser.add_subparsers(dest="command", required=True)
    commands.add_parser("missing", help="whether anything is missing that is made on demand")
    commands.add_parser("check", help="compare with what was made elsewhere").add_argument("folder", type=Path)
    commands.add_parser("pack", help="write the archive").add_argument("file", type=Path)
    options = parser.parse_args(arguments)
    try:
        if options.command == "missing":
            return 1 if missing() else 0
        if options.command == "pack":
            pack(options.file)
            return 0
        if found := list(differences(options.folder)):
            said = f"generated/ is not what derive makes, which is in {options.folder}: `make generate` replaces it"
            print("\n".join([*(f"generated/{line}" for line in found), said]), file=sys.stderr)
            return 1
        take(options.folder)
    except (Damaged, OSError) as error:
        print(error, file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
