"""Client of fitgauge: limits and fits, verdicts, measurements and NC programs over its HTTP API.

    from fitgauge import Client

    with Client("http://localhost:8286") as gauge:
        record = gauge.measure({"designation": "25 H7", "measured_mm": "25.0215", "part_id": "SN-1"})
        print(record["verdict"], record["excess_um"])

Answers are the service's JSON objects as dictionaries. Every length, angle, time and Q parameter in
them is a `decimal.Decimal` with all its digits; a binary float is refused before it is sent. What is
refused by the service is a `Problem` with its code; what gets no answer is a `NoAnswer`.

A request that may be sent again is, with growing pauses, or as long as the service says: reading, and
writing under an idempotency key, which is made when none is given. A client may be shared by threads.

The standard library alone: the folder can be copied beside the program that uses it.
"""

from ._control import ControlCalls
from ._errors import (BadRequest, Conflict, FitgaugeError, Forbidden, Invalid, NoAnswer, NotFound, PreconditionFailed,
                      Problem, ProgramInvalid, Unauthorized, Unavailable)
from ._json import Size, Text, dumps, loads
from ._limits import LimitsCalls
from ._log import LogCalls
from ._measurements import MeasurementCalls
from ._service import ServiceCalls
from ._statistics import StatisticsCalls
from ._types import (Accepted, Correction, FeatureWord, FieldError, Fit, Limits, Measurement, NewMeasurement, Note,
                     RuleWord, Run, RunLimits, RunStatus, Verdict, VerdictWord)
from ._values import Event, Parameter, when
from ._version import VERSION as __version__


class Client(LimitsCalls, StatisticsCalls, MeasurementCalls, LogCalls, ControlCalls, ServiceCalls):
    """A service, and connections to it that are kept open. After an error it can be used on."""


__all__ = ["Accepted", "BadRequest", "Client", "Conflict", "Correction", "Event", "FeatureWord", "FieldError", "Fit",
           "FitgaugeError", "Forbidden", "Invalid", "Limits", "Measurement", "NewMeasurement", "NoAnswer", "NotFound", "Note",
           "Parameter", "PreconditionFailed", "Problem", "ProgramInvalid", "RuleWord", "Run", "RunLimits",
           "RunStatus", "Size", "Text", "Unauthorized", "Unavailable", "Verdict", "VerdictWord", "__version__",
           "dumps", "loads", "when"]
