"""What an accuracy costs: the cheapest setting of some ladders that meets it."""


def cheapest(ladders, error, level):
    """The row of least `seconds` whose `error` (a key) is at most `level`, as are those of all tighter rows of its ladder: no lucky hits. None: there is none.
    `ladders`: lists of rows, from loose to tight; an error of None meets nothing.

    >>> musl = [{"error": 1e-4, "seconds": 1}, {"error": 5e-2, "seconds": 2}, {"error": 5e-3, "seconds": 4}]
    >>> cheapest([musl], "error", 1e-2)["seconds"]
    4
    """
    def holds(row):
        return row.get(error) is not None and row[error] <= level

    met = [row for rows in ladders for n, row in enumerate(rows) if all(holds(each) for each in rows[n:])]
    return min(met, key=lambda row: row["seconds"], default=None)
