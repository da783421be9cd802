"""Builds the wheel and the source distribution of the client (PEP 517) with the standard library.

Both are the same bytes wherever they are built.
"""

import base64
import gzip
import hashlib
import io
import re
import tarfile
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
MODULE = (*sorted(f"fitgauge/{path.name}" for path in (ROOT / "fitgauge").glob("*.py")), "fitgauge/py.typed")
SOURCES = (*MODULE, "README.md", "backend/fitgauge_build.py", "pyproject.toml")
WHEEL = "Wheel-Version: 1.0\nGenerator: fitgauge_build\nRoot-Is-Purelib: true\nTag: py3-none-any\n"


def version() -> str:
    found = re.search(r'^VERSION = "(.+)"$', read("fitgauge/_version.py").decode(), re.MULTILINE)
    if not found:
        raise RuntimeError("fitgauge/_version.py states no VERSION")
    return found[1]


def read(name: str) -> bytes:
    return (ROOT / name).read_bytes()


def license_text() -> bytes:
    """In the repository it lies at the top, in a source distribution beside this folder."""
    beside = ROOT / "LICENSE"
    return (beside if beside.exists() else ROOT.parent.parent / "LICENSE").read_bytes()


def metadata() -> bytes:
    fields = ("Metadata-Version: 2.1", "Name: fitgauge", f"Version: {version()}",
              "Summary: Client of fitgauge: ISO 286 limits and fits, verdicts, measurements, NC programs",
              "License: Apache-2.0", "Requires-Python: >=3.9", "Description-Content-Type: text/markdown",
              "Classifier: License :: OSI Approved :: Apache Software License",
              "Classifier: Programming Language :: Python :: 3", "Classifier: Typing :: Typed")
    return "\n".join(fields).encode() + b"\n\n" + read("README.md")


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    name = f"fitgauge-{version()}"
    info = f"{name}.dist-info"
    files = {path: read(path) for path in MODULE}
    files[f"{info}/LICENSE"] = license_text()
    files[f"{info}/METADATA"] = metadata()
    files[f"{info}/WHEEL"] = WHEEL.encode()
    record = "".join(f"{path},sha256={digest(content)},{len(content)}\n" for path, content in files.items())
    files[f"{info}/RECORD"] = (record + f"{info}/RECORD,,\n").encode()

    wheel = f"{name}-py3-none-any.whl"
    with zipfile.ZipFile(Path(wheel_directory) / wheel, "w", zipfile.ZIP_DEFLATED) as archive:
        for path, content in files.items():
            entry = zipfile.ZipInfo(path)  # of 1 January 1980
            entry.external_attr = 0o100644 << 16
            archive.writestr(entry, content, zipfile.ZIP_DEFLATED)
    return wheel


def digest(content: bytes) -> str:
    return base64.urlsafe_b64encode(hashlib.sha256(content).digest()).decode().rstrip("=")


def build_sdist(sdist_directory, config_settings=None):
    name = f"fitgauge-{version()}"
    files = {path: read(path) for path in SOURCES}
    files["LICENSE"] = license_text()
    files["PKG-INFO"] = metadata()
    packed = io.BytesIO()
    with tarfile.open(fileobj=packed, mode="w", format=tarfile.PAX_FORMAT) as archive:
        for path, content in sorted(files.items()):
            entry = tarfile.TarInfo(f"{name}/{path}")
            entry.size = len(content)
            archive.addfile(entry, io.BytesIO(content))
    sdist = f"{name}.tar.gz"
    (Path(sdist_directory) / sdist).write_bytes(gzip.compress(packed.getvalue(), mtime=0))
    return sdist
