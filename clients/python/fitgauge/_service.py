"""The service itself: plans, catalogues, connections, health."""

# The service's answers are taken to have the types that its API promises.
# mypy: no-warn-return-any

from __future__ import annotations

import itertools
import time
import urllib.parse
from typing import Any, Mapping, Sequence

from ._errors import NoAnswer, Unavailable
from ._json import dumps, loads
from ._transport import Request, Transport, path_of, pause_before, query_of



class ServiceCalls(Transport):
    """Plans, catalogues, connections to the world outside, and how the service is."""

    def plans(self) -> list[dict[str, Any]]:
        """`part`, `name`, how many `characteristics`, and `modified_at` of each plan."""
        return self._get("/v1/plans")["plans"]

    def plan(self, part: str) -> dict[str, Any]:
        """What is measured at a part, in order."""
        return self._get(path_of("plans", part))

    def put_plan(self, part: str, plan: Mapping[str, Any]) -> bool:
        """Stores a plan; True when it is new."""
        return self._put(path_of("plans", part), dumps(plan).encode(), "application/json").status == 201

    def plan_from_drawing(self, part: str, drawing: bytes) -> dict[str, Any]:
        """Makes a plan of a STEP file: what was `added`, `gone` and `changed`, and what was `not_read`."""
        return loads(self._put(path_of("plans", part), drawing, "model/step").body)

    def read_drawing(self, drawing: bytes, part: str | None = None) -> dict[str, Any]:
        """The `sizes` of a STEP file, and what was `not_read`; nothing is stored. With a `part` that has a plan also how
        it is `compared`: `added`, `gone` and `changed`."""
        target = "/v1/drawings" + query_of({"part": part})
        return loads(self._perform(Request("POST", target, drawing, {"Content-Type": "model/step"})).body)

    def delete_plan(self, part: str) -> None:
        self._perform(Request("DELETE", path_of("plans", part)))

    def catalogues(self) -> list[dict[str, Any]]:
        """`name` and `modified_at` of each catalogue of causes and actions."""
        return self._get("/v1/catalogues")["catalogues"]

    def catalogue(self, name: str) -> dict[str, Any]:
        """The `causes` and `measures` there are to choose from."""
        return self._get(path_of("catalogues", name))

    def put_catalogue(self, name: str, causes: Sequence[str], measures: Sequence[str]) -> bool:
        """Stores a catalogue; True when it is new."""
        body = dumps({"causes": list(causes), "measures": list(measures)}).encode()
        return self._put(path_of("catalogues", name), body, "application/json").status == 201

    def delete_catalogue(self, name: str) -> None:
        self._perform(Request("DELETE", path_of("catalogues", name)))

    def connections(self) -> list[dict[str, Any]]:
        """The connections to the world outside: settings without secrets, state, lag, last error, what they did."""
        return self._get("/v1/connections")["connections"]

    def connection(self, name: str) -> dict[str, Any]:
        return self._get(path_of("connections", name))

    def put_connection(self, name: str, connection: Mapping[str, Any]) -> bool:
        """Stores a connection, `kind` and what it takes, and starts it; True when it is new."""
        return self._put(path_of("connections", name), dumps(connection).encode(), "application/json").status == 201

    def delete_connection(self, name: str) -> None:
        self._perform(Request("DELETE", path_of("connections", name)))

    def test_connection(self, name: str) -> dict[str, Any]:
        """Tries the other side once: `ok` and `detail`."""
        return loads(self._perform(Request("POST", path_of("connections", name, "test"))).body)

    def replay_connection(self, name: str, start: str) -> dict[str, Any]:
        """Sends again from the id of a measurement or an event, or from a time."""
        return self._compute(path_of("connections", name, "replay"), {"from": start})

    def mtconnect(self, request: str, *, start: int | None = None, count: int | None = None) -> str:
        """An MTConnect document: `probe`, `current`, `sample` from a sequence on, `assets` or `asset/ID`."""
        return self._bytes("/mtconnect/" + urllib.parse.quote(request) + query_of({"from": start, "count": count}),
                           "text/xml").decode()

    def live(self) -> bool:
        """The process responds."""
        return bool(self._get("/livez")["status"] == "live")

    def ready(self) -> dict[str, Any]:
        """Version, database and table revision. Unavailable says what is not in order."""
        return self._get("/readyz")

    def wait_until_ready(self, timeout: float = 60.0) -> dict[str, Any]:
        """What `ready` gives, as soon as it does; what was wrong last when `timeout` seconds are over."""
        end = time.monotonic() + timeout
        for attempt in itertools.count():
            try:
                return loads(self._perform(Request("GET", "/readyz", repeatable=False)).body)
            except (NoAnswer, Unavailable):
                pause = pause_before(attempt)
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
