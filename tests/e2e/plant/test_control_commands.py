"""fitgauge control: a control over LSV-2 from the command line, against the virtual control."""

import json
import re
import socket
import struct
import threading
import unittest

from support.cli import Client, ClientTest
from support.lsv2 import control_port, telegram, text
from support.waiting import wait_for

LOOP = "BEGIN PGM LOOP MM\nLBL 1\nL X+10 R0 FMAX\nL X-10 R0 F500\nFN 9: IF +0 EQU +0 GOTO LBL 1\nEND PGM LOOP MM\n"


class Commands(ClientTest):
    flags = ("--control-listen", "127.0.0.1:0", "--control-write")

    def setUp(self):
        super().setUp()
        self.control = f"127.0.0.1:{control_port(self.daemon)}"

    def run_control(self, *arguments, **named):
        return self.assert_runs(0, "control", arguments[0], self.control, *arguments[1:], **named)

    def test_files_go_both_ways(self):
        program = "BEGIN PGM UP MM\r\nEND PGM UP MM\r\n"
        content = bytes(range(256)) * 300
        self.client.write("up.h", program)
        (self.client.folder / "up.bin").write_bytes(content)
        self.assertIn("TNC:\\nc_prog\\up.h  32 bytes\n", self.run_control("put", "up.h", "up.bin", "TNC:/nc_prog/"))
        self.assertEqual(self.daemon.get("/v1/files/nc_prog/up.bin").body, content)
        self.assertEqual(self.daemon.get("/v1/files/nc_prog/up.h").text, program.replace("\r", ""))
        self.run_control("get", "TNC:\\nc_prog\\up.bin", "back.bin")
        self.assertEqual((self.client.folder / "back.bin").read_bytes(), content)
        self.assertEqual(self.run_control("get", "nc_prog/up.h", "-"), program.replace("\r", ""))

    def test_nothing_is_replaced_unasked(self):
        self.client.write("one.txt", "1\n")
        self.client.write("two.txt", "2\n")
        self.run_control("put", "one.txt", "TNC:\\same.txt")
        self.assertIn("--force replaces it", self.assert_fails(7, "control", "put", self.control, "two.txt",
                                                               "TNC:\\same.txt"))
        self.assertEqual(self.daemon.get("/v1/files/same.txt").text, "1\n")
        self.run_control("put", "--force", "two.txt", "TNC:\\same.txt")
        self.assertEqual(self.daemon.get("/v1/files/same.txt").text, "2\n")
        self.assert_fails(5, "control", "get", self.control, "TNC:\\same.txt", "one.txt")
        self.run_control("get", "--force", "TNC:\\same.txt", "one.txt")
        self.assertEqual((self.client.folder / "one.txt").read_text(), "2\n")

    def test_a_folder_is_listed(self):
        listed = self.run_control("ls", "TNC:\\nc_prog")
        self.assertRegex(listed, r"(?m)^ +\d+  20\d\d-\S+Z  \$mdi\.h$")
        self.assertRegex(listed, r"(?m)  8255\\$")
        entries = json.loads(self.run_control("ls", "nc_prog/8255", "--json"))["entries"]
        self.assertEqual({entry["name"] for entry in entries}, {"8255.h", "82551.h", "82552.a"})
        self.assertIn("directory not found", self.assert_fails(7, "control", "ls", self.control, "TNC:\\none"))

    def test_a_program_runs_to_its_end(self):
        self.client.write("good.h", "BEGIN PGM GOOD MM\nQ1 = 1\nEND PGM GOOD MM\n")
        self.client.write("bad.h", "BEGIN PGM BAD MM\nTOOL CALL 99 Z\nEND PGM BAD MM\n")
        self.run_control("put", "good.h", "bad.h", "TNC:\\nc_prog\\")
        self.assertEqual(self.run_control("run", "TNC:\\nc_prog\\good.h"), "TNC:\\nc_prog\\good.h finished\n")
        done = self.client.run("control", "run", self.control, "TNC:\\nc_prog\\bad.h")
        self.assertEqual(done.returncode, 9)
        self.assertIn("tool 99", done.stderr_text)
        self.assertIn("bad.h ended with status failed", done.stderr_text)
        self.assertNotIn("--control-setup", done.stderr_text)
        self.assert_fails(7, "control", "run", self.control, "TNC:\\nc_prog\\none.h")

    def test_a_probe_that_touches_nothing_names_the_setting_of_the_workpiece(self):
        done = self.client.run("control", "run", self.control, "TNC:\\nc_prog\\8255\\8255.h")
        self.assertEqual(done.returncode, 9)
        self.assertIn("8255.h ended with status failed: if the machine has no workpiece, start fitgauged with a setup (--control-setup)",
                      done.stderr_text)

    def test_the_state_of_what_runs_is_told(self):
        self.daemon.request("PUT", "/v1/files/nc_prog/loop.h", LOOP.encode())
        running = self.client.spawn("control", "run", self.control, "nc_prog/loop.h")
        state = wait_for(lambda: (seen := json.loads(self.run_control("state", "--json")))["state"] == "started" and seen)
        self.assertEqual((state["control"], state["mode"], state["program"]), ("TNC640", "automatic", "TNC:\\nc_prog\\loop.h"))
        self.assertEqual(set(state["axes"]), {"X", "Y", "Z"})
        self.assertEqual(state["feed_percent"], 100)
        self.assertRegex(self.run_control("state"), r"(?m)^state      started\n")
        run = self.daemon.get("/v1/runs?limit=1").json["runs"][0]["id"]
        self.daemon.request("DELETE", f"/v1/runs/{run}")
        done = self.client.end(running)
        self.assertEqual(done.returncode, 9)
        self.assertIn("ended with status cancelled", done.stderr_text)

    def test_what_is_no_control_is_said(self):
        with socket.socket() as unused:
            unused.bind(("127.0.0.1", 0))
            self.assertIn("cannot be reached", self.assert_fails(6, "control", "ls", f"127.0.0.1:{unused.getsockname()[1]}"))
        self.assertIn("HOST:PORT", self.assert_fails(4, "control", "ls", "a:b:c"))
        self.assert_fails(6, "control", "ls", f"127.0.0.1:{self.daemon.port}")


class RealControl(unittest.TestCase):
    """What is asked of a control that is not ours, told by a server of raw telegrams."""

    def answered(self, answers, *arguments):
        """Runs fitgauge against a control with these answers; what it was asked, and how it ended."""
        asked = []
        with socket.create_server(("127.0.0.1", 0)) as server:
            def serve():
                peer, _ = server.accept()
                with peer, peer.makefile("rb") as stream:
                    while len(head := stream.read(8)) == 8:
                        length, name = struct.unpack("!L4s", head)
                        payload = stream.read(length)
                        asked.append((name.decode(), payload))
                        peer.sendall(answers(name.decode(), payload))
            thread = threading.Thread(target=serve, daemon=True)
            thread.start()
            client = Client("127.0.0.1:9")
            self.addCleanup(client.cleanup)
            done = client.run("control", arguments[0], f"127.0.0.1:{server.getsockname()[1]}", *arguments[1:])
            thread.join(30)
        return asked, done

    @staticmethod
    def machine(name, _):
        if name == "R_VR":
            return telegram("S_VR", b"".join(text(part) for part in ("TNC640", "340595 11", "builder 7", "00")))
        if name in ("A_LG", "C_DC"):
            return telegram("T_OK")
        if name == "R_DR":
            return telegram("T_FD")
        return telegram("T_ER", b"\1\x16")

    def test_no_program_of_it_is_started(self):
        asked, done = self.answered(self.machine, "run", "TNC:\\a.h")
        self.assertEqual(done.returncode, 7)
        self.assertIn("is a real control", done.stderr_text)
        self.assertEqual([payload for name, payload in asked if name == "A_LG"], [text("INSPECT")])
        self.assertFalse({name for name, _ in asked} & {"C_MC", "C_EK", "C_LK", "R_MB"})

    def test_it_keeps_256_bytes_where_no_buffer_is_agreed(self):
        asked, done = self.answered(self.machine, "ls", "TNC:\\")
        self.assertEqual((done.returncode, done.stdout_text), (0, ""))
        self.assertEqual([payload for name, payload in asked if name == "A_LG"], [text("INSPECT"), text("FILE")])
        long = "TNC:\\" + "x" * 250
        _, done = self.answered(self.machine, "ls", long)
        self.assertEqual(done.returncode, 7)

    def test_half_an_answer_and_a_false_one_are_said(self):
        _, done = self.answered(lambda *_: telegram("S_FL", b"x"), "ls")
        self.assertEqual(done.returncode, 6)
        self.assertRegex(done.stderr_text, re.escape("answers with S_FL"))
        _, done = self.answered(lambda *_: b"\xff\xff\xff\xffT_OK", "ls")
        self.assertEqual(done.returncode, 6)


if __name__ == "__main__":
    unittest.main()
