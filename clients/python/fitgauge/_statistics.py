"""Statistics, uncertainty budgets and gauges in use."""

# The service's answers are taken to have the types that its API promises.
# mypy: no-warn-return-any

from __future__ import annotations

from typing import Any, Mapping

from ._json import dumps, loads
from ._transport import Request, Transport, path_of



class StatisticsCalls(Transport):
    """What is computed from the values sent, and what is known of gauges."""

    def press_fit(self, body: Mapping[str, Any]) -> dict[str, Any]:
        """Pressure and stresses of an interference fit (Lame)."""
        return self._compute("/v1/press-fits", body)

    def statistics(self, kind: str, body: Mapping[str, Any]) -> dict[str, Any]:
        """`summary`, `anova`, `capability`, `chart`, `type1`, `grr` or `pairing` of the values sent."""
        return self._compute(path_of("statistics", kind), body)

    def uncertainty(self, body: Mapping[str, Any]) -> dict[str, Any]:
        """The combined and expanded uncertainty of a budget."""
        return self._compute("/v1/uncertainty", body)

    def uncertainties(self) -> list[dict[str, str]]:
        """The stored budgets: `name` and `modified_at`."""
        return self._get("/v1/uncertainties")["uncertainties"]

    def put_uncertainty(self, name: str, budget: Mapping[str, Any]) -> dict[str, Any]:
        """Stores a budget, in micrometres where a gauge uses it, and gives what `uncertainty` gives."""
        return loads(self._put(path_of("uncertainties", name), dumps(budget).encode(), "application/json").body)

    def stored_uncertainty(self, name: str) -> dict[str, Any]:
        """A budget as it was stored."""
        return self._get(path_of("uncertainties", name))

    def delete_uncertainty(self, name: str) -> None:
        self._perform(Request("DELETE", path_of("uncertainties", name), repeatable=True))

    def gauges_in_use(self) -> list[dict[str, str]]:
        """The gauges: `name` and `modified_at`."""
        return self._get("/v1/gauges-in-use")["gauges"]

    def put_gauge_in_use(self, name: str, calibration_due: str, uncertainty: str | None = None) -> bool:
        """Stores until when a gauge is calibrated, and the name of its budget. Gives whether it is new."""
        body = {"calibration_due": calibration_due, **({"uncertainty": uncertainty} if uncertainty else {})}
        return self._put(path_of("gauges-in-use", name), dumps(body).encode(), "application/json").status == 201

    def gauge_in_use(self, name: str) -> dict[str, Any]:
        """A gauge as it was stored."""
        return self._get(path_of("gauges-in-use", name))

    def record_calibration(self, name: str, calibration: Mapping[str, Any]) -> dict[str, Any]:
        """Records a calibration of a gauge: `from`, `due`, `certificate`, `laboratory`, `status` and others."""
        return self._compute(path_of("gauges-in-use", name, "calibrations"), calibration)

    def calibrations(self, name: str) -> list[dict[str, Any]]:
        """The calibrations of a gauge, by their beginnings."""
        return self._get(path_of("gauges-in-use", name, "calibrations"))["calibrations"]

    def studies(self) -> list[dict[str, str]]:
        """The stored gauge studies: `name`, `gauge`, `at`, `kind` and `modified_at`."""
        return self._get("/v1/studies")["studies"]

    def put_study(self, name: str, study: Mapping[str, Any]) -> dict[str, Any]:
        """Stores a study: `gauge`, `at`, `kind` (`grr`, `type1`) and the `input` of `statistics`. Gives it with its `result`."""
        return loads(self._put(path_of("studies", name), dumps(study).encode(), "application/json").body)

    def study(self, name: str) -> dict[str, Any]:
        """A study with its input and its result."""
        return self._get(path_of("studies", name))

    def delete_study(self, name: str) -> None:
        self._perform(Request("DELETE", path_of("studies", name), repeatable=True))

    def delete_gauge_in_use(self, name: str) -> None:
        self._perform(Request("DELETE", path_of("gauges-in-use", name), repeatable=True))
