"""Certificates for tests of TLS."""

import subprocess


def certificate(folder, name, serial):
    """A self-signed certificate for localhost; gives the files of it and its key."""
    files = folder / f"{name}.pem", folder / f"{name}.key"
    subprocess.run(["openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt",
                    "ec_paramgen_curve:prime256v1", "-nodes", "-days", "2", "-set_serial",
                    str(serial), "-subj", f"/CN={name}", "-addext", "subjectAltName=DNS:localhost",
                    "-out", files[0], "-keyout", files[1]], check=True, capture_output=True)
    return files
