"""MTConnect: the documents of a small agent over the log, read by the XML parser of Python and held against the
schemas where MTCONNECT_SCHEMAS names their folder."""

import os
import pathlib
import subprocess
import unittest
import xml.etree.ElementTree as tree

from support.daemon import DaemonTest

SCHEMAS = os.environ.get("MTCONNECT_SCHEMAS")
VERDICTS = {"good": "PASS", "rework": "REWORK", "reject": "FAIL", "indeterminate": "INDETERMINATE"}


class Agent(DaemonTest):
    def read(self, path, status=200):
        answer = self.daemon.get("/mtconnect/" + path)
        self.assertEqual(answer.status, status, answer)
        self.assertEqual(answer.headers["content-type"], "text/xml")
        root = tree.fromstring(answer.body)
        kind = root.tag.split("}")[1].removeprefix("MTConnect")
        self.assertEqual(root.tag, f"{{urn:mtconnect.org:MTConnect{kind}:2.4}}MTConnect{kind}")
        if SCHEMAS:
            schema = pathlib.Path(SCHEMAS) / f"MTConnect{kind}_2.4_1.0.xsd"
            done = subprocess.run(["xmllint", "--noout", "--nonet", "--schema", schema, "-"], input=answer.body,
                                  capture_output=True, check=False)
            self.assertEqual(done.returncode, 0, done.stderr.decode() + answer.text)
        for element in root.iter():
            element.tag = element.tag.split("}")[1]
        return root

    def header(self, root):
        return {name: int(value) for name, value in root.find("Header").attrib.items() if name.endswith("Sequence")}

    def features(self, root):
        return [(int(each.get("sequence")), each.find("Entry").get("key"),
                 {cell.get("key"): cell.text for cell in each.iter("Cell")}) for each in root.iter("FeatureMeasurementTable")
                if each.find("Entry") is not None]

    def test_the_log_as_an_agent_tells_it(self):
        self.assertEqual(self.header(self.read("current")), {"firstSequence": 1, "lastSequence": 1, "nextSequence": 2})
        self.assertEqual(self.features(self.read("current")), [])
        self.assertEqual(self.header(self.read("sample"))["nextSequence"], 2)
        items = {item.get("id"): item for item in self.read("probe").iter("DataItem")}
        self.assertEqual(items["feature"].get("type"), "FEATURE_MEASUREMENT")
        rows = [{"designation": "25 H7", "measured_mm": measured, "part_id": f"P<{number}>&", "characteristic": f"bore A{number}",
                 "rule": "guard_band", "uncertainty_um": 2}
                for number, measured in enumerate(("25.0101", "24.99", "25.05", "25.021"))]
        answer = self.daemon.measure(rows, {"Prefer": "return=representation"})
        stored = answer.json["measurements"]
        self.assertEqual([record["verdict"] for record in stored], list(VERDICTS))
        root = self.read("sample")
        self.assertEqual(self.header(root), {"firstSequence": 1, "lastSequence": 9, "nextSequence": 10})
        self.assertEqual([part.text for part in root.iter("PartId")], [row["part_id"] for row in rows])
        self.assertEqual(self.features(root), [
            (2 * number + 3, f"bore_A{number}", {
                "MEASUREMENT_TYPE": "DIAMETER", "MEASUREMENT_UNITS": "MILLIMETER", "MEASUREMENT_VALUE": row["measured_mm"],
                "CHARACTERISTIC_STATUS": VERDICTS[record["verdict"]], "UNCERTAINTY": "0.002", "UNCERTAINTY_TYPE": "COMBINED"})
            for number, (row, record) in enumerate(zip(rows, stored))])
        sequences = [int(each.get("sequence")) for each in root.iter() if each.get("dataItemId")]
        self.assertEqual(sequences, list(range(1, 10)))
        # Page by page, from any sequence on, each observation comes once.
        for count in (2, 3, 5):
            at, seen = 1, []
            while at < 10:
                root = self.read(f"sample?from={at}&count={count}")
                seen += [int(each.get("sequence")) for each in root.iter() if each.get("dataItemId")]
                self.assertGreater(self.header(root)["nextSequence"], at)
                at = self.header(root)["nextSequence"]
            self.assertEqual(seen, list(range(1, 10)), count)
        self.assertEqual(self.features(self.read("sample?from=10")), [])
        self.assertEqual(self.read("sample?from=11", 404).find("Errors/Error").get("errorCode"), "OUT_OF_RANGE")
        root = self.read("current")
        self.assertEqual(self.features(root)[0][0], 9)
        self.assertEqual({count.get("subType"): count.text for count in root.iter("PartCount")},
                         {"ALL": "4", "GOOD": "1", "BAD": "1", "x:REWORK": "1", "x:INDETERMINATE": "1"})
        for query in ("sample?from=0", "sample?count=1", "sample?interval=100"):
            self.assertEqual(self.daemon.get("/mtconnect/" + query).status, 400)


if __name__ == "__main__":
    unittest.main()
