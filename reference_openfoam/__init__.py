"""The OpenFOAM reference of Cupel: resolved case in, run of the volume-of-fluid melting solver, fields and run.json out."""

__version__ = "0.1.0"
