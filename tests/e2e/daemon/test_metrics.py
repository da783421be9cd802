"""/metrics: its format, its numbers, and that documents, alerts and the dashboard name what there is."""

import json
import re
import shutil
import subprocess
import time
import unittest

from support.control import workpiece
from support.daemon import ROOT, DaemonTest
from support.waiting import wait_for

SAMPLE = re.compile(r'^([a-z_]+)(?:\{((?:[a-z]+="[^"]*",?)*)\})? (\S+)$')
LABEL = re.compile(r'([a-z]+)="([^"]*)"')
# A metric in an expression; `sum by (instance)`, functions and label names are none.
NAME = re.compile(r"\b(?:fitgauge|process)_[a-z_]+\b")


class Metrics(DaemonTest):
    def scrape(self):
        """Types by family and values by (name, labels)."""
        answer = self.daemon.get("/metrics")
        self.assertEqual(answer.status, 200)
        self.assertEqual(answer.headers["content-type"], "text/plain; version=0.0.4; charset=utf-8")
        types, values, family = {}, {}, None
        for line in answer.text.splitlines():
            if line.startswith("# HELP "):
                family = line.split()[2]
                self.assertNotIn(family, types, "a family comes once")
                self.assertIn(" ", line.split(None, 3)[3])
            elif line.startswith("# TYPE "):
                self.assertEqual(line.split()[2], family)
                types[family] = line.split()[3]
            else:
                name, labels, value = SAMPLE.match(line).groups()
                self.assertIn(name.removeprefix(family), ("", "_bucket", "_sum", "_count"), line)
                key = name, tuple(sorted(LABEL.findall(labels or "")))
                self.assertNotIn(key, values)
                values[key] = float(value)
        return types, values

    def value(self, name, **labels):
        return self.scrape()[1].get((name, tuple(sorted(labels.items()))), 0)

    def wait_for(self, expected, name, **labels):
        wait_for(lambda: self.value(name, **labels) == expected,
                 lambda: f"{name} {labels} of {expected} is {self.value(name, **labels)}")

    def test_names_and_types_are_prometheus_own(self):
        types, values = self.scrape()
        for family, kind in types.items():
            self.assertEqual(family.endswith("_total"), kind == "counter", family)
            self.assertNotRegex(family, "milli|micro|nano|_ms|_kb|_mb", "base units alone")
        buckets = {}
        for (name, labels), value in values.items():
            if name.endswith("_bucket"):
                rest = tuple(label for label in labels if label[0] != "le")
                bound = float(dict(labels)["le"].replace("+Inf", "inf"))
                buckets.setdefault((name.removesuffix("_bucket"), rest), []).append((bound, value))
        self.assertGreater(len(buckets), 2)
        for (name, labels), rows in buckets.items():
            self.assertEqual(rows, sorted(rows), name)
            self.assertEqual([count for _, count in rows], sorted(count for _, count in rows), name)
            self.assertEqual(rows[-1], (float("inf"), values[f"{name}_count", labels]), name)

    @unittest.skipUnless(shutil.which("promtool"), "needs promtool (Debian: prometheus)")
    def test_promtool_finds_nothing(self):
        text = self.daemon.get("/metrics").body
        done = subprocess.run(["promtool", "check", "metrics"], input=text, capture_output=True)
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, b"", b""))
        done = subprocess.run(["promtool", "check", "rules", ROOT / "docs/deploy/alerts.yml"],
                              capture_output=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_verdicts_are_counted_by_source(self):
        before = self.value("fitgauge_measurements_total", source="gauge", verdict="reject")
        good = self.value("fitgauge_measurements_total", source="gauge", verdict="good")
        rows = [{"designation": "25 H7", "measured_mm": mm} for mm in ("25.5", "25.01", "25.01")]
        self.assertEqual(self.daemon.measure(rows).status, 201)
        self.wait_for(before + 1, "fitgauge_measurements_total", source="gauge", verdict="reject")
        self.wait_for(good + 2, "fitgauge_measurements_total", source="gauge", verdict="good")

    def test_the_writer_tells_its_commits(self):
        before = self.value("fitgauge_writer_commit_duration_seconds_count")
        self.assertEqual(self.daemon.measure({"designation": "25 H7", "measured_mm": "25.01"}).status, 201)
        seconds, jobs = ((f"fitgauge_writer_{name}_count", ()) for name in ("commit_duration_seconds", "batch_jobs"))
        # A commit beside may come between the two figures of one answer.
        values = wait_for(lambda: (now := self.scrape()[1])[seconds] == now[jobs] and now, "as many batches as commits")
        commits = values[seconds]
        self.assertGreater(commits, before)
        self.assertGreaterEqual(values["fitgauge_writer_batch_jobs_sum", ()], commits)
        self.assertGreater(values["fitgauge_database_bytes", (("file", "database"),)], 0)
        self.assertGreater(values["fitgauge_storage_free_bytes", ()], 0)
        self.assertEqual(values["fitgauge_ready", ()], 1)

    def test_runs_are_counted_by_how_they_ended(self):
        before = self.value("fitgauge_runs_total", status="completed")
        with self.daemon.client() as client:
            client.put_file("metrics.h", b"0 BEGIN PGM METRICS MM\n1 L X+10 R0 FMAX\n2 END PGM METRICS MM\n")
        order = {"program": "TNC:\\metrics.h", "setup": workpiece()}
        self.assertEqual(self.daemon.post("/v1/runs", order).status, 201)
        self.wait_for(before + 1, "fitgauge_runs_total", status="completed")
        self.wait_for(0, "fitgauge_runs_active", status="running")

    def test_event_readers_are_counted_while_they_read(self):
        connection = self.daemon.connect()
        connection.request("GET", "/v1/events")
        connection.getresponse()
        self.wait_for(1, "fitgauge_event_readers")
        connection.close()

    def test_refused_keys_are_problems_by_code(self):
        before = self.value("fitgauge_problems_total", code="auth.invalid")
        answer = self.daemon.get("/v1/measurements", Authorization="Bearer fg_nobody", X_Forwarded_For="10.0.0.9")
        self.assertEqual(answer.status, 401)
        self.wait_for(before + 1, "fitgauge_problems_total", code="auth.invalid")

    def test_the_process_is_this_one(self):
        _, values = self.scrape()
        self.assertLess(abs(values["process_start_time_seconds", ()] - time.time()), 3600)
        self.assertGreater(values["process_resident_memory_bytes", ()], 1e6)
        self.assertGreater(values["process_open_fds", ()], 3)
        self.assertLess(values["process_open_fds", ()], values["process_max_fds", ()])


class Documents(DaemonTest):
    def families(self):
        """What stands behind # TYPE, with the names of a histogram's samples."""
        text = self.daemon.get("/metrics").text
        types = dict(re.findall(r"^# TYPE (\S+) (\S+)$", text, re.MULTILINE))
        names = set(types)
        for family, kind in types.items():
            if kind == "histogram":
                names |= {f"{family}_{suffix}" for suffix in ("bucket", "sum", "count")}
        return types, names

    def test_the_reference_lists_each_with_its_type(self):
        page = (ROOT / "docs/reference/metrics.md").read_text()
        listed = dict(re.findall(r"^\| `([a-z_]+)` \| (\w+) \|", page, re.MULTILINE))
        self.assertEqual(listed, self.families()[0])

    def test_alerts_and_dashboard_name_what_there_is(self):
        _, names = self.families()
        codes = set(re.findall(r'FITGAUGE_ERROR\(\w+, "([^"]+)"',
                               (ROOT / "server/base/error_codes.inc").read_text()))
        dashboard = json.loads((ROOT / "docs/deploy/grafana-dashboard.json").read_text())
        texts = {"alerts.yml": (ROOT / "docs/deploy/alerts.yml").read_text(),
                 "dashboard": " ".join(target["expr"].replace('\\"', '"') for panel in dashboard["panels"]
                                       for target in panel["targets"])}
        for document, text in texts.items():
            named = set(NAME.findall(text))
            self.assertGreater(len(named), 10, document)
            self.assertEqual(named - names, set(), document)
            self.assertEqual(set(re.findall(r'code="([^"]+)"', text)) - codes, set(), document)

    def test_what_an_alert_counts_is_there_before_its_first_time(self):
        # A series that begins with 1 has no increase: the first internal error would wake nobody.
        alerts = (ROOT / "docs/deploy/alerts.yml").read_text()
        counted = re.findall(r"increase\((\w+)(?:\{([^}]*)\})?\[", alerts)
        self.assertGreater(len(counted), 5)
        samples = [SAMPLE.match(line).groups() for line in self.daemon.get("/metrics").text.splitlines()
                   if not line.startswith("#")]
        for name, labels in counted:
            if name.startswith("fitgauge_connection_"):
                continue  # there from the connection's start
            wanted = set(LABEL.findall(labels))
            there = [set(LABEL.findall(own or "")) for sample, own, _ in samples if sample == name]
            self.assertTrue(any(wanted <= own for own in there), (name, labels))


if __name__ == "__main__":
    unittest.main()
