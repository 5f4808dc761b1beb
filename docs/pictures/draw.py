#!/usr/bin/env python3
"""Draws what docs/ shows: docs/pictures/drawings/NAME.svg by NAME.py. PYTHONPATH=studies docs/pictures/draw.py [NAME...]"""
import importlib
import sys

drawings = ("schemes", "systems", "wave", "modes", "curves", "patches", "energy", "blast_window", "tempered_drop", "ring_on_ring")

if __name__ == "__main__":
    for name in sys.argv[1:] or drawings:
        importlib.import_module(name).draw()
