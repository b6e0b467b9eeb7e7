"""A record that anyone may edit, with every hash, link, root and seal made anew."""

import json
import re
from pathlib import Path

from derive.audit import store
from derive.audit.checker.lines import canonical, sha256_of
from derive.audit.checker.record import read_record, root_of
from derive.audit.claims import FigureClaim
from derive.audit.documents import rack_and_pinion, recess_action
from derive.audit.ledger import Chapter, build
from derive.audit.standing import of_ledger
from derive.files import replace_text

DESCRIPTIONS = Path(__file__).parents[2] / "generated" / "descriptions"
KINDS = ("source", "step", "equation", "certificate", "verdict")


HEADER = """/* A drive.
 * Equations, each proved of the definitions used here:
 *   rack-and-pinion/eq-1 {key}
 */
double x = a - b;
"""


def small_ledger():
    """A record of a few claims: proofs with one and several relations, a refutation, corrections, printed numbers."""
    wanted = {"helicoid", "eq-1", "eq-4", "meshing", "ratio-sign", "twice"}
    claims = [claim for claim in rack_and_pinion.CLAIMS if claim.key in wanted]
    printed = {"eq-1", "eq-7", "eq-12", "eq-16", "lead-angle-hob", "table-1-hob"}
    others = [claim for claim in recess_action.CLAIMS if claim.key in printed or isinstance(claim, FigureClaim)]
    return build([Chapter(rack_and_pinion.DOCUMENT, claims), Chapter(recess_action.DOCUMENT, others)])


def written(small_ledger, folder):
    """That record on disk below ``folder``, with a page and one generated header; the record's own folder."""
    texts = store.record_files(small_ledger) | {"index.html": "<p>proved</p>\n", "audit.tex": "proved\n"}
    key = of_ledger(small_ledger)["rack-and-pinion/eq-1"].key
    files = {"c/drive.h": HEADER.format(key=key)}
    files |= {f"audit/{name}": text for name, text in texts.items()}
    for name in sorted({step["read"]["drive"] for step in small_ledger.objects.values() if step.get("read")}):
        files[f"descriptions/{name}.json"] = (DESCRIPTIONS / f"{name}.json").read_text(encoding="utf-8")
    files["audit/artifacts.json"] = store.seal(small_ledger, files)
    for name, text in files.items():
        replace_text(folder / name, text)
    return folder / "audit"


class Forger:
    """A record that can be edited as plain JSON and is then hashed, linked, rooted and sealed again."""

    def __init__(self, folder):
        self.folder = folder
        self.objects = list(read_record(folder).values())

    def one(self, **wanted):
        return next(item for item in self.objects if all(item.get(key) == value for key, value in wanted.items()))

    def verdict(self, name):
        return self.one(object="verdict", id=name)

    def source(self, name):
        return self.one(object="source", id=name)

    def equation(self, name):
        return self.one(object="equation", id=name)

    def certificate(self, name):
        return self.one(object="certificate", equation=self.equation(name)["sha256"])

    def step(self, name):
        return self.one(object="step", id=name)

    def proof(self, left, right, /, name="recess-action/eq-12/as printed/1", **parts):
        """An equation and its certificate replaced by another statement with an empty numerator."""
        equation, certificate = self.equation(name), self.certificate(name)
        text = f"{parts.pop('text', 'omega1 = w1')}"
        equation |= {"lhs": left, "rhs": right, "where": {}, "signs": [], "jets": {}}
        certificate |= {
            "kind": "ring_nf", "outcome": "proved", "angles": [], "arcs": [], "roots": [], "generators": [],
            "relations": [], "components": [{"numerator": "", "denominators": [], "cofactors": []}], "degree": 0,
            "point": {"symbols": {}, "half_tangents": {}}, "lhs": ["0"], "rhs": ["0"],
        } | parts  # fmt: skip
        verdict = self.verdict(name.rsplit("/", 2)[0])
        verdict |= {"status": "proved", "described": []}
        verdict["readings"][0]["texts"] = [text]
        verdict["readings"][0]["parts"] = verdict["readings"][0]["parts"][:1]
        self.source(verdict["id"])["reading"] = {"as printed": [text]}

    def used(self):
        """The objects that a verdict rests on."""
        by_hash = {item["sha256"]: item for item in self.objects}
        pending, found = [item["sha256"] for item in self.objects if item["object"] == "verdict"], set()
        while pending:
            key = pending.pop()
            if key in by_hash and key not in found:
                found.add(key)
                pending += re.findall(r"[0-9a-f]{64}", canonical({**by_hash[key], "sha256": ""}))
        return [item for item in self.objects if item["sha256"] in found]

    def sealed(self, everything=False):
        """Everything hashed and written again, in the order of its links; what is no longer used is left out."""
        renamed, objects = {}, {}
        kept = self.objects if everything else self.used()
        for kind in KINDS:
            for item in (item for item in kept if item["object"] == kind):
                text = re.sub(r"[0-9a-f]{64}", lambda m: renamed.get(m[0], m[0]), canonical(item))
                body = json.loads(text)
                if kind == "step" and isinstance(body["inputs"], list):  # a mutation may have made it anything
                    body["inputs"].sort(key=str)
                old, body["sha256"] = item["sha256"], sha256_of(body)
                renamed[old] = body["sha256"]
                objects[body["sha256"]] = body
        lines = {"ledger.jsonl": "", "certificates.jsonl": ""}
        for item in objects.values():
            name = "certificates.jsonl" if item["object"] == "certificate" else "ledger.jsonl"
            lines[name] += canonical(item) + "\n"
        for name, text in lines.items():
            (self.folder / name).write_text(text, encoding="utf-8")
        reseal(self.folder)


def reseal(folder):
    """Root, keys of statements in headers and seal made anew over the files as they are."""
    objects = [json.loads(line) for name in ("ledger", "certificates")
               for line in (folder / f"{name}.jsonl").read_text().splitlines()]  # fmt: skip
    root = root_of({item["sha256"]: 0 for item in objects})
    for path in (folder.parent / "c").glob("*.h"):
        text = path.read_text()
        for item in objects:
            if item["object"] == "verdict":
                text = re.sub(rf"( {re.escape(item['id'])}) +[0-9a-f]{{16}}", rf"\1 {item['sha256'][:16]}", text)
        path.write_text(text)
    seal(folder, root)


def seal(folder, root):
    """The seal of the files as they are."""
    files = {
        path.relative_to(folder.parent).as_posix(): path.read_text(encoding="utf-8")
        for path in sorted(folder.parent.rglob("*"))
        if path.is_file() and path.name not in ("artifacts.json", "manifest.json")
    }

    class Rooted:
        pass

    Rooted.root = root
    (folder / "artifacts.json").write_text(store.seal(Rooted, files), encoding="utf-8")
