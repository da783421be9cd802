"""A service with a program and a setup, and its contract."""

import urllib.parse

from support.contract import Contract
from support.daemon import DaemonTest

PROGRAM = b"""BEGIN PGM HOLE MM
TOOL CALL 30 Z
L Z+50 R0 FMAX
TCH PROBE 421 MEASURE HOLE ~
Q273=+50 ~
Q274=+40 ~
Q262=25 ~
Q325=+0 ~
Q247=+90 ~
Q261=-5 ~
Q320=0 ~
Q260=+20 ~
Q301=0 ~
Q275=25.021 ~
Q276=25 ~
Q279=0 ~
Q280=0 ~
Q281=1 ~
Q309=0 ~
Q330=0 ~
Q423=4 ~
Q365=1
FN 16: F-PRINT TNC:\\nc_prog\\m.a / SCREEN:
END PGM HOLE MM
"""
SETUP = {"machine": {"axes": {"C": {"on": "table"}}}, "workpiece": {"features": [
    {"type": "block", "min_mm": [0, 0, -40], "max_mm": [100, 80, 0]},
    {"type": "bore", "center_mm": [50, 40], "diameter_mm": 25.013}]}}


class ContractTest(DaemonTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.contract = Contract(cls.daemon.get("/openapi.json").json)
        cls.daemon.request("PUT", "/v1/files/nc_prog/hole.h", PROGRAM)
        cls.daemon.request("PUT", "/v1/files/nc_prog/m.a", b'"DONE";\n')
        cls.daemon.request("PUT", "/v1/setups/m3", SETUP)

    def expect(self, operation_id, status, body=None, headers=None, **arguments):
        """One call of an operation; its answer is as the contract says."""
        path, method, operation = self.contract.operation(operation_id)
        query = {}
        for key, value in arguments.items():
            if "{" + key + "}" in path:
                path = path.replace("{" + key + "}", urllib.parse.quote(str(value), safe="/"))
            else:
                query[key] = value
        path += "?" + urllib.parse.urlencode(query) if query else ""
        answer = self.daemon.request(method.upper(), path, body, headers)
        self.assertEqual(answer.status, status, f"{operation_id}: {answer}")
        self.assertIsNone(self.contract.check(operation, answer), f"{operation_id}: {answer}")
        if status < 300:
            self.succeeded.add(operation_id)
        if method == "get" and "etag" in answer.headers:
            kept = self.daemon.get(path, **{**(headers or {}), "If-None-Match": answer.headers["etag"]})
            self.assertEqual(kept.status, 304, operation_id)
            self.assertIsNone(self.contract.check(operation, kept), f"{operation_id}: {kept}")
        return answer
