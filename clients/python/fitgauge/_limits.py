"""Limits, fits, gauges, verdicts and the tables they come from."""

# The service's answers are taken to have the types that its API promises.
# mypy: no-warn-return-any

from __future__ import annotations

from typing import Any, Literal, Mapping, Sequence

from ._json import Size, dumps, loads
from ._transport import Request, Transport, path_of, query_of
from ._types import Fit, Limits, RuleWord, Verdict
from ._values import Parameter



class LimitsCalls(Transport):
    """The standard, and verdicts that are not stored."""

    def limits(self, designation: str, *, revision: str | None = None) -> Limits:
        """Limits of size of `25 H7`, `Ø25H7`, `132,5 a13`; of `M10-6H`, `25 ISO 2768-m`."""
        return self._get(path_of("limits", designation), {"revision": revision})

    def limits_of(self, nominal_mm: Size, tolerance_class: str, *, revision: str | None = None) -> Limits:
        """The same from a size and a class."""
        return self._get("/v1/limits", {"nominal_mm": nominal_mm, "tolerance_class": tolerance_class,
                                        "revision": revision})

    def fit(self, designation: str, *, hole: Mapping[str, Parameter] | None = None,
            shaft: Mapping[str, Parameter] | None = None, subgroups: Literal["use", "ignore"] | None = None,
            revision: str | None = None) -> Fit:
        """The fit `25 H7/g6`. With filters of stored holes and shafts, `hole={"characteristic": "bore"}`, also how
        likely those interfere: `statistical.stored`."""
        chosen = {f"{side}_{name}": value for side, filters in (("hole", hole), ("shaft", shaft))
                  for name, value in (filters or {}).items()}
        return self._get(path_of("fits", designation), {**chosen, "subgroups": subgroups, "revision": revision})

    def fits(self, nominal_mm: Size, *, min_clearance_um: Size | None = None, max_clearance_um: Size | None = None,
             limit: int | None = None) -> dict[str, Any]:
        """The fits of a size whose clearances lie within bounds (interference is negative), the preferred first."""
        return self._get("/v1/fits", {"nominal_mm": nominal_mm, "min_clearance_um": min_clearance_um,
                                      "max_clearance_um": max_clearance_um, "limit": limit})

    def limit_gauges(self, designation: str) -> dict[str, Any]:
        """The sizes of the GO and the NO-GO gauge of `25 H7`."""
        return self._get(path_of("gauges", designation))

    def standards(self) -> list[dict[str, Any]]:
        """The standards beside ISO 286 that there are numbers of."""
        return self._get("/v1/standards")["standards"]

    def standard(self, name: str, *, size_mm: Size | None = None, table: str | None = None) -> dict[str, Any]:
        """The numbers of `iso2768-1`, `iso965-1`, `din6885-1` or `iso492`, all or those that hold for a size."""
        return self._get(path_of("standards", name), {"size_mm": size_mm, "table": table})

    def verdict(self, designation: str, measured_mm: Size, *, rule: RuleWord | None = None,
                uncertainty_um: Size | None = None, coverage_factor: Size | None = None,
                probability: Size | None = None, revision: str | None = None, **temperatures: Parameter) -> Verdict:
        """Judges a value, by an older `revision` of the tables on request, and stores nothing. `rule` is simple, or guard_band or conformance, which need
        `uncertainty_um`. `temperatures` correct to 20 degrees: `temperature_c` with `part_material`, say."""
        return self._get(path_of("verdicts", designation), {
            "measured_mm": measured_mm, "rule": rule, "uncertainty_um": uncertainty_um,
            "coverage_factor": coverage_factor, "probability": probability, "revision": revision, **temperatures})

    def tables(self) -> dict[str, Any]:
        """The revision in use, and the classes of the hole and the shaft table."""
        return self._get("/v1/tables")

    def table(self, feature: str, classes: Sequence[str] = (), revision: str | None = None) -> list[dict[str, Any]]:
        """The rows of the `hole` or `shaft` table: `over_mm`, `up_to_mm` and `limits` by class."""
        return self._get(path_of("tables", feature), {
            "classes": ",".join(classes) or None, "revision": revision})["rows"]

    def table_csv(self, feature: str, classes: Sequence[str] = (), revision: str | None = None) -> str:
        """The same as CSV."""
        query = query_of({"classes": ",".join(classes) or None, "revision": revision})
        return self._bytes(path_of("tables", feature) + query, "text/csv").decode()

    def table_tab(self, feature: str) -> str:
        """The same as the control's freely definable table, for program 8255."""
        return self._bytes(path_of("tables", f"{feature}.tab")).decode()

    def put_column(self, feature: str, name: str, rows: Sequence[Mapping[str, Size]],
                   revision: str | None = None) -> str:
        """Stores a custom tolerance class: rows of `over_mm`, `up_to_mm`, `upper_um`, `lower_um`. Gives
        the new revision. PreconditionFailed when `revision` is given and no longer in use."""
        answer = self._put(path_of("tables", feature, "classes", name), dumps({"rows": rows}).encode(),
                           "application/json", revision)
        return loads(answer.body)["revision"]

    def delete_column(self, feature: str, name: str, revision: str | None = None) -> None:
        """Back to the standard's class."""
        headers = {"If-Match": f'"{revision}"'} if revision else {}
        self._perform(Request("DELETE", path_of("tables", feature, "classes", name), headers=headers,
                               repeatable=not revision))
