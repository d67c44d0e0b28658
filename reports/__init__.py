"""The report: one HTML page, made from results only, that needs nothing but itself to be read."""
