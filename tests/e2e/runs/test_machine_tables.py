"""tool.t, tchprobe.tp, preset.pr and datum tables on the control's disk feed the machine."""

from support.control import ControlTest

TOOLS = ("BEGIN TOOL .T MM\n"
         "T       NAME      L         R         TL  TP_NO\n"
         "0\n"
         "5       MILL_D8   +92.5     +4\n"
         "6       WORN      +90       +4        L\n"
         "30      PROBE     +150.25   +3            2\n"
         "[END]\n")
PROBES = ("BEGIN TCHPROBE .TP MM\n"
          "NO      TYPE   F         FMAX      DIST      SET_UP\n"
          "2       TS460  300       2000      15        4\n"
          "[END]\n")
PRESETS = ("BEGIN PRESET .PR MM\n"
           "NO      DOC         X         Y         Z         SPC\n"
           "1                   +0        +0        +0\n"
           "5       vice        -100.5    +20       +7.25\n"
           "[END]\n")
DATUMS = ("BEGIN ZERO .D MM\n"
          "NR      X         Y         Z\n"
          "2       +12.5     -3\n"
          "[END]\n")
TOUCH = ("TOOL CALL 30 Z",
         "TCH PROBE 427 MEASURE COORDINATE ~\n Q263=+0 ~\n Q264=+0 ~\n Q261=+0 ~\n Q320=+1 ~\n Q272=+3 ~\n"
         " Q267=-1 ~\n Q260=+50 ~\n Q281=+0 ~\n Q288=+0 ~\n Q289=+0 ~\n Q309=+0 ~\n Q330=+0")
FACE = {"features": [{"type": "plane", "point_mm": [0, 0, 0.125]}]}


class MachineTables(ControlTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        test = cls()
        test.upload("table/tool.t", TOOLS)
        test.upload("TABLE/TCHPROBE.TP", PROBES)
        test.upload("table/preset.pr", PRESETS)

    def value(self, name, *blocks, machine=None):
        run = self.run_program(self.upload_program("read", *blocks), {"machine": machine or {}})
        self.assertEqual(run["status"], "completed", run["messages"])
        return run["parameters"][name]

    def test_length_and_radius_of_a_tool(self):
        self.assertEqual(self.value("Q1", "TOOL CALL 5 Z", "Q1 = Q114"), 92.5)
        self.assertEqual(self.value("Q1", 'TOOL CALL "mill_d8" Z', "Q1 = Q108"), 4)
        self.assertEqual(self.value("Q1", "FN 18: SYSREAD Q1 = ID50 NR1 IDX30"), 150.25)

    def test_locked_and_missing_tools_are_refused(self):
        for tool in (6, 7):
            run = self.run_program(self.upload_program("call", f"TOOL CALL {tool} Z"))
            self.assertEqual(run["status"], "failed")
            self.assertIn(f"tool {tool}", run["messages"][-1]["text"])

    def test_touch_probe_moves_as_its_row_says(self):
        run = self.run_program(self.upload_program("touch", *TOUCH), {"workpiece": FACE})
        self.assertEqual(run["status"], "completed", run["messages"])
        self.assertEqual(run["parameters"]["Q160"], 0.125)
        moves = self.daemon.get(f"/v1/runs/{run['id']}/trace").json["moves"]
        probing = next(move for move in moves if move["kind"] == "probe")
        self.assertEqual(probing["feed_mm_min"], 300)
        # From SET_UP + Q320 above the point, the nose a tool length higher.
        self.assertAlmostEqual(probing["start_mm"]["Z"], 4 + 1, places=6)

    def test_presets_by_number(self):
        self.assertEqual(self.value("Q1", "CYCL DEF 247 PRESETTING ~\n Q339=+5",
                                    "FN 18: SYSREAD Q1 = ID220 NR3 IDX1"), -100.5)
        self.assertEqual(self.value("Q1", "FN 18: SYSREAD Q1 = ID503 NR5 IDX3"), 7.25)
        self.assertEqual(self.value("Q1", "FN 18: SYSREAD Q1 = ID220 NR3 IDX2",
                                    machine={"active_preset": 5}), 20)

    def test_datum_table(self):
        self.upload("zero.d", DATUMS)
        blocks = ("SEL TABLE \"zero.d\"", "CYCL DEF 7.0 DATUM SHIFT", "CYCL DEF 7.1 #2")
        self.assertEqual(self.value("Q1", *blocks, "FN 18: SYSREAD Q1 = ID220 NR2 IDX1"), 12.5)
        self.assertEqual(self.value("Q1", *blocks, "FN 18: SYSREAD Q1 = ID220 NR2 IDX2"), -3)

    def test_setup_goes_before_the_file(self):
        tools = {"tools": [{"number": 30, "length_mm": 99, "radius_mm": 1, "probe": 2}]}
        self.assertEqual(self.value("Q1", "TOOL CALL 30 Z", "Q1 = Q114", machine=tools), 99)
        self.assertEqual(self.value("Q1", "TOOL CALL 5 Z", "Q1 = Q114", machine=tools), 92.5)
        presets = {"presets": [{"number": 5, "x_mm": 1}], "active_preset": 5}
        self.assertEqual(self.value("Q1", "FN 18: SYSREAD Q1 = ID220 NR3 IDX1", machine=presets), 1)

    def test_named_setup_may_use_rows_of_the_file(self):
        self.assertEqual(self.daemon.request("PUT", "/v1/setups/vice",
                                             {"machine": {"active_preset": 5}}).status, 201)
        self.assert_problem(self.daemon.request("PUT", "/v1/setups/none",
                                                {"machine": {"active_preset": 6}}),
                            422, "request.invalid")

    def test_what_a_run_changes_stays_in_the_run(self):
        self.assertEqual(self.value("Q1", "FN 17: SYSWRITE ID50 NR1 IDX5 = +10",
                                    "FN 18: SYSREAD Q1 = ID50 NR1 IDX5"), 10)
        self.assertEqual(self.value("Q1", "FN 18: SYSREAD Q1 = ID50 NR1 IDX5"), 92.5)
        self.assertEqual(self.daemon.get("/v1/files/table/tool.t").text, TOOLS)


class BadMachineTable(ControlTest):
    def test_table_that_cannot_be_read_is_named_with_its_line(self):
        program = self.upload_program("nothing", "Q1 = 1")
        self.upload("table/tool.t", TOOLS.replace("[END]\n", ""))
        problem = self.assert_problem(self.post_run(program), 422, "table.malformed")
        self.assertIn("TNC:\\table\\tool.t: line 6", problem["detail"])
        self.upload("table/tool.t", TOOLS.replace("+92.5", "long "))
        problem = self.assert_problem(self.post_run(program), 422, "table.malformed")
        self.assertIn("row 5, column L", problem["detail"])
        # Probe 2 is nowhere.
        self.upload("table/tool.t", TOOLS)
        problem = self.assert_problem(self.post_run(program), 422, "table.malformed")
        self.assertIn("row 30, probe: probe not found: 2", problem["detail"])
        self.daemon.request("DELETE", "/v1/files/table/tool.t")
        self.assertEqual(self.run_program(program)["status"], "completed")
