"""JSON with exact decimals."""

from __future__ import annotations

import json
import re
from datetime import datetime
from decimal import Decimal
from typing import Any, Dict, Mapping, Union

Size = Union[Decimal, int, str]  # in the unit that the field's name ends with
Text = Union[str, bytes]

_EXACT = re.compile(r"_(mm|um|c|deg|s|mm_min|um_per_m_k)$|"
                    r"^(seconds|coverage_factor|probability|conformance_probability|parameters)$")


def is_exact(name: str) -> bool:
    """Whether a member of that name has a unit: its numbers are Decimals."""
    return bool(_EXACT.search(name))


class _Exact(Dict[str, bool]):
    """Whether a name is of an exact number: each is looked at once, for there are few."""

    def __missing__(self, name: str) -> bool:
        found = is_exact(name)
        if len(self) < 1_000:
            self[name] = found
        return found


_exact = _Exact()


def decimals(value: Any) -> Any:
    if isinstance(value, int) and not isinstance(value, bool):
        return Decimal(value)
    if isinstance(value, list):
        return [decimals(item) for item in value]
    if isinstance(value, dict):
        return {name: decimals(item) for name, item in value.items()}
    return value


def loads(text: Text) -> Any:
    """Reads JSON; a fraction, and every number in a field with a unit, becomes a Decimal."""
    def make(pairs: list[tuple[str, Any]]) -> Any:
        return {name: decimals(value) if _exact[name] else value for name, value in pairs}
    return json.loads(text, parse_float=Decimal, object_pairs_hook=make)


def refuse_float(value: Any) -> None:
    if isinstance(value, float):
        raise TypeError(f"{value!r} is a binary float: give a Decimal, an int or a string")


def plain(value: Union[Decimal, int, datetime]) -> str:
    refuse_float(value)
    if isinstance(value, datetime):
        if value.tzinfo is None:
            raise ValueError(f"{value} has no time zone: use datetime.now(timezone.utc), say")
        return value.isoformat()
    if not Decimal(value).is_finite():
        raise ValueError(f"{value} is not a number")
    return format(value, "f") if isinstance(value, Decimal) else str(value)


def dumps(value: Any) -> str:
    """Writes JSON with the digits of each Decimal. TypeError for a float: it is not the number that was meant."""
    refuse_float(value)
    if isinstance(value, Decimal):
        return plain(value)
    if isinstance(value, datetime):
        return json.dumps(plain(value))
    if isinstance(value, Mapping):
        return "{" + ",".join(f"{json.dumps(str(name))}:{dumps(item)}" for name, item in value.items()) + "}"
    if isinstance(value, (list, tuple)):
        return "[" + ",".join(map(dumps, value)) + "]"
    return json.dumps(value)
