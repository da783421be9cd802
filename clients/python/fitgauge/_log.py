"""The log: proofs, checkpoints and records that are forwarded."""

# The service's answers are taken to have the types that its API promises.
# mypy: no-warn-return-any

from __future__ import annotations

from typing import Any, Iterator

from ._json import loads
from ._transport import Transport, path_of
from ._values import Parameter


class LogCalls(Transport):
    """What proves that nothing was altered."""

    def proof(self, measurement_id: str) -> dict[str, Any]:
        """That a record stands in the log: `index`, `size`, `leaf`, `hashes` and the signed `checkpoint`, for
        check_proof.py or another verifier."""
        return self._get(path_of("measurements", measurement_id, "proof"))

    def checkpoint(self) -> str:
        """The signed head of the log: keep one where those who can write the database cannot reach it."""
        return self._bytes("/v1/log/checkpoint").decode()

    def log_keys(self) -> list[str]:
        """The keys that verify checkpoints (vkeys), the newest first."""
        return self._bytes("/v1/log/key").decode().split()

    def log_tile(self, path: str) -> bytes:
        """A tile of the log as C2SP tlog-tiles names it: `0/000`, `entries/000.p/3`."""
        return self._bytes("/v1/log/tile/" + path)

    def changes(self, page: int = 1000, **filters: Parameter) -> Iterator[dict[str, Any]]:
        """What was changed of all that decides, oldest first: `kind`, `name`, `from_` and `to` choose."""
        return self._pages("/v1/changes", "changes", {**filters, "limit": page})

    def changes_after(self, cursor: str | None, **filters: Parameter) -> tuple[list[dict[str, Any]], str | None]:
        """The changes after a cursor, oldest first, and the cursor for the next call; None is before the first change."""
        found: list[dict[str, Any]] = []
        while True:
            page = self._get("/v1/changes", {**filters, "limit": 1000, "after": cursor})
            found += page["changes"]
            cursor = page["last"]
            if page["next"] is None:
                return found, cursor

    def changes_checkpoint(self) -> str:
        """The signed head of the log of changes."""
        return self._bytes("/v1/log/changes/checkpoint").decode()

    def changes_keys(self) -> list[str]:
        """The keys that verify its checkpoints (vkeys), the newest first."""
        return self._bytes("/v1/log/changes/key").decode().split()

    def changes_tile(self, path: str) -> bytes:
        """A tile of the log of changes; an entry is a change."""
        return self._bytes("/v1/log/changes/tile/" + path)

    def put_log(self, origin: str, place: int, batch: bytes) -> dict[str, Any]:
        """Forwards records of another data folder, as a station does; the head of its log that is here then."""
        path = path_of("log", origin, str(place))
        return loads(self._put(path, batch, "application/x-ndjson").body)
