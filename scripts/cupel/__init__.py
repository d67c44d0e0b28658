"""Cupel's command line: runs cases in both solvers, measures, compares and reports."""

__version__ = "0.1.0"
