"""Tables of a run: CSV to columns, columns to frames."""
from __future__ import annotations

import csv
import os
from typing import Any

import numpy as np

Columns = dict[str, np.ndarray]


def _column(cells: list[str]) -> np.ndarray:
    """Numbers where every cell is one or empty (NaN), else texts."""
    try:
        return np.array([float(cell) if cell else np.nan for cell in cells])
    except ValueError:
        return np.array(cells)


def read_csv(path: str | os.PathLike[str]) -> Columns:
    """Column name -> values. A last line without all its columns was cut off by a kill, and is left out."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    if not rows:
        raise ValueError("no line of names")
    complete = [row for row in rows[1:] if len(row) == len(rows[0])]
    return {name: _column([row[n] for row in complete]) for n, name in enumerate(rows[0])}


def frame(columns: Columns) -> Any:
    """A pandas.DataFrame where pandas is there, else a numpy structured array.

    >>> table = frame({"time": np.array([0.0, 1.0]), "body": np.array(["one", "two"])})
    >>> list(table["body"]), float(table["time"][1])
    (['one', 'two'], 1.0)
    """
    try:
        import pandas
    except ModuleNotFoundError:
        length = len(next(iter(columns.values()), []))
        table = np.empty(length, [(name, values.dtype) for name, values in columns.items()])
        for name, values in columns.items():
            table[name] = values
        return table
    return pandas.DataFrame(columns)
