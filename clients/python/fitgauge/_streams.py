"""What comes and goes in pieces: events, and rows in batches."""

from __future__ import annotations

import re
from typing import Iterable, Iterator, NamedTuple

from ._errors import Problem
from ._json import loads
from ._types import Accepted
from ._values import Event

MOST_BYTES = 8 << 20  # of a request with many rows; the service takes 32 MiB


def read_events(pieces: Iterable[bytes]) -> Iterator[Event]:
    """Server-Sent Events (WHATWG HTML, 9.2.6); one without data only tells its id."""
    kind = "message"
    last: str | None = None
    data: list[str] = []
    for line in read_lines(pieces):
        name, _, value = line.partition(":")
        value = value[1:] if value.startswith(" ") else value
        if not line:
            if data or last is not None:
                yield Event(kind, last, loads("\n".join(data)) if data else None)
            kind, last, data = "message", None, []
        elif name == "event":
            kind = value
        elif name == "id":
            last = value
        elif name == "data":
            data.append(value)


def read_lines(pieces: Iterable[bytes]) -> Iterator[str]:
    rest = b""
    for piece in pieces:
        *lines, rest = (rest + piece).split(b"\n")
        for line in lines:
            yield line.decode().rstrip("\r")


class Batch(NamedTuple):
    """Rows of one request, and how many rows and lines were in the requests before."""

    body: bytes
    rows: int
    lines: int


def cut_batches(records: Iterable[str], head: str, most: int) -> Iterator[Batch]:
    """Cuts records, each with its line end, into requests that begin with `head`. Blank ones are no rows."""
    held: list[str] = []
    rows = size = rows_before = lines_before = 0
    for record in records:
        held.append(record)
        rows += bool(record.strip())
        size += len(record)
        if rows == most or size > MOST_BYTES:
            text = "".join(held)
            yield Batch((head + text).encode(), rows_before, lines_before)
            rows_before, lines_before = rows_before + rows, lines_before + text.count("\n")
            held, rows, size = [], 0, 0
    if rows or not rows_before:  # an empty file is sent, so that the service refuses it
        yield Batch((head + "".join(held)).encode(), rows_before, lines_before)


def csv_records(lines: Iterable[str]) -> Iterator[str]:
    """Records of CSV: a line break between quotes does not end one."""
    held = ""
    for line in lines:
        if not isinstance(line, str):
            raise TypeError("a line of CSV is text: open the file with newline='' and an encoding, not 'rb'")
        held += line
        if held.count('"') % 2 == 0:
            yield held if held.endswith("\n") else held + "\n"
            held = ""
    if held:
        yield held


def counted_over_all(problem: Problem, batch: Batch) -> Problem:
    """The same problem with rows and lines counted from the first request's first."""
    errors = []
    for entry in problem.errors:
        moved = entry.copy()
        row = re.match(r"/(\d+)(.*)", entry.get("pointer", ""))
        if row:
            moved["pointer"] = f"/{int(row[1]) + batch.rows}{row[2]}"
        if "line" in entry:
            moved["line"] = entry["line"] + batch.lines
        errors.append(moved)
    return type(problem)(problem.status, {**problem.document, "errors": errors}, problem.retry_after)


def total_of(total: Accepted | None, more: Accepted) -> Accepted:
    if total is None:
        return more
    before, now = total["verdicts"], more["verdicts"]
    return {"accepted": total["accepted"] + more["accepted"], "first_id": total["first_id"],
            "last_id": more["last_id"],
            "verdicts": {"good": before["good"] + now["good"], "rework": before["rework"] + now["rework"],
                         "reject": before["reject"] + now["reject"],
                         "indeterminate": before["indeterminate"] + now["indeterminate"]}}
