"""A bound of /openapi.json is the service's own: what lies on it is accepted, what lies beyond it is refused, at its
place, and every example is accepted."""

import base64
import copy
import json
import pathlib
import shutil
import tempfile
import unittest
import urllib.parse

from support.contract import Contract, choices_of
from support.daemon import DaemonTest

PROGRAM = b"BEGIN PGM P MM\nQ1 = 1\nEND PGM P MM\n"
SETUP = {"machine": {"tools": [{"number": 5, "teeth": 2, "probe": 1, "radius_mm": 2, "length_mm": 80}],
                     "probes": [{"number": 1}], "presets": [{"number": 1}], "active_preset": 1}, "seed": 1,
         "workpiece": {"features": [{"type": "bore", "center_mm": [0, 0], "diameter_mm": 10, "lobes": 3}]}}
PATHS = {"name": "m3", "part": "4711-A", "id": None}  # id: of a measurement that is stored for the purpose
NAMES = {"putHoleTableColumn": "SHOP", "putShaftTableColumn": "shop", "replayConnection": "hook"}
CHART = {"kind": "i_mr", "values": [1, 2, 3, 4, 6]}
READINGS = [{"part": part, "operator": by, "trial": trial, "value": value} for part, by, trial, value in (
    (1, "a", 1, 1), (1, "a", 2, 1.1), (1, "b", 1, 1.2), (1, "b", 2, 1.1),
    (2, "a", 1, 2), (2, "a", 2, 2.1), (2, "b", 1, 2.2), (2, "b", 2, 2.4))]
CONTRIBUTION = {"name": "a", "standard_uncertainty": 1}
FOLDERS = tempfile.mkdtemp(prefix="fitgauge-bounds-")
FOLLOWER = {"filter": {"machine": "m", "verdict": ["good"], "source": "gauge"}, "start": "now", "longest_wait_s": 5}
# Bodies that are accepted, by operation and schema; together they have every member that bounds something.
BODIES = {
    "computeSummary": [{"values": [1, 2, 4]}],
    "analyseVariance": [{"groups": [[1, 2], [2, 4]]}],
    "assessCapability": [{"values": [1, 2, 3, 4, 6], "lower": 0, "upper": 9, "target": 4, "confidence": 0.9},
                         {"subgroups": [[1, 2], [2, 4], [1, 3]], "lower": 0}],
    "makeControlChart": [{**CHART, "rules": [1], "phase1": {"from": 0, "to": 5}},
                         {"kind": "ewma", "values": [1, 2, 3, 4, 6], "lambda": 0.2, "centre": 3, "standard_deviation": 1},
                         {"kind": "cusum", "values": [1, 2, 3, 4, 6], "reference_value": 0.5, "decision_interval": 5},
                         {"kind": "xbar_r", "subgroups": [[1, 2], [2, 4], [1, 3]]}],
    "studyGaugeOnMaster": [{"values": [1, 2, 4], "reference": 2, "tolerance": 1}],
    "studyGauge": [{"method": "anova", "model": "auto", "tolerance": 1, "measurements": READINGS},
                   {"method": "linearity", "model": "auto", "tolerance": 1, "measurements": [
                       {"reference": at, "value": value} for at, value in ((1, 1), (2, 2.1), (3, 3.3), (4, 4.1))]},
                   {"method": "stability", "model": "auto", "tolerance": 1, "measurements": [
                       {"at": at, "value": value} for at, value in ((1, 1), (2, 2.1), (3, 1.3), (4, 1.1))]}],
    "pairParts": [{"holes": [1, 2], "shafts": [1, 2], "target_clearance_um": 0},
                  {"holes_mm": [1, 2], "shafts_mm": [1, 2], "target_clearance_um": 0}],
    "combineUncertainties": [
        {"contributions": [{**CONTRIBUTION, "sensitivity": 1, "degrees_of_freedom": 5, "distribution": "normal"},
                           {"name": "b", "half_width": 1, "distribution": "rectangular"}],
         "correlations": [{"between": ["a", "b"], "coefficient": 0}], "probability": 0.9},
        {"contributions": [CONTRIBUTION], "monte_carlo": {"trials": 1000, "seed": 1}}],
    "putGaugeInUse": [{"calibration_due": "2036-03-31", "comment": "c"}],
    "recordCalibration": [{"from": "2026-03-31", "due": "2027-03-31", "certificate": "c", "laboratory": "l", "comment": "c"}],
    "computePressFit": [{"joint_diameter_mm": 40, "length_mm": 30, "friction": 0.1,
                         "hub": {"outer_diameter_mm": 80, "youngs_modulus_mpa": 2e5, "poisson_ratio": 0.3, "rz_um": 1},
                         "shaft": {"inner_diameter_mm": 0, "youngs_modulus_mpa": 2e5, "poisson_ratio": 0.3, "rz_um": 1},
                         "min_interference_um": 0, "max_interference_um": 50}],
    "postMeasurements": [{"measured_mm": 25.01, "designation": "25 H7", "characteristic": "c"},
                         [{"measured_mm": 25.01, "designation": "25 H7", "characteristic": "c"}]],
    "correctMeasurement": [{"measured_mm": 25.01, "reason": "r"}],
    "addNote": [{"cause": "c", "measure": "m"}],
    "putCatalogue": [{"causes": ["a"], "measures": ["b"]}],
    "putPlan": [{"characteristics": [{"name": "a", "designation": "25 H7", "subgroup_size": 5, "gauge": "g", "rule": "simple",
                                      "frequency": "each", "reaction": "r", "catalogue": "c", "picture": "p"}]},
                {"characteristics": [{"name": "a", "nominal_mm": 8, "feature": "hole", "upper_um": 36, "lower_um": 0}]}],
    "putHoleTableColumn": [{"rows": [{"over_mm": 18, "up_to_mm": 30, "upper_um": 15, "lower_um": -3}]}],
    "putShaftTableColumn": [{"rows": [{"over_mm": 18, "up_to_mm": 30, "upper_um": 15, "lower_um": -3}]}],
    "putSetup": [SETUP],
    "postRun": [{"program": "TNC:\\nc_prog\\p.h", "limits": {"blocks": 10, "seconds": 5}}],
    "putConnection": [
        {"kind": "lsv2", "address": "127.0.0.1:1", "paths": ["TNC:\\logs\\*.TXT"], "machine": "m", "interval_s": 60},
        {"kind": "webhook", "url": "http://127.0.0.1:1/x", "timeout_s": 1, **FOLLOWER, "events": ["note.added"],
         "headers": {"X-Plant": "p"}, "body": {"text": "{{id}}"},
         "secrets": ["whsec_" + base64.b64encode(b"k" * 32).decode()]},
        {"kind": "mqtt", "broker": "mqtt://127.0.0.1:1", "user": "u", "password": "p", "client_id": "c", "topic": "a/{machine}",
         "version": "5", "status_topic": "s", "events_topic": "e", **FOLLOWER},
        {"kind": "sparkplug", "broker": "mqtt://127.0.0.1:1", "group": "g", "node": "n", "device": "{machine}",
         "primary_host": "h", "most_devices": 5, **FOLLOWER},
        {"kind": "folder_in", "folder": f"{FOLDERS}/in", "names": ["*.fitgauge-none"], "map": {"A": "measured_mm"}, "set": {"machine": "m"},
         "time_zone": "UTC", "encoding": "auto", "other_columns": "refuse", "interval_s": 3600, "rest_s": 2},
        {"kind": "folder_out", "folder": f"{FOLDERS}/out", "format": "csv", "part_number": "p", "part_description": "d",
         "split": "none", "every_s": 60, "time_zone": "UTC", **FOLLOWER}],
}
BODIES["putStudy"] = [{"gauge": "m3", "at": "2026-03-31", "kind": "type1", "comment": "c", "input": BODIES["studyGaugeOnMaster"][0]}]
BODIES["replayConnection"] = [{"from": "2026-11-20T08:00:00Z"}]
BODIES["putUncertainty"] = BODIES["combineUncertainties"]
# Members that are held together: the first is at most the second.
TOGETHER = {"min_interference_um": "max_interference_um"}
# Members whose greatest value takes long to compute: all faults of a body are told at once, so it has another.
COSTLY = {"trials"}
# Codes of members that are good and do not go together with the others.
NOT_OF_A_BOUND = {"field.conflict", "field.missing"}


def tearDownModule():
    shutil.rmtree(FOLDERS, ignore_errors=True)


class Bounds(DaemonTest):
    flags = ("--connection-folders", FOLDERS)

    @classmethod
    def setUpClass(cls):
        for name in ("in", "out"):
            pathlib.Path(FOLDERS, name).mkdir(exist_ok=True)
        super().setUpClass()
        cls.contract = Contract(cls.daemon.get("/openapi.json").json)
        for name in ("p", "8255/8255"):
            cls.daemon.request("PUT", f"/v1/files/nc_prog/{name}.h", PROGRAM)
        cls.daemon.request("PUT", "/v1/setups/m3", SETUP)
        for name in ("m3", "G-07"):  # of studies
            cls.daemon.request("PUT", f"/v1/gauges-in-use/{name}", {"calibration_due": "2036-03-31"})
        cls.daemon.request("PUT", "/v1/connections/hook", next(each for each in BODIES["putConnection"] if each["kind"] == "webhook"))
        stored = cls.daemon.measure({"designation": "25 H7", "measured_mm": 25.01})
        PATHS["id"] = stored.json["id"]

    def operations(self):
        for path, method, operation in self.contract.operations():
            content = operation.get("requestBody", {}).get("content", {}).get("application/json")
            if content:
                operation_id = operation["operationId"]
                for name, value in {**PATHS, "name": NAMES.get(operation_id, PATHS["name"])}.items():
                    path = path.replace("{" + name + "}", urllib.parse.quote(value))
                yield operation_id, method.upper(), path, content["schema"]

    def errors(self, method, path, body):
        """The refusals of a body: pairs of pointer and code."""
        answer = self.daemon.request(method, path, body)
        if answer.status != 422:
            return []
        problem = answer.json
        return [(error["pointer"], error["code"]) for error in problem.get("errors", [])] or [("", problem["code"])]

    def test_every_operation_with_a_body_is_tried(self):
        self.assertEqual({name for name, *_ in self.operations()}, set(BODIES))

    def test_every_example_is_accepted(self):
        for name, method, path, schema in self.operations():
            for body in BODIES[name]:
                for example in self.examples(schema, body):
                    example = json.loads(json.dumps(example).replace("/srv/measurements", f"{FOLDERS}/in"))
                    with self.subTest(name, example=example):
                        answer = self.daemon.request(method, path, example)
                        # A record is corrected once.
                        self.assertTrue(answer.status < 400 or (name, answer.status) == ("correctMeasurement", 409), answer)

    def examples(self, schema, body, at=()):
        """The body with each example of its schema, or of one that its schema names, in its place."""
        schema, value = self.contract.resolve(schema), body
        for token in at:
            value = value[token]
        for choice in (schema, *choices_of(schema)):
            choice = self.contract.resolve(choice)
            for example in choice.get("examples", []):
                yield replaced(body, at, example)
            if not self.fits(choice, value):
                continue
            if isinstance(value, dict):
                for name, member in choice.get("properties", {}).items():
                    if name in value and name != "input":  # of a study: another kind has another input
                        yield from self.examples(member, body, (*at, name))
            elif isinstance(value, list) and value:
                yield from self.examples(choice["items"], body, (*at, 0))

    def test_bounds(self):
        for name, method, path, schema in self.operations():
            for body in BODIES[name]:
                with self.subTest(name, body=body):
                    refused = [e for e in self.errors(method, path, body)]
                    self.assertEqual(refused, [])
                for at, place in self.places(schema, body):
                    self.hold(name, method, path, body, at, place)

    def places(self, schema, value, at=()):
        """The places of a body with their schemas; of a union the alternative that names what the body has."""
        schema = self.contract.resolve(schema)
        for choice in choices_of(schema):
            choice = self.contract.resolve(choice)
            if self.fits(choice, value):
                return self.places(choice, value, at)
        found = [(at, schema)]
        if isinstance(value, dict):
            for name, member in schema.get("properties", {}).items():
                if name in value:
                    found += self.places(member, value[name], (*at, name))
        elif isinstance(value, list) and value:
            found += self.places(schema["items"], value[0], (*at, 0))
        return found

    def fits(self, schema, value):
        if not isinstance(value, dict):
            return schema.get("type") == ("array" if isinstance(value, list) else "string")
        properties = schema.get("properties", {})
        words = [(name, self.contract.resolve(member)) for name, member in properties.items() if name in value]
        return set(value) <= set(properties) and all(
            value[name] in member.get("enum", [member.get("const", value[name])]) for name, member in words)

    def hold(self, name, method, path, body, at, schema):
        pointer = "".join(f"/{token}" for token in at)
        if at and at[-1] in COSTLY:
            body = {**body, "no such member": 1}
        for bound, good, bad in self.edges(schema, at, body):
            with self.subTest(name, pointer=pointer, bound=bound):
                for value in good:
                    refused = self.errors(method, path, replaced(body, at, value))
                    about = [e for e in refused if e[0] == pointer and e[1] not in NOT_OF_A_BOUND]
                    if bound == "maxLength":
                        about = [e for e in about if e[1] == "field.too_long"]
                    self.assertEqual(about, [], f"{str(value)[:60]} is refused")
                for value in bad:
                    refused = self.errors(method, path, replaced(body, at, value))
                    of_list = pointer.rsplit("/", 1)[0] if at and isinstance(at[-1], int) else pointer
                    self.assertTrue(any(where.startswith(pointer) or where == of_list for where, _ in refused),
                                    f"{str(value)[:60]} is accepted: {refused}")

    def edges(self, schema, at, body):
        """Of each bound: values that are accepted and values that are not."""
        least = 1 if schema.get("type") == "integer" else 1e-7
        for bound, sign in (("minimum", -1), ("maximum", 1)):
            if bound in schema:
                edge = schema[bound]
                step = max(least, abs(edge) * 1e-7) if least < 1 else 1
                beyond = [edge + sign * step] if abs(edge) < 2**53 else []
                yield bound, [edge], beyond
        for bound, sign in (("exclusiveMinimum", 1), ("exclusiveMaximum", -1)):
            if bound in schema:
                edge = schema[bound]
                yield bound, [edge + sign * 1e-7], [edge]
        if "maxLength" in schema:
            scheme = "mqtt://" if at[-1] == "broker" else ""
            yield "maxLength", *([(scheme + "x" * n)[:n]] for n in (schema["maxLength"], schema["maxLength"] + 1))
        if "enum" in schema:
            yield "enum", schema["enum"], ["no such word"]
        if "pattern" in schema:
            yield "pattern", [], ["1e1", "1.", ".1", " 1", "1,5", "x", ""]
        value = body
        for token in at:
            value = value[token]
        if isinstance(value, list) and value:
            distinct = lambda n: (value + [value[-1]] * n)[:n]
            if schema.get("minItems"):
                yield "minItems", [], [distinct(schema["minItems"] - 1)]
            if "maxItems" in schema:
                yield "maxItems", [], [distinct(schema["maxItems"] + 1)]
        if isinstance(value, dict):
            if schema.get("additionalProperties") is False:
                yield "additionalProperties", [], [{**value, "no such member": 1}]
            for name in schema.get("required", []):
                yield f"required {name}", [], [{key: value[key] for key in value if key != name}]


def replaced(body, at, value):
    """A copy of a body with another value at a place."""
    if not at:
        return value
    body = copy.deepcopy(body)
    node = body
    for token in at[:-1]:
        node = node[token]
    node[at[-1]] = value
    if at[-1] in TOGETHER:
        node[TOGETHER[at[-1]]] = value
    return body


if __name__ == "__main__":
    unittest.main()
