"""Drawings: the sizes of a STEP file, and the plan that is made of it."""

import gzip
import hashlib
import os
import pathlib
import re
import unittest

from support.cli import ClientTest
from support.daemon import ROOT, SANITIZED
from support.waiting import wait_for

HOUSING = (ROOT / "tests/fuzz/corpus/step/housing.stp").read_bytes()
STEP = {"Content-Type": "model/step"}


class Drawings(ClientTest):
    def put(self, part, drawing):
        return self.daemon.request("PUT", f"/v1/plans/{part}", drawing, STEP)

    def plan(self, part):
        return self.daemon.request("GET", f"/v1/plans/{part}").json

    def test_a_drawing_is_read_and_nothing_is_stored(self):
        read = self.daemon.request("POST", "/v1/drawings", HOUSING, STEP).json
        self.assertEqual(read["digest"], hashlib.sha256(HOUSING).hexdigest())
        self.assertEqual(read["sizes"][1], {
            "name": "diameter 25", "nominal_mm": 25, "tolerance_class": "g6", "feature": "shaft", "quantity": "diameter",
            "count": 1, "entity": "#120", "modifiers": [], "remarks": []})
        self.assertEqual([one["name"] for one in read["sizes"]], ["Bore Ø A", "diameter 25", "width 8", "width 8.001", "distance 40"])
        self.assertEqual(len(read["not_read"]), 8)
        self.assert_problem(self.daemon.request("GET", "/v1/plans/read"), 404, "plan.unknown")

    def test_what_is_no_drawing_is_refused_with_its_line(self):
        for body in (b"", b"ISO-10303-21;", HOUSING[:-40], HOUSING.replace(b"AP242_", b"IFC4_"), HOUSING.replace(b"MEASURE(0.),#5", b"MEASURE(0.),#9")):
            for method, path in (("POST", "/v1/drawings"), ("PUT", "/v1/plans/no")):
                problem = self.daemon.request(method, path, body, STEP)
                self.assert_problem(problem, 400, "drawing.malformed")
                self.assertRegex(problem.json["detail"], r"^line \d+: ")
        self.assert_problem(self.put("no", HOUSING.replace(b"DIMENSIONAL_", b"OTHER_")), 422, "drawing.no_sizes")
        self.assert_problem(self.daemon.request("POST", "/v1/drawings", HOUSING, {"Content-Type": "text/plain"}), 415, "media_type.unsupported")
        self.assert_problem(self.daemon.request("PUT", "/v1/plans/no", b'{"name":"' + b"x" * (1 << 20) + b'"}', {"Content-Type": "application/json"}),
                            413, "request.body_too_large")

    def test_a_body_that_is_too_long_is_refused_before_it_is_sent(self):
        for method, path, media_type, most in (
                ("POST", "/v1/drawings", "model/step", 64 << 20), ("PUT", "/v1/plans/no", "model/step", 64 << 20),
                ("PUT", "/v1/plans/no", "application/json", 1 << 20)):
            connection = self.daemon.connect()
            self.addCleanup(connection.close)
            connection.putrequest(method, path)
            for field in (("Content-Type", media_type), ("Content-Length", str(most + 1))):
                connection.putheader(*field)
            connection.endheaders()
            with self.subTest(path=path, media_type=media_type):
                answer = connection.getresponse()
                self.assertEqual(answer.status, 413)
                self.assertIn(b"at most %d bytes" % most, answer.read())

    @unittest.skipIf(SANITIZED, "a sanitizer keeps what was freed")
    def test_the_largest_drawing_stays_on_disk_and_takes_eight_bytes_an_instance(self):
        head, tail = HOUSING.replace(b"#", b"#3000000").split(b"DATA;\n")
        head += b"DATA;\n"
        rows = b"".join(b"#%07d=A('%013d');\n" % (i, i) for i in range(1, 2_000_000))
        drawing = head + rows + b" " * ((64 << 20) - len(head) - len(rows) - len(tail)) + tail
        self.assertEqual(len(drawing), 64 << 20)
        read = self.daemon.request("POST", "/v1/drawings", drawing, STEP)
        self.assertEqual((read.status, len(read.json["sizes"]), read.json["digest"]), (200, 5, hashlib.sha256(drawing).hexdigest()))
        packed = self.daemon.request("PUT", "/v1/plans/large", gzip.compress(drawing, 1), {**STEP, "Content-Encoding": "gzip"})
        self.assertEqual((packed.status, len(packed.json["added"])), (201, 5), packed)
        cut = self.daemon.request("POST", "/v1/drawings", drawing[:-9], STEP)
        self.assertRegex(cut.json["detail"], r"^line 2\d{6}: the file ends here")
        self.assertLess(self.daemon.memory("VmHWM"), 120 << 20)

    def test_a_drawing_on_disk_has_no_name_and_goes_with_the_service(self):
        names = sorted(os.listdir(self.daemon.data))
        connection = self.daemon.connect()
        self.addCleanup(connection.close)
        connection.putrequest("POST", "/v1/drawings")
        for field in (*STEP.items(), ("Content-Length", str(64 << 20))):
            connection.putheader(*field)
        connection.endheaders(b" " * (8 << 20))
        maps = pathlib.Path(f"/proc/{self.daemon.process.pid}/maps")
        wait_for(lambda: re.search(rf"{re.escape(str(self.daemon.data))}/\S+ \(deleted\)", maps.read_text()), "a file on disk")
        self.assertEqual(sorted(os.listdir(self.daemon.data)), names)
        self.daemon.kill()
        self.daemon.start()
        self.assertEqual(sorted(os.listdir(self.daemon.data)), names)

    def test_a_revision_says_what_it_changed_and_keeps_what_people_gave(self):
        first = self.put("4711-A", HOUSING)
        self.assertEqual((first.status, len(first.json["added"])), (201, 5))
        plan = self.plan("4711-A")
        self.assertEqual(plan["drawing"], {"digest": hashlib.sha256(HOUSING).hexdigest(), "part": "4711-A"})
        plan["characteristics"][1]["gauge"] = "G-07"
        plan["characteristics"].append({"name": "by hand", "designation": "30 k6"})
        self.assertEqual(self.daemon.request("PUT", "/v1/plans/4711-A", plan).status, 200)
        self.assertNotIn("compared", self.daemon.request("POST", "/v1/drawings?part=none", HOUSING, STEP).json)
        revision = HOUSING.replace(b"'g6','shaft'", b"'f7','shaft'").replace(b"#170=DIMENSIONAL_LOCATION", b"#170=OTHER_LOCATION")
        compared = self.daemon.request("POST", "/v1/drawings?part=4711-A", revision, STEP).json["compared"]
        self.assertEqual(compared.pop("digest"), hashlib.sha256(HOUSING).hexdigest())
        self.assertEqual(self.plan("4711-A")["characteristics"][1]["tolerance_class"], "g6")
        second = self.put("4711-A", revision)
        self.assertEqual(compared, {name: second.json[name] for name in compared})
        self.assertEqual(second.status, 200)
        self.assertEqual(second.json["changed"], [{"name": "diameter 25", "before": "nominal_mm 25, tolerance_class g6",
                                                   "after": "nominal_mm 25, tolerance_class f7"}])
        self.assertEqual((second.json["added"], second.json["gone"]), ([], ["distance 40"]))
        now = self.plan("4711-A")["characteristics"]
        self.assertEqual((now[1]["gauge"], now[-1]["name"]), ("G-07", "by hand"))

    def test_characteristics_of_a_drawing_are_measured_as_they_are(self):
        self.put("measured", HOUSING)
        for one, measured in zip(self.plan("measured")["characteristics"], (25.01, 24.99, 7.98, 7.97, 40)):
            limits = {name: value for name, value in one.items() if name in ("nominal_mm", "tolerance_class", "designation", "feature",
                                                                              "quantity", "upper_um", "lower_um")}
            stored = self.daemon.request("POST", "/v1/measurements", {**limits, "measured_mm": measured, "characteristic": one["name"]})
            self.assertEqual((stored.status, stored.json["verdict"]), (201, "good"), stored)

    def test_the_command_line_reads_a_drawing_and_makes_its_plan(self):
        (self.client.folder / "housing.stp").write_bytes(HOUSING)
        listed = self.assert_runs(0, "plan", "from", "housing.stp")
        self.assertRegex(listed, r"#130 +width 8 +8 0 / -36 +width hole\n")
        self.assert_runs(0, "plan", "from", "housing.stp", "--part", "by line")
        self.put("by%20wire", HOUSING)
        self.assertEqual(self.plan("by%20line")["characteristics"], self.plan("by%20wire")["characteristics"])
        (self.client.folder / "cut.stp").write_bytes(HOUSING[:2000])
        cut = self.client.run("plan", "from", "cut.stp")
        self.assertEqual(cut.returncode, 5)
        self.assertRegex(cut.stderr_text, r"cut\.stp: line \d+: ")
