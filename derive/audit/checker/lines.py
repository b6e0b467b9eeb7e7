"""Canonical JSON, one object a line, and its hash."""

import hashlib
import json
from pathlib import Path

from .refusal import Rejected, require


def canonical(value: object) -> str:
    return json.dumps(value, sort_keys=True, separators=(",", ":"), ensure_ascii=False)


def sha256_of(body: dict) -> str:
    return hashlib.sha256(
        canonical({key: value for key, value in body.items() if key != "sha256"}).encode()
    ).hexdigest()


def read_json(text: str):
    """JSON without repeated keys, floating-point numbers or NaN."""

    def once(pairs: list) -> dict:
        require(len(pairs) == len({key for key, _ in pairs}), "a key stands twice")
        return dict(pairs)

    def never(token: str):
        raise Rejected(f"{token} is not a number of the record")

    return json.loads(text, object_pairs_hook=once, parse_float=never, parse_constant=never)


def read_file(path: Path) -> str:
    try:
        return path.read_bytes().decode("utf-8")
    except (OSError, ValueError) as error:
        raise Rejected(f"{path.name} cannot be read: {error}") from error


def read_lines(path: Path) -> list[dict]:
    text = read_file(path)
    require(text.endswith("\n") and "\r" not in text, f"{path.name} does not end its lines as it should")
    items = []
    for number, line in enumerate(text[:-1].split("\n"), 1):
        try:
            item = read_json(line)
        except (Rejected, ValueError, RecursionError) as error:
            raise Rejected(f"{path.name} line {number}: {error}") from error
        require(type(item) is dict and canonical(item) == line, f"{path.name} line {number}: not canonical")
        items.append(item)
    return items
