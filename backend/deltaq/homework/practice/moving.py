"""Systems that are guided, turn, roll or run over heavy pulleys."""

from __future__ import annotations

from .draw import Draw
from .one_degree import line_damper, pivot_extras
from .parts import (
    ORIGIN,
    Document,
    Part,
    Vertical,
    angle,
    below,
    dissipation,
    element,
    ending,
    length,
    particle,
    point,
    potential,
    rigid,
    told,
    upright,
    weight,
)
from .symbols import CURVATURE, INCLINATION, RADIUS, Kind
from .two_degrees import hung_at, wedge, wedge_spring

SLOW = Kind("rad/s", (1.5, 2.0, 2.5))  # the bead stays near the lowest point
# J = factor m R² of what rolls.
ROUND = (("ring", "m*R^2"), ("disc", "m*R^2/2"), ("ball", "2*m*R^2/5"))


def pendulum_on_guided_pivot(draw: Draw) -> Part:
    """A pendulum whose pivot is moved to and fro, round a circle, or evenly faster."""
    phi, vertical, as_rod = draw.one_of(("phi", "theta", "psi")), upright(draw), draw.chance(0.35)
    kind = draw.one_of(("vertical", "horizontal", "circle", "lift"))
    across, down, guided = _moved(kind)
    names = tuple(each["name"] for each in guided)
    pivot = Part(
        title=f"pendulum-{kind}",
        vertical=vertical,
        told=told(f"pivot-{kind}", y="y", x="x", a="a", motion=_MOTIONS[kind], across=_sum(across), down=_sum(down)),
        kinds={"a": Kind("m", (0.15, 0.2, 0.25))},
        coordinates=guided,
        guides=tuple({"coordinate": name, "value": _MOTIONS[kind]} for name in names),
        called={"origin": "pivot-start"},
        points=(point("origin", "0", "0"), point("pivot", _sum(across), below(vertical, *down) if down else "0")),
        elements=_support(kind),
    )
    hung = hung_at(vertical, phi, "pivot", across=across, down=down, as_rod=as_rod)
    way = ending("pivot", "2 + y") if kind == "lift" else Part()
    return sum(draw.some_of(pivot_extras(phi), 1), pivot + hung + way + weight(vertical))


_MOTIONS = {
    "vertical": "y0*sin(Omega*t)",
    "horizontal": "x0*sin(Omega*t)",
    "circle": "Omega*t",
    "lift": "-a0*t^2/2",
}


def _sum(terms: tuple[str, ...]) -> str:
    return " + ".join(terms) or "0"


def _moved(kind: str) -> tuple[tuple[str, ...], tuple[str, ...], tuple[Document, ...]]:
    """Terms of the pivot's place, across and downwards, and the coordinates that are guided."""
    if kind == "horizontal":
        return ("x",), (), (length("x", 0.0),)
    if kind == "circle":
        return ("a*cos(Omega*t)",), ("a*sin(Omega*t)",), ()
    return (), ("y",), (length("y", 0.0, 2.0),)


def _support(kind: str) -> tuple[Document, ...]:
    if kind == "circle":
        return (element("hoop", at="origin", radius="a"), element("rod", start="origin", to="pivot"))
    return (element("guide", at="pivot", direction="horizontal" if kind == "horizontal" else "vertical"),)


def bead_on_turning_wire(draw: Draw) -> Part:
    """A bead on a wire that turns evenly about the vertical."""
    x = draw.one_of(("r", "s", "x"))
    curve, height, kinds = draw.one_of(
        (
            ("parabola", f"a*{x}^2", {"a": CURVATURE}),
            ("catenary", f"a*cosh({x}/a)", {}),
            ("line", f"{x}*tan(beta)", {"beta": INCLINATION}),
            ("cosine", f"-a*cos({x}/b)", {}),
        )
    )
    wire = Part(
        title=f"turning-{curve}",
        told=told("turning-wire", mass="m", curve=f"z({x}) = {height}", Omega="Omega", x=x),
        kinds={**kinds, "Omega": SLOW, "k": Kind("N/m", (20.0, 25.0, 30.0))},
        coordinates=(length(x, 0.5, 1.1, least=0.0 if curve == "line" else None),),
        called={"origin": "axis-start"},
        points=(point("origin", "0", "0", "0"),),
        bodies=(particle("bead", "m", f"{x}*cos(Omega*t)", f"{x}*sin(Omega*t)", height),),
        elements=(
            element("wire", at="bead", coordinate=x),
            element("bob", at="bead"),
            element("trail", at="bead"),
            element("weight", at="bead"),
        ),
    )
    spring = Part(told=told("axis-spring", k="k", r=x), adds=("spring",), loads=(potential("spring", f"k*{x}^2/2"),))
    options = (line_damper(x),) if curve == "line" else (spring, line_damper(x))
    held = wire + spring if curve == "line" else wire  # nothing else draws the bead back on a straight wire
    return sum(draw.some_of(options, 1), held + weight("up", 3))


def bead_on_turning_hoop(draw: Draw) -> Part:
    """A bead on a hoop that is turned evenly about its vertical diameter."""
    theta = draw.one_of(("theta", "phi"))
    vertical: Vertical = "down"  # from which the drawing counts the angle
    place = (f"R*sin({theta})*cos(Omega*t)", f"R*sin({theta})*sin(Omega*t)", below(vertical, f"R*cos({theta})"))
    hoop = Part(
        title="turning-hoop",
        vertical=vertical,
        told=told("turning-hoop", mass="m", R="R", Omega="Omega", theta=theta),
        coordinates=(angle(theta, 0.8),),
        view=(-1.5, 1.5, -1.5, 1.6),
        called={"origin": "hoop-centre"},
        points=(point("origin", "0", "0", "0"),),
        bodies=(particle("bead", "m", *place),),
        elements=(
            element("wire", at="bead", coordinate=theta),
            element("polar", start="origin", to="bead", coordinate=theta),
            element("bob", at="bead"),
            element("weight", at="bead"),
        ),
    )
    return sum(draw.some_of((_hoop_damping(theta),), 1), hoop + weight(vertical, 3))


def _hoop_damping(theta: str) -> Part:
    return Part(
        told=told("hoop-damping", c="c"),
        adds=("damper",),
        kinds={"c": Kind("N m s", (0.1, 0.2, 0.3))},
        loads=(dissipation(f"c*dot({theta})^2/2"),),
    )


def bead_on_turning_rod(draw: Draw) -> Part:
    """A bead on a straight rod that is turned evenly in a level or an upright plane."""
    r, level = draw.one_of(("r", "s", "x")), draw.chance(0.5)
    rod = Part(
        title="turning-rod-level" if level else "turning-rod-upright",
        told=told("turning-rod-level" if level else "turning-rod-upright", mass="m", Omega="Omega", r=r),
        coordinates=(length(r, 0.5, 1.5, least=0.0),),
        called={"origin": "rod-end"},
        points=(ORIGIN,),
        bodies=(particle("bead", "m", f"{r}*cos(Omega*t)", f"{r}*sin(Omega*t)"),),
        elements=(
            element("wire", at="bead", coordinate=r),
            element("pivot", at="origin"),
            element("bob", at="bead"),
        ),
    )
    spring = Part(
        told=told("hub-spring", k="k", l0="l0", r=r),
        adds=("spring",),
        loads=(potential("spring", f"k*({r} - l0)^2/2"),),
        kinds={"k": Kind("N/m", (40.0, 50.0, 60.0))},
        elements=(element("spring", start="origin", to="bead", load="spring"),),
    )
    held = rod + spring if level else rod + spring + weight("up")
    return sum(draw.some_of((line_damper(r),), 1), held)


def driven_support(draw: Draw) -> Part:
    """A mass on a spring whose other end is moved."""
    vertical = upright(draw)
    mass = Part(
        title="driven-support",
        vertical=vertical,
        told=told("driven-support", mass="m", k="k", l0="l0", y="y", z="z", motion="y0*sin(Omega*t)"),
        coordinates=(length("y", 0.0, 0.3), length("z", 0.15, 0.5)),
        guides=({"coordinate": "y", "value": "y0*sin(Omega*t)"},),
        points=(point("support", "0", below(vertical, "y")), point("rest", "0", below(vertical, "l0"))),
        bodies=(particle("block", "m", "0", below(vertical, "l0", "z")),),
        loads=(potential("spring", "k*(z - y)^2/2"),),
        elements=(
            element("guide", at="support", direction="vertical"),
            element("spring", start="support", to="block", load="spring"),
            element("block", at="block", width=0.24, height=0.14),
            element("dimension", start="rest", to="block", coordinate="z"),
            element("force", load="weight"),
        ),
    )
    between = Part(
        told=told("damper-at-spring", c="c"),
        adds=("damper",),
        loads=(dissipation("c*(dot(z) - dot(y))^2/2"),),
    )
    return sum(draw.some_of((between,), 1), mass + weight(vertical))


def rolling_on_incline(draw: Draw) -> Part:
    """A ring, disc or ball that rolls on an incline or a level floor, with a spring or a damper at its axle."""
    s, vertical = draw.one_of(("s", "x")), upright(draw)
    shape, inertia = draw.one_of(ROUND)
    centre = (f"{s}*cos(alpha) + R*sin(alpha)", below(vertical, f"{s}*sin(alpha)", "-R*cos(alpha)"))
    wheel = Part(
        title=f"rolling-{shape}",
        vertical=vertical,
        told=told(f"rolling-{shape}", mass="m", R="R", alpha="alpha", s=s),
        kinds={"R": RADIUS},
        coordinates=(length(s, -0.5, 1.2),),
        called={"origin": "slope-start"},
        points=(
            ORIGIN,
            point("contact", f"{s}*cos(alpha)", below(vertical, f"{s}*sin(alpha)")),
        ),
        bodies=(rigid("wheel", "m", inertia, f"{s}/R", *centre),),
        elements=(
            element("wire", at="contact", coordinate=s),
            element("disc", at="wheel", radius="R"),
            element("force", load="weight"),
        ),
    )
    spring = Part(
        told=told("axle-spring", k="k", l0="l0", s=s),
        adds=("spring",),
        kinds={"l0": Kind("m", (1.0, 1.2))},
        points=(point("anchor", "-l0*cos(alpha) + R*sin(alpha)", below(vertical, "-l0*sin(alpha)", "-R*cos(alpha)")),),
        loads=(potential("spring", f"k*{s}^2/2"),),
        elements=(element("spring", start="anchor", to="wheel", load="spring"),),
    )
    whole = wheel + ending("wheel", f"2 - {s}") + weight(vertical)
    return sum(draw.some_of((spring, line_damper(s)), 2), whole)


def rolling_in_trough(draw: Draw) -> Part:
    """A ring, disc or ball that rolls in a round trough; φ is the angle of its centre."""
    phi, vertical = draw.one_of(("phi", "theta")), upright(draw)
    shape, inertia = draw.one_of(ROUND)
    inertia = inertia.replace("R", "a")
    centre = (f"(R - a)*sin({phi})", below(vertical, f"(R - a)*cos({phi})"))
    return Part(
        title=f"trough-{shape}",
        vertical=vertical,
        told=told(f"trough-{shape}", mass="m", a="a", R="R", phi=phi),
        kinds={"a": RADIUS},
        coordinates=(angle(phi, 0.8),),
        view=(-1.5, 1.5, -1.5, 1.5),
        called={"origin": "trough-centre"},
        points=(ORIGIN,),
        bodies=(rigid("wheel", "m", inertia, f"(R - a)*{phi}/a", *centre),),
        elements=(
            element("hoop", at="origin", radius="R"),
            element("disc", at="wheel", radius="a"),
            element("angle", at="origin", coordinate=phi),
            element("force", load="weight"),
        ),
    ) + weight(vertical)


def unrolling_disc(draw: Draw) -> Part:
    """A disc that unrolls from its rope."""
    x, vertical = draw.one_of(("x", "s", "y")), upright(draw)
    return Part(
        title="unrolling-disc",
        vertical=vertical,
        told=told("unrolling-disc", mass="m", R="R", x=x),
        kinds={"R": RADIUS},
        coordinates=(length(x, 0.3, 2.0, least=0.0),),
        called={"origin": "rope-end"},
        points=(ORIGIN, point("leaving", "0", below(vertical, x))),
        bodies=(rigid("wheel", "m", "m*R^2/2", f"{x}/R", "R", below(vertical, x)),),
        elements=(
            element("ground", at="origin"),
            element("rod", start="origin", to="leaving"),
            element("disc", at="wheel", radius="R"),
            element("dimension", start="origin", to="leaving", coordinate=x),
            element("force", load="weight"),
        ),
    ) + (ending("wheel", f"2 - {x}") + weight(vertical))


def heavy_pulley(draw: Draw) -> Part:
    """Masses on a rope over a pulley with inertia."""
    x, vertical = draw.one_of(("x", "s", "y")), upright(draw)
    on_table = draw.chance(0.5)
    title = "table-and-heavy-pulley" if on_table else "atwood-heavy-pulley"
    first = ("-l1 + " + x, "0") if on_table else ("-R", below(vertical, x))
    second = ("R", below(vertical, x if on_table else "l1", *(() if on_table else (f"-{x}",))))
    centre = ("0", below(vertical, "R")) if on_table else ("0", "0")
    return Part(
        title=title,
        vertical=vertical,
        told=told(
            title,
            m1="m1",
            m2="m2",
            M="M",
            R="R",
            l1="l1",
            x=x,
        ),
        kinds={"R": RADIUS, "l1": Kind("m", (1.5, 1.8))},
        coordinates=(length(x, 0.5, 1.4, least=0.0),),
        points=(point("left", "-R", "0"), point("right", "R", centre[1])),
        bodies=(
            particle("first", "m1", *first),
            particle("second", "m2", *second),
            rigid("pulley", "M", "M*R^2/2", f"{x}/R", *centre),
        ),
        elements=(
            element("disc", at="pulley", radius="R"),
            element("rod", start="first", to="left"),
            element("rod", start="right", to="second"),
            element("block", at="first", width=0.24, height=0.16),
            element("block", at="second", width=0.16, height=0.2),
        ),
    ) + (ending("first", x, f"l1 - {x}") + weight(vertical))


def block_on_pushed_wedge(draw: Draw) -> Part:
    """A block on a wedge that is moved evenly faster, or to and fro."""
    s, vertical = draw.one_of(("s", "u")), upright(draw)
    motion = draw.one_of(("a0*t^2/2", "x0*sin(Omega*t)"))
    whole = wedge(vertical, "x", s) + Part(
        title="pushed-wedge",
        told=told("pushed-wedge", mass="m", alpha="alpha", b="b", x="x", s=s, motion=motion),
        coordinates=(length("x", 0.0, 2.0), length(s, 0.3, 1.2)),
        guides=({"coordinate": "x", "value": motion},),
        elements=(element("force", load="weight"),),
    )
    way = ending("block", "2 - x") if motion.startswith("a0") else Part()
    return whole + way + wedge_spring(s) + weight(vertical)


def drawn_in_pendulum(draw: Draw) -> Part:
    """A pendulum whose string is drawn in evenly, or lengthened and shortened."""
    phi, vertical = draw.one_of(("phi", "theta")), upright(draw)
    motion = draw.one_of(("l0 - v*t", "l0 + x0*sin(Omega*t)"))
    return Part(
        title="drawn-in-pendulum",
        vertical=vertical,
        told=told("drawn-in-pendulum", mass="m", phi=phi, r="r", motion=motion),
        kinds={"l0": Kind("m", (1.0, 1.2)), "v": Kind("m/s", (0.02, 0.03, 0.04))},
        coordinates=(length("r", 1.0, 1.5, least=0.1), angle(phi, 0.6)),
        guides=({"coordinate": "r", "value": motion},),
        points=(point("pivot", "0", "0"),),
        bodies=(particle("bob", "m", f"r*sin({phi})", below(vertical, f"r*cos({phi})")),),
        elements=(
            element("ground", at="pivot"),
            element("rod", start="pivot", to="bob"),
            element("pivot", at="pivot"),
            element("angle", at="pivot", coordinate=phi),
            element("bob", at="bob"),
            element("trail", at="bob"),
            element("force", load="weight"),
        ),
    ) + weight(vertical)


def pendulum_on_wheel(draw: Draw) -> Part:
    """A pendulum hung on the axle of a disc that rolls on the floor, which a spring may hold."""
    x, phi, vertical = draw.one_of(("x", "s")), draw.one_of(("phi", "theta")), upright(draw)
    wheel = Part(
        title="pendulum-on-wheel",
        vertical=vertical,
        told=told("rolling-wheel", mass="M", R="R", x=x),
        kinds={"R": RADIUS},
        coordinates=(length(x, 0.2),),
        called={"origin": "axle-start"},
        points=(
            ORIGIN,
            point("left", "-1.5", below(vertical, "R")),
            point("right", "1.5", below(vertical, "R")),
            point("wall", "-1.4", "0"),
        ),
        bodies=(rigid("wheel", "M", "M*R^2/2", f"{x}/R", x, "0"),),
        elements=(element("wall", start="left", to="right"), element("disc", at="wheel", radius="R")),
    )
    hung = hung_at(vertical, phi, "wheel", across=(x,), down=(), as_rod=draw.chance(0.3))
    spring = Part(
        told=told("axle-wall-spring", k="k", x=x),
        adds=("spring",),
        loads=(potential("spring", f"k*{x}^2/2"),),
        elements=(element("spring", start="wall", to="wheel", load="spring"),),
    )
    return sum(draw.some_of((spring,), 1), wheel + hung + weight(vertical))


FAMILIES = (
    pendulum_on_guided_pivot,
    bead_on_turning_wire,
    bead_on_turning_hoop,
    bead_on_turning_rod,
    driven_support,
    rolling_on_incline,
    rolling_in_trough,
    unrolling_disc,
    heavy_pulley,
    block_on_pushed_wedge,
    drawn_in_pendulum,
    pendulum_on_wheel,
)
# Always driven: they never rest.
DRIVEN = (pendulum_on_guided_pivot, driven_support, drawn_in_pendulum)
