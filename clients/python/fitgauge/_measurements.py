"""Measurements: stored, listed, summed up and corrected."""

# The service's answers are taken to have the types that its API promises.
# mypy: no-warn-return-any

from __future__ import annotations

import time
import uuid
from typing import Any, Callable, Iterable, Iterator, Mapping, Sequence

from ._errors import NoAnswer, Problem, Unavailable
from ._json import Size, dumps
from ._streams import Batch, counted_over_all, csv_records, cut_batches, read_events, total_of
from ._transport import Request, Transport, path_of, pause_before, query_of
from ._types import Accepted, Correction, Measurement, NewMeasurement, Note, Part
from ._values import Event, Parameter

SILENCE_S = 45.0  # a stream of events has a sign of life every 15 s



class MeasurementCalls(Transport):
    """Measured values and their figures."""

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
        return self._post_batches(cut_batches(records, "", rows), "application/x-ndjson", idempotency_key, progress)

    def measure_csv(self, lines: Iterable[str], *, idempotency_key: str | None = None, rows: int = 5_000,
                    progress: Callable[[Accepted], object] | None = None) -> Accepted:
        """The same from the lines of CSV, the header line first: an open file, say."""
        if isinstance(lines, (str, bytes)):
            raise TypeError("measure_csv takes lines: an open file, io.StringIO(text), or a list of lines")
        records = csv_records(lines)
        return self._post_batches(cut_batches(records, next(records, ""), rows), "text/csv", idempotency_key, progress)

    def _post_batches(self, batches: Iterable[Batch], kind: str, key: str | None,
                      progress: Callable[[Accepted], object] | None) -> Accepted:
        key = key or str(uuid.uuid4())
        total: Accepted | None = None
        for batch in batches:
            try:
                total = total_of(total, self._post("/v1/measurements", batch.body, kind, f"{key}/{batch.rows}"))
            except Problem as problem:
                raise counted_over_all(problem, batch) from None
            if progress:
                progress(total)
        assert total is not None  # there is always a first batch
        return total

    def measurement(self, measurement_id: str) -> Measurement:
        """One record."""
        return self._get(path_of("measurements", measurement_id))

    def measurements(self, *, page: int = 1_000, **filters: Parameter) -> Iterator[Measurement]:
        """Records in storage order, `page` a request: `part_id`, `characteristic`, `order`, `machine`,
        `verdict`, `source`, `from_`, `to`, `history`."""
        return self._pages("/v1/measurements", "measurements", {**filters, "limit": page})

    def export(self, form: str = "csv", **filters: Parameter) -> Iterator[bytes]:
        """All records that match as `csv`, `ndjson`, `qif`, `dfq` of Q-DAS or `xlsx` (these take `time_zone`, a dfq
        `part_number` and `part_description`), in pieces of one answer. Close it to stop early."""
        return self._stream(Request("GET", "/v1/measurements" + query_of({"format": form, **filters})))

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

    def compensation(self, *, target_mm: Size | None = None, cost: Size | None = None,
                     **filters: Parameter) -> dict[str, Any]:
        """The next offset of a machine, from the newest values: `state`, `offset_um`, `interval_um`, `next_in_parts`."""
        return self._get("/v1/measurements/compensation", {"target_mm": target_mm, "cost": cost, **filters})

    def correct(self, measurement_id: str, correction: Correction, *,
                idempotency_key: str | None = None) -> Measurement:
        """A new record in place of a wrong one, which stays: `measured_mm`, `reason`, and what else changes."""
        return self._post(path_of("measurements", measurement_id, "corrections"),
                                         dumps(correction).encode(), "application/json", idempotency_key)

    def note(self, measurement_id: str, *, cause: str | None = None, measure: str | None = None,
             text: str | None = None, operator: str | None = None, idempotency_key: str | None = None) -> Note:
        """Adds a note beside a record, which stays as it is: why the value is what it is, what was done, whatever else."""
        said = {"cause": cause, "measure": measure, "text": text, "operator": operator}
        given = {name: value for name, value in said.items() if value is not None}
        return self._post(path_of("measurements", measurement_id, "notes"), dumps(given).encode(), "application/json",
                          idempotency_key)

    def notes(self, measurement_id: str) -> list[Note]:
        """The notes beside a record, oldest first."""
        return self._get(path_of("measurements", measurement_id, "notes"))["notes"]

    def part(self, part_id: str, *, plan: str | None = None) -> Part:
        """The verdict of a part by its plan, what is `missing`, its `characteristics` and `open_reactions`."""
        return self._get(path_of("parts", part_id), {"plan": plan})

    def certificate(self, *, order: str | None = None, part_id: str | None = None, **options: Parameter) -> bytes:
        """The inspection certificate of an order, a part or both, as PDF. `options` are `title`, `company`,
        `customer`, `paper` (a4, letter) and the filters of measurements."""
        query = query_of({"order": order, "part_id": part_id, **options})
        return self._bytes("/v1/certificates" + query, "application/pdf")

    def events(self, last_event_id: str | None = None, source: str | None = None) -> Iterator[Event]:
        """What happens, for ever: measurement.recorded, verdict.reject, run.finished,
        table.changed, note.added. When the connection
        breaks it is made again, and goes on after the last event, or after `last_event_id` to begin with.
        `resync` says that events are gone: read the lists again."""
        last, stood = last_event_id, False
        while True:
            headers = {"Accept": "text/event-stream", **({"Last-Event-ID": last} if last else {})}
            request = Request("GET", "/v1/events" + query_of({"source": source}), headers=headers, timeout=SILENCE_S)
            try:
                for event in read_events(self._stream(request)):
                    last, stood = event.id or last, True
                    if event.data is not None:
                        yield event
            except (NoAnswer, Unavailable):
                if not stood:
                    raise
            time.sleep(pause_before(3))
