# SPDX-License-Identifier: MIT
"""Pages with numbers put into them.

A template NAME.md.in is the page NAME.md with names in braces. {table NAME} on a line of its own stands for the rows of
a table, every other name for one number or a short list of numbers."""
import re

PLACE = re.compile(r"\{([^{}\n]+)\}")


def row(cells):
    return "| " + " | ".join(str(cell) for cell in cells) + " |"


def fill(text, values, where="template"):
    """The page. `values` gives the text of a name, or raises a KeyError; an unknown name is an error that names its
    place."""
    lines = []
    for number, line in enumerate(text.splitlines(), 1):
        def put(found, number=number):
            try:
                return values(found.group(1))
            except (KeyError, ValueError) as error:
                raise ValueError(f"{where}:{number}: {{{found.group(1)}}}: {error}") from error
        lines.append(PLACE.sub(put, line))
    return "\n".join(lines) + "\n"
