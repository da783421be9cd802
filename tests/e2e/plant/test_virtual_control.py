"""The virtual control over LSV-2: files, machine and refusals as its wire facts have them."""

import random
import struct
import unittest

from support.daemon import Daemon, DaemonTest
from support.lsv2 import Client, Refused, control_port, served, telegram, text, turned_away
from support.waiting import PATIENCE, wait_for

WRITABLE = ("--control-listen", "127.0.0.1:0", "--control-write")
LOOP = ("BEGIN PGM LOOP MM\nTOOL CALL 30 Z\nLBL 2\nLBL 1\nL X+10 Y+20 R0 FMAX\nL X-10 R0 F500\n"
        "CALL LBL 1 REP 1000\nFN 9: IF +0 EQU +0 GOTO LBL 2\nEND PGM LOOP MM\n")
# Prints a log, closes it, and goes on for ever.
LOGGING = ('BEGIN PGM LOGS MM\nQ1 = 25.013\nFN 16: F-PRINT TNC:\\nc_prog\\LINE.A / TNC:\\nc_prog\\OUT.TXT\n'
           "LBL 1\nL Z+100 R0 FMAX\nL Z+90 R0 FMAX\nFN 9: IF +0 EQU +0 GOTO LBL 1\nEND PGM LOGS MM\n")
MASK = '"DIAMETER %8.3f", Q1;\nM_CLOSE;\n'


class ControlTest(DaemonTest):
    def client(self, *logins):
        client = Client(control_port(self.daemon))
        self.addCleanup(client.close)
        return client.login(*logins)

    def assert_refused(self, code, client, name, payload=b""):
        with self.assertRaises(Refused) as refused:
            client.ask(name, payload)
        self.assertEqual(refused.exception.code, code)


class Writable(ControlTest):
    flags = WRITABLE

    def test_its_files_are_those_of_http(self):
        content = bytes(random.Random(1).randbytes(100_000))
        client = self.client("FILE")
        self.assertEqual(client.upload("TNC:\\a.bin", b"short"), ("T_OK", b""))
        client.agree_buffer()
        client.upload("TNC:\\b.bin", content)
        self.assertEqual(self.daemon.get("/v1/files/b.bin").body, content)
        self.assertEqual(client.download("TNC:/B.BIN"), content)
        self.daemon.request("PUT", "/v1/files/nc_prog/h.h", b"BEGIN PGM H MM\r\nEND PGM H MM\n")
        self.assertEqual(client.download("TNC:\\nc_prog\\h.h", mode=0),
                         b"BEGIN PGM H MM\0END PGM H MM\0")
        client.upload("TNC:\\nc_prog\\h.h", b"BEGIN PGM H MM\0END PGM H MM\0", mode=0)
        self.assertEqual(self.daemon.get("/v1/files/nc_prog/h.h").body,
                         b"BEGIN PGM H MM\nEND PGM H MM\n")
        client.ask("C_FD", text("TNC:\\b.bin"))
        self.assertEqual(self.daemon.get("/v1/files/b.bin").status, 404)
        self.assert_refused(32, client, "R_FL", text("TNC:\\b.bin") + b"\1")
        self.assert_refused(32, client, "R_FI", text("TNC:\\b.bin"))

    def test_it_brings_its_own_files_and_the_examples(self):
        client = self.client("FILE")
        self.assertLessEqual({"nc_prog", "table"}, set(client.listing("TNC:\\")))
        self.assertIn("$mdi.h", client.listing("TNC:\\nc_prog"))
        self.assertEqual(set(client.listing("8255")), {"8255.h", "82551.h", "82552.a"})
        self.assertIn(b"PROBE", client.download("TNC:\\table\\tool.t"))
        run = self.daemon.post("/v1/runs", {"program": "nc_prog/$mdi.h"}).json
        self.assertEqual(run["status"], "completed", run)

    def test_directories_are_made_changed_and_deleted(self):
        client = self.client("FILE")
        self.assert_refused(55, client, "C_DM", text("TNC:\\no\\such"))
        client.ask("C_DM", text("TNC:\\new\\"))
        client.ask("C_DM", text("TNC:\\new\\er"))
        self.assertEqual(client.listing("TNC:\\NEW"), {"er": (0, 0x20)})
        self.assert_refused(36, client, "C_DD", text("TNC:\\new"))  # it is in it
        client.ask("C_DC", text("TNC:\\"))
        self.assert_refused(54, client, "C_DD", text("TNC:\\new"))
        self.assert_refused(36, client, "C_DD", text("TNC:\\nc_prog"))
        client.ask("C_DC", text("TNC:\\NEW"))
        client.ask("C_DC", text("er"))
        free, path = struct.unpack("!L160x", client.ask("R_DI")[1][:164])[0], client.ask("R_DI")[1][164:]
        self.assertGreater(free, 0)
        self.assertEqual(path, b"TNC:\\NEW\\er\\\0")
        self.assert_refused(36, client, "C_DD", text("TNC:\\new\\er"))
        client.ask("C_DC", text("TNC:\\"))
        client.ask("C_DD", text("TNC:\\new\\er"))
        client.ask("C_DD", text("TNC:\\new"))
        self.assert_refused(55, client, "C_DC", text("TNC:\\new"))

    def test_files_are_copied_and_renamed(self):
        client = self.client("FILE")
        client.upload("TNC:\\nc_prog\\one.h", b"1")
        client.ask("C_DC", text("TNC:\\nc_prog"))
        client.ask("C_FC", text("one.h") + text("TNC:\\nc_prog\\two.h"))
        self.assert_refused(34, client, "C_FC", text("one.h") + text("two.h"))
        self.assert_refused(34, client, "C_FR", text("one.h") + text("two.h"))
        self.assert_refused(32, client, "C_FR", text("none.h") + text("x.h"))
        self.assert_refused(55, client, "C_FC", text("one.h") + text("TNC:\\none\\x.h"))
        client.ask("C_FR", text("one.h") + text("three.h"))
        names = client.listing("TNC:\\nc_prog")
        self.assertNotIn("one.h", names)
        self.assertEqual(client.download("three.h") + client.download("two.h"), b"11")

    def test_no_path_leaves_the_disk(self):
        client = self.client("FILE")
        for path in ("TNC:\\..\\x", "PLC:\\x", "C:\\x", "/etc/passwd", "..\\..\\etc\\passwd", ""):
            with self.subTest(path), self.assertRaises(Refused):
                client.ask("R_FL", text(path) + b"\1")
            with self.subTest(path), self.assertRaises(Refused):
                client.ask("C_DC", text("TNC:\\no" + path))

    def test_a_program_runs_and_the_machine_is_seen(self):
        self.daemon.request("PUT", "/v1/files/nc_prog/loop.h", LOOP.encode())
        client = self.client("INSPECT", "DNC", "PLCDEBUG")
        client.ask("C_MC", b"\0\0\0\1" + text("Fitgauge.program") + text("TNC:\\nc_prog\\loop.h"))
        wait_for(lambda: client.state() == 0)
        self.assertEqual(client.info(23), b"\0\4")  # automatic
        stack = client.info(24)
        self.assertEqual(stack[4:], text("TNC:\\nc_prog\\loop.h") * 2)
        self.assertIn(wait_for(lambda: struct.unpack("!L", client.info(24)[:4])[0]), range(1, 9))
        axes = wait_for(lambda: (found := client.info(22))[2:4] in (b"10", b"-1") and found)
        self.assertEqual(axes[:2], b"\0\3")
        self.assertEqual(axes.split(b"\0")[-4:], [b"X", b"Y", b"Z", b""])
        self.assertEqual(axes[2:].split(b"\0")[1], b"20.0000")
        self.assertEqual(struct.unpack("!3L", client.info(25)), (10000, 10000, 10000))
        self.assert_refused(56, client, "C_MC",
                            b"\0\0\0\1" + text("Fitgauge.program") + text("TNC:\\nc_prog\\loop.h"))
        client.ask("C_MC", b"\0\0\0\1" + text("Fitgauge.program") + text(""))
        wait_for(lambda: client.state() == 3)  # cancelled
        self.assert_refused(57, client, "R_RI", struct.pack("!H", 27))
        self.assert_refused(32, client, "C_MC",
                            b"\0\0\0\1" + text("Fitgauge.program") + text("TNC:\\none.h"))

    def test_the_errors_of_a_program_are_read(self):
        self.daemon.request("PUT", "/v1/files/nc_prog/bad.h",
                            b"BEGIN PGM BAD MM\nTOOL CALL 99 Z\nEND PGM BAD MM\n")
        client = self.client("DNC", "PLCDEBUG")
        client.ask("C_MC", b"\0\0\0\1" + text("Fitgauge.program") + text("TNC:\\nc_prog\\bad.h"))
        wait_for(lambda: client.state() == 5)
        self.assertIn(b"tool 99", client.info(27))
        self.assert_refused(57, client, "R_RI", struct.pack("!H", 28))

    def test_a_log_is_fetched_while_its_program_runs(self):
        self.daemon.request("PUT", "/v1/files/nc_prog/line.a", MASK.encode())
        self.daemon.request("PUT", "/v1/files/nc_prog/logs.h", LOGGING.encode())
        client = self.client("FILE", "DNC", "PLCDEBUG")
        client.ask("C_MC", b"\0\0\0\1" + text("Fitgauge.program") + text("TNC:\\nc_prog\\logs.h"))
        wait_for(lambda: "OUT.TXT" in client.listing("TNC:\\nc_prog"))
        self.assertEqual(client.state(), 0)
        self.assertEqual(client.download("TNC:\\nc_prog\\out.txt"), b"DIAMETER   25.013\n")
        self.assertEqual(self.daemon.get("/v1/files/nc_prog/out.txt").status, 404)
        client.ask("C_MC", b"\0\0\0\1" + text("Fitgauge.program") + text(""))
        wait_for(lambda: client.state() == 3)
        wait_for(lambda: self.daemon.get("/v1/files/nc_prog/out.txt").status == 200)
        client.ask("C_FD", text("TNC:\\nc_prog\\out.txt"))
        self.assertNotIn("OUT.TXT", client.listing("TNC:\\nc_prog"))

    def test_logins_open_their_telegrams(self):
        client = self.client()
        for name, payload in (("R_VR", b""), ("R_PR", b""), ("R_DI", b""), ("R_RI", b"\0\x16"),
                              ("R_MB", b"\0\0\0\0\1"), ("C_EK", b"\1\xC0"), ("C_LK", b"\1")):
            with self.subTest(name):
                self.assert_refused(23, client, name, payload)
        self.assert_refused(49, client, "A_LG", text("FILEPLC"))
        self.assert_refused(49, client, "A_LG", text("FILEPLC") + text("wrong"))
        client.ask("A_LG", text("FILEPLC") + text("807667"))
        client.login("INSPECT", "PLCDEBUG")
        self.assertTrue(client.ask("R_VR")[1].startswith(b"TNC640\x00340595 08 SP1\0"))
        self.assertEqual(len(client.ask("R_PR")[1]), 120)
        self.assertEqual(client.ask("R_MB", b"\0\0\x80\0\4")[1], b"\0\0\0\0")
        self.assert_refused(52, client, "R_MB", b"\xFF\xFF\xFF\xFF\4")
        client.ask("A_LO")
        self.assert_refused(23, client, "R_PR")

    def test_telegrams_out_of_order_are_refused(self):
        client = self.client("FILE")
        for name in ("T_OK", "T_FD", "S_FL"):
            self.assert_refused(21, client, name)
        self.assert_refused(22, client, "C_TP")
        self.assert_refused(20, client, "R_FI", b"no end")
        client.ask("C_FL", text("TNC:\\x") + b"\1")
        client.ask("R_DI")
        self.assert_refused(21, client, "S_FL", b"late")
        self.assertEqual(self.daemon.get("/v1/files/x").status, 404)


class ReadOnly(ControlTest):
    flags = ("--control-listen", "127.0.0.1:0", "--control-model", "iTNC530")

    def test_nothing_is_changed(self):
        client = self.client("FILE", "MONITOR", "PLCDEBUG", "DNC")
        self.assertIn("$MDI.H", client.listing("TNC:\\"))
        before = self.daemon.get("/v1/files").json
        for name, payload in (
                ("C_FL", text("TNC:\\x") + b"\1"), ("C_FD", text("TNC:\\TOOL.T")),
                ("C_FC", text("TOOL.T") + text("TNC:\\x")), ("C_FR", text("TOOL.T") + text("TNC:\\x")),
                ("C_DM", text("TNC:\\x")), ("C_DD", text("TNC:\\nc_prog\\8255")),
                ("C_CC", struct.pack("!H", 12) + text("TNC:\\x.bmp")), ("C_EK", b"\1\xC0"),
                ("C_LK", b"\1"), ("C_MC", b"\0\0\0\0" + text("7230.0") + text("1")),
                ("C_MC", b"\0\0\0\0" + text("Fitgauge.program") + text("TNC:\\nc_prog\\8255\\8255.h"))):
            with self.subTest(name):
                self.assert_refused(59, client, name, payload)
        self.assertEqual(self.daemon.get("/v1/files").json, before)
        self.assertEqual(len(client.info(51)), 24)

    def test_a_thousand_clients_and_broken_telegrams(self):
        """Beyond a hundred a client is closed at once; what is no telegram ends its connection."""
        port = control_port(self.daemon)
        clients = [served(port) for _ in range(100)]
        try:
            self.assertEqual(set(turned_away(port, 900)), {None})
            for index, client in enumerate(clients):
                broken = (b"\xFF\xFF\xFF\xFFA_LG", b"GET / HTTP/1.1\r\n\r\n", b"\0\0\0\1r_vr\0",
                          b"\0\0\1\0A_LG")[index % 4]
                client.socket.sendall(broken)
                self.assertIsNone(client.read())
        finally:
            for client in clients:
                client.close()
        served(port).close()
        self.assertEqual(self.daemon.get("/livez").status, 200)

    def test_random_telegrams_are_all_answered(self):
        noise = random.Random(3)
        names = ["A_LG", "A_LO", "R_VR", "R_PR", "R_CI", "C_CC", "C_DC", "R_DI", "R_FI", "R_DR", "C_DM",
                 "C_DD", "C_FD", "C_FC", "C_FR", "C_FL", "R_FL", "S_FL", "T_OK", "R_RI", "R_MB", "R_MC",
                 "C_MC", "C_LK", "C_EK", "R_DP", "X_YZ"]
        client = self.client("INSPECT", "FILE", "DNC", "MONITOR", "PLCDEBUG", "DATA")
        for _ in range(5_000):
            payload = noise.randbytes(noise.choice((0, 1, 2, 4, 5, 9, 40, 200)))
            if noise.random() < 0.5:
                payload = text("TNC:\\") + payload[:1]
            client.socket.sendall(telegram(noise.choice(names), payload))
            self.assertIsNotNone(client.read())


class Settings(unittest.TestCase):
    def test_an_unknown_model_ends_the_start(self):
        daemon = Daemon("--control-listen", "127.0.0.1:0", "--control-model", "TNC9")
        self.addCleanup(daemon.cleanup)
        self.assertEqual(daemon.spawn().process.wait(PATIENCE), 2)
        self.assertIn("control-model must be one of: TNC640", daemon.log)

    def test_the_end_of_the_service_waits_for_no_long_trace(self):
        daemon = Daemon(*WRITABLE)
        self.addCleanup(daemon.cleanup)
        daemon.start()
        daemon.request("PUT", "/v1/files/nc_prog/loop.h", LOOP.encode())
        with Client(control_port(daemon)) as client:
            client.login("DNC", "PLCDEBUG")
            client.ask("C_MC", b"\0\0\0\1" + text("Fitgauge.program") + text("TNC:\\nc_prog\\loop.h"))
            run = wait_for(lambda: daemon.get("/v1/runs?limit=1").json["runs"])[0]["id"]
            wait_for(lambda: daemon.get(f"/v1/runs/{run}").json["blocks_executed"] > 10_000)
        self.assertEqual(daemon.stop(), 0)
        daemon.start()
        trace = daemon.get(f"/v1/runs/{run}/trace").json
        self.assertGreater(len(trace["moves"]), 1000)
        self.assertEqual(daemon.stop(), 0)

    def test_the_machine_is_that_of_the_setup(self):
        daemon = Daemon("--control-listen", "127.0.0.1:0", "--control-setup", "cell-3")
        self.addCleanup(daemon.cleanup)
        daemon.start()
        daemon.wait_for_log("control_setup_unusable")
        setup = {"machine": {"start_mm": {"X": 12.5, "Y": -3, "Z": 250}}}
        self.assertEqual(daemon.request("PUT", "/v1/setups/cell-3", setup).status, 201)
        self.assertEqual(daemon.stop(), 0)
        daemon.start()
        with Client(control_port(daemon, starts=2)) as client:
            axes = client.login("DNC").info(22)
        self.assertEqual(axes, b"\0\3" b"12.5000\0-3.0000\0" b"250.0000\0X\0Y\0Z\0")
        self.assertEqual(daemon.stop(), 0)


if __name__ == "__main__":
    unittest.main()
