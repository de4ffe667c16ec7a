"""Systems of one degree of freedom: beads, pendulums, blocks, masses on springs, masses on one rope."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from .draw import Draw
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
    force,
    length,
    particle,
    point,
    potential,
    rigid,
    told,
    upright,
    weight,
)
from .symbols import CURVATURE, INERTIA, PIVOT_DAMPING, QUARTIC, Kind


@dataclass(frozen=True)
class Curve:
    """A wire y(x) and its slope."""

    key: str
    height: str
    slope: str
    kinds: tuple[tuple[str, Kind], ...] = ()


CURVES = (
    Curve("parabola", "a*{x}^2", "2*a*{x}", (("a", CURVATURE),)),
    Curve("catenary", "a*cosh({x}/a)", "sinh({x}/a)"),
    Curve("cosine", "-a*cos({x}/b)", "a/b*sin({x}/b)"),
    Curve("quartic", "a*{x}^4", "4*a*{x}^3", (("a", QUARTIC),)),
    Curve("double-well", "a*{x}^4 - b*{x}^2", "4*a*{x}^3 - 2*b*{x}", (("a", QUARTIC), ("b", CURVATURE))),
)


def bead_on_curve(draw: Draw) -> Part:
    """A bead on a wire y(x), with a spring, drag or a force."""
    curve, x = draw.one_of(CURVES), draw.one_of(("x", "s", "u"))
    height, slope = curve.height.format(x=x), curve.slope.format(x=x)
    bead = Part(
        title=f"bead-on-{curve.key}",
        told=told("bead-on-curve", mass="m", curve=f"y({x}) = {height}", x=x),
        kinds=dict(curve.kinds),
        coordinates=(length(x, 0.7, 1.2),),
        points=(ORIGIN, point("axis", "0", height)),
        bodies=(particle("bead", "m", x, height),),
        elements=(
            element("wire", at="bead", coordinate=x),
            element("force", load="weight"),
            element("bob", at="bead"),
            element("dimension", start="axis", to="bead", coordinate=x),
        ),
    )
    drag = Part(
        told=told("drag", body="c"),
        adds=("drag",),
        loads=(force("drag", "bead", f"-c*dot({x})", f"-c*{_product(slope, x)}"),),
    )
    spring = Part(told=told("level-spring", k="k", x=x), adds=("spring",), loads=(potential("spring", f"k*{x}^2/2"),))
    pushed = Part(
        told=told("constant-force", F="F"),
        adds=("force",),
        loads=(force("F", "bead", "F", "0"),),
        elements=(element("force", load="F"),),
    )
    return sum(draw.some_of((drag, spring, pushed), 1), bead + weight("up"))


def _product(slope: str, x: str) -> str:
    return f"({slope})*dot({x})" if " " in slope else f"{slope}*dot({x})"


def bead_on_ellipse(draw: Draw) -> Part:
    """A bead on an ellipse or a cycloid, by a parameter."""
    u = draw.one_of(("u", "theta", "phi"))
    curve, across, height = draw.one_of(
        (
            ("ellipse", f"a*sin({u})", f"-b*cos({u})"),
            ("cycloid", f"R*({u} + sin({u}))", f"R*(1 - cos({u}))"),
            ("circle", f"R*sin({u})", f"-R*cos({u})"),
        )
    )
    bead = Part(
        title=f"bead-on-{curve}",
        told=told("bead-on-parametric", mass="m", across=across, height=height, u=u),
        coordinates=(angle(u, 0.9),),
        points=(ORIGIN,),
        bodies=(particle("bead", "m", across, height),),
        elements=(
            element("wire", at="bead", coordinate=u),
            element("force", load="weight"),
            element("bob", at="bead"),
        ),
    )
    spring = Part(
        told=told("soft-spring-to-origin", k="k"),
        adds=("spring",),
        loads=({"name": "spring", "kind": "spring", "from": "origin", "to": "bead", "stiffness": "k"},),
        elements=(element("spring", start="origin", to="bead", load="spring"),),
    )
    options = () if curve == "circle" else (spring,)
    return sum(draw.some_of(options, 1), bead + weight("up"))


def bead_on_helix(draw: Draw) -> Part:
    """A bead on a helix about the vertical."""
    phi = draw.one_of(("phi", "psi"))
    bead = Part(
        title="bead-on-helix",
        told=told("bead-on-helix", mass="m", R="R", height=f"a*{phi}", phi=phi),
        coordinates=(angle(phi, 1.0),),
        view=(-1.6, 1.6, -1.8, 1.9),
        points=(point("origin", "0", "0", "0"),),
        bodies=(particle("bead", "m", f"R*cos({phi})", f"R*sin({phi})", f"a*{phi}"),),
        elements=(
            element("wire", at="bead", coordinate=phi),
            element("bob", at="bead"),
            element("weight", at="bead"),
        ),
    )
    spring = Part(
        told=told("upright-spring", k="k"),
        adds=("spring",),
        loads=(potential("spring", f"k*(a*{phi})^2/2"),),
    )
    return sum(draw.some_of((spring,), 1), bead + ending("bead", f"{phi} + 3") + weight("up", 3))


@dataclass(frozen=True)
class Swing:
    """What swings on a pivot: its bodies at the end of `terms`, and where a force or spring takes hold."""

    key: str
    bodies: Callable[[Vertical, str], Part]
    hold: str


def bob(vertical: Vertical, phi: str) -> Part:
    """A particle on a massless rod."""
    return Part(
        told=told("pendulum-bob", mass="m", l="l"),
        bodies=(particle("bob", "m", f"l*sin({phi})", below(vertical, f"l*cos({phi})")),),
        elements=(element("rod", start="pivot", to="bob"), element("bob", at="bob")),
    )


def rod(vertical: Vertical, phi: str) -> Part:
    """A homogeneous rod."""
    centre = (f"l/2*sin({phi})", below(vertical, f"l/2*cos({phi})"))
    return Part(
        told=told("pendulum-rod", mass="m", l="l"),
        points=(point("end", f"l*sin({phi})", below(vertical, f"l*cos({phi})")),),
        bodies=(rigid("rod", "m", "m*l^2/12", phi, *centre),),
        elements=(element("rod", start="pivot", to="end"),),
    )


def body(vertical: Vertical, phi: str) -> Part:
    """A rigid body with its centre of mass a from the pivot."""
    centre = (f"a*sin({phi})", below(vertical, f"a*cos({phi})"))
    return Part(
        told=told("pendulum-body", mass="m", a="a", J="J"),
        kinds={"J": INERTIA},
        bodies=(rigid("body", "m", "J", phi, *centre),),
        elements=(element("rod", start="pivot", to="body"), element("disc", at="body", radius=0.16, coordinate=phi)),
    )


def opposite(vertical: Vertical, phi: str) -> Part:
    """Two particles on a massless rod, one above the pivot."""
    return Part(
        told=told("pendulum-opposite", first="m1", second="m2", a="a", b="b"),
        kinds={"m2": Kind("kg", (0.2, 0.3, 0.4))},
        bodies=(
            particle("first", "m1", f"a*sin({phi})", below(vertical, f"a*cos({phi})")),
            particle("second", "m2", f"-b*sin({phi})", below(vertical, f"-b*cos({phi})")),
        ),
        elements=(
            element("rod", start="second", to="first"),
            element("bob", at="first"),
            element("bob", at="second"),
        ),
    )


SWINGS = (
    Swing("pendulum", bob, "bob"),
    Swing("rod-pendulum", rod, "end"),
    Swing("physical-pendulum", body, "body"),
    Swing("two-bob-pendulum", opposite, "first"),
)


def pendulum(draw: Draw) -> Part:
    """A pendulum of some kind, with a torsion spring, damping, a force, a moment or a level spring."""
    swing, phi = draw.one_of(SWINGS), draw.one_of(("phi", "theta", "psi"))
    vertical = upright(draw)
    whole = Part(
        title=swing.key,
        vertical=vertical,
        coordinates=(angle(phi, 0.9),),
        points=(point("pivot", "0", "0"),),
        elements=(
            element("ground", at="pivot"),
            element("pivot", at="pivot"),
            element("angle", at="pivot", coordinate=phi),
            element("force", load="weight"),
        ),
    )
    hung = whole + swing.bodies(vertical, phi) + Part(told=told("pendulum-angle", phi=phi)) + weight(vertical)
    drawn = draw.one_of((pulled(swing.hold), pushed(vertical, phi, swing.hold)))
    options = (*pivot_extras(phi), drawn)
    return sum(draw.some_of(options, 2), hung)


def pivot_extras(phi: str) -> tuple[Part, ...]:
    """What can act on whatever turns about the pivot."""
    return (
        Part(
            told=told("torsion-spring", kappa="kappa", phi=phi),
            adds=("torsion-spring",),
            loads=(potential("torsion_spring", f"kappa*{phi}^2/2"),),
        ),
        Part(
            told=told("pivot-damping", c="c", phi=phi),
            adds=("pivot-damping",),
            kinds={"c": PIVOT_DAMPING},
            loads=(dissipation(f"c*dot({phi})^2/2"),),
        ),
    )


def pulled(at: str) -> Part:
    """A constant level force at the end."""
    return Part(
        told=told("constant-force", F="F"),
        adds=("force",),
        loads=(force("F", at, "F", "0"),),
        elements=(element("force", load="F"),),
    )


def block_on_incline(draw: Draw) -> Part:
    """A block on an incline with a spring up the slope, and perhaps a damper or a force."""
    s, vertical = draw.one_of(("s", "x", "u")), upright(draw)
    options = (line_damper(s), line_force("block", vertical, "cos(alpha)", "sin(alpha)"))
    block = on_incline("block-on-incline", vertical, "m", s, 0.5) + slope_spring(vertical, s)
    return sum(draw.some_of(options, 1), block + weight(vertical))


def pushed(vertical: Vertical, phi: str, at: str) -> Part:
    """A force that turns with the rod and stays at right angles to it."""
    return Part(
        told=told("follower-force", F="F"),
        adds=("follower-force",),
        loads=(force("F", at, f"F*cos({phi})", below(vertical, f"-F*sin({phi})")),),
        elements=(element("force", load="F"),),
    )


def on_incline(title: str, vertical: Vertical, mass: str, s: str, start: float) -> Part:
    """A block that slides on an incline."""
    return Part(
        title=title,
        vertical=vertical,
        told=told("block-on-incline", mass=mass, alpha="alpha", s=s),
        coordinates=(length(s, start, 1.2),),
        called={"origin": "slope-start"},
        points=(ORIGIN,),
        bodies=(particle("block", mass, f"{s}*cos(alpha)", below(vertical, f"{s}*sin(alpha)")),),
        elements=(
            element("wire", at="block", coordinate=s),
            element("block", at="block", width=0.2, height=0.14),
            element("force", load="weight"),
        ),
    )


def slope_spring(vertical: Vertical, s: str) -> Part:
    """A spring along the slope, held above."""
    return Part(
        told=told("slope-spring", k="k", l0="l0", s=s),
        adds=("spring",),
        kinds={"l0": Kind("m", (1.0, 1.2))},
        points=(point("anchor", "-l0*cos(alpha)", below(vertical, "-l0*sin(alpha)")),),
        loads=(potential("spring", f"k*{s}^2/2"),),
        elements=(element("spring", start="anchor", to="block", load="spring"),),
    )


def line_damper(x: str, key: str = "line-damper") -> Part:
    """A damper along the way of a body."""
    return Part(told=told(key, c="c"), adds=("damper",), loads=(dissipation(f"c*dot({x})^2/2"),))


def line_force(at: str, vertical: Vertical, across: str, down: str) -> Part:
    """A driving force along the way of a body, whose direction has these components."""
    driven = "F0*cos(Omega*t)"
    components = [driven if part == "1" else f"{driven}*{part}" if part != "0" else "0" for part in (across, down)]
    return Part(
        told=told("driving-force", force=driven),
        adds=("driving",),
        loads=(force("F", at, components[0], below(vertical, components[1])),),
        elements=(element("force", load="F"),),
    )


def hanging_mass(draw: Draw) -> Part:
    """A mass hung on a spring, perhaps with a damper or a driving force."""
    y, vertical = draw.one_of(("y", "s", "u")), upright(draw)
    mass = Part(
        title="hanging-mass",
        vertical=vertical,
        told=told("hanging-mass", mass="m", k="k", y=y, l0="l0"),
        coordinates=(length(y, 0.3),),
        points=(point("pivot", "0", "0"), point("rest", "0", below(vertical, "l0"))),
        bodies=(particle("block", "m", "0", below(vertical, "l0", y)),),
        loads=(potential("spring", f"k*{y}^2/2"),),
        elements=(
            element("ground", at="pivot"),
            element("spring", start="pivot", to="block", load="spring"),
            element("block", at="block", width=0.24, height=0.14),
            element("dimension", start="rest", to="block", coordinate=y),
            element("force", load="weight"),
        ),
    )
    options = (line_damper(y), line_force("block", vertical, "0", "1"))
    return sum(draw.some_of(options, 2), mass + weight(vertical))


def side_spring(draw: Draw) -> Part:
    """A bead on a level rod, drawn back by a spring from beside the rod."""
    x, soft = draw.one_of(("x", "s")), draw.chance(0.4)
    spring = {"name": "spring", "kind": "spring", "from": "anchor", "to": "bead", "stiffness": "k"}
    bead = Part(
        title="side-spring",
        told=told("side-spring-soft" if soft else "side-spring", mass="m", k="k", b="b", l0="l0", x=x),
        kinds={"l0": Kind("m", (0.2, 0.25, 0.3))},
        coordinates=(length(x, 0.7),),
        called={"origin": "rod-start"},
        points=(ORIGIN, point("anchor", "0", "b"), point("left", "-1.2", "0"), point("right", "1.2", "0")),
        bodies=(particle("bead", "m", x, "0"),),
        loads=(spring if soft else {**spring, "rest_length": "l0"},),
        elements=(
            element("ground", at="anchor"),
            element("rod", start="left", to="right"),
            element("spring", start="anchor", to="bead", load="spring"),
            element("bob", at="bead"),
            element("dimension", start="origin", to="bead", coordinate=x),
        ),
    )
    return sum(draw.some_of((line_damper(x), line_force("bead", "up", "1", "0")), 1), bead)


def rope(draw: Draw) -> Part:
    """Two masses on one rope over a pulley without mass: hanging, on a table, or on an incline."""
    x, vertical = draw.one_of(("x", "s", "y")), upright(draw)
    kind, first = draw.one_of(
        (
            ("atwood", ("-a", below(vertical, x))),
            ("table-and-hanging", (f"-l1 + {x}", "0")),
            ("incline-and-hanging", (f"-(l1 - {x})*cos(alpha)", below(vertical, f"(l1 - {x})*sin(alpha)"))),
        )
    )
    second = ("a", below(vertical, "l2", f"-{x}")) if kind == "atwood" else ("0", below(vertical, x))
    pulley = Part(
        title=kind,
        vertical=vertical,
        told=told(kind, first="m1", second="m2", x=x, alpha="alpha", a="a", l1="l1", l2="l2"),
        kinds={"l1": Kind("m", (1.5, 1.8)), "l2": Kind("m", (1.5, 1.8))},
        coordinates=(length(x, 0.5, 1.4, least=0.0),),
        points=_pulley(kind),
        bodies=(particle("first", "m1", *first), particle("second", "m2", *second)),
        elements=_ropes(kind, x),
    )
    rope_length = "l2" if kind == "atwood" else "l1"
    return pulley + ending("first", x, f"{rope_length} - {x}") + weight(vertical)


def _pulley(kind: str) -> tuple[Document, ...]:
    if kind == "atwood":
        return (point("left", "-a", "0"), point("right", "a", "0"), point("pulley", "0", "0"))
    return (point("pulley", "0", "0"),)


def _ropes(kind: str, x: str) -> tuple[Document, ...]:
    left, right = ("left", "right") if kind == "atwood" else ("pulley", "pulley")
    return (
        *(() if kind == "atwood" else (element("wire", at="first", coordinate=x),)),
        element("rod", start="first", to=left),
        element("rod", start=right, to="second"),
        element("disc", at="pulley", radius="a" if kind == "atwood" else 0.06),
        element("block", at="first", width=0.24, height=0.16),
        element("block", at="second", width=0.16, height=0.2),
        element("force", load="weight"),
    )


def lever(draw: Draw) -> Part:
    """A beam on a bearing, with masses at its ends and an upright spring."""
    phi = draw.one_of(("phi", "psi", "alpha"))
    beam = Part(
        title="lever",
        told=told("lever", first="m1", second="m2", a="a", b="b", phi=phi),
        adds=("spring",),
        kinds={"a": Kind("m", (0.6, 0.8)), "b": Kind("m", (0.4, 0.5))},
        coordinates=(angle(phi, 0.4),),
        points=(point("pivot", "0", "0"),),
        bodies=(
            particle("first", "m1", f"a*cos({phi})", f"a*sin({phi})"),
            particle("second", "m2", f"-b*cos({phi})", f"-b*sin({phi})"),
        ),
        elements=(
            element("rod", start="second", to="first"),
            element("pivot", at="pivot"),
            element("ground", at="pivot"),
            element("block", at="first", width=0.16, height=0.16),
            element("block", at="second", width=0.16, height=0.16),
            element("force", load="weight"),
        ),
    )
    arm = draw.one_of(("a", "b"))
    spring = Part(
        told=told(f"lever-spring-{arm}", k="k", phi=phi),
        loads=(potential("spring", f"k*({arm}*sin({phi}))^2/2"),),
    )
    return sum(draw.some_of(pivot_extras(phi)[1:], 1), beam + spring + weight("up"))


FAMILIES = (
    bead_on_curve,
    bead_on_ellipse,
    bead_on_helix,
    pendulum,
    block_on_incline,
    hanging_mass,
    side_spring,
    rope,
    lever,
)
