"""The signatures of a release: scripts/release_sign makes them with a key of the test, scripts/release_check and gpgv judge
them. A byte that is changed after signing is found in each file."""

import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

from support.daemon import ROOT

CONTROL = """Package: fitgauge
Version: 9.9.9-1
Architecture: amd64
Section: science
Priority: optional
Maintainer: A shop <shop@fitgauge.example>
Description: a package of the test
"""


def run(*command, **environment):
    return subprocess.run([str(each) for each in command], capture_output=True, text=True, check=False, timeout=120,
                          stdin=subprocess.DEVNULL, env={**os.environ, "SOURCE_DATE_EPOCH": "1795000000", **environment})


class Signing(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        # In /tmp: the socket of gpg's agent has a short path.
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="fitgauge-sign-", dir="/tmp"))
        cls.addClassCleanup(shutil.rmtree, cls.folder, ignore_errors=True)
        cls.keys = [cls.make_key("shop", "20260101"), cls.make_key("stranger", "20261119")]  # the commit is of 18 November
        made = cls.folder / "package/DEBIAN"
        made.mkdir(parents=True)
        (made / "control").write_text(CONTROL)
        cls.dist = cls.signed("dist", cls.keys[0])

    @classmethod
    def make_key(cls, name, day):
        """@returns the file of a new private key"""
        home = cls.folder / f"{name}-gnupg"
        home.mkdir(mode=0o700)
        made = run("gpg", "--batch", "--quiet", "--passphrase", "", "--faked-system-time", f"{day}T000000",
                   "--quick-generate-key", f"{name} <{name}@fitgauge.example>", "ed25519", "sign", "never", GNUPGHOME=str(home))
        exported = run("gpg", "--batch", "--armor", "--export-secret-keys", GNUPGHOME=str(home))
        run("gpgconf", "--kill", "all", GNUPGHOME=str(home))
        if made.returncode or not exported.stdout:
            raise RuntimeError(made.stderr + exported.stderr)
        path = cls.folder / f"{name}.asc"
        path.write_text(exported.stdout)
        return path

    @classmethod
    def signed(cls, name, *key, **environment):
        dist = cls.folder / name
        dist.mkdir()
        (dist / "fitgauge-9.9.9-amd64.oci.tar").write_bytes(b"an image\n" * 100)
        built = run("dpkg-deb", "--root-owner-group", "--build", cls.folder / "package", dist / "fitgauge_9.9.9-1_amd64.deb")
        done = run(ROOT / "scripts/release_sign", dist, *key, **environment)
        if built.returncode or done.returncode:
            raise RuntimeError(built.stderr + done.stderr)
        return dist

    def leave_semaphores(self):
        """As processes under libfaketime leave them that were killed and whose numbers come again."""
        last = subprocess.Popen(["true"])
        last.wait()
        for number in range(last.pid + 1, last.pid + 1000):
            path = pathlib.Path(f"/dev/shm/sem.faketime_sem_{number}")
            if not path.exists():
                path.touch()
                self.addCleanup(path.unlink, missing_ok=True)

    def copy(self):
        path = self.folder / "copy"
        shutil.copytree(self.dist, path)
        self.addCleanup(shutil.rmtree, path)
        return path

    def check(self, dist):
        return run(ROOT / "scripts/release_check", "--sums", dist)

    def verify(self, signature, *signed):
        """gpgv with the key that the release brings."""
        ring = self.folder / "ring.gpg"
        run("gpg", "--batch", "--yes", "--dearmor", "--output", ring, self.dist / "fitgauge.asc")
        return run("gpgv", "--keyring", ring, signature, *signed).returncode

    def test_all_that_is_signed_verifies(self):
        checked = self.check(self.dist)
        self.assertEqual(checked.returncode, 0, checked.stderr)
        release = self.dist / "apt/dists/bookworm"
        self.assertEqual(self.verify(self.dist / "SHA256SUMS.asc", self.dist / "SHA256SUMS"), 0)
        self.assertEqual(self.verify(release / "InRelease"), 0)
        self.assertEqual(self.verify(release / "Release.gpg", release / "Release"), 0)
        self.assertNotIn("PRIVATE", (self.dist / "fitgauge.asc").read_text())

    def test_a_changed_byte_is_found_in_every_file(self):
        dist = self.copy()
        for path in sorted(each for each in dist.rglob("*") if each.is_file()):
            with self.subTest(str(path.relative_to(dist))):
                text = path.read_bytes()
                place = len(text) // 2
                path.write_bytes(text[:place] + bytes([text[place] ^ 1]) + text[place + 1:])
                self.assertNotEqual(self.check(dist).returncode, 0)
                path.write_bytes(text)
        self.assertEqual(self.check(dist).returncode, 0)

    def test_sums_made_anew_do_not_hide_a_change(self):
        dist = self.copy()
        image = dist / "fitgauge-9.9.9-amd64.oci.tar"
        image.write_bytes(b"another image\n")
        self.assertEqual(run("sh", "-c", f"cd {dist} && find . -type f ! -name 'SHA256SUMS*' | xargs sha256sum > SHA256SUMS"
                             ).returncode, 0)
        checked = self.check(dist)
        self.assertEqual(checked.returncode, 1)
        self.assertIn("the signature of SHA256SUMS is bad", checked.stderr)

    def test_a_missing_signature_is_found_if_there_is_a_key(self):
        dist = self.copy()
        (dist / "SHA256SUMS.asc").unlink()
        checked = self.check(dist)
        self.assertEqual(checked.returncode, 1)
        self.assertIn("SHA256SUMS.asc is missing", checked.stderr)

    def test_a_signature_of_another_key_is_refused(self):
        other = self.signed("other", self.keys[1])
        self.assertEqual((other / "SHA256SUMS.asc").exists(), True)
        self.assertNotEqual(self.verify(other / "SHA256SUMS.asc", other / "SHA256SUMS"), 0)
        self.assertNotEqual(self.verify(other / "apt/dists/bookworm/InRelease"), 0)

    def test_the_same_key_signs_the_same_bytes(self):
        self.leave_semaphores()
        again = self.signed("again", self.keys[0], TZ="Europe/Berlin")
        files = sorted(each.relative_to(again) for each in again.rglob("*") if each.is_file())
        self.assertEqual(files, sorted(each.relative_to(self.dist) for each in self.dist.rglob("*") if each.is_file()))
        for each in files:
            self.assertEqual((again / each).read_bytes(), (self.dist / each).read_bytes(), each)

    def test_a_broken_line_of_the_sums_is_found(self):
        plain = self.signed("torn")
        sums = plain / "SHA256SUMS"
        whole = sums.read_text()
        sums.write_text(whole + whole.splitlines()[0][1:] + "\n")  # one digit is missing
        self.assertEqual(self.check(plain).returncode, 1)
        sums.write_text(whole)
        self.assertEqual(self.check(plain).returncode, 0)

    def test_without_a_key_nothing_is_signed(self):
        plain = self.signed("plain")
        checked = self.check(plain)
        self.assertEqual((checked.returncode, checked.stdout), (0, "not signed\n"))
        self.assertEqual([path.name for path in plain.rglob("*") if path.suffix in (".asc", ".gpg") or path.name == "InRelease"], [])


if __name__ == "__main__":
    unittest.main()
