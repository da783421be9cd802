"""Requests over connections that are kept, sent again where that is safe."""

# The service's answers are taken to have the types that its API promises.
# mypy: no-warn-return-any

from __future__ import annotations

import email.message
import http.client
import itertools
import os
import random
import selectors
import ssl
import time
import urllib.parse
import uuid
from contextlib import suppress
from typing import Any, Iterator, Mapping, NamedTuple, TypeVar

from ._errors import FitgaugeError, NoAnswer, problem_of
from ._json import dumps, loads, plain
from ._values import Parameter
from ._version import VERSION

FIRST_PAUSE_S, LONGEST_PAUSE_S = 0.1, 10.0

T = TypeVar("T", bound="Transport")


class Request(NamedTuple):
    method: str
    path: str
    body: bytes | None = None
    headers: Mapping[str, str] = {}
    repeatable: bool = True
    timeout: float | None = None
    streamed: bool = False


class Answer(NamedTuple):
    status: int
    headers: email.message.Message
    body: bytes  # empty where it is streamed
    connection: http.client.HTTPConnection
    response: http.client.HTTPResponse


def pause_before(attempt: int) -> float:
    return min(LONGEST_PAUSE_S, FIRST_PAUSE_S * 2.0 ** min(attempt, 20)) * random.uniform(0.5, 1.0)


def path_of(*segments: str) -> str:
    for segment in segments:
        if not isinstance(segment, str):
            raise TypeError(f"{segment!r} is no text: a designation is '25 H7', a name or an id a string")
    return "/v1/" + "/".join(urllib.parse.quote(segment, safe="") for segment in segments)


def query_of(parameters: Mapping[str, Parameter]) -> str:
    """A trailing underscore is dropped: `from` is a word of Python's own."""
    pairs = [(name.rstrip("_"), value if isinstance(value, str) else plain(value))
             for name, value in parameters.items() if value is not None]
    return "?" + urllib.parse.urlencode(pairs) if pairs else ""


class Transport:
    """Connections to a service that are kept open, and requests over them."""

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
        self._headers = {"Accept": "application/json", "User-Agent": f"fitgauge-python/{VERSION}"}
        key = key or os.environ.get("FITGAUGE_KEY")
        if key:
            self._headers["Authorization"] = f"Bearer {key}"
        self._idle: list[http.client.HTTPConnection] = []

    def __enter__(self: T) -> T:
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

    def _give_back(self, answer: Answer) -> None:
        if answer.response.isclosed() and not answer.response.will_close:
            self._idle.append(answer.connection)
        else:
            answer.connection.close()

    def _exchange(self, connection: http.client.HTTPConnection, request: Request) -> Answer:
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
        answer = Answer(response.status, response.headers, body, connection, response)
        if not open_end:
            self._give_back(answer)
        return answer

    def _perform(self, request: Request) -> Answer:
        """Sends a request until it is answered for good. Raises Problem or NoAnswer."""
        unsure = False  # whether one before was carried out
        for attempt in itertools.count():
            connection = None
            failure: FitgaugeError
            pause = pause_before(attempt)
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
                failure = problem = problem_of(answer.status, answer.headers.get("Retry-After"), answer.body)
                again = request.repeatable and problem.passes
                pause = max(pause, problem.retry_after or 0.0)
            if not again or attempt >= self._retries:
                raise failure
            time.sleep(pause)
        raise AssertionError("unreachable")

    def _stream(self, request: Request) -> Iterator[bytes]:
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
        return loads(self._perform(Request("GET", path + query_of(parameters))).body)

    def _bytes(self, path: str, accept: str = "*/*") -> bytes:
        return self._perform(Request("GET", path, headers={"Accept": accept})).body

    def _put(self, path: str, body: bytes, kind: str, match: str | None = None) -> Answer:
        headers = {"Content-Type": kind, **({"If-Match": f'"{match}"'} if match else {})}
        return self._perform(Request("PUT", path, body, headers, repeatable=not match))

    def _post(self, path: str, body: bytes, kind: str, key: str | None, prefer: str = "",
              timeout: float | None = None) -> Any:
        """A write that is carried out once, however often it is sent."""
        headers = {"Content-Type": kind, "Idempotency-Key": key or str(uuid.uuid4())}
        if prefer:
            headers["Prefer"] = prefer
        return loads(self._perform(Request("POST", path, body, headers, timeout=timeout)).body)

    def _compute(self, path: str, body: Mapping[str, Any]) -> Any:
        """Sends what is computed with; nothing is stored, so it may be repeated."""
        headers = {"Content-Type": "application/json"}
        return loads(self._perform(Request("POST", path, dumps(body).encode(), headers, repeatable=True)).body)

    def _pages(self, path: str, name: str, parameters: Mapping[str, Parameter]) -> Iterator[Any]:
        page: dict[str, Any] = {"next": parameters.get("after")}
        while True:
            page = self._get(path, {**parameters, "after": page["next"]})
            yield from page[name]
            if page["next"] is None:
                return
