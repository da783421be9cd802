"""The Python package: it installs without a network, holds what it says, and its types are right."""

import base64
import csv
import hashlib
import io
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tarfile
import tempfile
import unittest
import zipfile

from support.daemon import ROOT, DaemonTest

CLIENT = ROOT / "clients" / "python"
# A pip that asks an index fails.
NO_NETWORK = {**os.environ, "PIP_NO_INDEX": "1", "PIP_DISABLE_PIP_VERSION_CHECK": "1", "PYTHONDONTWRITEBYTECODE": "1"}


def run(*command, **options):
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True, timeout=240, check=False,
                          **{"env": NO_NETWORK, **options})
    if done.returncode != 0:
        raise AssertionError(f"{command}: {done.stdout}{done.stderr}")
    return done.stdout


def build(folder, hook, source=CLIENT):
    """Builds as an installer does (PEP 517); gives the file."""
    program = f"import sys; sys.path.insert(0, 'backend'); import fitgauge_build as b; print(b.{hook}({str(folder)!r}))"
    return folder / run(sys.executable, "-B", "-c", program, cwd=source).strip()


class Installed(DaemonTest):
    def test_pip_installs_it_from_the_folder_in_a_fresh_environment(self):
        environment = self.daemon.folder / "venv"
        run(sys.executable, "-m", "venv", environment)
        python = environment / "bin" / "python"
        run(python, "-m", "pip", "install", CLIENT)
        run(python, "-m", "pip", "check")
        program = ("import fitgauge; print(fitgauge.__file__); client = fitgauge.Client();"
                   "print(client.measure({'designation': '25 H7', 'measured_mm': '25.0215'})['verdict'])")
        place, verdict = run(python, "-c", program, cwd=self.daemon.folder, env={
            **NO_NETWORK, "FITGAUGE_SERVER": f"127.0.0.1:{self.daemon.port}"}).splitlines()
        self.assertTrue(pathlib.Path(place).is_relative_to(environment), place)
        self.assertEqual(verdict, "reject")


class Package(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="fitgauge-package-"))
        self.addCleanup(shutil.rmtree, self.folder)

    def test_the_wheel_records_each_of_its_files(self):
        wheel = build(self.folder, "build_wheel")
        with zipfile.ZipFile(wheel) as archive:
            contents = {name: archive.read(name) for name in archive.namelist()}
        info = wheel.name.replace("-py3-none-any.whl", ".dist-info")
        rows = list(csv.reader(io.StringIO(contents[f"{info}/RECORD"].decode())))
        self.assertEqual({row[0] for row in rows}, set(contents))
        for name, digest, size in rows:
            if name != f"{info}/RECORD":
                expected = base64.urlsafe_b64encode(hashlib.sha256(contents[name]).digest()).decode().rstrip("=")
                self.assertEqual((digest, int(size)), (f"sha256={expected}", len(contents[name])), name)
        self.assertTrue({"fitgauge/__init__.py", "fitgauge/py.typed", f"{info}/LICENSE"} <= set(contents))
        self.assertIn(b"\nName: fitgauge\n", contents[f"{info}/METADATA"])

    def test_the_source_distribution_builds_the_same_wheel(self):
        with tarfile.open(build(self.folder, "build_sdist")) as archive:
            archive.extractall(self.folder)
        unpacked, = (path for path in self.folder.iterdir() if path.is_dir())
        (self.folder / "again").mkdir()
        again = build(self.folder / "again", "build_wheel", unpacked)
        self.assertEqual(build(self.folder, "build_wheel").read_bytes(), again.read_bytes())

    def test_its_version_is_that_of_the_service(self):
        project = re.search(r"project\(fitgauge VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text())[1]
        self.assertIn(f"fitgauge-{project}-", build(self.folder, "build_wheel").name)

    def test_its_types_are_checked(self):
        run("mypy", "--strict", "--python-version", "3.9", "--cache-dir", self.folder, CLIENT / "fitgauge")
        wrong = self.folder / "wrong.py"
        wrong.write_text("import fitgauge\nfitgauge.Client().measure({'measured_mm': 25.0215})\n")
        with self.assertRaisesRegex(AssertionError, "float.*measured_mm.*Decimal"):
            run("mypy", "--strict", "--cache-dir", self.folder, wrong, env={**NO_NETWORK, "MYPYPATH": str(CLIENT)})

    def test_it_needs_the_standard_library_alone(self):
        program = ("import sys; before = set(sys.modules); import fitgauge;"
                   "print(*{m.partition('.')[0] for m in set(sys.modules) - before} - {'fitgauge'})")
        imported = run(sys.executable, "-I", "-B", "-c", f"import sys; sys.path.append({str(CLIENT)!r}); {program}").split()
        self.assertEqual(set(imported) - set(sys.stdlib_module_names), set())
