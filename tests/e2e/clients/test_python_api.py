"""The Python client on a running service: every call, and every route of the API by some call."""

import io
import json
import re
import typing
from datetime import datetime, timedelta, timezone
from decimal import Decimal

from support.control import FOREVER, ControlTest, setup
from support.daemon import ROOT, fitgauge

PART = {"designation": "25 H7", "measured_mm": "25.0215", "part_id": "SN-1", "characteristic": "bore-A"}
COLUMN = [{"over_mm": 18, "up_to_mm": 30, "upper_um": Decimal("15.5"), "lower_um": -3}]
PROGRAM = "TNC:\\nc_prog\\8255\\8255.h"
ENDLESS = "\n".join(["BEGIN PGM loop MM", *FOREVER, "END PGM loop MM", ""]).encode()
# The page with its parts, and the same fit in two segments.
NOT_THE_CLIENTS = {("GET", "/"), ("GET", "/web/{path}"), ("GET", "/v1/fits/{hole}/{shaft}"), ("GET", "/v1/log/revisions")}


class Recorder(fitgauge.Client):
    """Remembers what was asked."""

    calls = set()

    def _perform(self, request):
        self.calls.add((request.method, request.path.partition("?")[0]))
        return super()._perform(request)


class EveryRoute(ControlTest):
    def test_every_route_has_a_call_that_works(self):
        with Recorder(f"http://127.0.0.1:{self.daemon.port}") as client:
            self.call_tables(client)
            self.call_measurements(client)
            self.call_control(client)
            self.call_service(client)
            routes = [(method.upper(), path) for path, methods in client.openapi()["paths"].items()
                      for method in methods if method in ("get", "put", "post", "delete")]
        self.assertGreater(len(routes), 30)
        missed = [route for route in routes if route not in NOT_THE_CLIENTS and not self.was_called(client, *route)]
        self.assertEqual(missed, [])

    def was_called(self, client, method, pattern):
        segments = re.sub(r"\{[^/]*\}", "[^/]+", re.sub(r"\{path\}", ".+", pattern.replace(".", r"\.")))
        return any(called == method and re.fullmatch(segments, path) for called, path in client.calls)

    def call_tables(self, client):
        limits = client.limits("Ø25 H7")
        self.assertEqual(limits, client.limits_of("25.0", "H7"))
        self.assertEqual(limits, client.limits("25,0H7"))
        self.assertEqual(limits["upper_limit_mm"], Decimal("25.021"))
        self.assertIsInstance(limits["nominal_mm"], Decimal)
        self.assertIsInstance(limits["size_range_mm"]["over"], Decimal)
        found = client.fits(25, min_clearance_um=5, max_clearance_um=45, limit=3)
        self.assertEqual(len(found["fits"]), 3)
        self.assertEqual(client.limit_gauges("25 H7")["scheme"], "ISO/R 1938:1971")
        self.assertEqual(client.limits("M10-6H")["upper_limit_mm"], Decimal("9.206"))
        self.assertIn("iso492", [standard["name"] for standard in client.standards()])
        self.assertEqual(client.standard("iso492", size_mm=25, table="bores")["rows"][0]["limits"]["P5"]["lower_um"], -6)
        # Worked out by hand: 1, 2, 3 have the mean 2, and groups 1, 2 and 3, 4 an F of 8.
        self.assertEqual(client.statistics("summary", {"values": [1, 2, 3]})["mean"], 2)
        self.assertEqual(client.statistics("anova", {"groups": [[1, 2], [3, 4]]})["f"], 8)
        values = [Decimal("25.010"), Decimal("25.012"), Decimal("25.009"), Decimal("25.011"), Decimal("25.010")]
        self.assertIn("cp", client.statistics("capability", {"values": values, "lower": 25, "upper": Decimal("25.021")}))
        self.assertEqual(client.statistics("chart", {"kind": "i_mr", "values": values})["violations"], [])
        self.assertIn("cg", client.statistics("type1", {"values": values, "reference": Decimal("25.01"),
                                                        "tolerance": Decimal("0.021")}))
        study = [{"part": str(part), "operator": operator, "trial": trial, "value": part + trial * Decimal("0.01")}
                 for part in range(3) for operator in "AB" for trial in range(2)]
        self.assertIn("ndc", client.statistics("grr", {"method": "anova", "tolerance": 5, "measurements": study}))
        pairs = client.statistics("pairing", {"holes": [25, Decimal("25.01")], "shafts": [Decimal("24.99"), Decimal("24.98")],
                                              "target_clearance_um": 20})["pairs"]
        self.assertEqual(len(pairs), 2)
        self.assertEqual(client.uncertainty({"contributions": [
            {"name": "a", "standard_uncertainty": 3}, {"name": "b", "standard_uncertainty": 4}]})["combined_standard_uncertainty"], 5)
        budget = {"contributions": [{"name": "a", "standard_uncertainty": 1}]}
        self.assertEqual(client.put_uncertainty("plug", budget)["combined_standard_uncertainty"], 1)
        self.assertEqual(client.stored_uncertainty("plug"), budget)
        self.assertEqual([found["name"] for found in client.uncertainties()], ["plug"])
        self.assertTrue(client.put_gauge_in_use("G-07", "2027-03-31", "plug"))
        self.assertEqual(client.gauge_in_use("G-07"), {"calibration_due": "2027-03-31", "uncertainty": "plug"})
        self.assertEqual([found["name"] for found in client.gauges_in_use()], ["G-07"])
        recorded = client.record_calibration("G-07", {"from": "2026-03-31", "due": "2027-03-31", "certificate": "K-1"})
        self.assertEqual((recorded["certificate"], client.calibrations("G-07")), ("K-1", [recorded]))
        self.assertEqual([each["after"] for each in client.changes(page=1, kind="calibration", name="G-07")], [recorded])
        seen, cursor = client.changes_after(None)
        self.assertEqual([client.changes_after(cursor), [*client.changes(after=cursor)]], [([], cursor), []])
        self.assertEqual([*client.changes(page=2, after=seen[1]["id"])], seen[2:])
        origin, size = client.changes_checkpoint().split("\n")[:2]
        self.assertEqual(origin, client.changes_keys()[0].split("+")[0])
        self.assertEqual(len(client.changes_tile(f"0/000.p/{size}")), 32 * int(size))
        kept = client.put_study("G-07 of March", {"gauge": "G-07", "at": "2026-03-31", "kind": "grr", "input": {"measurements": study}})
        self.assertIn("ndc", kept["result"])
        self.assertEqual(client.study("G-07 of March"), kept)
        self.assertEqual([(found["name"], found["gauge"]) for found in client.studies()], [("G-07 of March", "G-07")])
        client.delete_study("G-07 of March")
        client.delete_gauge_in_use("G-07")
        client.delete_uncertainty("plug")
        pressed = client.press_fit({"joint_diameter_mm": 50, "length_mm": 40, "max_interference_um": 40,
                                    "hub": {"outer_diameter_mm": 100}, "shaft": {}})
        self.assertAlmostEqual(float(pressed["at_max_interference"]["pressure_mpa"]), 63, places=9)
        fit = client.fit("25 H7/g6")
        self.assertEqual((fit["type"], fit["max_clearance_um"]), ("clearance", 41))
        verdict = client.verdict("25H7", Decimal("25.0194"), rule="guard_band", uncertainty_um="0.8",
                                 coverage_factor=2)
        self.assertEqual(verdict["verdict"], "good")

        revision = client.tables()["revision"]
        new = client.put_column("hole", "PRESS", COLUMN, revision)
        self.assertNotEqual(new, revision)
        self.assertEqual(client.limits("25PRESS")["upper_deviation_um"], Decimal("15.5"))
        with self.assertRaises(fitgauge.PreconditionFailed):
            client.put_column("hole", "PRESS", COLUMN, revision)
        client.delete_column("hole", "PRESS", new)
        client.put_column("shaft", "press", COLUMN)
        client.delete_column("shaft", "press")
        for feature, name in (("hole", "H7"), ("shaft", "g6")):
            rows = client.table(feature, [name], revision)
            self.assertEqual((len(rows), rows[0]["over_mm"], list(rows[0]["limits"])), (41, 0, [name]))
            self.assertEqual(len(client.table_csv(feature, [name]).splitlines()), 42)
            self.assertIn("BEREICH", client.table_tab(feature))

    def call_measurements(self, client):
        record = client.measure({**PART, "measured_at": datetime(2026, 11, 20, 8, tzinfo=timezone(timedelta(hours=1)))})
        self.assertEqual((record["verdict"], record["excess_um"]), ("reject", Decimal("0.5")))
        self.assertEqual(record["measured_at"], "2026-11-20T07:00:00Z")
        note = client.note(record["id"], cause="Insert worn", measure="Insert changed", operator="Kim")
        self.assertEqual((note["measurement_id"], client.notes(record["id"])), (record["id"], [note]))
        self.assertEqual(client.part(record["part_id"])["part_id"], record["part_id"])
        new = client.correct(record["id"], {"measured_mm": "25.0185", "reason": "gauge was not zeroed"})
        self.assertEqual(client.measurement(record["id"])["corrected_by"], new["id"])
        self.assertEqual(list(client.measurements(part_id="SN-1")), [new])
        self.assertEqual(len(list(client.measurements(part_id="SN-1", history="all"))), 2)
        self.assertEqual(list(client.measurements(from_=datetime(2026, 11, 20, 7, 0, 1, tzinfo=timezone.utc))), [])
        group, = client.summary(part_id="SN-1")
        self.assertTrue(client.certificate(part_id="SN-1", paper="letter").startswith(b"%PDF-"))
        proof = client.proof(new["id"])
        self.assertEqual(client.checkpoint().splitlines()[0], proof["checkpoint"].splitlines()[0])
        self.assertTrue(client.log_keys()[0].startswith("fitgauge/station/"))
        self.assertEqual(len(client.log_tile("0/000.p/2")), 64)
        batch = json.dumps({"checkpoint": client.checkpoint(), "key": client.log_keys()[0]})
        with self.assertRaises(fitgauge.Conflict) as own:  # no folder forwards to itself
            client.put_log(record["id"].split("-")[1], 1, batch.encode())
        self.assertEqual(own.exception.code, "log.forked")
        self.assertEqual((group["count"], group["mean_mm"], group["standard_deviation_mm"]),
                         (1, Decimal("25.0185"), None))
        events = client.events(last_event_id="m0.e0")
        self.assertEqual([next(events).type for _ in range(3)],
                         ["measurement.recorded", "verdict.reject", "measurement.recorded"])
        events.close()
        values = [Decimal("25.010"), Decimal("25.012"), Decimal("25.009"), Decimal("25.011"), Decimal("25.010")]
        client.measure_all([{"designation": "25 H7", "measured_mm": value, "characteristic": "figures"}
                            for value in values])
        self.assertEqual(client.capability(characteristic="figures", target_mm=25)["selection"]["count"], 5)
        self.assertEqual(client.compensation(characteristic="figures")["state"], "wait")
        chart = client.chart("i_mr", [1, 2], characteristic="figures")
        self.assertEqual((chart["charts"][0]["points"], chart["violations"]), (values, []))

    def call_control(self, client):
        self.upload_examples()
        self.assertTrue(client.put_file("some/File 1.h", ENDLESS))
        self.assertFalse(client.put_file("TNC:\\SOME\\file 1.h", ENDLESS))
        self.assertEqual(client.file("some/file 1.h"), ENDLESS)
        self.assertEqual([file["size"] for file in client.files("some/")], [len(ENDLESS)])
        self.assertEqual(client.check(PROGRAM), [])

        self.assertTrue(client.put_setup("hole-good", setup("8255/hole-good", fitgauge.loads)))
        self.assertIn("hole-good", [entry["name"] for entry in client.setups()])
        self.assertEqual(client.setup("hole-good"), setup("8255/hole-good", fitgauge.loads))
        run = client.run_program(PROGRAM, "hole-good", parameters={"Q1": 25})
        self.assertEqual((run["verdict"], run["parameters"]["Q23"]), ("good", Decimal("25.021")))
        self.assertEqual(client.run(run["id"]), run)
        self.assertEqual(client.run_parameters(run["id"]), run["parameters"])
        self.assertIn(b"25.0130", client.run_file(run["id"], "TCHPR421.TXT"))
        moves = client.trace(run["id"])
        self.assertIsInstance(moves[0]["end_mm"]["Z"], Decimal)
        self.assertEqual(len(client.trace_csv(run["id"]).splitlines()), len(moves) + 1)
        order = client.run_request(run["id"])
        self.assertEqual(client.run_program(**order)["screen"], run["screen"])
        started = client.start_run(PROGRAM, setup("8255/hole-reject", fitgauge.loads))
        self.assertEqual(client.wait_for_run(started["id"])["verdict"], "reject")
        self.assertEqual([event.type for event in client.run_events(started["id"])][-1], "end")

        endless = client.start_run("some/file 1.h", limits={"blocks": 100_000_000, "seconds": 60})
        client.cancel_run(endless["id"])
        with self.assertRaises(fitgauge.Conflict):
            client.cancel_run(run["id"])
        self.assertEqual([r["id"] for r in client.runs(status="cancelled", page=1)], [endless["id"]])
        client.delete_setup("hole-good")
        plan = {"characteristics": [{"name": "bore-A", "designation": "25 H7"}]}
        self.assertTrue(client.put_plan("4711/A", plan))
        self.assertEqual(client.plan("4711/A"), {"part": "4711/A", **plan})
        self.assertEqual([(each["part"], each["characteristics"]) for each in client.plans()], [("4711/A", 1)])
        housing = (ROOT / "tests/fuzz/corpus/step/housing.stp").read_bytes()
        self.assertEqual(len(client.read_drawing(housing)["sizes"]), 5)
        self.assertEqual(len(client.plan_from_drawing("4711/A", housing)["added"]), 5)
        client.delete_plan("4711/A")
        catalogue = {"causes": ["Insert worn"], "measures": []}
        self.assertTrue(client.put_catalogue("turning", **catalogue))
        self.assertEqual(client.catalogue("turning"), catalogue)
        self.assertEqual([each["name"] for each in client.catalogues()], ["turning"])
        client.delete_catalogue("turning")
        client.delete_file("some/file 1.h")
        with self.assertRaises(fitgauge.NotFound):
            client.file("some/file 1.h")

    def call_service(self, client):
        self.assertTrue(client.live())
        self.assertEqual(client.connections(), [])
        control = {"kind": "lsv2", "address": "127.0.0.1:1", "paths": ["TNC:\\logs\\*.TXT"], "interval_s": 3600}
        self.assertTrue(client.put_connection("mill", control))
        self.assertEqual(client.connection("mill")["address"], "127.0.0.1:1")
        self.assertFalse(client.test_connection("mill")["ok"])
        client.delete_connection("mill")
        client.put_connection("mes", {"kind": "webhook", "url": "http://127.0.0.1:1/", "secrets": ["whsec_" + "A" * 32]})
        self.assertEqual(client.replay_connection("mes", "2026-11-20T08:00:00Z")["kind"], "webhook")
        client.delete_connection("mes")
        self.assertIn("FEATURE_MEASUREMENT", client.mtconnect("probe"))
        self.assertIn("nextSequence", client.mtconnect("sample", start=1, count=2))
        self.assertIn("PartCount", client.mtconnect("current"))
        assets = client.mtconnect("assets")
        self.assertEqual(re.findall("<Asset>|QIFDocument ", client.mtconnect("asset")),
                         re.findall("<Asset>|QIFDocument ", assets))
        asset = re.search(r'assetId="([^"]+)"', assets)[1]
        self.assertIn(f'assetId="{asset}"', client.mtconnect(f"asset/{asset}"))
        self.assertEqual(client.wait_until_ready()["database"], client.ready()["database"])
        with fitgauge.Client("http://127.0.0.1:1") as nobody, self.assertRaises(fitgauge.NoAnswer):
            nobody.wait_until_ready(timeout=0.2)
        self.assertEqual(client.ready()["version"], fitgauge.__version__)
        self.assertIn("fitgauge_", client.metrics())
        self.assertEqual(client.cycle(421), next(c for c in client.cycles() if c["number"] == 421))


class ManyRows(ControlTest):
    def setUp(self):
        self.client = self.daemon.client()
        self.addCleanup(self.client.close)

    def rows(self, count, prefix):
        for number in range(count):
            yield {**PART, "part_id": f"{prefix}{number}", "measured_mm": Decimal("25.01") + Decimal(number).scaleb(-6)}

    def stored(self, prefix):
        return [record for record in self.client.measurements() if record.get("part_id", "").startswith(prefix)]

    def test_records_of_one_request(self):
        records = self.client.measure_all(list(self.rows(3, "all-")))
        self.assertEqual([record["measured_mm"] for record in records],
                         [Decimal("25.01"), Decimal("25.010001"), Decimal("25.010002")])

    def test_an_iterator_is_read_as_it_is_sent(self):
        taken, seen = [], []
        rows = (taken.append(row["part_id"]) or row for row in self.rows(2_500, "lazy-"))
        total = self.client.measure_many(rows, rows=1_000,
                                         progress=lambda sum: seen.append((sum["accepted"], len(taken))))
        self.assertEqual(seen, [(1_000, 1_000), (2_000, 2_000), (2_500, 2_500)])
        self.assertEqual((total["accepted"], total["verdicts"]["good"]), (2_500, 2_500))
        stored = self.stored("lazy-")
        self.assertEqual((stored[0]["id"], stored[-1]["id"], len(stored)),
                         (total["first_id"], total["last_id"], 2_500))
        self.assertEqual(stored[-1]["measured_mm"], Decimal("25.012499"))

    def test_begun_again_it_stores_nothing_twice(self):
        def broken():
            yield from self.rows(250, "again-")
            raise EOFError
        with self.assertRaises(EOFError):
            self.client.measure_many(broken(), idempotency_key="night-1", rows=100)
        self.assertEqual(len(self.stored("again-")), 200)
        total = self.client.measure_many(self.rows(300, "again-"), idempotency_key="night-1", rows=100)
        self.assertEqual(total["accepted"], 300)
        self.assertEqual(len(self.stored("again-")), 300)

    def test_csv_with_line_breaks_in_quotes(self):
        text = "\ufeffdesignation;measured_mm;part_id;comment\r\n" + "".join(
            f'25 H7;25,01;csv-{i};"first\r\nsecond ""{i}"""\r\n' for i in range(5))
        total = self.client.measure_csv(io.StringIO(text, newline=""), rows=2)
        self.assertEqual(total["accepted"], 5)
        self.assertEqual([record["comment"] for record in self.stored("csv-")],
                         [f'first\r\nsecond "{i}"' for i in range(5)])

    def test_a_bad_row_is_counted_over_all_requests(self):
        rows = list(self.rows(25, "bad-"))
        rows[23]["measured_mm"] = "x"
        with self.assertRaises(fitgauge.Invalid) as caught:
            self.client.measure_many(rows, rows=10)
        entry, = caught.exception.errors
        self.assertEqual((entry["pointer"], entry["line"], entry["code"]), ("/23/measured_mm", 24, "length.malformed"))
        text = 'designation,measured_mm,comment\n' + '25 H7,25.01,"two\nlines"\n\n' * 4 + "25 H7,,\n"
        with self.assertRaises(fitgauge.Invalid) as caught:
            self.client.measure_csv(text.splitlines(keepends=True), rows=2)
        entry, = caught.exception.errors
        self.assertEqual((entry["pointer"], entry["line"]), ("/4/measured_mm", 14))

    def test_nothing_is_an_error_of_the_service(self):
        for nothing in (lambda: self.client.measure_many([]), lambda: self.client.measure_csv([]),
                        lambda: self.client.measure_csv(["designation,measured_mm\n"])):
            with self.assertRaises((fitgauge.Invalid, fitgauge.BadRequest)):
                nothing()

    def test_a_whole_list_as_a_stream(self):
        self.client.measure_many(self.rows(2_000, "out-"))
        pieces = list(self.client.export(part_id="out-7"))
        self.assertEqual(len(b"".join(pieces).splitlines()), 2)
        ndjson = b"".join(self.client.export("ndjson"))
        records = [fitgauge.loads(line) for line in ndjson.splitlines()]
        self.assertEqual(records, list(self.client.measurements()))
        stopped = self.client.export("ndjson")
        next(stopped)
        stopped.close()
        self.assertTrue(self.client.live())


class Numbers(ControlTest):
    def test_every_digit_goes_there_and_back(self):
        client = self.daemon.client()
        for text in ("25.013", "25.021001", "0.000001", "99999999.999999"):
            record = client.measure({"nominal_mm": "100000000", "feature": "hole", "upper_um": "0",
                                     "lower_um": Decimal("-0.001"), "measured_mm": Decimal(text)})
            self.assertEqual(record["measured_mm"], Decimal(text))
        client.close()

    def test_every_number_of_a_record_is_the_decimal_its_type_says(self):
        with self.daemon.client() as client:
            record = client.measure({"designation": "25H7", "measured_mm": "25.01", "rule": "conformance",
                                     "uncertainty_um": 1, "probability": "0.9", "temperature_c": 21,
                                     "part_expansion_um_per_m_k": "11.5",
                                     "part_expansion_uncertainty_um_per_m_k": "0.1"})
        types = typing.get_type_hints(fitgauge.Measurement)
        wrong = {name for name, value in record.items() if types.get(name) is Decimal and type(value) is not Decimal}
        self.assertEqual(wrong, set())

    def test_what_is_no_exact_number_is_not_sent(self):
        client = self.daemon.client()
        for value, error in ((25.013, TypeError), (Decimal("NaN"), ValueError), (Decimal("Infinity"), ValueError)):
            with self.assertRaises(error):
                client.measure({**PART, "measured_mm": value})
        with self.assertRaises(ValueError):
            client.measure({**PART, "measured_at": datetime(2026, 11, 20)})
        self.assertEqual(list(client.measurements(part_id="SN-1")), [])
        for call in (lambda: client.verdict("25H7", 25.01), lambda: client.limits_of(25.0, "H7"),
                     lambda: client.run_program("nc_prog/8255.h", parameters={"Q1": 25.0})):
            with self.assertRaisesRegex(TypeError, "binary float"):
                call()
        client.close()

    def test_what_was_meant_otherwise_is_told(self):
        client = self.daemon.client()
        for call, told in ((lambda: client.limits(25), "no text"), (lambda: client.measure([PART]), "measure_all"),
                           (lambda: client.measure_csv("night.csv"), "open file"),
                           (lambda: client.measure_csv(io.BytesIO(b"a\nb\n")), "'rb'")):
            with self.assertRaisesRegex(TypeError, told):
                call()
        client.close()

    def test_times(self):
        moment = datetime(2026, 11, 20, 7, 0, 1, 250000, tzinfo=timezone.utc)
        self.assertEqual(fitgauge.when("2026-11-20T07:00:01.25Z"), moment)
        self.assertEqual(fitgauge.when("2026-11-20T07:00:01.250000999Z"), moment)
        self.assertEqual(fitgauge.when("2026-11-20T07:00:01Z"), moment.replace(microsecond=0))


class Problems(ControlTest):
    def test_each_kind_has_its_class_and_facts(self):
        client = self.daemon.client()
        with self.assertRaises(fitgauge.BadRequest) as caught:
            client.limits("7H")
        self.assertEqual((caught.exception.status, caught.exception.code), (400, "designation.malformed"))
        with self.assertRaises(fitgauge.NotFound):
            client.measurement("m999999")
        with self.assertRaises(fitgauge.Invalid) as caught:
            client.measure({**PART, "measured_mm": "", "colour": "blue"})
        self.assertEqual({entry["pointer"] for entry in caught.exception.errors}, {"/measured_mm", "/colour"})
        self.assertIn("/colour field.unknown", str(caught.exception))
        client.put_file("bad.h", b"0 BEGIN PGM bad MM\n1 GARBAGE\n2 END PGM bad MM\n")
        with self.assertRaises(fitgauge.ProgramInvalid) as caught:
            client.run_program("TNC:\\bad.h")
        self.assertEqual(caught.exception.diagnostics[0]["line"], 2)
        self.assertEqual(client.check("bad.h")[0]["severity"], "error")
        client.close()
