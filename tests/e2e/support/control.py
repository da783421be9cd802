"""The example programs of clients/nc on a running daemon."""

import json
import pathlib

from support.daemon import DaemonTest

EXAMPLES = pathlib.Path(__file__).resolve().parents[3] / "clients" / "nc"
# Without an end: the time of a run is over before the most blocks that it may have, on the fastest machine too.
FOREVER = ("Q1 = 1", "LBL 1", *["QS1 = TOCHAR ( DAT+Q1 DECIMALS4 )"] * 20, "FN 9: IF +1 EQU +1 GOTO LBL 1")
BLOCK = {"type": "block", "min_mm": [-300, -300, -60], "max_mm": [300, 300, 0]}


def setup(name, loads=json.loads):
    """A setup of the examples: `8255/hole-good`."""
    program, _, setup_name = name.partition("/")
    return loads((EXAMPLES / program / "setups" / f"{setup_name}.json").read_text())


def workpiece(*features, **machine):
    return {"machine": machine, "workpiece": {"features": list(features)}}


class ControlTest(DaemonTest):
    """Tests on the control's disk, with helpers for files and runs."""

    def upload(self, path, content):
        with self.daemon.client() as client:
            client.put_file(path, content.encode() if isinstance(content, str) else content)

    def upload_examples(self):
        for program in ("8255", "8210", "8025", "444", "451"):
            for file in (EXAMPLES / program).iterdir():
                if file.is_file():
                    self.upload(f"nc_prog/{program}/{file.name}", file.read_bytes())

    def upload_program(self, name, *blocks):
        """A program in TNC:\\ of these blocks; gives its path."""
        lines = [f"BEGIN PGM {name} MM", *blocks, f"END PGM {name} MM"]
        self.upload(f"{name}.h", "".join(f"{n} {text}\n" for n, text in enumerate(lines)))
        return f"TNC:\\{name}.h"

    def post_run(self, program, machine_setup=None, headers=None, **order):
        body = {"program": program, "setup": machine_setup or {}, **order}
        return self.daemon.post("/v1/runs", body, headers)

    def run_program(self, program, machine_setup=None, **order):
        answer = self.post_run(program, machine_setup, **order)
        self.assertEqual(answer.status, 201, answer)
        return answer.json

    def run_example(self, program, machine_setup, **order):
        return self.run_program(f"TNC:\\nc_prog\\{program[:4]}\\{program}.h", machine_setup, **order)
