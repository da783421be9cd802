"""The version, which is that of the service."""

VERSION = "1.0.0"
