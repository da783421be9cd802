"""Programs that cannot run say so with file, line and block; the service stays responsive."""

import os
import pathlib
import threading
import unittest

from support.control import ControlTest
from support.daemon import TRACEABLE
from support.tracing import attach, can_trace
from support.waiting import wait_for


class BadInput(ControlTest):
    def refused(self, name, *blocks):
        """The errors a program is refused with."""
        answer = self.post_run(self.upload_program(name, *blocks))
        problem = self.assert_problem(answer, 422, "program.invalid")
        errors = [found for found in problem["diagnostics"] if found["severity"] == "error"]
        for found in errors:
            self.assertEqual(found["program"], f"TNC:\\{name}.h")
            self.assertGreater(found["line"], 0)
            self.assertGreater(found["column"], 0)
        self.assertTrue(errors, answer)
        return errors

    def fails(self, name, *blocks, status="failed", **order):
        """The message a run ends with."""
        run = self.run_program(self.upload_program(name, *blocks), **order)
        self.assertEqual(run["status"], status, run)
        message = run["messages"][-1]
        self.assertTrue(message["program"].startswith("TNC:\\"), message)
        self.assertGreater(message["line"], 0)
        self.assertIsNotNone(message["block"])
        return message

    def test_unknown_label(self):
        found = self.refused("jump", "FN 9: IF +1 EQU +1 GOTO LBL 7")
        self.assertEqual((found[0]["code"], found[0]["line"], found[0]["block"]),
                         ("label.unknown", 2, 1))

    def test_duplicate_label(self):
        self.assertEqual(self.refused("twice", "LBL 1", "LBL 1")[0]["code"], "label.duplicate")

    def test_all_errors_of_a_file_at_once(self):
        found = self.refused("many", "GARBAGE HERE", "Q1 = (", "CALL LBL 9")
        self.assertEqual([entry["block"] for entry in found], [1, 2, 3])

    def test_missing_program(self):
        message = self.fails("caller", "CALL PGM nowhere")
        self.assertEqual((message["line"], message["block"]), (2, 1))

    def test_missing_table_row_and_column(self):
        self.upload("small.tab", "BEGIN small .TAB MM\nNR      X\n0       +1\n[END]\n")
        self.fails("notable", "FN 26: TABOPEN missing.tab")
        self.fails("norow", "FN 26: TABOPEN small.tab", 'FN 28: TABREAD Q1 = 5/"X"')
        self.fails("nocolumn", "FN 26: TABOPEN small.tab", 'FN 28: TABREAD Q1 = 0/"Y"')

    def test_table_without_end(self):
        self.upload("open.tab", "BEGIN open .TAB MM\nNR      X\n0       +1\n")
        self.fails("openended", "FN 26: TABOPEN open.tab")
        answer = self.daemon.request("POST", "/v1/files/open.tab?action=check")
        found, = answer.json["diagnostics"]
        self.assertEqual((found["severity"], found["program"], found["line"]),
                         ("error", "TNC:\\open.tab", 3))

    def test_unknown_cycle_and_m_function_fail_when_they_are_reached(self):
        self.assertIn("586", self.fails("oem", "TOOL CALL 30 Z", "TCH PROBE 586 UNKNOWN")["text"])
        self.assertIn("M987", self.fails("builder", "L M987")["text"])
        path = self.upload_program("passed", "FN 9: IF +1 EQU +1 GOTO LBL 1",
                                   "L M987", "LBL 1")
        self.assertEqual(self.run_program(path)["status"], "completed")

    def test_division_by_zero_and_undefined_parameter(self):
        self.fails("zero", "Q1 = 0", "Q2 = 1 / Q1")
        self.assertIn("Q77", self.fails("undefined", "Q1 = Q77 + 1")["text"])

    def test_recursion_without_end(self):
        self.assertEqual(self.fails("selfish", "CALL PGM selfish")["number"], 1025)

    def test_endless_loop_ends_at_its_budget_while_others_are_served(self):
        loop = self.upload_program("forever", "LBL 1", "FN 9: IF +1 EQU +1 GOTO LBL 1")

        def served():
            """How often others are served during a run: once, if they wait for its end."""
            answer = self.post_run(loop, headers={"Prefer": "respond-async"},
                                   limits={"blocks": 100_000_000, "seconds": 5})
            self.assertEqual(answer.status, 202)
            count = 0
            while (run := self.daemon.get(answer.headers["location"]).json)["status"] in ("queued", "running"):
                self.assertEqual(self.daemon.get("/v1/limits/25H7").status, 200)
                count += 1
            self.assertEqual(run["status"], "limit_exceeded")
            self.assertEqual(run["messages"][-1]["kind"], "limit")
            return count
        # A machine that stands still during one run serves during another.
        wait_for(lambda: served() > 3, "others that are served meanwhile")

    def test_string_of_256_characters(self):
        self.refused("long", f'QS1 = "{"x" * 256}"')
        answer = self.post_run(self.upload_program("short", "Q1 = 1"),
                               parameters={"QS1": "x" * 256})
        entry = self.assert_problem(answer, 422, "request.invalid")["errors"][0]
        self.assertEqual((entry["pointer"], entry["code"]), ("/parameters/QS1", "field.too_long"))
        half = "x" * 128
        self.assertIn("255", self.fails("joined", f'QS1 = "{half}"', "QS2 = QS1 || QS1")["text"])

    def test_binary_garbage(self):
        self.upload("noise.h", bytes(range(256)) * 64)
        self.upload("zeros.h", bytes(100_000))
        for name in ("noise.h", "zeros.h"):
            problem = self.assert_problem(self.post_run(f"TNC:\\{name}"), 422, "program.invalid")
            self.assertTrue(all(found["line"] > 0 for found in problem["diagnostics"]))

    def test_path_out_of_the_disk(self):
        self.fails("escape", "CALL PGM ..\\..\\..\\etc\\passwd")
        self.assert_problem(self.post_run("TNC:\\..\\..\\etc\\passwd"), 422, "request.invalid")
        self.assert_problem(self.daemon.get("/v1/files/../../etc/passwd"), 400,
                            "file.path_invalid")

    def test_a_blank_around_a_name_is_not_dropped(self):
        for path in ("trimmed.h%20", "%20trimmed.h", "trimmed.h%09", "a%20/trimmed.h", "a/%20trimmed.h", "a%5C%20trimmed.h"):
            for method in ("PUT", "GET"):
                answer = self.daemon.request(method, f"/v1/files/{path}", b"0" if method == "PUT" else None)
                self.assert_problem(answer, 400, "file.path_invalid")
        self.assertEqual(self.daemon.get("/v1/files?prefix=trimmed").json["files"], [])
        self.assertEqual(self.daemon.request("PUT", "/v1/files/not%20trimmed.h", b"0").status, 201)

    def test_program_of_50_megabytes(self):
        connection = self.daemon.connect()
        connection.putrequest("PUT", "/v1/files/huge.h")
        connection.putheader("Content-Length", str(50 << 20))
        connection.endheaders()
        self.assertEqual(connection.getresponse().status, 413)
        connection.close()

    def test_program_of_8_megabytes_is_checked_while_others_are_served(self):
        blocks = "".join(f"L X+{n % 100}.500000 Y-{n % 90}.000000 F500\n" for n in range(260_000))
        self.upload("large.h", f"BEGIN PGM large MM\n{blocks}CALL LBL 1\nEND PGM large MM\n")
        checked = threading.Thread(target=lambda: answers.append(self.post_run("TNC:\\large.h")))
        answers = []
        checked.start()
        served = 0
        while checked.is_alive():
            self.assertEqual(self.daemon.get("/v1/limits/25H7").status, 200)
            served += 1
        self.assertGreater(served, 3)
        problem = self.assert_problem(answers[0], 422, "program.invalid")
        self.assertEqual(problem["diagnostics"][0]["line"], 260_002)

    def test_program_that_takes_too_much_memory_says_where_and_what_to_do(self):
        blocks = "".join(f"L X+{n % 100}.5 Y-{n % 90} F500\n" for n in range(400_000))
        self.upload("larger.h", f"BEGIN PGM larger MM\n{blocks}END PGM larger MM\n")
        found, = self.assert_problem(self.post_run("TNC:\\larger.h"), 422, "program.invalid")["diagnostics"]
        self.assertIn("split it", found["message"])
        self.assertTrue(380_000 < found["line"] < 400_000, found)

    def test_unknown_program(self):
        self.assert_problem(self.post_run("TNC:\\nothing.h"), 422, "program.unknown")


@unittest.skipUnless(can_trace(), "needs strace and the right to trace")
class HostFiles(ControlTest):
    PATHS = ("..\\..\\..\\etc\\passwd", "TNC:\\..\\..\\etc\\passwd", "/etc/passwd", "C:\\x.h",
             "..\\secret.a", "TNC:\\etc\\passwd")
    environment = TRACEABLE

    def test_no_path_of_a_program_opens_a_file_of_the_host(self):
        self.daemon.get("/v1/limits/25H7")
        trace = self.daemon.folder / "trace"
        attach(self, self.daemon, "-o", trace, "-e", "trace=%file,fdatasync")
        self.upload("say.a", '"X";\n')
        for n, path in enumerate(self.PATHS):
            for block in (f"CALL PGM {path}", f'SEL PGM "{path}"\nCALL SELECTED PGM',
                          f"FN 26: TABOPEN {path}", f"FN 16: F-PRINT {path} / SCREEN:",
                          f"FN 16: F-PRINT say.a / {path}", f'SEL TABLE "{path}"'):
                self.post_run(self.upload_program(f"path{n}", block))
        self.assertIn("fdatasync", trace.read_text(), "nothing was traced")
        opened = [line.split('"')[1] for line in trace.read_text().splitlines() if '"' in line]
        data = str(self.daemon.data)
        # To look at a descriptor names no file.
        outside = [name for name in opened
                   if name and not name.startswith(data) and name != os.environ.get("SLOW_DISK")]
        self.assertEqual(outside, [])
        self.assertFalse(list(pathlib.Path(self.daemon.folder).rglob("passwd*")))
