"""fitgauge replay: the log of a machine against the same program on the machine's contacts."""

import json
import math
import unittest

from support.cli import ClientTest

PROGRAM = """BEGIN PGM BORE MM
TOOL CALL 30 Z
TCH PROBE 421 MEASURE HOLE ~
Q273=+50 ~
Q274=+50 ~
Q262=+25 ~
Q325=+0 ~
Q247=+90 ~
Q261=-5 ~
Q320=+2 ~
Q260=+50 ~
Q301=+0 ~
Q275=+25.021 ~
Q276=+25 ~
Q279=+0.1 ~
Q280=+0.1 ~
Q281=+1 ~
Q309=+0 ~
Q330=+0
END PGM BORE MM
"""
# What a control prints of a bore of 25.0131 mm, 4 µm off its place.
LOG = """Measuring log for touch probe cycle 421 Hole measuring
Date: 30-06-2025
Time: 6:55:04
Measuring program: TNC:\\nc_prog\\BORE.H
Type of dimension (0 = MM / 1 = INCH): 0
Nominal values:
Center in reference axis: 50.0000
Center in minor axis: 50.0000
Diameter: 25.0000
Given limit values:
Maximum limit for center in reference axis: 50.1000
Minimum limit for center in reference axis: 49.9000
Maximum limit for center in minor axis: 50.1000
Minimum limit for center in minor axis: 49.9000
Maximum dimension for hole: 25.0210
Minimum dimension for hole: 25.0000
Actual values:
Center in reference axis: 50.0040
Center in minor axis: 50.0000
Diameter: 25.0131
Measuring log end
"""


def contacts(diameter, centre=(50.004, 50), ball=4):
    """Centres of the probe's ball, 4 mm in every setup, at its touches of 0, 90, 180 and 270 degrees."""
    radius = (diameter - ball) / 2
    return [[centre[0] + radius * math.cos(math.radians(angle)), centre[1] + radius * math.sin(math.radians(angle)), -5]
            for angle in (0, 90, 180, 270)]


class Replay(ClientTest):
    def setUp(self):
        super().setUp()
        self.client.write("bore.h", PROGRAM)
        self.client.write("log.txt", LOG)
        self.assert_runs(0, "nc", "put", "bore.h", "nc_prog/bore.h")

    def replay(self, code, points, *flags):
        self.client.write("contacts.json", json.dumps(points))
        return self.assert_runs(code, "replay", "nc_prog/bore.h", "log.txt", "--contacts", "contacts.json", *flags)

    def test_the_same_contacts_give_the_printed_digits(self):
        self.assertEqual(self.replay(0, contacts(25.0131)), "3 results, 0 of them differ\n")

    def test_every_result_that_differs_is_named(self):
        points = contacts(25.0131)
        points[0][0] += 0.002
        self.assertEqual(self.replay(9, points), (
            "cycle 421, log 1: Centre, main axis: 50.0040 in the log, 50.0050 in the replay, +0.0010\n"
            "cycle 421, log 1: Diameter: 25.0131 in the log, 25.0141 in the replay, +0.0010\n"
            "3 results, 2 of them differ\n"))
        document = json.loads(self.replay(9, points, "--json"))
        self.assertEqual(document["results"], 3)
        self.assertEqual(document["differing"][1], {"cycle": 421, "call": 1, "result": "Diameter", "log": "25.0131",
                                                    "replay": "25.0141"})

    def test_contacts_of_another_program_are_said(self):
        points = contacts(25.0131)
        self.client.write("contacts.json", json.dumps(points[:3]))
        done = self.client.run("replay", "nc_prog/bore.h", "log.txt", "--contacts", "contacts.json")
        self.assertEqual(done.returncode, 9)
        self.assertIn("all 3 are used", done.stderr_text)
        self.assertIn("nothing in the replay", done.stdout_text)
        self.client.write("contacts.json", json.dumps([[0, 0, 0]]))
        done = self.client.run("replay", "nc_prog/bore.h", "log.txt", "--contacts", "contacts.json")
        self.assertIn("contact 1 lies", done.stderr_text)
        self.client.write("contacts.json", json.dumps(points + [None]))
        done = self.client.run("replay", "nc_prog/bore.h", "log.txt", "--contacts", "contacts.json")
        self.assertEqual(done.returncode, 0)
        self.assertIn("1 of 5 contacts were not used", done.stderr_text)

    def test_what_is_no_log_and_no_contacts_is_refused(self):
        self.client.write("contacts.json", "[]")
        self.client.write("other.txt", "hello\n")
        self.assertIn("other.txt:1:", self.assert_fails(5, "replay", "nc_prog/bore.h", "other.txt", "--contacts", "contacts.json"))
        self.client.write("contacts.json", "[[1,2]]")
        self.assertIn("a contact must be [X, Y, Z]", self.assert_fails(7, "replay", "nc_prog/bore.h", "log.txt", "--contacts",
                                                                  "contacts.json"))


if __name__ == "__main__":
    unittest.main()
