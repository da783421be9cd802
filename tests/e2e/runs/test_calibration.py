"""Cycles that write data of the machine: 460 to 463 of its probe, 480 to 484 of its tools, 450 to 453 its axes."""

from support.control import ControlTest, workpiece


def cycle(number, name, **parameters):
    """A block of a touch-probe cycle."""
    return f"TCH PROBE {number} {name} ~\n " + " ~\n ".join(
        f"{parameter}={value:+}" for parameter, value in parameters.items())


def above(x, y, z):
    return "L Z+200 FMAX", f"L X{x:+} Y{y:+} FMAX", f"L Z{z:+} FMAX"


def read(*values):
    """FN 18 of ID, NR and IDX to Q1, Q2, ..."""
    return [f"FN 18: SYSREAD Q{k} = ID{group} NR{number} IDX{index}"
            for k, (group, number, index) in enumerate(values, 1)]


# The effective ball radius, the offset of its centre in two axes, the length of the probe.
PROBE = read((350, 11, 0), (350, 14, 1), (350, 14, 2), (50, 1, 30))
BORE = cycle(421, "MEASURE HOLE", Q273=100, Q274=80, Q262=25, Q247=90, Q261=-5, Q260=30)


class Control(ControlTest):
    def completed(self, machine, *blocks):
        run = self.run_program(self.upload_program("p", *blocks), machine)
        self.assertEqual(run["status"], "completed", run["messages"])
        return run

    def assert_values(self, parameters, *expected):
        for k, value in enumerate(expected, 1):
            self.assertAlmostEqual(parameters[f"Q{k}"], value, delta=3e-6, msg=f"Q{k}")

    def log(self, run, name):
        answer = self.daemon.get(f"/v1/runs/{run['id']}/files/{name}")
        self.assertEqual(answer.status, 200, answer)
        return answer.text


class ProbeCalibration(Control):
    """A ball that is smaller, longer and beside the spindle axis, until a cycle has found out."""

    MACHINE = workpiece(
        {"type": "block", "min_mm": [0, 0, -40], "max_mm": [200, 200, 0]},
        {"type": "bore", "center_mm": [100.02, 79.97], "depth_mm": 30, "diameter_mm": 25.013},
        tools=[{"number": 30, "name": "PROBE", "length_mm": 120, "radius_mm": 2, "probe": 1,
                "actual_length_mm": 120.25, "actual_radius_mm": 1.9963}],
        probes=[{"number": 1, "center_offset_mm": [0.013, -0.021]}],
        calibration_ring={"center_mm": [-200, 100], "diameter_mm": 50},
        calibration_stud={"center_mm": [-200, -100], "top_mm": 30, "height_mm": 30, "diameter_mm": 40},
        calibration_sphere={"center_mm": [-200, 0, 60], "radius_mm": 12.5})

    def calibrated(self, *blocks):
        """The probe's data after the blocks, and the bore that it then measures."""
        run = self.completed(self.MACHINE, "TOOL CALL 30 Z", *blocks, *PROBE, *above(100, 80, 20), BORE)
        return run, run["parameters"]

    def assert_bore(self, parameters, x, y, diameter):
        for name, value in (("Q151", x), ("Q152", y), ("Q153", diameter)):
            self.assertAlmostEqual(parameters[name], value, delta=3e-6)

    def test_uncalibrated(self):
        parameters = self.calibrated()[1]
        self.assert_values(parameters, 2, 0, 0, 120)
        self.assertNotAlmostEqual(parameters["Q151"], 100.02, delta=0.01)
        self.assertNotAlmostEqual(parameters["Q153"], 25.013, delta=0.005)

    def test_460_on_the_sphere(self):
        run, parameters = self.calibrated(
            *above(-200.2, 0.3, 80), cycle(460, "CALIBRATION OF TS ON A SPHERE", Q407=12.5, Q433=1, Q434=60))
        self.assert_values(parameters, 1.9963, 0.013, -0.021, 120.25)
        self.assert_bore(parameters, 100.02, 79.97, 25.013)
        self.assertIn("1.9963", self.log(run, "TCHPRAUTO.html"))

    def test_461_on_the_ring(self):
        run, parameters = self.calibrated(
            *above(-165, 100, 5), cycle(461, "TS CALIBRATION OF TOOL LENGTH", Q434=0))
        self.assert_values(parameters, 2, 0, 0, 120.25)
        self.assertIn("120.2500", self.log(run, "TCHPRAUTO.html"))

    def test_462_in_the_ring(self):
        run, parameters = self.calibrated(
            *above(-200.3, 100.2, -12), cycle(462, "CALIBRATION OF TS IN RING", Q407=25))
        self.assert_values(parameters, 1.9963, 0.013, -0.021, 120)
        self.assert_bore(parameters, 100.02, 79.97, 25.013)
        self.assertIn("-0.0210", self.log(run, "TCHPRAUTO.html"))

    def test_463_on_the_stud(self):
        parameters = self.calibrated(
            *above(-199.8, -100.3, 32), cycle(463, "TS CALIBRATION ON STUD", Q407=20))[1]
        self.assert_values(parameters, 1.9963, 0.013, -0.021, 120)
        self.assert_bore(parameters, 100.02, 79.97, 25.013)

    def test_calibration_ends_with_the_run(self):
        self.test_462_in_the_ring()
        self.test_uncalibrated()


class ToolMeasuring(Control):
    """A worn mill, and a tool touch probe that stands elsewhere than the control knows."""

    MACHINE = workpiece(
        tools=[{"number": 5, "length_mm": 100, "radius_mm": 6, "teeth": 4, "length_tolerance_mm": 0.05,
                "actual_length_mm": 99.97, "actual_radius_mm": 5.988},
               {"number": 99, "length_mm": 80, "radius_mm": 5}],
        tt={"center_mm": [300, 0, 50], "radius_mm": 20,
            "actual_center_mm": [300.4, -0.3, 50.12], "actual_radius_mm": 19.95})
    TT = read((350, 20, 1), (350, 20, 2), (350, 20, 3), (350, 21, 0))
    CHECK = {"Q340": 1, "Q260": 200}

    def calibrate(self):
        return "TOOL CALL 99 Z", cycle(480, "CALIBRATE TT", Q260=200)

    def test_480_at_the_known_place(self):
        parameters = self.completed(self.MACHINE, *self.calibrate(), *self.TT)["parameters"]
        self.assert_values(parameters, 300.4, -0.3, 50.12, 19.95)

    def test_484_where_the_tool_stands(self):
        run = self.completed(self.MACHINE, "TOOL CALL 99 Z", *above(302, 1, 70),
                             cycle(484, "CALIBRATE IR TT", Q536=0), *self.TT)
        self.assert_values(run["parameters"], 300.4, -0.3, 50.12, 19.95)
        self.assertEqual([message["kind"] for message in run["messages"]], ["stop"])

    def measured(self, number, name):
        columns = read((50, 4, 5), (50, 5, 5), (50, 7, 5))  # DL, DR, TL
        return self.completed(self.MACHINE, *self.calibrate(), "TOOL CALL 5 Z",
                              cycle(number, name, **self.CHECK), *columns)["parameters"]

    def test_481_to_483_write_the_wear(self):
        self.assert_values(self.measured(481, "CAL. TOOL LENGTH"), -0.03, 0, 0)
        self.assert_values(self.measured(482, "CAL. TOOL RADIUS"), 0, -0.012, 0)
        both = self.measured(483, "MEASURE TOOL")
        self.assert_values(both, -0.03, -0.012, 0)
        self.assertEqual(both["Q199"], 0)

    def test_a_tool_that_is_too_short_is_locked(self):
        machine = {**self.MACHINE, "machine": dict(self.MACHINE["machine"])}
        worn = {**machine["machine"]["tools"][0], "length_tolerance_mm": 0.02}
        machine["machine"]["tools"] = [worn, machine["machine"]["tools"][1]]
        program = self.upload_program("worn", *self.calibrate(), "TOOL CALL 5 Z",
                                      cycle(481, "CAL. TOOL LENGTH", **self.CHECK), "TOOL CALL 5 Z")
        run = self.run_program(program, machine)
        self.assertEqual(run["status"], "failed")
        self.assertEqual(run["parameters"]["Q199"], 1)
        self.assertIn("Tool locked", run["messages"][-1]["text"])


class Kinematics(Control):
    """A table whose C axis lies 0.02 mm beside its model: measured, corrected, saved, restored."""

    MACHINE = workpiece(
        axes={"C": {"on": "table", "center_mm": [0, 0, -100], "center_error_mm": [0.02, -0.01, 0]}},
        calibration_sphere={"center_mm": [60, 25, 40], "radius_mm": 15},
        presets=[{"number": 1, "x_mm": 60, "y_mm": 25, "z_mm": 40}])
    SPHERE = {"Q407": 15, "Q408": 80, "Q253": 2000}
    AXES = {"Q414": 0, "Q418": 0, "Q419": -90, "Q420": 180, "Q422": 4}
    ABOVE = ("TOOL CALL 30 Z", *above(0, 0, 30))

    def measure(self, mode):
        return cycle(451, "MEASURE KINEMATICS", Q406=mode, **self.SPHERE, **self.AXES)

    @staticmethod
    def record(mode, name="OLD"):
        return f'TCH PROBE 450 SAVE KINEMATICS ~\n Q410={mode:+} ~\n QS409="{name}"'

    def test_451_finds_and_corrects(self):
        run = self.completed(self.MACHINE, *self.ABOVE, self.measure(1), "Q1 = Q143", "Q2 = Q147",
                             "Q3 = Q148", self.measure(0))
        self.assertGreater(run["parameters"]["Q1"], 0.005)
        self.assertAlmostEqual(run["parameters"]["Q2"], 0.02, delta=1e-6)
        self.assertAlmostEqual(run["parameters"]["Q3"], -0.01, delta=1e-6)
        self.assertAlmostEqual(run["parameters"]["Q143"], 0, delta=1e-6)
        self.assertIn("X 0.0200, Y -0.0100", self.log(run, "TCHPR451.html"))

    def test_450_through_one_run(self):
        run = self.completed(
            self.MACHINE, *self.ABOVE, self.record(0), self.measure(1), self.measure(0), "Q1 = Q143",
            self.record(1), self.measure(0), "Q2 = Q143", self.record(2), self.record(3), self.record(2))
        self.assertAlmostEqual(run["parameters"]["Q1"], 0, delta=1e-6)
        self.assertGreater(run["parameters"]["Q2"], 0.005)
        self.assertEqual(sorted(file["path"].rsplit("\\", 1)[1] for file in run["files"]),
                         ["DATA450.KD", "TCHPR450.html", "TCHPR451.html"])
        log = self.log(run, "TCHPR450.html")
        for part in ("Saved as OLD", "Restored from OLD. Before:", "1 of 16 records:</p>\n<p>OLD",
                     "Deleted OLD", "0 of 16 records"):
            self.assertIn(part, log)

    def test_records_stay_in_the_run_until_they_are_put_on_the_disk(self):
        """As every change of the machine: an order that is posted again gives the same run."""
        saved = self.completed(self.MACHINE, *self.ABOVE, self.measure(1), self.record(0))
        restored = self.upload_program("again", *self.ABOVE, self.record(1), self.measure(0))

        def assert_error():
            run = self.run_program(restored, self.MACHINE)
            self.assertEqual(run["status"], "failed")
            self.assertEqual(run["messages"][-1]["number"], 1096)

        assert_error()
        records = self.log(saved, "DATA450.KD")
        self.upload("table/data450.kd", records)
        run = self.run_program(restored, self.MACHINE)
        self.assertEqual(run["status"], "completed", run["messages"])
        self.assertAlmostEqual(run["parameters"]["Q143"], 0, delta=1e-6)
        self.upload("table/data450.kd", records.replace("TABLE", "FLOOR"))
        assert_error()
        self.daemon.request("DELETE", "/v1/files/table/data450.kd")
        assert_error()

    def test_452_and_453(self):
        preset = cycle(452, "PRESET COMPENSATION", **self.SPHERE, **self.AXES)
        grid = cycle(453, "KINEMATICS GRID", Q406=1, **{**self.SPHERE, "Q408": 90})
        for block, log in ((preset, "TCHPR452.html"), (grid, "TCHPR453.html")):
            run = self.completed(self.MACHINE, *self.ABOVE, block, "Q1 = Q143", self.measure(0))
            self.assertGreater(run["parameters"]["Q1"], 0.005)
            self.assertAlmostEqual(run["parameters"]["Q143"], 0, delta=1e-6)
            self.assertIn("Location error", self.log(run, log))
