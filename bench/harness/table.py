"""Plain tables for a terminal, and means that say when there is nothing to average."""


def mean(values):
    values = [value for value in values if value is not None]
    return sum(values) / len(values) if values else None


def largest(values):
    return max((value for value in values if value is not None), default=None)


def cell(value, form=""):
    """A value as text, `-` for none."""
    return "-" if value is None else format(value, form)


def table(header, rows):
    """Texts in columns: the first to the left, the others to the right, with a rule below the header."""
    rows = [header, *rows]
    widths = [max(len(row[k]) for row in rows) for k in range(len(header))]
    lines = ["  ".join(text.rjust(width) if k else text.ljust(width) for k, (text, width) in enumerate(zip(row, widths)))
             for row in rows]
    lines.insert(1, "  ".join("-" * width for width in widths))
    return "\n".join(lines)
