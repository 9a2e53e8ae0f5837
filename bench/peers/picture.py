"""The time of a tick against the size of the knowledge base, both axes logarithmic, as SVG. Series differ by marker and dash as
well as by colour (Okabe and Ito's, which people with any kind of colour vision can tell apart), and are named beside their ends."""
import math

WIDTH, HEIGHT, LEFT, RIGHT, TOP, BOTTOM = 760, 460, 80, 190, 40, 60
STYLES = {   # colour, dashes, marker
    "Waymark, image": ("#0072b2", "", "circle"),
    "switch by hand": ("#000000", "2 4", "square"),
    "linear scan": ("#e69f00", "8 4", "triangle"),
    "behaviour tree by hand": ("#56b4e9", "8 3 2 3", "cross"),
    "CLIPS": ("#d55e00", "12 4", "diamond"),
}
LABELS = {"CLIPS": "CLIPS (Rete)"}


def marker(kind, x, y, colour):
    if kind == "circle":
        return f'<circle cx="{x:.1f}" cy="{y:.1f}" r="5" fill="{colour}"/>'
    if kind == "square":
        return f'<rect x="{x - 4.5:.1f}" y="{y - 4.5:.1f}" width="9" height="9" fill="{colour}"/>'
    shapes = {"triangle": "M0 -6L6 5L-6 5Z", "diamond": "M0 -7L6 0L0 7L-6 0Z", "cross": "M-5 -5L5 5M-5 5L5 -5"}
    line = f' stroke="{colour}" stroke-width="2.5" fill="none"' if kind == "cross" else f' fill="{colour}"'
    return f'<path transform="translate({x:.1f} {y:.1f})" d="{shapes[kind]}"{line}/>'


def draw(rows, path):
    """`rows`: name, rules, ns. Writes the file."""
    low = math.floor(math.log10(min(row["ns"] for row in rows)))
    high = math.ceil(math.log10(max(row["ns"] for row in rows)))

    def x_of(rules):
        return LEFT + (math.log10(rules) - 1) / 5 * (WIDTH - LEFT - RIGHT)

    def y_of(ns):
        return HEIGHT - BOTTOM - (math.log10(ns) - low) / (high - low) * (HEIGHT - TOP - BOTTOM)

    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" width="{WIDTH}" height="{HEIGHT}" '
           'font-family="sans-serif" font-size="13">', "<title>Time of an event tick against the number of rules</title>",
           f'<rect width="{WIDTH}" height="{HEIGHT}" fill="#ffffff"/>']
    for exponent in range(1, 7):
        x = x_of(10 ** exponent)
        out.append(f'<path d="M{x:.1f} {TOP}V{HEIGHT - BOTTOM}" stroke="#dddddd"/>')
        out.append(f'<text x="{x:.1f}" y="{HEIGHT - BOTTOM + 20}" text-anchor="middle">10<tspan dy="-5" font-size="10">{exponent}</tspan></text>')
    units = ("1 ns", "10 ns", "100 ns", "1 &#181;s", "10 &#181;s", "100 &#181;s", "1 ms", "10 ms", "100 ms", "1 s")
    for exponent in range(low, high + 1):
        y = y_of(10 ** exponent)
        out.append(f'<path d="M{LEFT} {y:.1f}H{WIDTH - RIGHT}" stroke="#dddddd"/>')
        out.append(f'<text x="{LEFT - 8}" y="{y + 4:.1f}" text-anchor="end">{units[exponent]}</text>')
    out.append(f'<path d="M{LEFT} {TOP}V{HEIGHT - BOTTOM}H{WIDTH - RIGHT}" stroke="#000000" fill="none"/>')
    out.append(f'<text x="{(LEFT + WIDTH - RIGHT) / 2}" y="{HEIGHT - 14}" text-anchor="middle">rules in the knowledge base</text>')
    out.append(f'<text x="20" y="{(TOP + HEIGHT - BOTTOM) / 2}" text-anchor="middle" '
               f'transform="rotate(-90 20 {(TOP + HEIGHT - BOTTOM) / 2})">time of a tick with an event</text>')
    taken = []
    for name, (colour, dashes, kind) in STYLES.items():
        points = [(x_of(row["rules"]), y_of(row["ns"])) for row in rows if row["name"] == name]
        if not points:
            continue
        line = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
        out.append(f'<polyline points="{line}" fill="none" stroke="{colour}" stroke-width="2" stroke-dasharray="{dashes or "none"}"/>')
        out += [marker(kind, x, y, colour) for x, y in points]
        x, y = points[-1]
        if name == "CLIPS":   # the others run through its end
            x, y = points[0][0] + 4, points[0][1] - 16
        while any(abs(y - other) < 16 and abs(x - at) < 150 for at, other in taken):
            y += 8
        taken.append((x, y))
        out.append(f'<text x="{x + 12:.1f}" y="{y + 4:.1f}">{LABELS.get(name, name)}</text>')
    out.append("</svg>")
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n".join(out) + "\n")
