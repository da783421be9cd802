"""What programs of many shops write, over HTTP: the builder's functions, unreadable lines, formatting, notes."""

import unittest

from support.control import ControlTest


class Language(ControlTest):
    def ends(self, name, *blocks, status="completed", **order):
        run = self.run_program(self.upload_program(name, *blocks), **order)
        self.assertEqual(run["status"], status, run["messages"])
        return run

    def test_the_builders_functions_are_data_of_the_setup(self):
        blocks = ("L X+1 FMAX M55", "CYCL DEF 392 ATC Q240=+7")
        run = self.ends("oem", *blocks, status="failed")
        message = run["messages"][-1]
        self.assertIn('"m_functions":{"55":"ignore"}', message["text"])
        self.assertEqual((message["column"], message["source"]), (1, "1 L X+1 FMAX M55"), message)
        setup = {"m_functions": {"55": "ignore"}, "cycles": {"392": "ignore"}}
        self.ends("oem", *blocks, setup=setup)
        self.ends("oem", *blocks, setup={"machine": setup})
        self.upload_program("m25", "Q9 = 4")
        call = {"m_functions": {"25": {"call": "TNC:\\m25.h"}}}
        self.assertEqual(self.ends("calls", "L X+1 FMAX M25", setup=call)["parameters"]["Q9"], 4)
        self.assertEqual(self.daemon.request("PUT", "/v1/setups/oem", setup).status, 201)
        self.ends("oem", *blocks, setup="oem")

    def test_a_table_that_makes_no_sense_is_refused(self):
        path = self.upload_program("empty")
        bad = {"m_functions": {"3": "ignore", "x": "ignore", "55": "skip"}, "cycles": {"200": "ignore"},
               "decimal_separator": "dot", "fn16_default_path": "C:\\logs"}
        found = {e["pointer"] for e in
                 self.assert_problem(self.post_run(path, setup=bad), 422, "request.invalid")["errors"]}
        self.assertEqual(found, {"/setup/m_functions/3", "/setup/m_functions/x", "/setup/m_functions/55",
                                 "/setup/cycles/200", "/setup/decimal_separator", "/setup/fn16_default_path"})

    def test_an_unreadable_line_may_wait_until_it_is_reached(self):
        path = self.upload_program("torn", "Q1 = 1", "CYCLE DEF 9.0", "Q1 = 2")
        problem = self.assert_problem(self.post_run(path), 422, "program.invalid")
        self.assertIn("did you mean CYCL?", problem["diagnostics"][0]["message"])
        run = self.run_program(path, unreadable="error_block")
        self.assertEqual((run["status"], run["parameters"]["Q1"]), ("failed", 1), run)
        self.assert_problem(self.post_run(path, unreadable="no"), 422, "request.invalid")

    def test_a_finding_names_the_other_place(self):
        path = self.upload_program("twice", "LBL 5", "LBL 5")
        found = self.assert_problem(self.post_run(path), 422, "program.invalid")["diagnostics"][0]
        self.assertEqual(found["notes"], [{"message": "label 5 is also in line 2", "line": 2, "column": 1}])

    def test_format_tidies_and_renumbers(self):
        self.upload("loose.h", "BEGIN PGM LOOSE MM\n7 L   x+1,5 y2  fmax ; text\n12 CYCL DEF9 .0\nEND PGM LOOSE MM\n")
        answer = self.daemon.request("POST", "/v1/files/loose.h?action=format")
        self.assertEqual(answer.status, 200, answer.text)
        self.assertEqual(answer.text, "0 BEGIN PGM LOOSE MM\n1 L X+1.5 Y+2 FMAX ; text\n2 CYCL DEF 9.0\n"
                                      "3 END PGM LOOSE MM\n")
        self.upload("bad.h", "BEGIN PGM B MM\nRUBBISH\nEND PGM B MM\n")
        self.assert_problem(self.daemon.request("POST", "/v1/files/bad.h?action=format"), 422, "program.invalid")
        self.assert_problem(self.daemon.request("POST", "/v1/files/none.h?action=format"), 404, "file.unknown")

    def test_machining_cycles_are_described(self):
        cycles = self.daemon.get("/v1/cycles").json["cycles"]
        numbers = {(cycle["family"], cycle["number"]) for cycle in cycles}
        wanted = [*range(1, 6), 14, 17, 18, *range(20, 25), *range(200, 210), 220, 221, 225, 251, 252, 253, 254,
                  262, 263, 264, 265, 267]
        self.assertTrue({("CYCL DEF", number) for number in wanted} <= numbers)
        self.assertEqual(self.daemon.get("/v1/cycles/208").json["kind"], "machining")


if __name__ == "__main__":
    unittest.main()
