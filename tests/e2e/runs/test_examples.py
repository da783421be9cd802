"""The example programs 8255, 8210, 8025, 444 and 451 with their setups."""

from support.control import EXAMPLES, ControlTest, setup


class Examples(ControlTest):
    def test_444_probes_a_face_point_by_point(self):
        run = self.run_example("444", setup("444/plate"))
        self.assertEqual(run["status"], "completed", run["messages"])
        # The four edges from the middle, 0.02 high, to the corners: two fifths of the way from each corner.
        corners = {22: 0, 23: 0.01, 24: 0.045, 25: -0.015}
        wanted = {f"Q{number}": 0.6 * corner + 0.4 * 0.02 for number, corner in corners.items()} | {"Q21": 0.02}
        for name, deviation in wanted.items():
            self.assertAlmostEqual(run["parameters"][name], deviation, places=4, msg=name)
        self.assertEqual([file["path"].rsplit("\\", 1)[1].upper() for file in run["files"]], ["TCHPR444.HTML"])

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.upload_examples(cls())

    def gauge(self, name, **order):
        shaft = {"QS1": "g6", "Q31": 10} if name.startswith("shaft") else {}
        return self.run_example("8255", setup(f"8255/{name}"), parameters=shaft, **order)

    def test_good_bore_is_shown_on_the_screen(self):
        run = self.gauge("hole-good")
        self.assertEqual(run["status"], "completed", run["messages"])
        self.assertEqual(run["screen"], ["STATUS OF THE FIT: GOOD",
                                         "CHECKED FIT: 25H7",
                                         "MINIMUM SIZE:  25.0000",
                                         "MAXIMUM SIZE:  25.0210",
                                         "MEASURED DIAMETER:  25.0130"])
        self.assertEqual(run["verdict"], "good")
        self.assertEqual(run["parameters"]["QS3"], "GOOD")
        self.assertEqual(run["parameters"]["Q23"], 25.021)
        self.assertEqual(run["tables"], [{"path": "TNC:\\nc_prog\\8255\\82553_hole.tab",
                                          "source": "live"}])

    def test_every_setup_of_8255_ends_as_its_name_says(self):
        for feature in ("hole", "shaft"):
            for verdict in ("good", "rework", "reject"):
                with self.subTest(feature=feature, verdict=verdict):
                    run = self.gauge(f"{feature}-{verdict}")
                    self.assertEqual(run["status"], "completed", run["messages"])
                    self.assertEqual(run["verdict"], verdict)
                    self.assertEqual(run["screen"][0], f"STATUS OF THE FIT: {verdict.upper()}")

    def test_screen_speaks_the_language_of_the_control(self):
        first = {"german": "STATUS DER PASSUNG: AUSSCHUSS",
                 "dutch": "STATUS VAN DE PASSING: AFKEUR",
                 "italian": "STATO DELL'ACCOPPIAMENTO: SCARTO"}
        for language, line in first.items():
            self.assertEqual(self.gauge("hole-reject", language=language)["screen"][0], line)

    def test_stop_ends_the_run_when_asked(self):
        run = self.gauge("hole-good", on_stop="end")
        self.assertEqual(run["status"], "stopped")
        self.assertEqual(run["messages"][-1]["program"], "TNC:\\nc_prog\\8255\\8255.h")

    def test_log_and_record_of_the_measuring_cycle(self):
        run = self.gauge("hole-good")
        self.assertEqual([file["path"].rsplit("\\", 1)[1] for file in run["files"]],
                         ["TCHPR421.TXT"])
        log = self.daemon.get(f"/v1/runs/{run['id']}/files/tchpr421.txt")
        self.assertIn("25.0130", log.text)
        self.assertEqual(log.headers["content-type"], "text/plain; charset=utf-8")
        self.assertEqual(log.headers["x-content-type-options"], "nosniff")
        self.assertEqual(log.headers["content-security-policy"],
                         "sandbox; default-src 'none'; style-src 'unsafe-inline'")
        records = self.daemon.stored(f"run_id={run['id']}")
        self.assertEqual(records, [row for row in self.daemon.stored("source=simulation")
                                   if row["run_id"] == run["id"]])
        self.assertEqual(len(records), 1)
        self.assertEqual(self.daemon.stored(f"run_id={run['id']}&source=gauge"), [])
        expected = {"source": "simulation", "cycle": 421, "nominal_mm": 25, "basis": "explicit",
                    "upper_limit_mm": 25.021, "lower_limit_mm": 25, "measured_mm": 25.013,
                    "verdict": "good"}
        self.assertEqual({name: records[0][name] for name in expected}, expected)
        self.assertEqual(self.daemon.get("/v1/measurements").json["measurements"], [])

    def test_8210_sets_the_datum_at_the_highest_point(self):
        run = self.run_example("8210", setup("8210/highest-in-the-middle"),
                               parameters={"QL3": 1.5})
        self.assertEqual(run["status"], "completed", run["messages"])
        names = ("QL40", "QL41", "QL42")
        self.assertEqual([run["parameters"][name] for name in names], [50, 40, 0.35])
        self.assertEqual(run["active_preset"], 1)
        # The touched point, 0.35 in machine coordinates, reads QL3.
        preset = next(row for row in run["presets"] if row["number"] == 1)
        self.assertAlmostEqual(0.35 - preset["z_mm"], 1.5, places=9)

    def test_8210_keeps_the_first_of_two_equal_points(self):
        run = self.run_example("8210", setup("8210/two-are-highest"))
        self.assertEqual(run["status"], "completed", run["messages"])
        self.assertEqual([run["parameters"][name] for name in ("QL40", "QL41")], [90, 10])

    def test_8210_of_many_points_in_any_order(self):
        # Heights in no order, each there once; the table begins with a row that is not asked for.
        heights = [k * 37 % 101 / 100 for k in range(1, 13)]
        places = [(10 + 15 * (k % 4), 10 + 25 * (k // 4)) for k in range(12)]
        rows = "".join(f"{k + 2:<8}{x:<10}{y}\n" for k, (x, y) in enumerate(places))
        self.upload("many/8210.h", (EXAMPLES / "8210" / "8210.h").read_bytes())
        self.upload("many/82101.tab", f"BEGIN 82101 .TAB MM\nNR      X         Y\n0       1         1\n"
                                      f"{rows}[END]\n")
        corners = [[-200, -200, -1], [200, -200, -1], [-200, 200, -1], [200, 200, -1]]
        for count in (1, 2, 5, 12):
            points = [[x, y, z] for (x, y), z in list(zip(places, heights))[:count]]
            surface = {"type": "surface", "points_mm": corners + points}
            run = self.run_program("TNC:\\many\\8210.h", {"workpiece": {"features": [surface]}},
                                   parameters={"QL1": count, "QL3": -2, "QL5": 2})
            self.assertEqual(run["status"], "completed", run["messages"])
            highest = max(heights[:count])
            x, y = places[heights.index(highest)]
            q = run["parameters"]
            self.assertEqual((q["QL40"], q["QL41"]), (x, y))
            self.assertAlmostEqual(q["QL42"], highest, places=6)
            preset = next(row for row in run["presets"] if row["number"] == run["active_preset"])
            self.assertAlmostEqual(highest - preset["z_mm"], -2, places=6)

    def test_8210_fails_where_there_is_nothing_to_touch(self):
        run = self.run_example("8210", setup("8210/out-of-reach"))
        self.assertEqual(run["status"], "failed")
        message = run["messages"][-1]
        self.assertEqual(message["number"], 1014)
        self.assertEqual(message["program"], "TNC:\\nc_prog\\8210\\8210.h")
        self.assertGreater(message["line"], 0)

    def test_8025_raises_the_feed_step_by_step(self):
        run = self.run_example("8025", setup("8025/cutter"),
                               parameters={"Q1": 120, "Q2": 480, "Q3": 45, "Q4": 6, "Q5": -5})
        self.assertEqual(run["status"], "completed", run["messages"])
        moves = self.daemon.get(f"/v1/runs/{run['id']}/trace").json["moves"]
        ramp = [move for move in moves if move["kind"] == "feed"
                and move["start_mm"]["X"] != move["end_mm"]["X"]]
        self.assertEqual(len(ramp), 6)
        for k, move in enumerate(ramp, start=1):
            self.assertAlmostEqual(move["feed_mm_min"], 120 + k * (480 - 120) / 6, places=9)
            self.assertAlmostEqual(move["end_mm"]["X"], -5 + k * 45 / 6, places=9)
            self.assertAlmostEqual(move["seconds"], 45 / 6 / move["feed_mm_min"] * 60, places=6)
        self.assertAlmostEqual(ramp[-1]["end_mm"]["X"], -5 + 45, places=9)
        on = moves[moves.index(ramp[-1]) + 1]
        self.assertEqual((on["kind"], on["feed_mm_min"]), ("feed", 480))
        self.assertGreater(moves[-1]["end_mm"]["Z"], on["end_mm"]["Z"])

    def measure_axes(self, name):
        run = self.run_example("451", setup(f"451/{name}"))
        self.assertEqual(run["status"], "completed", run["messages"])
        return run

    def test_451_leaves_a_machine_alone_that_is_as_modelled(self):
        run = self.measure_axes("as-modelled")
        self.assertEqual(run["screen"], ["AS FOUND", "STANDARD DEVIATION A:   0.0000",
                                         "STANDARD DEVIATION C:   0.0000",
                                         "KINEMATICS: GOOD AS FOUND"])

    def test_451_corrects_axes_that_lie_elsewhere(self):
        run = self.measure_axes("off-centre")
        found, corrected = run["screen"].index("AS FOUND"), run["screen"].index("AS CORRECTED")
        before, after = (max(float(line.rsplit(":", 1)[1]) for line in run["screen"][at + 1:at + 3])
                         for at in (found, corrected))
        self.assertGreater(before, 0.02)
        self.assertLess(after, 0.006)
        self.assertEqual(run["screen"][-1], "KINEMATICS: CORRECTED")
        log = self.daemon.get(f"/v1/runs/{run['id']}/files/tchpr451.html")
        self.assertEqual(log.text.count("<h3>Axis C</h3>"), 3)
        self.assertEqual(log.text.count("<!DOCTYPE"), 1)

    def test_451_restores_the_kinematics_of_a_machine_that_scatters(self):
        self.assertEqual(self.measure_axes("worn")["screen"][-1],
                         "KINEMATICS: RESTORED: THE AXES SCATTER")

    def test_trace_without_moves_as_csv_has_its_header(self):
        self.daemon.request("PUT", "/v1/files/still.h", "BEGIN PGM still MM\nEND PGM still MM\n")
        run = self.daemon.post("/v1/runs", {"program": "still.h"}).json
        answer = self.daemon.get(f"/v1/runs/{run['id']}/trace", Accept="text/csv")
        self.assertRegex(answer.text, r"\Akind,block,line,program,start_x_mm,[^\r\n]+\r\n\Z")

    def test_trace_as_csv_has_a_row_for_every_move(self):
        run = self.gauge("hole-good")
        path = f"/v1/runs/{run['id']}/trace"
        moves = self.daemon.get(path).json["moves"]
        lines = self.daemon.get(path, Accept="text/csv").text.splitlines()
        self.assertEqual(self.daemon.get(path + "?format=csv").text.splitlines(), lines)
        self.assertEqual(len(lines), len(moves) + 1)
        self.assertTrue(lines[0].startswith("kind,block,line,program,start_x_mm"), lines[0])
        probes = [move for move in moves if move["kind"] == "probe"]
        self.assertEqual(len(probes), 4)
        for move in probes:
            self.assertEqual(move["program"], "TNC:\\nc_prog\\8255\\82551.h")
            self.assertIsNotNone(move["contact_mm"])

    def test_a_check_finds_no_fault_with_the_examples(self):
        for path in ("8255/8255.h", "8255/82551.h", "8255/82552.a", "8210/8210.h",
                     "8210/82101.tab", "8025/8025.h", "451/451.h", "451/4511.a"):
            answer = self.daemon.request("POST", f"/v1/files/nc_prog/{path}?action=check")
            self.assertEqual(answer.json, {"diagnostics": []}, path)
