"""What calls take and give beside the bodies of the service."""

from __future__ import annotations

from datetime import datetime
from decimal import Decimal
from typing import Any, NamedTuple, Union

Parameter = Union[Decimal, int, str, datetime, None]  # of a query; None is left out


class Event(NamedTuple):
    """What happened; `id` is where a reader goes on that comes back."""

    type: str
    id: str | None
    data: Any


def when(text: str) -> datetime:
    """The moment of `measured_at`, `received_at`, `created_at`: in UTC, to the microsecond."""
    whole, _, fraction = text.rstrip("Z").partition(".")
    return datetime.fromisoformat(f"{whole}.{fraction[:6]:0<6}+00:00")
