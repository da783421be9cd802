"""Client of fitgauge: limits and fits, verdicts, measurements and NC programs over its HTTP API.

    from fitgauge import Client

    with Client("http://localhost:8286") as gauge:
        record = gauge.measure({"designation": "25 H7", "measured_mm": "25.0215", "part_id": "SN-1"})
        print(record["verdict"], record["excess_um"])

Answers are the service's JSON objects as dictionaries. Every length, angle, time and Q parameter in
them is a `decimal.Decimal` with all its digits; a binary float is refused before it is sent. What is
refused by the service is a `Problem` with its code; what gets no answer is a `NoAnswer`.

A request that may be sent again is, with growing pauses, or as long as the service says: reading, and
writing under an idempotency key, which is made when none is given. A client may be shared by threads.

One file and the standard library, so that it can be copied beside the program that uses it.
"""

# The service's answers are taken to have the types that its API promises.
# mypy: no-warn-return-any

from __future__ import annotations

import email.message
import http.client
import itertools
import json
import os
import random
import re
import selectors
import ssl
import time
import urllib.parse
import uuid
from contextlib import suppress
from datetime import datetime, timezone
from decimal import Decimal
from email.utils import parsedate_to_datetime
from typing import Any, Callable, Dict, Iterable, Iterator, Literal, Mapping, NamedTuple, Sequence, TypedDict, Union

__version__ = "0.1.0"

Size = Union[Decimal, int, str]  # in the unit that the field's name ends with
Parameter = Union[Decimal, int, str, datetime, None]  # of a query; None is left out
Text = Union[str, bytes]
VerdictWord = Literal["good", "rework", "reject", "indeterminate"]
RuleWord = Literal["simple", "guard_band", "conformance"]
FeatureWord = Literal["hole", "shaft"]
RunStatus = Literal["queued", "running", "completed", "stopped", "failed", "limit_exceeded", "cancelled"]

_SILENCE_S = 45.0  # a stream of events has a sign of life every 15 s
_FIRST_PAUSE_S, _LONGEST_PAUSE_S = 0.1, 10.0
_RUN_S = 180.0  # the 60 s a run may take, after others before it
_MOST_BYTES = 8 << 20  # of a request with many rows; the service takes 32 MiB


# --- JSON with exact decimals -------------------------------------------------------------------------

_EXACT = re.compile(r"_(mm|um|c|deg|s|mm_min)$|^(seconds|coverage_factor|parameters)$")


class _Exact(Dict[str, bool]):
    """Whether a name is of an exact number: each is looked at once, for there are few."""

    def __missing__(self, name: str) -> bool:
        found = bool(_EXACT.search(name))
        if len(self) < 1_000:
            self[name] = found
        return found


_exact = _Exact()


def _decimals(value: Any) -> Any:
    if isinstance(value, int) and not isinstance(value, bool):
        return Decimal(value)
    if isinstance(value, list):
        return [_decimals(item) for item in value]
    if isinstance(value, dict):
        return {name: _decimals(item) for name, item in value.items()}
    return value


def loads(text: Text) -> Any:
    """Reads JSON; a fraction, and every number in a field with a unit, becomes a Decimal."""
    def make(pairs: list[tuple[str, Any]]) -> Any:
        return {name: _decimals(value) if _exact[name] else value for name, value in pairs}
    return json.loads(text, parse_float=Decimal, object_pairs_hook=make)


def _refuse_float(value: Any) -> None:
    if isinstance(value, float):
        raise TypeError(f"{value!r} is a binary float: give a Decimal, an int or a string")


def _plain(value: Union[Decimal, int, datetime]) -> str:
    _refuse_float(value)
    if isinstance(value, datetime):
        if value.tzinfo is None:
            raise ValueError(f"{value} has no time zone: use datetime.now(timezone.utc), say")
        return value.isoformat()
    if not Decimal(value).is_finite():
        raise ValueError(f"{value} is not a number")
    return format(value, "f") if isinstance(value, Decimal) else str(value)


def dumps(value: Any) -> str:
    """Writes JSON with the digits of each Decimal. TypeError for a float: it is not the number that was meant."""
    _refuse_float(value)
    if isinstance(value, Decimal):
        return _plain(value)
    if isinstance(value, datetime):
        return json.dumps(_plain(value))
    if isinstance(value, Mapping):
        return "{" + ",".join(f"{json.dumps(str(name))}:{dumps(item)}" for name, item in value.items()) + "}"
    if isinstance(value, (list, tuple)):
        return "[" + ",".join(map(dumps, value)) + "]"
    return json.dumps(value)


# --- What the service answers -------------------------------------------------------------------------


class _Sizes(TypedDict):
    nominal_mm: Decimal
    feature: FeatureWord
    upper_deviation_um: Decimal
    lower_deviation_um: Decimal
    upper_limit_mm: Decimal
    lower_limit_mm: Decimal
    tolerance_um: Decimal
    basis: Literal["iso286", "custom", "explicit"]


class Limits(_Sizes, total=False):
    """Limits of size. `size_range_mm` has `over` and `up_to`. With the limits of a drawing (`basis` explicit)
    there is no class, range and revision."""

    designation: str
    tolerance_class: str
    size_range_mm: Mapping[str, Decimal]
    table_revision: str


class Fit(TypedDict):
    """A hole with a shaft; interference is negative clearance."""

    designation: str
    hole: Limits
    shaft: Limits
    type: Literal["clearance", "transition", "interference"]
    max_clearance_um: Decimal
    min_clearance_um: Decimal


class Verdict(Limits):
    """`excess_um` is 0 within the limits."""

    measured_mm: Decimal
    deviation_um: Decimal
    verdict: VerdictWord
    excess_um: Decimal


class _Circumstances(TypedDict, total=False):
    part_id: str
    characteristic: str
    order: str
    operation: str
    machine: str
    operator: str
    gauge: str
    unit: str
    comment: str
    rule: RuleWord
    part_material: str
    scale_material: str


class _Measured(TypedDict):
    measured_mm: Size


class NewMeasurement(_Measured, _Circumstances, total=False):
    """`measured_mm`, and the limits once: `designation`, or `nominal_mm` with `tolerance_class`, or
    `nominal_mm` with `feature`, `upper_um` and `lower_um`. A correction has a `reason` too."""

    designation: str
    nominal_mm: Size
    tolerance_class: str
    feature: FeatureWord
    upper_um: Size
    lower_um: Size
    measured_at: Union[str, datetime]
    uncertainty_um: Size
    coverage_factor: Size
    probability: Size
    temperature_c: Size
    scale_temperature_c: Size
    part_expansion_um_per_m_k: Size
    scale_expansion_um_per_m_k: Size
    reason: str


class _Origin(TypedDict):
    id: str
    source: Literal["gauge", "simulation"]
    measured_at: str
    received_at: str


class Measurement(Verdict, _Origin, _Circumstances, total=False):
    """A record as it is stored; fields that were not given are not there. `when` reads its times."""

    uncertainty_um: Decimal
    coverage_factor: Decimal
    probability: Decimal
    conformance_probability: Decimal
    guard_band_um: Decimal
    temperature_c: Decimal
    scale_temperature_c: Decimal
    part_expansion_um_per_m_k: Decimal
    scale_expansion_um_per_m_k: Decimal
    corrected_mm: Decimal
    caller: str
    run_id: str
    cycle: int
    correction_of: str
    reason: str
    corrected_by: str


class Accepted(TypedDict):
    """How many rows were stored, the ids of the first and the last, and how many of each verdict."""

    accepted: int
    first_id: str
    last_id: str
    verdicts: dict[str, int]


class FieldError(TypedDict, total=False):
    """A bad field: its JSON pointer (rows count from 0), and its line (from 1) in a file."""

    pointer: str
    code: str
    detail: str
    line: int


class _RunHead(TypedDict):
    id: str
    status: RunStatus
    program: str
    created_at: str


class Run(_RunHead, total=False):
    """A run of an NC program; `status` is queued or running until it is over."""

    finished_at: str
    blocks_executed: int
    verdict: VerdictWord | None
    parameters: Mapping[str, Union[Decimal, str]]
    screen: list[str]
    files: list[dict[str, Any]]
    tables: list[dict[str, str]]
    messages: list[dict[str, Any]]
    measurements: list[dict[str, Any]]
    active_preset: int
    presets: list[dict[str, Any]]
    machining_time_s: Decimal
    setup_seed: int


class RunLimits(TypedDict, total=False):
    """What ends a run with the status limit_exceeded."""

    blocks: int
    seconds: Size


class Event(NamedTuple):
    """What happened; `id` is where a reader goes on that comes back."""

    type: str
    id: str | None
    data: Any


def when(text: str) -> datetime:
    """The moment of `measured_at`, `received_at`, `created_at`: in UTC, to the microsecond."""
    whole, _, fraction = text.rstrip("Z").partition(".")
    return datetime.fromisoformat(f"{whole}.{fraction[:6]:0<6}+00:00")


# --- What goes wrong ----------------------------------------------------------------------------------


class FitgaugeError(Exception):
    """Base of all errors of this module."""


class NoAnswer(FitgaugeError):
    """The service is not there, or the connection broke: a write may have been carried out or not. Sent
    again under the same idempotency key it is stored once."""


class Problem(FitgaugeError):
    """The service refused (RFC 9457). `code` is stable; `errors` has every bad field of the body."""

    def __init__(self, status: int, document: Mapping[str, Any], retry_after: float | None = None):
        self.status = status
        self.document = document
        self.code: str = document.get("code", "")
        self.title: str = document.get("title", "")
        self.detail: str = document.get("detail", "")
        self.errors: list[FieldError] = document.get("errors", [])
        self.retry_after = retry_after
        fields = "".join(f"; {e.get('pointer')} {e.get('code')}: {e.get('detail')}" for e in self.errors)
        super().__init__(f"{status} {self.code}: {self.detail or self.title}{fields}")

    @property
    def pointer(self) -> str | None:
        """Of the first bad field."""
        return self.errors[0].get("pointer") if self.errors else None

    @property
    def passes(self) -> bool:
        """The same request may succeed later."""
        if self.status == 503:  # without Retry-After it is a fault that a person has to mend
            return self.retry_after is not None or not self.code
        return self.status in (408, 429, 502, 504) or self.code == "idempotency.in_progress"


class BadRequest(Problem):
    """400: not readable."""


class Unauthorized(Problem):
    """401: a key is needed, or this one is unknown."""


class Forbidden(Problem):
    """403: the key's role is not enough."""


class NotFound(Problem):
    """404."""


class Conflict(Problem):
    """409: corrected before, run finished, key in use."""


class PreconditionFailed(Problem):
    """412: the tables have changed meanwhile."""


class Invalid(Problem):
    """422: readable, with wrong fields."""


class ProgramInvalid(Invalid):
    """422 `program.invalid`: `diagnostics` has the findings in the NC program."""

    @property
    def diagnostics(self) -> list[dict[str, Any]]:
        found: list[dict[str, Any]] = self.document.get("diagnostics", [])
        return found


class Unavailable(Problem):
    """503: the disk, the tables or the queue; writes under a key may be sent again."""


_BY_STATUS: Mapping[int, type[Problem]] = {
    400: BadRequest, 401: Unauthorized, 403: Forbidden, 404: NotFound, 409: Conflict, 412: PreconditionFailed,
    422: Invalid, 503: Unavailable}


def _seconds(retry_after: str | None) -> float | None:
    """Retry-After: seconds or a date (RFC 9110, 10.2.3)."""
    if retry_after is None:
        return None
    if retry_after.strip().isdigit():
        return float(retry_after)
    with suppress(ValueError, TypeError):
        return max(0.0, (parsedate_to_datetime(retry_after) - datetime.now(timezone.utc)).total_seconds())
    return None


def _problem(answer: _Answer) -> Problem:
    try:
        document = loads(answer.body)
        if not isinstance(document, dict):
            raise ValueError("no object")
    except ValueError:  # of a proxy, say
        document = {"detail": answer.body[:200].decode("utf-8", "replace")}
    kind = _BY_STATUS.get(answer.status, Problem)
    if document.get("code") == "program.invalid":
        kind = ProgramInvalid
    return kind(answer.status, document, _seconds(answer.headers.get("Retry-After")))


# --- Requests -----------------------------------------------------------------------------------------


class _Request(NamedTuple):
    method: str
    path: str
    body: bytes | None = None
    headers: Mapping[str, str] = {}
    repeatable: bool = True
    timeout: float | None = None
    streamed: bool = False


class _Answer(NamedTuple):
    status: int
    headers: email.message.Message
    body: bytes  # empty where it is streamed
    connection: http.client.HTTPConnection
    response: http.client.HTTPResponse


def _pause(attempt: int) -> float:
    return min(_LONGEST_PAUSE_S, _FIRST_PAUSE_S * 2.0 ** min(attempt, 20)) * random.uniform(0.5, 1.0)


def _path(*segments: str) -> str:
    for segment in segments:
        if not isinstance(segment, str):
            raise TypeError(f"{segment!r} is no text: a designation is '25 H7', a name or an id a string")
    return "/v1/" + "/".join(urllib.parse.quote(segment, safe="") for segment in segments)


def _query(parameters: Mapping[str, Parameter]) -> str:
    """A trailing underscore is dropped: `from` is a word of Python's own."""
    pairs = [(name.rstrip("_"), value if isinstance(value, str) else _plain(value))
             for name, value in parameters.items() if value is not None]
    return "?" + urllib.parse.urlencode(pairs) if pairs else ""


def _below_drive(path: str) -> str:
    """`TNC:\\nc_prog\\8255.h` and `nc_prog/8255.h` are the same file: the latter."""
    plain = path[4:] if path[:4].upper() == "TNC:" else path
    return plain.replace("\\", "/").lstrip("/")


def _control_path(path: str) -> str:
    return _path("files", *_below_drive(path).split("/"))


def _events(pieces: Iterable[bytes]) -> Iterator[Event]:
    """Server-Sent Events (WHATWG HTML, 9.2.6); one without data only tells its id."""
    kind = "message"
    last: str | None = None
    data: list[str] = []
    for line in _lines(pieces):
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


def _lines(pieces: Iterable[bytes]) -> Iterator[str]:
    rest = b""
    for piece in pieces:
        *lines, rest = (rest + piece).split(b"\n")
        for line in lines:
            yield line.decode().rstrip("\r")


class _Batch(NamedTuple):
    """Rows of one request, and how many rows and lines were in the requests before."""

    body: bytes
    rows: int
    lines: int


def _batches(records: Iterable[str], head: str, most: int) -> Iterator[_Batch]:
    """Cuts records, each with its line end, into requests that begin with `head`. Blank ones are no rows."""
    held: list[str] = []
    rows = size = rows_before = lines_before = 0
    for record in records:
        held.append(record)
        rows += bool(record.strip())
        size += len(record)
        if rows == most or size > _MOST_BYTES:
            text = "".join(held)
            yield _Batch((head + text).encode(), rows_before, lines_before)
            rows_before, lines_before = rows_before + rows, lines_before + text.count("\n")
            held, rows, size = [], 0, 0
    if rows or not rows_before:  # an empty file is sent, so that the service refuses it
        yield _Batch((head + "".join(held)).encode(), rows_before, lines_before)


def _csv_records(lines: Iterable[str]) -> Iterator[str]:
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


def _moved(problem: Problem, batch: _Batch) -> Problem:
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


def _sum(total: Accepted | None, more: Accepted) -> Accepted:
    if total is None:
        return more
    return {"accepted": total["accepted"] + more["accepted"], "first_id": total["first_id"],
            "last_id": more["last_id"],
            "verdicts": {word: total["verdicts"].get(word, 0) + n for word, n in more["verdicts"].items()}}


class Client:
    """A service, and connections to it that are kept open. After an error it can be used on."""

    def __init__(self, server: str | None = None, key: str | None = None, *, timeout: float = 30.0,
                 retries: int = 6, ca_file: str | None = None, cert_file: str | None = None,
                 key_file: str | None = None, tls: ssl.SSLContext | None = None):
        """`server` is $FITGAUGE_SERVER or http://127.0.0.1:8286 when absent, `key` $FITGAUGE_KEY.

        `timeout` in seconds is for each step of a request, `retries` how often it is sent again. For
        https, `ca_file` is the authority to trust instead of the system's, `cert_file` with `key_file`
        the client's certificate; `tls` replaces all three.
        """
        server = server or os.environ.get("FITGAUGE_SERVER") or "http://127.0.0.1:8286"
        parts = urllib.parse.urlsplit(server if "://" in server else f"http://{server}")
        if parts.scheme not in ("http", "https") or not parts.hostname:
            raise ValueError(f"{server!r} is not the address of a service: http://host:8286")
        self._host, self._port, self._base = parts.hostname, parts.port, parts.path.rstrip("/")
        self._timeout, self._retries = timeout, retries
        self._tls = tls
        if parts.scheme == "https" and tls is None:
            self._tls = ssl.create_default_context(cafile=ca_file)
            if cert_file:
                self._tls.load_cert_chain(cert_file, key_file)
        elif parts.scheme == "http" and (tls or ca_file or cert_file):
            raise ValueError(f"{server!r} is not https, and certificates were given")
        self._headers = {"Accept": "application/json", "User-Agent": f"fitgauge-python/{__version__}"}
        key = key or os.environ.get("FITGAUGE_KEY")
        if key:
            self._headers["Authorization"] = f"Bearer {key}"
        self._idle: list[http.client.HTTPConnection] = []

    def __enter__(self) -> Client:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """Closes the connections that are idle."""
        while self._idle:
            self._idle.pop().close()

    # Connections

    def _take(self, timeout: float) -> http.client.HTTPConnection:
        """A connection that stands; one that was idle too long the service has closed."""
        with suppress(IndexError):  # no idle one, or another thread has taken the last
            while True:
                connection = self._idle.pop()
                with selectors.DefaultSelector() as selector:
                    selector.register(connection.sock, selectors.EVENT_READ)
                    closed = selector.select(0)
                if not closed:
                    connection.sock.settimeout(timeout)
                    return connection
                connection.close()
        if self._tls:
            connection = http.client.HTTPSConnection(self._host, self._port, timeout=timeout, context=self._tls)
        else:
            connection = http.client.HTTPConnection(self._host, self._port, timeout=timeout)
        try:
            connection.connect()
        except BaseException:
            connection.close()
            raise
        return connection

    def _give_back(self, answer: _Answer) -> None:
        if answer.response.isclosed() and not answer.response.will_close:
            self._idle.append(answer.connection)
        else:
            answer.connection.close()

    def _exchange(self, connection: http.client.HTTPConnection, request: _Request) -> _Answer:
        try:
            with suppress(BrokenPipeError):  # refused before all was sent: the answer is there
                connection.request(request.method, self._base + request.path, request.body,
                                   {**self._headers, **request.headers})
            response = connection.getresponse()
            open_end = request.streamed and response.status < 400
            body = b"" if open_end else response.read()
        except BaseException:
            connection.close()
            raise
        answer = _Answer(response.status, response.headers, body, connection, response)
        if not open_end:
            self._give_back(answer)
        return answer

    def _perform(self, request: _Request) -> _Answer:
        """Sends a request until it is answered for good. Raises Problem or NoAnswer."""
        unsure = False  # whether one before was carried out
        for attempt in itertools.count():
            connection = None
            failure: FitgaugeError
            pause = _pause(attempt)
            try:
                connection = self._take(request.timeout or self._timeout)
                answer = self._exchange(connection, request)
            except (OSError, http.client.HTTPException) as error:
                failure = NoAnswer(f"{request.method} {request.path}: {error or type(error).__name__}")
                failure.__cause__ = error
                again = connection is None or request.repeatable
                again = again and not isinstance(error, ssl.SSLCertVerificationError)
                unsure = unsure or connection is not None
            else:
                if answer.status < 400 or (request.method == "DELETE" and unsure and answer.status == 404):
                    return answer
                failure = problem = _problem(answer)
                again = request.repeatable and problem.passes
                pause = max(pause, problem.retry_after or 0.0)
            if not again or attempt >= self._retries:
                raise failure
            time.sleep(pause)
        raise AssertionError("unreachable")

    def _stream(self, request: _Request) -> Iterator[bytes]:
        """The body in pieces, as they come. Raises NoAnswer when it breaks off."""
        answer = self._perform(request._replace(streamed=True))
        response = answer.response
        read = response.read1 if response.chunked else response.read
        try:
            while True:
                piece = read(65536)
                if not piece:
                    break
                yield piece
            if response.length:
                raise http.client.IncompleteRead(b"", response.length)
        except (OSError, http.client.HTTPException) as error:
            raise NoAnswer(f"{request.path} broke off: {error or type(error).__name__}") from error
        finally:
            self._give_back(answer)

    def _get(self, path: str, parameters: Mapping[str, Parameter] = {}) -> Any:
        return loads(self._perform(_Request("GET", path + _query(parameters))).body)

    def _bytes(self, path: str, accept: str = "*/*") -> bytes:
        return self._perform(_Request("GET", path, headers={"Accept": accept})).body

    def _put(self, path: str, body: bytes, kind: str, match: str | None = None) -> _Answer:
        headers = {"Content-Type": kind, **({"If-Match": f'"{match}"'} if match else {})}
        return self._perform(_Request("PUT", path, body, headers, repeatable=not match))

    def _post(self, path: str, body: bytes, kind: str, key: str | None, prefer: str = "",
              timeout: float | None = None) -> Any:
        """A write that is carried out once, however often it is sent."""
        headers = {"Content-Type": kind, "Idempotency-Key": key or str(uuid.uuid4())}
        if prefer:
            headers["Prefer"] = prefer
        return loads(self._perform(_Request("POST", path, body, headers, timeout=timeout)).body)

    def _compute(self, path: str, body: Mapping[str, Any]) -> Any:
        """Sends what is computed with; nothing is stored, so it may be repeated."""
        headers = {"Content-Type": "application/json"}
        return loads(self._perform(_Request("POST", path, dumps(body).encode(), headers, repeatable=True)).body)

    def _pages(self, path: str, name: str, parameters: Mapping[str, Parameter]) -> Iterator[Any]:
        after: str | None = None
        while True:
            page = self._get(path, {**parameters, "after": after})
            yield from page[name]
            after = page["next"]
            if after is None:
                return

    # Limits, fits, tables

    def limits(self, designation: str) -> Limits:
        """Limits of size of `25 H7`, `Ø25H7`, `132,5 a13`."""
        return self._get(_path("limits", designation))

    def limits_of(self, nominal_mm: Size, tolerance_class: str) -> Limits:
        """The same from a size and a class."""
        return self._get("/v1/limits", {"nominal_mm": nominal_mm, "tolerance_class": tolerance_class})

    def fit(self, designation: str) -> Fit:
        """The fit `25 H7/g6`."""
        return self._get(_path("fits", designation))

    def fits(self, nominal_mm: Size, *, min_clearance_um: Size | None = None, max_clearance_um: Size | None = None,
             limit: int | None = None) -> dict[str, Any]:
        """The fits of a size whose clearances lie within bounds (interference is negative), the preferred first."""
        return self._get("/v1/fits", {"nominal_mm": nominal_mm, "min_clearance_um": min_clearance_um,
                                      "max_clearance_um": max_clearance_um, "limit": limit})

    def limit_gauges(self, designation: str) -> dict[str, Any]:
        """The sizes of the GO and the NO-GO gauge of `25 H7`."""
        return self._get(_path("gauges", designation))

    def press_fit(self, body: Mapping[str, Any]) -> dict[str, Any]:
        """Pressure and stresses of an interference fit (Lame)."""
        return self._compute("/v1/press-fits", body)

    def statistics(self, kind: str, body: Mapping[str, Any]) -> dict[str, Any]:
        """`summary`, `anova`, `capability`, `chart`, `type1`, `grr` or `pairing` of the values sent."""
        return self._compute(_path("statistics", kind), body)

    def uncertainty(self, body: Mapping[str, Any]) -> dict[str, Any]:
        """The combined and expanded uncertainty of a budget."""
        return self._compute("/v1/uncertainty", body)

    def uncertainties(self) -> list[dict[str, str]]:
        """The stored budgets: `name` and `modified_at`."""
        return self._get("/v1/uncertainties")["uncertainties"]

    def put_uncertainty(self, name: str, budget: Mapping[str, Any]) -> dict[str, Any]:
        """Stores a budget, in micrometres where a gauge uses it, and gives what `uncertainty` gives."""
        return loads(self._put(_path("uncertainties", name), dumps(budget).encode(), "application/json").body)

    def stored_uncertainty(self, name: str) -> dict[str, Any]:
        """A budget as it was stored."""
        return self._get(_path("uncertainties", name))

    def delete_uncertainty(self, name: str) -> None:
        self._perform(_Request("DELETE", _path("uncertainties", name), repeatable=True))

    def gauges_in_use(self) -> list[dict[str, str]]:
        """The gauges: `name` and `modified_at`."""
        return self._get("/v1/gauges-in-use")["gauges"]

    def put_gauge_in_use(self, name: str, calibration_due: str, uncertainty: str | None = None) -> bool:
        """Stores until when a gauge is calibrated, and the name of its budget. Gives whether it is new."""
        body = {"calibration_due": calibration_due, **({"uncertainty": uncertainty} if uncertainty else {})}
        return self._put(_path("gauges-in-use", name), dumps(body).encode(), "application/json").status == 201

    def gauge_in_use(self, name: str) -> dict[str, Any]:
        """A gauge as it was stored."""
        return self._get(_path("gauges-in-use", name))

    def delete_gauge_in_use(self, name: str) -> None:
        self._perform(_Request("DELETE", _path("gauges-in-use", name), repeatable=True))

    def verdict(self, designation: str, measured_mm: Size, *, rule: RuleWord | None = None,
                uncertainty_um: Size | None = None, coverage_factor: Size | None = None,
                probability: Size | None = None, **temperatures: Parameter) -> Verdict:
        """Judges a value and stores nothing. `rule` is simple, or guard_band or conformance, which need
        `uncertainty_um`. `temperatures` correct to 20 degrees: `temperature_c` with `part_material`, say."""
        return self._get(_path("verdicts", designation), {
            "measured_mm": measured_mm, "rule": rule, "uncertainty_um": uncertainty_um,
            "coverage_factor": coverage_factor, "probability": probability, **temperatures})

    def tables(self) -> dict[str, Any]:
        """The revision in use, and the classes of the hole and the shaft table."""
        return self._get("/v1/tables")

    def table(self, feature: str, classes: Sequence[str] = (), revision: str | None = None) -> list[dict[str, Any]]:
        """The rows of the `hole` or `shaft` table: `over_mm`, `up_to_mm` and `limits` by class."""
        return self._get(_path("tables", feature), {
            "classes": ",".join(classes) or None, "revision": revision})["rows"]

    def table_csv(self, feature: str, classes: Sequence[str] = (), revision: str | None = None) -> str:
        """The same as CSV."""
        query = _query({"classes": ",".join(classes) or None, "revision": revision})
        return self._bytes(_path("tables", feature) + query, "text/csv").decode()

    def table_tab(self, feature: str) -> str:
        """The same as the control's freely definable table, for program 8255."""
        return self._bytes(_path("tables", f"{feature}.tab")).decode()

    def put_column(self, feature: str, name: str, rows: Sequence[Mapping[str, Size]],
                   revision: str | None = None) -> str:
        """Stores a column of the shop's own: rows of `over_mm`, `up_to_mm`, `upper_um`, `lower_um`. Gives
        the new revision. PreconditionFailed when `revision` is given and no longer in use."""
        answer = self._put(_path("tables", feature, "classes", name), dumps({"rows": rows}).encode(),
                           "application/json", revision)
        return loads(answer.body)["revision"]

    def delete_column(self, feature: str, name: str, revision: str | None = None) -> None:
        """Back to the standard's class."""
        headers = {"If-Match": f'"{revision}"'} if revision else {}
        self._perform(_Request("DELETE", _path("tables", feature, "classes", name), headers=headers,
                               repeatable=not revision))

    # Measurements

    def measure(self, measurement: NewMeasurement, *, idempotency_key: str | None = None) -> Measurement:
        """Judges and stores one value; when this returns it is on the service's disk."""
        if not isinstance(measurement, Mapping):
            raise TypeError("measure takes one measurement; measure_all and measure_many take several")
        return self._post("/v1/measurements", dumps(measurement).encode(), "application/json",
                                         idempotency_key)

    def measure_all(self, measurements: Sequence[NewMeasurement], *,
                    idempotency_key: str | None = None) -> list[Measurement]:
        """Stores up to 100,000 values in one request, all or none, and gives their records."""
        answer = self._post("/v1/measurements", dumps(list(measurements)).encode(), "application/json",
                            idempotency_key, "return=representation")
        records: list[Measurement] = answer["measurements"]
        return records

    def measure_many(self, measurements: Iterable[NewMeasurement], *, idempotency_key: str | None = None,
                     rows: int = 5_000, progress: Callable[[Accepted], object] | None = None) -> Accepted:
        """Stores any number of values, taken from the iterator as they are sent, `rows` a request, each
        all or none. Begun again with the same key, values and `rows` it stores none twice.
        `progress` is called with the sum after each request. Bad rows are counted over all."""
        records = (dumps(measurement) + "\n" for measurement in measurements)
        return self._post_batches(_batches(records, "", rows), "application/x-ndjson", idempotency_key, progress)

    def measure_csv(self, lines: Iterable[str], *, idempotency_key: str | None = None, rows: int = 5_000,
                    progress: Callable[[Accepted], object] | None = None) -> Accepted:
        """The same from the lines of CSV, the header line first: an open file, say."""
        if isinstance(lines, (str, bytes)):
            raise TypeError("measure_csv takes lines: an open file, io.StringIO(text), or a list of lines")
        records = _csv_records(lines)
        return self._post_batches(_batches(records, next(records, ""), rows), "text/csv", idempotency_key, progress)

    def _post_batches(self, batches: Iterable[_Batch], kind: str, key: str | None,
                      progress: Callable[[Accepted], object] | None) -> Accepted:
        key = key or str(uuid.uuid4())
        total: Accepted | None = None
        for batch in batches:
            try:
                total = _sum(total, self._post("/v1/measurements", batch.body, kind, f"{key}/{batch.rows}"))
            except Problem as problem:
                raise _moved(problem, batch) from None
            if progress:
                progress(total)
        assert total is not None  # there is always a first batch
        return total

    def measurement(self, measurement_id: str) -> Measurement:
        """One record."""
        return self._get(_path("measurements", measurement_id))

    def measurements(self, *, page: int = 1_000, **filters: Parameter) -> Iterator[Measurement]:
        """Records in storage order, `page` a request: `part_id`, `characteristic`, `order`, `machine`,
        `verdict`, `source`, `from_`, `to`, `history`."""
        return self._pages("/v1/measurements", "measurements", {**filters, "limit": page})

    def export(self, form: str = "csv", **filters: Parameter) -> Iterator[bytes]:
        """All records that match as `csv` or `ndjson`, in pieces of one answer. Close it to stop early."""
        kind = {"csv": "text/csv", "ndjson": "application/x-ndjson"}[form]
        return self._stream(_Request("GET", "/v1/measurements" + _query(filters), headers={"Accept": kind}))

    def summary(self, group_by: str = "characteristic", **filters: Parameter) -> list[dict[str, Any]]:
        """Count, verdicts, `mean_mm`, `standard_deviation_mm`, `min_mm` and `max_mm` of each group."""
        return self._get("/v1/measurements/summary",
                                                 {"group_by": group_by, **filters})["groups"]

    def capability(self, *, target_mm: Size | None = None, confidence: Size | None = None,
                   **filters: Parameter) -> dict[str, Any]:
        """Capability and performance of stored values against the limits in their records; by `subgroup` where
        they name one, unless `subgroups="ignore"`."""
        return self._get("/v1/measurements/capability",
                         {"target_mm": target_mm, "confidence": confidence, **filters})

    def chart(self, kind: str | None = None, rules: Sequence[int] = (), **filters: Parameter) -> dict[str, Any]:
        """Control chart of stored values with the violations of `rules` of 1 to 4. `kind` is i_mr, xbar_r, xbar_s,
        ewma or cusum; without it xbar_r where the values name subgroups, else i_mr."""
        return self._get("/v1/measurements/chart",
                         {"kind": kind, "rules": ",".join(map(str, rules)) or None, **filters})

    def correct(self, measurement_id: str, correction: NewMeasurement, *,
                idempotency_key: str | None = None) -> Measurement:
        """A new record in place of a wrong one, which stays: `measured_mm`, `reason`, and what else changes."""
        return self._post(_path("measurements", measurement_id, "corrections"),
                                         dumps(correction).encode(), "application/json", idempotency_key)

    def certificate(self, *, order: str | None = None, part_id: str | None = None, **options: Parameter) -> bytes:
        """The inspection certificate of an order, a part or both, as PDF. `options` are `title`, `company`,
        `customer`, `paper` (a4, letter) and the filters of measurements."""
        query = _query({"order": order, "part_id": part_id, **options})
        return self._bytes("/v1/certificates" + query, "application/pdf")

    def proof(self, measurement_id: str) -> dict[str, Any]:
        """That a record stands in the log: `index`, `size`, `leaf`, `hashes` and the signed `checkpoint`, for
        check_proof.py or another verifier."""
        return self._get(_path("measurements", measurement_id, "proof"))

    def checkpoint(self) -> str:
        """The signed head of the log: keep one where those who can write the database cannot reach it."""
        return self._bytes("/v1/log/checkpoint").decode()

    def log_keys(self) -> list[str]:
        """The keys that verify checkpoints (vkeys), the newest first."""
        return self._bytes("/v1/log/key").decode().split()

    def log_tile(self, path: str) -> bytes:
        """A tile of the log as C2SP tlog-tiles names it: `0/000`, `entries/000.p/3`."""
        return self._bytes("/v1/log/tile/" + path)

    def put_log(self, origin: str, place: int, batch: bytes) -> dict[str, Any]:
        """Forwards records of another data folder, as a station does; the head of its log that is here then."""
        path = _path("log", origin, str(place))
        return loads(self._put(path, batch, "application/x-ndjson").body)

    def events(self, last_event_id: str | None = None, source: str | None = None) -> Iterator[Event]:
        """What happens, for ever: measurement.recorded, verdict.reject, run.finished. When the connection
        breaks it is made again, and goes on after the last event, or after `last_event_id` to begin with.
        `resync` says that events are gone: read the lists again."""
        last, stood = last_event_id, False
        while True:
            headers = {"Accept": "text/event-stream", **({"Last-Event-ID": last} if last else {})}
            request = _Request("GET", "/v1/events" + _query({"source": source}), headers=headers, timeout=_SILENCE_S)
            try:
                for event in _events(self._stream(request)):
                    last, stood = event.id or last, True
                    if event.data is not None:
                        yield event
            except (NoAnswer, Unavailable):
                if not stood:
                    raise
            time.sleep(_pause(3))

    # The control's disk

    def files(self, prefix: str = "") -> list[dict[str, Any]]:
        """`path`, `size` and `modified_at` of each file whose path begins so."""
        return self._get("/v1/files", {"prefix": prefix or None})["files"]

    def put_file(self, path: str, content: bytes) -> bool:
        """Stores a file as `nc_prog/8255.h` or `TNC:\\nc_prog\\8255.h`; True when it is new."""
        return self._put(_control_path(path), content, "application/octet-stream").status == 201

    def file(self, path: str) -> bytes:
        """The content of a file."""
        return self._bytes(_control_path(path))

    def delete_file(self, path: str) -> None:
        self._perform(_Request("DELETE", _control_path(path)))

    def check(self, path: str) -> list[dict[str, Any]]:
        """The findings in a program with those it calls, a mask or a table; nothing runs."""
        answer = self._perform(_Request("POST", _control_path(path) + "?action=check"))
        return loads(answer.body)["diagnostics"]

    # Plans

    def plans(self) -> list[dict[str, Any]]:
        """`part`, `name`, how many `characteristics`, and `modified_at` of each plan."""
        return self._get("/v1/plans")["plans"]

    def plan(self, part: str) -> dict[str, Any]:
        """What is measured at a part, in order."""
        return self._get(_path("plans", part))

    def put_plan(self, part: str, plan: Mapping[str, Any]) -> bool:
        """Stores a plan; True when it is new."""
        return self._put(_path("plans", part), dumps(plan).encode(), "application/json").status == 201

    def delete_plan(self, part: str) -> None:
        self._perform(_Request("DELETE", _path("plans", part)))

    # Setups and runs

    def setups(self) -> list[dict[str, str]]:
        """`name` and `modified_at` of each setup."""
        return self._get("/v1/setups")["setups"]

    def setup(self, name: str) -> dict[str, Any]:
        return self._get(_path("setups", name))

    def put_setup(self, name: str, setup: Union[Mapping[str, Any], Text]) -> bool:
        """Stores a setup, an object or its JSON text; True when it is new."""
        text = dumps(setup) if isinstance(setup, Mapping) else setup
        return self._put(_path("setups", name), text.encode() if isinstance(text, str) else text,
                         "application/json").status == 201

    def delete_setup(self, name: str) -> None:
        self._perform(_Request("DELETE", _path("setups", name)))

    def run_program(self, program: str, setup: Union[str, Mapping[str, Any], None] = None, *,
                    parameters: Mapping[str, Size] | None = None, limits: RunLimits | None = None,
                    on_stop: Literal["continue", "end"] | None = None, block_skip: bool | None = None,
                    language: Literal["english", "german", "dutch", "italian"] | None = None,
                    idempotency_key: str | None = None) -> Run:
        """Runs `nc_prog/8255.h` or `TNC:\\nc_prog\\8255.h` and waits for its end. A program that fails is a
        run with that status; one that cannot start is ProgramInvalid."""
        order = {"setup": setup, "parameters": parameters, "limits": limits, "on_stop": on_stop,
                 "block_skip": block_skip, "language": language}
        return self._order(program, order, idempotency_key, "")

    def start_run(self, program: str, setup: Union[str, Mapping[str, Any], None] = None, *,
                  parameters: Mapping[str, Size] | None = None, limits: RunLimits | None = None,
                  on_stop: Literal["continue", "end"] | None = None, block_skip: bool | None = None,
                  language: Literal["english", "german", "dutch", "italian"] | None = None,
                  idempotency_key: str | None = None) -> Run:
        """The same without waiting."""
        order = {"setup": setup, "parameters": parameters, "limits": limits, "on_stop": on_stop,
                 "block_skip": block_skip, "language": language}
        return self._order(program, order, idempotency_key, "respond-async")

    def _order(self, program: str, order: Mapping[str, Any], key: str | None, prefer: str) -> Run:
        body = {"program": "TNC:\\" + _below_drive(program).replace("/", "\\"),
                **{name: value for name, value in order.items() if value is not None}}
        return self._post("/v1/runs", dumps(body).encode(), "application/json", key, prefer, _RUN_S)

    def wait_for_run(self, run_id: str) -> Run:
        """The run when it is over."""
        for attempt in itertools.count():
            run = self.run(run_id)
            if run["status"] not in ("queued", "running"):
                return run
            with suppress(NoAnswer):
                for _ in self.run_events(run_id):
                    pass
            time.sleep(_pause(attempt))
        raise AssertionError("unreachable")

    def run(self, run_id: str) -> Run:
        return self._get(_path("runs", run_id))

    def runs(self, *, page: int = 100, **filters: Parameter) -> Iterator[Run]:
        """The runs, the newest first: `status`, `program`."""
        return self._pages("/v1/runs", "runs", {**filters, "limit": page})

    def run_parameters(self, run_id: str) -> dict[str, Union[Decimal, str]]:
        """Q parameters that are defined at the end."""
        return _decimals(self._get(_path("runs", run_id, "parameters")))

    def run_request(self, run_id: str) -> dict[str, Any]:
        """The order with its setup; given to `run_program` it repeats the run."""
        return self._get(_path("runs", run_id, "request"))

    def run_file(self, run_id: str, name: str) -> bytes:
        """A file the run has written."""
        return self._bytes(_path("runs", run_id, "files", name))

    def trace(self, run_id: str) -> list[dict[str, Any]]:
        """Every move with its block, start, end, feed, time and contact."""
        return self._get(_path("runs", run_id, "trace"))["moves"]

    def trace_csv(self, run_id: str) -> str:
        return self._bytes(_path("runs", run_id, "trace"), "text/csv").decode()

    def run_events(self, run_id: str) -> Iterator[Event]:
        """progress, output, and end with the run."""
        return _events(self._stream(_Request("GET", _path("runs", run_id, "events"),
                                             headers={"Accept": "text/event-stream"}, timeout=_SILENCE_S)))

    def cancel_run(self, run_id: str) -> None:
        """Conflict when it was over before."""
        self._perform(_Request("DELETE", _path("runs", run_id), repeatable=False))

    # Service

    def connections(self) -> list[dict[str, Any]]:
        """The connections to the world outside: settings without secrets, state, lag, last error, what they did."""
        return self._get("/v1/connections")["connections"]

    def connection(self, name: str) -> dict[str, Any]:
        return self._get(_path("connections", name))

    def put_connection(self, name: str, connection: Mapping[str, Any]) -> bool:
        """Stores a connection, `kind` and what it takes, and starts it; True when it is new."""
        return self._put(_path("connections", name), dumps(connection).encode(), "application/json").status == 201

    def delete_connection(self, name: str) -> None:
        self._perform(_Request("DELETE", _path("connections", name)))

    def test_connection(self, name: str) -> dict[str, Any]:
        """Tries the other side once: `ok` and `detail`."""
        return loads(self._perform(_Request("POST", _path("connections", name, "test"))).body)

    def mtconnect(self, request: str, *, start: int | None = None, count: int | None = None) -> str:
        """An MTConnect document: `probe`, `current` or `sample`, from a sequence on."""
        return self._bytes("/mtconnect/" + urllib.parse.quote(request, safe="") + _query({"from": start, "count": count}),
                           "text/xml").decode()

    def cycles(self) -> list[dict[str, Any]]:
        """The touch-probe cycles with their parameters and results."""
        return self._get("/v1/cycles")["cycles"]

    def cycle(self, number: int) -> dict[str, Any]:
        return self._get(_path("cycles", str(number)))

    def live(self) -> bool:
        """The process answers."""
        return bool(self._get("/livez")["status"] == "live")

    def ready(self) -> dict[str, Any]:
        """Version, database and table revision. Unavailable says what is not in order."""
        return self._get("/readyz")

    def wait_until_ready(self, timeout: float = 60.0) -> dict[str, Any]:
        """What `ready` gives, as soon as it does; what was wrong last when `timeout` seconds are over."""
        end = time.monotonic() + timeout
        for attempt in itertools.count():
            try:
                return loads(self._perform(_Request("GET", "/readyz", repeatable=False)).body)
            except (NoAnswer, Unavailable):
                pause = _pause(attempt)
                if time.monotonic() + pause >= end:
                    raise
                time.sleep(pause)
        raise AssertionError("unreachable")

    def metrics(self) -> str:
        """Counters for Prometheus."""
        return self._bytes("/metrics").decode()

    def openapi(self) -> dict[str, Any]:
        """The description of the API."""
        return self._get("/openapi.json")
