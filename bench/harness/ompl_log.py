"""OMPL's benchmark logs."""


def read(text):
    """A dictionary of properties a run, of the first planner; empty cells are None."""
    lines = iter(text.splitlines())

    def count():
        return int(next(lines).split()[0])

    for _ in range(2):  # the settings, the machine
        while not next(lines).startswith("|>>>"):
            pass
    for _ in range(5):
        next(lines)
    for _ in range(count()):
        next(lines)
    count()
    next(lines)
    for _ in range(count()):
        next(lines)
    names = [next(lines).rsplit(" ", 1)[0] for _ in range(count())]
    rows = [next(lines).split("; ")[:-1] for _ in range(count())]
    return [dict(zip(names, (float(cell) if cell else None for cell in row), strict=True)) for row in rows]
