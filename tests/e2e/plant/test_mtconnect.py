"""MTConnect: the documents of a small agent over the log, read by the XML parser of Python and held against the
schemas where MTCONNECT_SCHEMAS names their folder."""

import os
import pathlib
import subprocess
import types
import unittest
import urllib.parse
import xml.etree.ElementTree as tree

from support.daemon import Daemon, DaemonTest

SCHEMAS = os.environ.get("MTCONNECT_SCHEMAS")
VERDICTS = {"good": "PASS", "rework": "REWORK", "reject": "FAIL", "indeterminate": "INDETERMINATE"}


class Agent(DaemonTest):
    def setUp(self):
        self.daemon = Daemon().start()
        self.addCleanup(self.daemon.cleanup)

    def read(self, path, status=200):
        answer = self.daemon.get("/mtconnect/" + path)
        self.assertEqual(answer.status, status, answer)
        self.assertEqual(answer.headers["content-type"], "text/xml")
        return self.document(answer)

    def document(self, answer):
        root = tree.fromstring(answer.body)
        kind = root.tag.split("}")[1].removeprefix("MTConnect")
        self.assertEqual(root.tag, f"{{urn:mtconnect.org:MTConnect{kind}:2.4}}MTConnect{kind}")
        if SCHEMAS:
            schema = pathlib.Path(SCHEMAS) / f"MTConnect{kind}_2.4_1.0.xsd"
            done = subprocess.run(["xmllint", "--noout", "--nonet", "--schema", schema, "-"], input=answer.body,
                                  capture_output=True, check=False)
            self.assertEqual(done.returncode, 0, done.stderr.decode() + answer.text)
        for element in root.iter():
            element.tag = element.tag.split("}")[-1]
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
        for count in (1, 2, 3, 5):
            at, seen = 1, []
            while at < 10:
                root = self.read(f"sample?from={at}&count={count}")
                page = [int(each.get("sequence")) for each in root.iter() if each.get("dataItemId")]
                self.assertLessEqual(len(page), count)
                seen += page
                self.assertGreater(self.header(root)["nextSequence"], at)
                at = self.header(root)["nextSequence"]
            self.assertEqual(seen, list(range(1, 10)), count)
        self.assertEqual(self.features(self.read("sample?from=10")), [])
        self.assertEqual(self.read("sample?from=11", 404).find("Errors/Error").get("errorCode"), "OUT_OF_RANGE")
        root = self.read("current")
        self.assertEqual(self.features(root)[0][0], 9)
        self.assertEqual({count.get("subType"): count.text for count in root.iter("PartCount")},
                         {"ALL": "4", "GOOD": "1", "BAD": "1", "x:REWORK": "1", "x:INDETERMINATE": "1"})

    def sequences(self, root):
        return [int(each.get("sequence")) for each in root.iter() if each.get("dataItemId")]

    def test_a_negative_count_goes_backwards(self):
        self.assertEqual(self.sequences(self.read("sample?count=-5")), [1])
        self.daemon.measure([{"designation": "25 H7", "measured_mm": f"25.0{i}", "part_id": f"P{i}"} for i in range(4)])
        newest_first = list(range(9, 0, -1))
        self.assertEqual(self.sequences(self.read("sample?count=-100")), newest_first)
        self.assertEqual(self.sequences(self.read("sample?count=-3")), [9, 8, 7])
        for count in (1, 2, 3, 4, 5):
            at, seen = 9, []
            for _ in range(20):
                root = self.read(f"sample?from={at}&count=-{count}")
                seen += self.sequences(root)
                self.assertLessEqual(len(self.sequences(root)), count)
                at = self.header(root)["nextSequence"]
                if seen[-1] == 1:
                    break
            self.assertEqual((seen, at), (newest_first, 1), count)
        self.assertEqual(self.sequences(self.read("sample?from=6&count=-2")), [6, 5])
        self.assertEqual(self.sequences(self.read("sample?from=10&count=-1")), [9])
        self.assertEqual(self.code("sample?from=11&count=-1", 404), "OUT_OF_RANGE")
        root = self.read("sample?count=-2&path=" + urllib.parse.quote("//DataItem[@id='part']"))
        self.assertEqual((self.sequences(root), self.header(root)["nextSequence"]), ([8, 6], 5))

    def test_current_at_a_sequence_is_the_state_it_had(self):
        """As an observer who read the whole sample up to there has it."""
        self.assertEqual(self.sequences(self.read("current?at=1")), self.sequences(self.read("current")))
        ids = [self.daemon.measure({"designation": "25 H7", "measured_mm": measured, "part_id": f"P{i}"}).json["id"]
               for i, measured in enumerate(("25.01", "24.99", "25.05"))]
        self.daemon.post(f"/v1/measurements/{ids[0]}/corrections", {"measured_mm": "25.06", "reason": "misread"})
        last = self.header(self.read("current"))["lastSequence"]
        self.assertEqual(last, 9)
        part, feature, counts = "UNAVAILABLE", [], {"GOOD": 0, "BAD": 0, "x:REWORK": 0}
        status = {"PASS": "GOOD", "FAIL": "BAD", "REWORK": "x:REWORK"}
        for at in range(1, last + 1):
            seen = self.read(f"sample?from={at}&count=1")
            for each in seen.iter("PartId"):
                part = each.text
            if self.features(seen):
                feature = self.features(seen)
                counts[status[feature[0][2]["CHARACTERISTIC_STATUS"]]] += 1
                if at == 9:  # the correction takes the place of the first
                    counts["GOOD"] -= 1
            root = self.read(f"current?at={at}")
            self.assertEqual([each.text for each in root.iter("PartId")], [part], at)
            self.assertEqual(self.features(root), feature, at)
            shown = {each.get("subType"): int(each.text) for each in root.iter("PartCount")}
            self.assertEqual({name: shown[name] for name in counts}, counts, at)
            self.assertLessEqual(max(self.sequences(root)), at)
            self.assertEqual(self.header(root), {"firstSequence": 1, "lastSequence": last, "nextSequence": last + 1})
        self.assertEqual(self.read("current?at=9").find("Streams/DeviceStream/ComponentStream/Events/PartId").text,
                         self.read("current").find("Streams/DeviceStream/ComponentStream/Events/PartId").text)
        for query, status_code in (("at=10", 404), ("at=0", 400), ("at=x", 400), ("at=-1", 400)):
            self.assertEqual(self.code("current?" + query, status_code), "OUT_OF_RANGE", query)

    def code(self, path, status):
        return self.read(path, status).find("Errors/Error").get("errorCode")

    def test_errors_are_documents_of_mtconnect(self):
        for query in ("from=0", "from=x", "count=0", "count=-10001", "count=10001", "count=-1&interval=10", "interval=-1", "heartbeat=0"):
            self.assertEqual(self.code("sample?" + query, 400), "OUT_OF_RANGE", query)
        self.assertEqual(self.code("sample?nothing=1", 400), "INVALID_REQUEST")
        self.assertEqual(self.code("nothing", 404), "INVALID_URI")
        for path in ("x", "//", "//DataItem[", "//DataItem[@type]", "//DataItem[type='A']", "//DataItem[@type='A' & @id='b']",
                     "//Axes", "//DataItem[@type='POSITION']", "/DataItem", "//DataItem|", "//DataItem[@type='PART_ID"):
            for name in ("sample", "current"):
                self.assertEqual(self.code(f"{name}?path={urllib.parse.quote(path)}", 400), "INVALID_PATH", path)
        answer = self.daemon.post("/mtconnect/probe", b"")
        self.assertEqual((answer.status, self.document(answer).find("Errors/Error").get("errorCode")), (405, "UNSUPPORTED"))

    def test_a_path_chooses_what_is_shown(self):
        self.daemon.measure([{"designation": "25 H7", "measured_mm": 25.01, "part_id": f"P{i}"} for i in range(3)])
        shown = lambda path, name="current": [each.get("dataItemId") for each in
                                              self.read(f"{name}?path={urllib.parse.quote(path)}").iter() if each.get("dataItemId")]
        everything = shown("//*")
        self.assertEqual(len(everything), 10)
        for path, items in (("//DataItem", everything), ("//Device[@name='Gauge']", everything), ("/MTConnectDevices/Devices/Device/DataItems/DataItem", everything),
                            ('//DataItem[@type="PART_ID"]', ["part"]), ("//m:DataItem[@id='part' or @id='avail']", ["avail", "part"]),
                            ("//DataItem[ @type = 'PART_COUNT' and @subType='BAD' ]", ["count3"]), ("//Device[@id='gauge']//DataItem[@category='EVENT']", everything),
                            ("//DataItem[@id='part']|//DataItem[@id='feature']", ["part", "feature"])):
            self.assertEqual(sorted(shown(path)), sorted(items), path)
        self.assertEqual(shown("//DataItem[@id='part']", "sample"), ["part"] * 3)
        root = self.read("sample?count=2&path=" + urllib.parse.quote("//DataItem[@id='feature']"))
        self.assertEqual(([each.get("sequence") for each in root.iter("FeatureMeasurementTable")], self.header(root)["nextSequence"]), (["3", "5"], 6))

    def test_the_results_are_an_asset(self):
        self.assertEqual(len(self.read("assets").find("Assets")), 0)
        self.assertEqual(self.read("probe").find("Header").get("assetCount"), "0")
        self.assertEqual(self.code("asset/nothing", 404), "ASSET_NOT_FOUND")
        self.daemon.measure([{"designation": "25 H7", "measured_mm": f"25.0{i}", "part_id": f"P{i}"} for i in range(1, 5)])
        changed = next(self.read("current").iter("AssetChanged"))
        self.assertEqual(changed.get("assetType"), "QIFDocumentWrapper")
        self.assertEqual(self.read("probe").find("Header").get("assetCount"), "1")
        for path in ("assets", "asset", "assets?type=QIFDocumentWrapper", "asset/" + changed.text):
            wrapper = self.read(path).find("Assets/QIFDocumentWrapper")
            self.assertEqual((wrapper.get("assetId"), wrapper.get("qifDocumentType")), (changed.text, "RESULTS"))
            self.assertEqual([each.text for each in wrapper.iter("Value")], ["25.01", "25.02", "25.03", "25.04"])
        self.assertEqual(len(self.read("assets?type=CuttingTool").find("Assets")), 0)

    def stream(self, query):
        connection = self.daemon.connect()
        self.addCleanup(connection.close)
        connection.request("GET", "/mtconnect/sample?" + query)
        return connection.getresponse()

    def part(self, stream):
        """The next document of the stream."""
        self.assertEqual(stream.readline(), b"--fitgauge-mtconnect\r\n")
        headers = {}
        while (line := stream.readline().strip()):
            name, _, value = line.partition(b": ")
            headers[name.lower()] = value
        self.assertEqual(headers[b"content-type"], b"text/xml")
        body = stream.read(int(headers[b"content-length"]))
        self.assertEqual(stream.readline(), b"\r\n")
        return self.document(types.SimpleNamespace(body=body, text=body.decode()))

    def test_a_stream_tells_what_is_measured_and_beats_between(self):
        stream = self.stream("interval=10&heartbeat=200&count=3&from=1")
        self.assertEqual(stream.status, 200)
        self.assertEqual(stream.getheader("content-type"), "multipart/x-mixed-replace;boundary=fitgauge-mtconnect")
        seen = []

        def follow(until):
            while not seen or seen[-1] < until:
                root = self.part(stream)
                seen.extend(int(each.get("sequence")) for each in root.iter() if each.get("dataItemId"))
            return root
        follow(1)
        root = self.part(stream)  # a heartbeat
        self.assertEqual(([each for each in root.iter() if each.get("dataItemId")], self.header(root)["nextSequence"]), ([], 2))
        for i in range(5):
            self.daemon.measure([{"designation": "25 H7", "measured_mm": 25.01, "part_id": f"P{i}-{j}"} for j in range(4)])
            follow(2 * 4 * (i + 1) + 1)
        self.assertEqual(seen, list(range(1, 42)))

    def test_streams_are_bounded(self):
        streams = [self.stream("interval=1000&heartbeat=1000") for _ in range(32)]
        self.assertEqual([stream.status for stream in streams], [200] * 32)
        self.assertEqual(self.code("sample?interval=1000", 503), "TOO_MANY")


if __name__ == "__main__":
    unittest.main()
