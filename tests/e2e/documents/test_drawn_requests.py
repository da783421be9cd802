"""Requests drawn from the schemas of /openapi.json: no answer but what the contract says."""

import http.client
import json
import os
import unittest
import urllib.parse

from support.contract import Drawing, spoil
from support.contract_test import SETUP, ContractTest
from support.daemon import Answer

HINTS = {
    "designation": ["25H7", "25 g6", "10,5 h6", "3150 H7", "0.5 t6", "7H"], "hole": ["25H7", "H7"],
    "shaft": ["g6", "s6", "H7"], "fit": ["25H7/g6", "25H7"], "tolerance_class": ["H7", "js6", "H19"],
    "nominal_mm": [25, "25", 10.5, 3151], "measured_mm": [25.01, "25.013"], "name": ["H7", "g6x", "SHOP", "m3"],
    "id": ["m1", "m2", "r1", "m999999", "x"], "number": [421, 400, 9999], "path": ["nc_prog/hole.h", "nc_prog/no.h", "a b.h"],
    "program": ["TNC:\\nc_prog\\hole.h", "TNC:\\nc_prog\\no.h"], "setup": ["m3", SETUP], "action": ["check"],
    "part": ["4711-A", "no plan"],
    "If-Match": ['"x"', "*"], "Idempotency-Key": ["k1", "k2"], "Prefer": ["return=minimal", "respond-async"],
    "seconds": [1], "after": ["m1", "x"], "revision": ["1-x"]}
ENDLESS = {"followEvents", "followRun"}
STREAMS = {"interval"}  # parameters that make an answer endless


class Drawn(ContractTest):
    """Requests drawn from the schemas, every second one spoiled: no answer but what the contract says.

    DRAWN_REQUESTS is how many for each operation, DRAWN_SEED which."""

    def test_a_path_that_is_cut_in_a_message_stays_utf_8(self):
        for path in ("/v1/files/", "/v1/runs/", "/v1/measurements/", "/v1/setups/"):
            answer = self.daemon.get(path + "a" + "%C3%B8" * 300)
            self.assertIn(answer.json["code"], ("file.path_invalid", "run.unknown", "measurement.unknown", "setup.unknown",
                                                "path.malformed"), answer)
        answer = self.daemon.post("/v1/measurements", {}, {"Origin": "http://a" + "\xc3\xb8" * 150})
        self.assertEqual(answer.json["code"], "origin.refused")

    def test_no_request_is_answered_but_as_documented(self):
        count = int(os.environ.get("DRAWN_REQUESTS", "10"))
        seed = int(os.environ.get("DRAWN_SEED", "1"))
        drawing = Drawing(self.contract, seed, HINTS)
        connection = self.daemon.connect()
        self.addCleanup(connection.close)
        statuses = set()
        for path, method, operation in self.contract.operations():
            if operation["operationId"] in ENDLESS:
                continue
            for number in range(count):
                spoiled = number % 2 == 1
                request, body = self.draw(drawing, path, method, operation, spoiled)
                with self.subTest(operation["operationId"], seed=seed, number=number):
                    answer = self.send(connection, *request)
                    statuses.add(answer.status)
                    self.assertIsNone(self.contract.check(operation, answer), f"{request} {answer}")
                    if answer.status == 422 and not spoiled and body is not None:
                        codes = {entry["code"] for entry in answer.json.get("errors", [])}
                        self.assertFalse(codes & {"field.unknown", "field.type", "field.too_long"},
                                         f"the schema allows what is refused: {request} {answer}")
        self.assertLessEqual({200, 201, 204, 400, 404, 422}, statuses)

    def draw(self, drawing, path, method, operation, spoiled):
        chance = drawing.random
        query, headers = {}, {}
        for parameter in operation.get("parameters", []):
            name = parameter["name"]
            if name in STREAMS or not parameter["required"] and chance.random() < 0.6:
                continue
            value = drawing.value(parameter["schema"], name)
            if spoiled and chance.random() < 0.2:
                value = chance.choice(["", "x", "-1", "%", "ø" * 300, "1e9", "25,5"])
            if parameter["in"] == "path":
                path = path.replace("{" + name + "}", urllib.parse.quote(str(value) or "x", safe=""))
            elif parameter["in"] == "query":
                query[name] = value
            else:
                headers[name] = str(value)
        if spoiled and chance.random() < 0.1:
            query["no_such"] = "1"
        if query:
            path += "?" + urllib.parse.urlencode(query)
        content = operation.get("requestBody", {}).get("content", {})
        body = None
        if "application/json" in content:
            body = drawing.value(content["application/json"]["schema"])
            if spoiled:
                body = spoil(body, chance)
            headers["Content-Type"] = "application/json"
            if spoiled and chance.random() < 0.1:
                headers["Content-Type"] = "text/plain"
        elif content:
            body = drawing.value({"type": "string"})
        return (method.upper(), path, body, headers), body

    def send(self, connection, method, path, body, headers):
        data = None if body is None else body.encode() if isinstance(body, str) and "Content-Type" not in headers \
            else json.dumps(body).encode()
        try:
            connection.request(method, path, data, {k: v.encode("utf-8") for k, v in headers.items()})
            answer = Answer(connection.getresponse())
        except (http.client.HTTPException, OSError) as error:
            raise AssertionError(f"{method} {path}: {error!r}") from error
        return answer


if __name__ == "__main__":
    unittest.main()
