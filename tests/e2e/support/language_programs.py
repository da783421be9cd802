"""Right programs of both dialects, and a test whose client edits them."""

import shutil
import tempfile
import unittest

from support.language_client import LanguageClient

HOLE = """TCH PROBE 421 MEASURE HOLE ~
    Q273=+50 ;CENTRE IN 1ST AXIS ~
    Q274=+40 ;CENTRE IN 2ND AXIS ~
    Q262=+Q1 ;NOMINAL DIAMETER ~
    Q325=+0 ;STARTING ANGLE ~
    Q247=+90 ;STEPPING ANGLE ~
    Q261=-5 ;MEASURING HEIGHT ~
    Q320=+0 ;SET-UP CLEARANCE ~
    Q260=+50 ;CLEARANCE HEIGHT ~
    Q301=+0 ;MOVE TO CLEARANCE HEIGHT ~
    Q275=+25.1 ;MAXIMUM SIZE ~
    Q276=+24.9 ;MINIMUM SIZE ~
    Q279=+0 ~
    Q280=+0 ~
    Q281=+0 ~
    Q309=+0 ~
    Q330=+0"""
PROGRAM = f"""BEGIN PGM DEMO MM
Q1 = +25 ;NOMINAL
TOOL CALL 30 Z
CALL LBL "HOLE"
STOP
LBL "HOLE"
{HOLE}
Q2 = Q153 - Q1
LBL 0
END PGM DEMO MM
"""
ISO = """%DEMO G71 *
N5 D00 Q1 P01 +25 *
N7 T30 G17 *
N8 L1,0 *
N9 G38 *
N40 G98 L1 *
N50 G421 MEASURE HOLE ~
    Q273=+50 ~
    Q274=+40 ~
    Q262=+Q1 ~
    Q325=+0 ~
    Q247=+90 ~
    Q261=-5 ~
    Q320=+0 ~
    Q260=+50 ~
    Q301=+0 ~
    Q275=+25.1 ~
    Q276=+24.9 ~
    Q279=+0 ~
    Q280=+0 ~
    Q281=+0 ~
    Q309=+0 ~
    Q330=+0 *
N60 G98 L0 *
N99999999 %DEMO G71 *
"""


class LanguageTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.mkdtemp(prefix="fitgauge-lsp-")
        self.addCleanup(shutil.rmtree, folder, ignore_errors=True)
        self.client = self.start(folder)

    def start(self, folder, **named):
        client = LanguageClient(folder, **named)
        self.addCleanup(client.close)
        return client

    def line_of(self, name, text):
        return self.line_with(self.client.text[name], text)

    def at(self, method, name, text, inside="", **more):
        """The answer about the first place of `inside` in the first line that has `text`."""
        line = self.line_of(name, text)
        return self.client.at(method, name, line, self.client.text[name].split("\n")[line].index(inside or text), **more)

    def corrected(self, name, line, title):
        """The program after the remedy whose title begins so."""
        action = next(each for each in self.client.actions(name, line) if each["title"].startswith(title))
        return self.client.applied(name, action["edit"]["changes"][self.client.uri(name)])

    @staticmethod
    def line_with(text, part):
        return next(i for i, line in enumerate(text.split("\n")) if part in line)
