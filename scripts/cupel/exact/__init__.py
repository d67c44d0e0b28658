"""Exact solutions that measures and cases are judged against; each file states its source, symbols and units."""
