"""The log: proofs, checkpoints and records that are forwarded."""

# The service's answers are taken to have the types that its API promises.
# mypy: no-warn-return-any

from __future__ import annotations

from typing import Any

from ._json import loads
from ._transport import Transport, path_of



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

    def put_log(self, origin: str, place: int, batch: bytes) -> dict[str, Any]:
        """Forwards records of another data folder, as a station does; the head of its log that is here then."""
        path = path_of("log", origin, str(place))
        return loads(self._put(path, batch, "application/x-ndjson").body)
