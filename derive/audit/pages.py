"""The record as pages to read: self-contained HTML with MathML, and one LaTeX file. No network, no script, no date."""

import re
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path

import jinja2
from markupsafe import Markup

from derive.audit import coverage
from derive.audit.certified import OPEN, OUTCOMES, STEPS, TRUSTED
from derive.audit.checker.lines import sha256_of
from derive.audit.claims import Document, Figure
from derive.audit.described import origin_of
from derive.audit.drive_pages import Page, drive_pages, file_name
from derive.audit.guarded import Row
from derive.audit.kernel.translate import is_stated
from derive.audit.ledger import Chapter, Judged, Ledger, Reading, Verdict, drives_read
from derive.audit.mutations.table import measured
from derive.audit.plain_text import words_of
from derive.audit.published import comparisons
from derive.audit.render import LATEX_GREEK, LaTeX, MathML, difference, raised
from derive.audit.validation import NOT_VERIFIED, VERIFIED
from derive.passes.guards import GUARDS
from derive.prove.certificate import decimal
from derive.prove.points import arctangent
from derive.prove.polynomial import Terms
from derive.prove.prover import Instance
from derive.prove.tree import Tree, parse_formula

STATUS_TEXT = {
    "proved": "proved",
    "proved_with_correction": "misprint, correction proved",
    "false": "false",
    "ambiguous": "ambiguous",
    "undecided": "undecided",
    "definition": "definition",
    "not_mathematical": "not mathematical",
}
SHOWN_TERMS = 6

_ENVIRONMENT = jinja2.Environment(
    loader=jinja2.FileSystemLoader(Path(__file__).parent / "templates"),
    undefined=jinja2.StrictUndefined,
    autoescape=lambda name: bool(name) and ".html" in name,
    trim_blocks=True,
    lstrip_blocks=True,
    keep_trailing_newline=True,
)


@dataclass(frozen=True)
class Part:
    """One equation as shown: printed, its definitions, the evidence, a worked point."""

    equation: Markup
    latex: str
    outcome: str
    definitions: tuple[tuple[str, Markup], ...]
    """Anchor and letter of each definition in use; they stand once on the page."""
    latex_definitions: tuple[str, ...]
    evidence: str
    certificate: str
    conditions: tuple[str, ...]
    instance: dict | None


@dataclass(frozen=True)
class Entry:
    """One verdict as shown."""

    key: str
    verdict: Verdict
    status: str
    status_text: str
    readings: tuple[tuple[str, str, tuple[Part, ...]], ...]
    corrected: tuple[Part, ...]
    contradiction: tuple[Part, ...]
    conditions: tuple[str, ...]
    evidence: str
    damage: str
    missing: str
    change: str
    offset: int | None
    """Where the verbatim text stands in the source; None for a transliteration."""
    drives: list[str]
    """Whose descriptions its equations read."""

    @property
    def is_general(self) -> bool:
        """Whether equations were judged that read no drive's description: they are of mathematics in general."""
        readings = (*self.verdict.readings, self.verdict.contradiction)
        parts = [part for reading in readings if reading for part in reading.parts]
        return not self.drives and any(not isinstance(part.of, Figure) for part in parts)


def _held(
    ledger: Ledger, counts: Mapping[str, Counter[str]], functions: Mapping[str, Mapping[str, list[str]]]
) -> list[tuple[str, int, str]]:
    """How much is held by what: (kind, number, what it is and what checks it), of the objects that the checks read."""
    certificates = [item for item in ledger.objects.values() if item["object"] == "certificate"]
    stated = sum(map(is_stated, certificates))
    points = sum(item["kind"] == "exact_point" for item in certificates)
    numbers = len(certificates) - stated - points
    taken = sum(count["definition"] + count["not_mathematical"] for count in counts.values())
    return [
        ("proved by the kernel", stated, "identities, each component a theorem of Coq (make kernel)"),
        ("checked modulo primes", sum(map(len, functions.values())),
         "generated C functions, compared with the descriptions at random points (check_code.py, "
         "check_description.py)"),
        ("tested", points + numbers,
         f"statements without a theorem: {points} counterexamples and {numbers} results of arithmetic, such as numbers "
         "of tables, recomputed in exact fractions or enclosures (check.py)"),
        ("trusted", taken + len(TRUSTED),
         f"entries and premises: {taken} definitions and sentences with nothing to prove, and {len(TRUSTED)} premises "
         "of certified contact"),
    ]  # fmt: skip


def pages(
    ledger: Ledger,
    chapters: list[Chapter],
    functions: Mapping[str, Mapping[str, list[str]]],
    conditions: Mapping[str, list[Row]],
    generated: Mapping[str, str],
) -> dict[str, str]:
    """File name -> text of every page.

    `functions` maps generated headers to their functions and equation ids, `conditions` families to side conditions,
    `generated` the paths of all generated files to their texts.
    """
    shown = [
        (chapter.document, [_entry(chapter.document, verdict) for verdict in ledger.verdicts[chapter.document.key]])
        for chapter in chapters
    ]
    sources = [(document, entries) for document, entries in shown if document.sha256]
    common = {
        "root": ledger.root,
        "navigation": [(document.key, document.name, bool(document.sha256)) for document, _ in shown],
        "status_text": STATUS_TEXT,
    }
    corrections = [
        (document, entry)
        for document, entries in sources
        for entry in entries
        if entry.status in ("proved_with_correction", "false", "ambiguous")
    ]
    claims = {chapter.document.key: chapter.claims for chapter in chapters if chapter.document.sha256}
    covered = coverage.rows(claims)
    drives = drive_pages(generated, functions)
    used = _used(drives)
    names = {row.document: row.document for row in covered}  # of one that cannot be read there is no more
    names |= {document.key: document.name for document, _ in sources}
    counts = {document.key: Counter(entry.status for entry in entries) for document, entries in shown}
    texts = {
        "index.html": _render(
            "index.html.jinja",
            **common,
            shown=shown,
            counts=counts,
            held=_held(ledger, counts, functions),
            corrections=corrections,
            covered=[(names[line[0]], *line) for line in coverage.summary(covered)],
            unjudged=[(row, names[row.document]) for row in covered if not row.entries],
            drives=[(file_name(page.name), page.name, page.title, page.family) for page in drives],
            literal=sum(entry.offset is not None for _, entries in sources for entry in entries),
            quoted=sum(bool(entry.verdict.claim.verbatim) for _, entries in sources for entry in entries),
        ),
        "validation.html": _render(
            "validation.html.jinja",
            **common,
            verified=VERIFIED,
            not_verified=NOT_VERIFIED,
            published=comparisons(),
            corrections=corrections,
            functions=functions,
            ledger=ledger,
            kinds=Counter(item["object"] for item in ledger.objects.values()),
            mutations=measured(),
        ),
        "side-conditions.html": _render("side-conditions.html.jinja", **common, guards=GUARDS, conditions=conditions),
        "certified-contact.html": _render(
            "certified.html.jinja",
            **common,
            certified={"outcomes": OUTCOMES, "steps": STEPS, "trusted": TRUSTED, "open": OPEN},
        ),
        "audit.tex": _render("audit.tex.jinja", **common, shown=shown, tex=_tex),
    }
    for page in drives:
        texts[file_name(page.name)] = _render("drive.html.jinja", **common, page=page)
    for document, entries in shown:
        texts[f"{document.key}.html"] = _render(
            "chapter.html.jinja",
            **common,
            document=document,
            entries=entries,
            symbols=_symbols(document),
            counts=counts[document.key],
            definitions=_definitions(document, ledger.verdicts[document.key]),
            letters=_letters(ledger.verdicts[document.key]),
            used=used,
        )
    return texts


def _used(drives: list[Page]) -> dict[str, list[tuple[str, list[str]]]]:
    """Statement -> the drives whose functions rest on it, with these functions."""
    found: dict[str, list[tuple[str, list[str]]]] = {}
    for page in drives:
        own: dict[str, list[str]] = {}
        for function in page.functions:
            for key in function.rests_on:
                own.setdefault(key, []).append(function.name)
        for key, names in own.items():
            found.setdefault(key, []).append((page.name, names))
    return found


def _render(template: str, **values) -> str:
    return _ENVIRONMENT.get_template(template).render(**values)


def _symbols(document: Document) -> list[tuple[Markup, str, str]]:
    """Symbol, unit and meaning, in the letters of the source."""
    return [
        (Markup(f"<i>{Markup.escape(shown)}</i>"), unit, meaning) for shown, unit, meaning in document.symbols.values()
    ]


def _entry(document: Document, verdict: Verdict) -> Entry:
    names = {name: shown for name, (shown, _, _) in document.symbols.items()}
    mathml = MathML(names)
    first = verdict.readings[0] if verdict.readings else None
    readings = tuple(
        (reading.label, str(reading.outcome), _parts(mathml, reading, verdict.corrected if reading is first else None))
        for reading in verdict.readings
    )
    corrected = _parts(mathml, verdict.corrected, first) if verdict.corrected else ()
    contradiction = _parts(mathml, verdict.contradiction) if verdict.contradiction else ()
    conditions = tuple(getattr(verdict.claim, "conditions", ()))
    drops = getattr(verdict.claim, "drops", "")
    return Entry(
        verdict.claim.key, verdict, verdict.status, STATUS_TEXT[verdict.status], readings, corrected, contradiction,
        conditions + ((f"step: divided by {mathml.plain(drops)} ≠ 0",) if drops else ()), _evidence_of(verdict),
        getattr(verdict.claim, "damage", ""), getattr(verdict.claim, "missing", ""),
        re.sub(r"\w+", lambda word: names.get(word[0], word[0]), verdict.change),
        coverage.offset(verdict.id, verdict.claim.verbatim), drives_read(verdict),
    )  # fmt: skip


def anchor(name: str, tree: Tree) -> str:
    """Where a definition stands on its page: the same name may be defined otherwise elsewhere on it."""
    return f"def-{name}-{sha256_of({'tree': tree})[:8]}"


def _definitions(document: Document, verdicts: Sequence[Verdict]) -> list[tuple[str, Markup, str, str]]:
    """Of every definition that a chapter's statements use, in the order of first use: anchor, formula, and the drive
    and the part of its description that it was read from.
    """
    mathml = MathML({name: shown for name, (shown, _, _) in document.symbols.items()})
    found: dict[str, tuple[Markup, str, str]] = {}
    for name, tree in _used_definitions(verdicts):
        origin = origin_of(tree)
        drive, read = (origin.drive, words_of(origin.part)) if origin else ("", "")
        found.setdefault(anchor(name, tree), (Markup(mathml.equation(name, tree)), drive, read))
    return [(key, *shown) for key, shown in found.items()]


def _letters(verdicts: Sequence[Verdict]) -> list[tuple[str, str]]:
    """The drives that a chapter reads, each with what its letters stand for there."""
    origins = [origin for _, tree in _used_definitions(verdicts) if (origin := origin_of(tree))]
    found = dict.fromkeys((origin.drive, origin.letters) for origin in origins)
    return [(drive, ", ".join(f"{old} → {new}" for old, new in letters) or "its own") for drive, letters in found]


def _used_definitions(verdicts: Sequence[Verdict]) -> Iterator[tuple[str, Tree]]:
    for verdict in verdicts:
        for reading in (*verdict.readings, verdict.corrected, verdict.contradiction):
            for part in reading.parts if reading else ():
                if not isinstance(part.of, Figure):
                    yield from part.statement.used.items()


def _evidence_of(verdict: Verdict) -> str:
    reading = verdict.corrected or verdict.contradiction or (verdict.readings[-1] if verdict.readings else None)
    return reading.parts[0].certificate if reading else ""


def _parts(mathml: MathML, reading: Reading, other: Reading | None = None) -> tuple[Part, ...]:
    against = other.parts if other and len(other.parts) == len(reading.parts) else (None,) * len(reading.parts)
    return tuple(_part(mathml, part, previous) for part, previous in zip(reading.parts, against, strict=True))


def _part(mathml: MathML, part: Judged, previous: Judged | None) -> Part:
    if isinstance(part.of, Figure):
        return _figure_part(mathml, part)
    statement = part.statement
    left, right = statement.lhs, statement.rhs
    if previous is not None and not isinstance(previous.of, Figure):
        left, right = difference(left, previous.statement.lhs), difference(right, previous.statement.rhs)
    latex = LaTeX(mathml.names)
    definitions = tuple((anchor(name, tree), Markup(f"<math>{mathml.name(name)}</math>"))
                        for name, tree in statement.used.items())  # fmt: skip
    return Part(
        Markup(mathml.equation(left, right)), latex.equation(left, right), str(part.outcome), definitions,
        tuple(latex.equation(name, tree) for name, tree in statement.used.items()), _evidence(mathml, part),
        part.certificate, _denominators(mathml, part), _instance(mathml, part.decision.instance),
    )  # fmt: skip


def _figure_part(mathml: MathML, part: Judged) -> Part:
    figure = part.figure
    tree = parse_formula(figure.formula)
    if figure.is_sign:
        value, aside = f"{figure.value:.6g}", f"printed as {'above' if figure.printed == '>0' else 'below'} zero"
    else:
        value, aside = f"{figure.value:.7g}", f"printed {figure.printed} {figure.unit}"
    shown = mathml.figure(tree, value, aside)
    latex = rf"{LaTeX().write(tree)} = {figure.value:.7g}"
    return Part(Markup(shown), latex, str(part.outcome), (), (), "numeric", part.certificate, (), None)


def _evidence(mathml: MathML, part: Judged) -> str:
    decision = part.decision
    if str(part.outcome) == "proved":
        terms = sum(len(component.numerator) for component in decision.components)
        used = sorted(
            {
                r.generator
                for component in decision.components
                for r, cofactor in zip(decision.relations, component.cofactors, strict=True)
                if cofactor
            }
        )
        return (
            f"{terms} terms cancel"
            + (f" by the relations of {', '.join(map(mathml.plain, used))}" if used else " without any relation")
            if terms
            else "both sides expand to the same polynomial"
        )
    if str(part.outcome) == "refuted":
        return "the sides differ at the point below"
    return "neither proved nor refuted"


def _denominators(mathml: MathML, part: Judged) -> tuple[str, ...]:
    """Denominators that must not vanish, readable where short."""
    decision = part.decision
    found: dict[str, None] = {}
    for component in decision.components:
        for factor, _ in component.denominators:
            if any(any(powers) for powers in factor):
                found.setdefault(_polynomial(mathml, factor, decision.names))
    return tuple(f"{text} ≠ 0" for text in found)


def _polynomial(mathml: MathML, terms: Terms, names: tuple[str, ...]) -> str:
    if len(terms) > SHOWN_TERMS:
        return f"a denominator of {len(terms)} terms (in the certificate)"
    parts = []
    for powers, factor in sorted(terms.items(), reverse=True):
        body = " ".join(
            mathml.plain(name) + (f"^{power}" if power > 1 else "")
            for name, power in zip(names, powers, strict=True)
            if power
        )
        number = str(abs(factor)) if abs(factor) != 1 or not body else ""
        parts.append(("− " if factor < 0 else "+ ") + " ".join(filter(None, (number, body))))
    return " ".join(parts).removeprefix("+ ")


def _instance(mathml: MathML, instance: Instance | None) -> dict | None:
    if instance is None:
        return None
    point = instance.point
    values = [(mathml.plain(name), str(value)) for name, value in sorted(point.symbols.items())]
    angles = []
    for name, t in sorted(point.half_tangents.items()):
        degrees = 360 * arctangent(t) / (4 * arctangent(Fraction(1)))
        angles.append(
            (
                mathml.plain(name),
                decimal(Fraction(round(degrees * 10**6), 10**6)),
                str((1 - t * t) / (1 + t * t)),
                str(2 * t / (1 + t * t)),
            )
        )
    return {
        "values": values,
        "angles": angles,
        "lhs": [decimal(v) for v in instance.lhs],
        "rhs": [decimal(v) for v in instance.rhs],
    }


_TEX = str.maketrans(
    {
        "\\": r"\textbackslash{}", "&": r"\&", "%": r"\%", "_": r"\_", "#": r"\#", "^": r"\^{}", "{": r"\{", "}": r"\}",
        "$": r"\$", "~": r"\~{}", "<": r"\ensuremath{<}", ">": r"\ensuremath{>}", "|": r"\ensuremath{|}",
        "−": r"\ensuremath{-}", "·": r"\ensuremath{\cdot}", "×": r"\ensuremath{\times}", "∂": r"\ensuremath{\partial}",
        "′": r"\ensuremath{'}", "≠": r"\ensuremath{\neq}", "≥": r"\ensuremath{\geq}", "≤": r"\ensuremath{\leq}",
        "±": r"\ensuremath{\pm}", "∓": r"\ensuremath{\mp}", "√": r"\ensuremath{\surd}", "→": r"\ensuremath{\to}",
        "⇒": r"\ensuremath{\Rightarrow}",
        "°": r"\ensuremath{^\circ}", "₀": r"\ensuremath{_0}", "Δ": r"\ensuremath{\Delta}", "µ": r"\ensuremath{\mu}",
        "–": "--", "§": r"\S{}", "\ufffd": r"\fbox{?}",
    }
    | {letter: rf"\ensuremath{{{command}}}" for letter, command in LATEX_GREEK.items() if len(letter) == 1}
)  # fmt: skip


def _tex(text: str) -> str:
    """Plain text for LaTeX, whatever the engine; scripts for which it needs a font of its own are left out."""
    return re.sub(r"[^\x00-\x7f]+", r"[\\dots]", "".join(map(_tex_letter, text)))


def _tex_letter(letter: str) -> str:
    above = raised(letter)
    return rf"\ensuremath{{^{{{above.translate(_TEX)}}}}}" if above else letter.translate(_TEX)
