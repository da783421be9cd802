"""The control: files, plans, setups and runs of NC programs."""

# The service's answers are taken to have the types that its API promises.
# mypy: no-warn-return-any

from __future__ import annotations

import itertools
import time
from contextlib import suppress
from decimal import Decimal
from typing import Any, Iterator, Literal, Mapping, Union

from ._errors import NoAnswer
from ._json import Size, Text, decimals, dumps, loads
from ._streams import read_events
from ._transport import Request, Transport, path_of, pause_before
from ._types import Run, RunLimits
from ._values import Event, Parameter

SILENCE_S = 45.0  # a stream of events has a sign of life every 15 s
RUN_S = 180.0  # the 60 s a run may take, after others before it


def below_drive(path: str) -> str:
    """`TNC:\\nc_prog\\8255.h` and `nc_prog/8255.h` are the same file: the latter."""
    plain = path[4:] if path[:4].upper() == "TNC:" else path
    return plain.replace("\\", "/").lstrip("/")


def control_path(path: str) -> str:
    return path_of("files", *below_drive(path).split("/"))



class ControlCalls(Transport):
    """NC programs, and what they run with."""

    def files(self, prefix: str = "") -> list[dict[str, Any]]:
        """`path`, `size` and `modified_at` of each file whose path begins so."""
        return self._get("/v1/files", {"prefix": prefix or None})["files"]

    def put_file(self, path: str, content: bytes) -> bool:
        """Stores a file as `nc_prog/8255.h` or `TNC:\\nc_prog\\8255.h`; True when it is new."""
        return self._put(control_path(path), content, "application/octet-stream").status == 201

    def file(self, path: str) -> bytes:
        """The content of a file."""
        return self._bytes(control_path(path))

    def delete_file(self, path: str) -> None:
        self._perform(Request("DELETE", control_path(path)))

    def check(self, path: str) -> list[dict[str, Any]]:
        """The findings in a program with those it calls, a mask or a table; nothing runs."""
        answer = self._perform(Request("POST", control_path(path) + "?action=check"))
        return loads(answer.body)["diagnostics"]

    def setups(self) -> list[dict[str, str]]:
        """`name` and `modified_at` of each setup."""
        return self._get("/v1/setups")["setups"]

    def setup(self, name: str) -> dict[str, Any]:
        return self._get(path_of("setups", name))

    def put_setup(self, name: str, setup: Union[Mapping[str, Any], Text]) -> bool:
        """Stores a setup, an object or its JSON text; True when it is new."""
        text = dumps(setup) if isinstance(setup, Mapping) else setup
        return self._put(path_of("setups", name), text.encode() if isinstance(text, str) else text,
                         "application/json").status == 201

    def delete_setup(self, name: str) -> None:
        self._perform(Request("DELETE", path_of("setups", name)))

    def run_program(self, program: str, setup: Union[str, Mapping[str, Any], None] = None, *,
                    parameters: Mapping[str, Size] | None = None, limits: RunLimits | None = None,
                    on_stop: Literal["continue", "end"] | None = None, block_skip: bool | None = None,
                    language: Literal["english", "german", "dutch", "italian", "polish"] | None = None,
                    part_id: str | None = None, order: str | None = None,
                    idempotency_key: str | None = None) -> Run:
        """Runs `nc_prog/8255.h` or `TNC:\\nc_prog\\8255.h` and waits for its end. A program that fails is a
        run with that status; one that cannot start is ProgramInvalid. Its records have the part and the order."""
        body = {"setup": setup, "parameters": parameters, "limits": limits, "on_stop": on_stop,
                "block_skip": block_skip, "language": language, "part_id": part_id, "order": order}
        return self._order(program, body, idempotency_key, "")

    def start_run(self, program: str, setup: Union[str, Mapping[str, Any], None] = None, *,
                  parameters: Mapping[str, Size] | None = None, limits: RunLimits | None = None,
                  on_stop: Literal["continue", "end"] | None = None, block_skip: bool | None = None,
                  language: Literal["english", "german", "dutch", "italian", "polish"] | None = None,
                  part_id: str | None = None, order: str | None = None,
                  idempotency_key: str | None = None) -> Run:
        """The same without waiting."""
        body = {"setup": setup, "parameters": parameters, "limits": limits, "on_stop": on_stop,
                "block_skip": block_skip, "language": language, "part_id": part_id, "order": order}
        return self._order(program, body, idempotency_key, "respond-async")

    def _order(self, program: str, given: Mapping[str, Any], key: str | None, prefer: str) -> Run:
        body = {"program": "TNC:\\" + below_drive(program).replace("/", "\\"),
                **{name: value for name, value in given.items() if value is not None}}
        return self._post("/v1/runs", dumps(body).encode(), "application/json", key, prefer, RUN_S)

    def wait_for_run(self, run_id: str) -> Run:
        """The run when it is over."""
        for attempt in itertools.count():
            run = self.run(run_id)
            if run["status"] not in ("queued", "running"):
                return run
            with suppress(NoAnswer):
                for _ in self.run_events(run_id):
                    pass
            time.sleep(pause_before(attempt))
        raise AssertionError("unreachable")

    def run(self, run_id: str) -> Run:
        return self._get(path_of("runs", run_id))

    def runs(self, *, page: int = 100, **filters: Parameter) -> Iterator[Run]:
        """The runs, the newest first: `status`, `program`."""
        return self._pages("/v1/runs", "runs", {**filters, "limit": page})

    def run_parameters(self, run_id: str) -> dict[str, Union[Decimal, str]]:
        """Q parameters that are defined at the end."""
        return decimals(self._get(path_of("runs", run_id, "parameters")))

    def run_request(self, run_id: str) -> dict[str, Any]:
        """The order with its setup; given to `run_program` it repeats the run."""
        return self._get(path_of("runs", run_id, "request"))

    def run_file(self, run_id: str, name: str) -> bytes:
        """A file the run has written, by its name or, of several files of that name, by its path."""
        return self._bytes(path_of("runs", run_id, "files", name))

    def trace(self, run_id: str) -> list[dict[str, Any]]:
        """Every move with its block, start, end, feed, time and contact."""
        return self._get(path_of("runs", run_id, "trace"))["moves"]

    def trace_csv(self, run_id: str) -> str:
        return self._bytes(path_of("runs", run_id, "trace"), "text/csv").decode()

    def run_events(self, run_id: str) -> Iterator[Event]:
        """progress, output, and end with the run."""
        return read_events(self._stream(Request("GET", path_of("runs", run_id, "events"),
                                             headers={"Accept": "text/event-stream"}, timeout=SILENCE_S)))

    def cancel_run(self, run_id: str) -> None:
        """Conflict when it was over before."""
        self._perform(Request("DELETE", path_of("runs", run_id), repeatable=False))

    def cycles(self) -> list[dict[str, Any]]:
        """The touch-probe cycles with their parameters and results."""
        return self._get("/v1/cycles")["cycles"]

    def cycle(self, number: int) -> dict[str, Any]:
        return self._get(path_of("cycles", str(number)))
