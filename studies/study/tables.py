"""Tables as CSV, and as Markdown for the pages."""
import csv
import pathlib


def write_csv(path, columns, rows):
    """`rows` are dictionaries; None is an empty cell."""
    path = pathlib.Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    with open(path, "w", newline="") as file:
        writer = csv.DictWriter(file, columns, restval="")
        writer.writeheader()
        for row in rows:
            writer.writerow({key: ("" if value is None else value) for key, value in row.items()})


def read_csv(path):
    """Rows as dictionaries; numbers where a cell holds one, None where it is empty."""
    def value(text):
        if text == "":
            return None
        try:
            return float(text)
        except ValueError:
            return text
    with open(path, newline="") as file:
        return [{key: value(text) for key, text in row.items()} for row in csv.DictReader(file)]


def number(value, digits=3, none="–"):
    """A number for a reader: `digits` significant ones, a true minus sign."""
    if value is None or value != value:
        return none
    if isinstance(value, str):
        return value
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, int):
        text = f"{value:,}"
    else:
        text = f"{value:.{digits}g}"
        if "e" not in text and abs(value) >= 10.0**digits:
            text = f"{value:,.0f}"
        if "e" in text:
            mantissa, exponent = text.split("e")
            text = f"{mantissa}e{int(exponent)}"
    return text.replace("-", "\u2212")


def markdown(header, rows):
    """A table; cells are texts or numbers."""
    lines = ["| " + " | ".join(header) + " |", "|" + "---|" * len(header)]
    for row in rows:
        lines.append("| " + " | ".join(number(cell).replace("|", "\\|") for cell in row) + " |")
    return "\n".join(lines)
