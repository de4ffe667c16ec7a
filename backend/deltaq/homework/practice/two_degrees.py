"""Systems of two degrees of freedom: carts, chains, double pendulums, wedges, ropes."""

from __future__ import annotations

from collections.abc import Callable

from .draw import Draw
from .one_degree import line_damper, on_incline, slope_spring
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
    total,
    upright,
    weight,
)
from .symbols import LARGE_MASS, Kind

SMALL_ANGLE = 0.6
STIFF = Part(kinds={"k": Kind("N/m", (40.0, 50.0, 60.0))})


def hung_at(
    vertical: Vertical, phi: str, at: str, *, across: tuple[str, ...], down: tuple[str, ...], as_rod: bool
) -> Part:
    """A pendulum at a place: a particle on a massless rod, or a homogeneous rod."""
    end = (total(*across, f"l*sin({phi})"), below(vertical, *down, f"l*cos({phi})"))
    arc = element("angle", at=at, coordinate=phi)
    if as_rod:
        centre = (total(*across, f"l/2*sin({phi})"), below(vertical, *down, f"l/2*cos({phi})"))
        return Part(
            told=told("hung-rod", mass="m", l="l", phi=phi),
            coordinates=(angle(phi, SMALL_ANGLE),),
            points=(point("end", *end),),
            bodies=(rigid("rod", "m", "m*l^2/12", phi, *centre),),
            elements=(element("rod", start=at, to="end"), element("pivot", at=at), arc),
        )
    return Part(
        told=told("hung-bob", mass="m", l="l", phi=phi),
        coordinates=(angle(phi, SMALL_ANGLE),),
        bodies=(particle("bob", "m", *end),),
        elements=(element("rod", start=at, to="bob"), element("pivot", at=at), arc, element("bob", at="bob")),
    )


def cart_with_pendulum(draw: Draw) -> Part:
    """A cart that carries a pendulum, with a spring, a damper or a force at the cart."""
    x, phi, vertical = draw.one_of(("x", "s", "u")), draw.one_of(("phi", "theta")), upright(draw)
    cart = Part(
        title="cart-pendulum",
        vertical=vertical,
        told=told("cart", mass="M", x=x),
        coordinates=(length(x, 0.2),),
        called={"origin": "cart-start"},
        points=(ORIGIN, point("wall", "-1.4", "0")),
        bodies=(particle("cart", "M", x, "0"),),
        elements=(
            element("ground", at="origin", width=3.0),
            element("cart", at="cart"),
            element("dimension", start="origin", to="cart", coordinate=x),
        ),
    )
    hung = hung_at(vertical, phi, "cart", across=(x,), down=(), as_rod=draw.chance(0.35))
    spring = Part(
        told=told("wall-spring", k="k", x=x),
        adds=("spring",),
        loads=(potential("spring", f"k*{x}^2/2"),),
        elements=(element("spring", start="wall", to="cart", load="spring"),),
    )
    pushed = Part(
        told=told("force-at-cart", F="F"),
        adds=("force",),
        loads=(force("F", "cart", "F", "0"),),
        elements=(element("force", load="F"),),
    )
    options = draw.one_of(((), (spring,), (spring, pushed), (spring, line_damper(x, "damper-at-cart"))))
    return sum(options, cart + hung + weight(vertical))


def block_with_pendulum(draw: Draw) -> Part:
    """A block on an upright spring, or on an incline, with a pendulum hung on it."""
    vertical, phi = upright(draw), draw.one_of(("phi", "psi"))
    if draw.chance(0.5):
        y = draw.one_of(("y", "s"))
        block = Part(
            title="sprung-pendulum",
            vertical=vertical,
            told=told("sprung-block", mass="M", k="k", y=y, l0="l0"),
            coordinates=(length(y, 0.15, 0.4),),
            points=(point("support", "0", below(vertical, "-l0")),),
            bodies=(particle("block", "M", "0", below(vertical, y)),),
            loads=(potential("spring", f"k*{y}^2/2"),),
            elements=(
                element("ground", at="support"),
                element("spring", start="support", to="block", load="spring"),
                element("guide", at="block", direction="vertical"),
            ),
        )
        hung = hung_at(vertical, phi, "block", across=(), down=(y,), as_rod=draw.chance(0.4))
        return block + hung + weight(vertical)
    s = draw.one_of(("s", "u"))
    block = on_incline("incline-pendulum", vertical, "M", s, 0.2) + slope_spring(vertical, s) + STIFF
    hung = hung_at(vertical, phi, "block", across=(f"{s}*cos(alpha)",), down=(f"{s}*sin(alpha)",), as_rod=False)
    return block + hung + weight(vertical)


def chain_of_masses(draw: Draw) -> Part:
    """Two masses in a row with two or three springs, level or hanging, perhaps damped or driven."""
    first, second = draw.one_of((("x1", "x2"), ("s1", "s2"), ("u1", "u2")))
    hanging, third = draw.chance(0.4), draw.chance(0.5)
    place: Placing = (lambda way: ("0", way)) if hanging else (lambda way: (way, "0"))
    kind = "hanging" if hanging else "level"
    whole = Part(
        title=f"{kind}-chain",
        vertical="down" if hanging else "up",
        told=told(f"chain-{kind}", first="m1", second="m2", x1=first, x2=second, l1="l1"),
        coordinates=(length(first, 0.25, 0.4), length(second, -0.1, 0.4)),
        points=(point("rest1", *place("0")), point("rest2", *place("l1"))),
        kinds={"l1": Kind("m", (0.8, 0.9, 1.0))},
        bodies=(particle("first", "m1", *place(first)), particle("second", "m2", *place(f"l1 + {second}"))),
        elements=(
            *(element("block", at=name, width=0.2, height=0.2) for name in ("first", "second")),
            element("dimension", start="rest1", to="first", coordinate=first),
            element("dimension", start="rest2", to="second", coordinate=second),
        ),
    )
    damper = Part(
        told=told("damper-between", c="c"),
        adds=("damper",),
        loads=(dissipation(f"c*(dot({second}) - dot({first}))^2/2"),),
    )
    driven = Part(
        told=told("driving-force-at-second", force="F0*cos(Omega*t)"),
        adds=("driving",),
        loads=(force("F", "second", *place("F0*cos(Omega*t)")),),
        elements=(element("force", load="F"),),
    )
    held = whole + chain_springs(place, first, second, third=third)
    heavy = held + weight("down") if hanging else held
    return sum(draw.some_of((damper, driven), 1), heavy)


Placing = Callable[[str], tuple[str, str]]


def chain_springs(place: Placing, first: str, second: str, *, third: bool) -> Part:
    """The springs of a chain; without the third its end is free."""
    ends = ("begin", "first", "second", "end")
    energies = (f"k1*{first}^2/2", f"k2*({second} - {first})^2/2", f"k3*{second}^2/2")[: 2 + third]
    names = ("first_spring", "second_spring", "third_spring")[: 2 + third]
    walls = (("begin", "-l1"), ("end", "2*l1"))[: 1 + third]
    return Part(
        told=told("three-springs" if third else "two-springs", k1="k1", k2="k2", k3="k3"),
        points=tuple(point(name, *place(way)) for name, way in walls),
        loads=tuple(map(potential, names, energies)),
        elements=(
            *(element("spring", start=ends[n], to=ends[n + 1], load=name) for n, name in enumerate(names)),
            *(element("ground", at=name, width=0.4) for name, _ in walls),
        ),
    )


def double_pendulum(draw: Draw) -> Part:
    """Two pendulums in a row, of particles or rods."""
    one, two = draw.one_of((("phi1", "phi2"), ("theta1", "theta2"), ("phi", "psi")))
    vertical, kind = upright(draw), draw.one_of(("bobs", "rod-and-bob", "bob-and-rod"))
    end = (f"l1*sin({one})", f"l1*cos({one})")
    joint = point("joint", end[0], below(vertical, end[1]))
    if kind == "rod-and-bob":
        upper: Document = rigid("rod", "M", "M*l1^2/12", one, f"l1/2*sin({one})", below(vertical, f"l1/2*cos({one})"))
    else:
        upper = particle("first", "m1", end[0], below(vertical, end[1]))
    half = "l2/2" if kind == "bob-and-rod" else "l2"
    place = (total(end[0], f"{half}*sin({two})"), below(vertical, end[1], f"{half}*cos({two})"))
    tip = point("end", total(end[0], f"l2*sin({two})"), below(vertical, end[1], f"l2*cos({two})"))
    lower = rigid("rod", "m2", "m2*l2^2/12", two, *place) if kind == "bob-and-rod" else particle("second", "m2", *place)
    whole = Part(
        title=f"double-pendulum-{kind}",
        vertical=vertical,
        told=told(f"double-pendulum-{kind}", M="M", m1="m1", m2="m2", l1="l1", l2="l2", phi1=one, phi2=two),
        coordinates=(angle(one, 0.5), angle(two, 0.8)),
        points=(point("pivot", "0", "0"), joint, tip),
        bodies=(upper, lower),
        elements=(
            element("ground", at="pivot"),
            element("rod", start="pivot", to="joint"),
            element("rod", start="joint", to="end"),
            element("pivot", at="pivot"),
            element("pivot", at="joint"),
            element("angle", at="pivot", coordinate=one),
            element("angle", at="joint", coordinate=two),
            *(element("bob", at=name) for name in ("first", "second") if name in (upper["name"], lower["name"])),
        ),
    )
    sprung = Part(
        told=told("torsion-spring-between", kappa="kappa"),
        adds=("torsion-spring",),
        loads=(potential("torsion_spring", f"kappa*({two} - {one})^2/2"),),
    )
    return sum(draw.some_of((sprung,), 1), whole + weight(vertical))


def coupled_pendulums(draw: Draw) -> Part:
    """Two pendulums side by side, coupled by a level spring."""
    one, two = draw.one_of((("phi1", "phi2"), ("theta1", "theta2")))
    vertical, same = upright(draw), draw.chance(0.5)
    first, second = ("m", "m") if same else ("m1", "m2")
    arm = draw.one_of(("a", "l"))
    return Part(
        title="coupled-pendulums",
        vertical=vertical,
        told=told("coupled-pendulums", first=first, second=second, l="l", b="b", phi1=one, phi2=two)
        + told(f"coupling-spring-{arm}", k="k", a="a"),
        kinds={"b": Kind("m", (0.8, 1.0))},
        coordinates=(angle(one, 0.5), angle(two, 0.0)),
        points=(
            point("left", "0", "0"),
            point("right", "b", "0"),
            point("hold1", f"{arm}*sin({one})", below(vertical, f"{arm}*cos({one})")),
            point("hold2", f"b + {arm}*sin({two})", below(vertical, f"{arm}*cos({two})")),
        ),
        bodies=(
            particle("first", first, f"l*sin({one})", below(vertical, f"l*cos({one})")),
            particle("second", second, f"b + l*sin({two})", below(vertical, f"l*cos({two})")),
        ),
        loads=(potential("spring", f"k*({arm}*sin({two}) - {arm}*sin({one}))^2/2"),),
        elements=(
            *(element("ground", at=name) for name in ("left", "right")),
            *(element("pivot", at=name) for name in ("left", "right")),
            element("rod", start="left", to="first"),
            element("rod", start="right", to="second"),
            element("spring", start="hold1", to="hold2", load="spring"),
            element("angle", at="left", coordinate=one),
            element("angle", at="right", coordinate=two),
            element("bob", at="first"),
            element("bob", at="second"),
        ),
    ) + weight(vertical)


def wedge(vertical: Vertical, x: str, s: str) -> Part:
    """A wedge at x whose slope is b long, and the block on it."""
    foot = below(vertical, "b*sin(alpha)")
    sides = (("upper", "lower"), ("lower", "corner"), ("corner", "upper"))
    return Part(
        vertical=vertical,
        kinds={"b": Kind("m", (1.2, 1.4))},
        called={"origin": "wedge-start"},
        points=(ORIGIN, point("upper", x, "0"), point("lower", f"{x} + b*cos(alpha)", foot), point("corner", x, foot)),
        bodies=(particle("block", "m", f"{x} + {s}*cos(alpha)", below(vertical, f"{s}*sin(alpha)")),),
        elements=(
            *(element("rod", start=start, to=end) for start, end in sides),
            element("block", at="block", width=0.2, height=0.14),
            element("dimension", start="origin", to="upper", coordinate=x),
        ),
    )


def wedge_spring(s: str) -> Part:
    """A spring between block and wedge."""
    return Part(
        told=told("wedge-spring", k="k", s=s),
        adds=("spring",),
        loads=(potential("spring", f"k*{s}^2/2"),),
        elements=(element("spring", start="upper", to="block", load="spring"),),
    )


def wedge_with_block(draw: Draw) -> Part:
    """A block on a wedge that slides on the floor, with springs where they fit."""
    x, s = draw.one_of((("x", "s"), ("x1", "x2"), ("u", "s")))
    vertical = upright(draw)
    whole = wedge(vertical, x, s) + Part(
        title="wedge",
        told=told("wedge", first="M", second="m", alpha="alpha", b="b", x=x, s=s),
        coordinates=(length(x, 0.0), length(s, 0.3, 1.2)),
        bodies=(particle("wedge", "M", x, "0"),),
    )
    held = whole + wedge_spring(s) + weight(vertical)
    return sum(draw.some_of((line_damper(x, "damper-at-wedge"),), 1), held)


def ropes_on_pulleys(draw: Draw) -> Part:
    """Three masses on two ropes: a pulley hangs from a pulley."""
    x, y = draw.one_of((("x", "y"), ("x1", "x2"), ("s1", "s2")))
    vertical = upright(draw)
    third = ("3*a/2", below(vertical, "2*l1", f"-{x}", f"-{y}"))
    whole = Part(
        title="double-atwood",
        vertical=vertical,
        told=told("double-atwood", first="m1", second="m2", third="m3", a="a", l1="l1", x=x, y=y),
        kinds={"a": Kind("m", (0.3,)), "l1": Kind("m", (1.0, 1.2)), "m1": LARGE_MASS},
        coordinates=(length(x, 0.5, 1.0, least=0.0), length(y, 0.5, 1.0, least=0.0)),
        points=(
            point("fixed", "0", "0"),
            point("left", "-a", "0"),
            point("right", "a", "0"),
            point("pulley", "a", below(vertical, "l1", f"-{x}")),
            point("left_rim", "a/2", below(vertical, "l1", f"-{x}")),
            point("right_rim", "3*a/2", below(vertical, "l1", f"-{x}")),
        ),
        bodies=(
            particle("first", "m1", "-a", below(vertical, x)),
            particle("second", "m2", "a/2", below(vertical, "l1", f"-{x}", y)),
            particle("third", "m3", *third),
        ),
        elements=(
            element("rod", start="left", to="first"),
            element("rod", start="right", to="pulley"),
            element("rod", start="left_rim", to="second"),
            element("rod", start="right_rim", to="third"),
            element("disc", at="fixed", radius="a"),
            element("disc", at="pulley", radius=0.15),
            *(element("block", at=name, width=0.16, height=0.16) for name in ("first", "second", "third")),
        ),
    )
    ends = ending("first", x, y, f"l1 - {x}", f"l1 - {y}")
    return whole + ends + weight(vertical)


FAMILIES = (
    cart_with_pendulum,
    block_with_pendulum,
    chain_of_masses,
    double_pendulum,
    coupled_pendulums,
    wedge_with_block,
    ropes_on_pulleys,
)
