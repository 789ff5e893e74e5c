# SPDX-License-Identifier: MIT
"""Names beside points, where there is room."""

SIZE = 7.5
# Places around a point: shift in typographic points, and how the text is aligned.
PLACES = [(5, 4, "left"), (-5, 4, "right"), (5, -10, "left"), (-5, -10, "right"), (0, 8, "center"), (0, -14, "center"),
          (5, 13, "left"), (5, -19, "left")]


def overlap(a, b):
    return a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]


def box_at(place, text):
    """In typographic points; letters are about 0.6 of their size wide."""
    width = 0.6 * SIZE * len(text)
    left = place[0] - {"left": 0, "right": width, "center": width / 2}[place[2]]
    return left, place[1] - 1, left + width, place[1] + SIZE


def write(ax, labels):
    """`labels`: (x, y, text, colour, must). Those that must be there come first and always get a place."""
    scale = 72 / ax.figure.dpi
    spots = {label: tuple(ax.transData.transform(label[:2]) * scale) for label in labels}
    taken = [(x - 2.5, y - 2.5, x + 2.5, y + 2.5) for x, y in spots.values()]
    frame = ax.bbox.extents * scale
    for label in sorted(labels, key=lambda label: not label[4]):
        x, y, text, colour, must = label
        spot = spots[label]
        for dx, dy, align in PLACES:
            box = box_at((spot[0] + dx, spot[1] + dy, align), text)
            inside = box[0] >= frame[0] and box[2] <= frame[2] + 8 and box[1] >= frame[1] and box[3] <= frame[3] + 8
            if inside and not any(overlap(box, other) for other in taken):
                break
        else:
            if not must:
                continue
            dx, dy, align = PLACES[0]
            box = box_at((spot[0] + dx, spot[1] + dy, align), text)
        taken.append(box)
        ax.annotate(text, (x, y), (dx, dy), textcoords="offset points", ha=align, fontsize=SIZE,
                    color=colour, annotation_clip=False)
