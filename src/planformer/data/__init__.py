"""Data sets of expert paths: how they are made, stored and read.

The modules are imported one by one, so that reading a data set (`planformer.data.dataset`) needs
nothing but NumPy and pyarrow.
"""
