"""What goes wrong."""

from __future__ import annotations

from contextlib import suppress
from datetime import datetime, timezone
from email.utils import parsedate_to_datetime
from typing import Any, Mapping

from ._json import loads
from ._types import FieldError


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
        # The detail repeats the first field, which the list has with its place.
        said = self.title if fields else self.detail or self.title
        super().__init__(f"{status} {self.code}: {said}{fields}")

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


def seconds_of(retry_after: str | None) -> float | None:
    """Retry-After: seconds or a date (RFC 9110, 10.2.3)."""
    if retry_after is None:
        return None
    if retry_after.strip().isdigit():
        return float(retry_after)
    with suppress(ValueError, TypeError):
        return max(0.0, (parsedate_to_datetime(retry_after) - datetime.now(timezone.utc)).total_seconds())
    return None


def problem_of(status: int, retry_after: str | None, body: bytes) -> Problem:
    """The error of an answer."""
    try:
        document = loads(body)
        if not isinstance(document, dict):
            raise ValueError("no object")
    except ValueError:  # of a proxy, say
        document = {"detail": body[:200].decode("utf-8", "replace")}
    kind = _BY_STATUS.get(status, Problem)
    if document.get("code") == "program.invalid":
        kind = ProgramInvalid
    return kind(status, document, seconds_of(retry_after))
