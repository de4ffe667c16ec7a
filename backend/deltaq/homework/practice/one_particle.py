"""Systems of two degrees of freedom in which one particle has both: on a spring, a rope or a surface, in a plane."""

from __future__ import annotations

from .draw import Draw
from .one_degree import pivot_extras
from .parts import (
    Part,
    Vertical,
    angle,
    below,
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
from .symbols import CURVATURE, INCLINATION, LARGE_MASS, Kind


def spring_pendulum(draw: Draw) -> Part:
    """A pendulum whose rod is a spring, or a bead with a spring on a heavy rod that swings."""
    r, phi, vertical = draw.one_of(("r", "s")), draw.one_of(("phi", "theta")), upright(draw)
    place = (f"{r}*sin({phi})", below(vertical, f"{r}*cos({phi})"))
    stretched = potential("spring", f"k*({r} - l0)^2/2")
    common = Part(
        vertical=vertical,
        coordinates=(length(r, 0.8, 1.5, least=0.2), angle(phi, 0.7)),
        points=(point("pivot", "0", "0"),),
        loads=(stretched,),
        elements=(
            element("ground", at="pivot"),
            element("pivot", at="pivot"),
            element("angle", at="pivot", coordinate=phi),
            element("spring", start="pivot", to="bead", load="spring"),
            element("bob", at="bead"),
            element("trail", at="bead"),
        ),
    )
    if draw.chance(0.5):
        kind = Part(
            title="elastic-pendulum",
            told=told("elastic-pendulum", mass="m", k="k", l0="l0", r=r, phi=phi),
            bodies=(particle("bead", "m", *place),),
        )
        return sum(draw.some_of(pivot_extras(phi)[1:], 1), common + kind + weight(vertical))
    kind = Part(
        title="bead-on-swinging-rod",
        told=told("bead-on-swinging-rod", mass="m", M="M", l="l", k="k", l0="l0", r=r, phi=phi),
        kinds={"l": Kind("m", (1.5, 1.8))},
        points=(point("end", f"l*sin({phi})", below(vertical, f"l*cos({phi})")),),
        bodies=(
            particle("bead", "m", *place),
            rigid("rod", "M", "M*l^2/12", phi, f"l/2*sin({phi})", below(vertical, f"l/2*cos({phi})")),
        ),
        elements=(element("rod", start="pivot", to="end"),),
    )
    return common + kind + weight(vertical)


def hole_in_table(draw: Draw) -> Part:
    """A particle on a table, on a rope through a hole from which a mass hangs."""
    r, phi = draw.one_of(("r", "s")), draw.one_of(("phi", "psi"))
    return Part(
        title="hole-in-table",
        told=told("hole-in-table", first="m", second="M", l="l", r=r, phi=phi),
        coordinates=(length(r, 0.7, 1.2, least=0.1), angle(phi, 0.0, rate=3.0)),
        kinds={"l": Kind("m", (1.5, 1.8))},
        called={"origin": "hole"},
        points=(point("origin", "0", "0", "0"),),
        bodies=(
            particle("bead", "m", f"{r}*cos({phi})", f"{r}*sin({phi})", "0"),
            particle("hanging", "M", "0", "0", f"{r} - l"),
        ),
        elements=(
            element("rod", start="origin", to="bead"),
            element("rod", start="origin", to="hanging"),
            element("bob", at="bead"),
            element("bob", at="hanging"),
            element("trail", at="bead"),
            element("weight", at="hanging"),
        ),
    ) + weight("up", 3)


def swinging_atwood(draw: Draw) -> Part:
    """A mass and a pendulum at the two ends of a rope."""
    r = draw.one_of(("r", "s"))
    phi, vertical = draw.one_of(("phi", "theta")), upright(draw)
    return Part(
        title="swinging-atwood",
        vertical=vertical,
        told=told("swinging-atwood", first="M", second="m", a="a", l="l", r=r, phi=phi),
        kinds={"l": Kind("m", (1.5, 1.8)), "M": LARGE_MASS},
        coordinates=(length(r, 0.8, 1.5, least=0.2), angle(phi, 0.8)),
        points=(point("left", "-a", "0"), point("pivot", "0", "0")),
        bodies=(
            particle("hanging", "M", "-a", below(vertical, "l", f"-{r}")),
            particle("bob", "m", f"{r}*sin({phi})", below(vertical, f"{r}*cos({phi})")),
        ),
        elements=(
            element("rod", start="left", to="hanging"),
            element("rod", start="left", to="pivot"),
            element("rod", start="pivot", to="bob"),
            element("disc", at="left", radius=0.06),
            element("disc", at="pivot", radius=0.06),
            element("angle", at="pivot", coordinate=phi),
            element("bob", at="bob"),
            element("block", at="hanging", width=0.2, height=0.2),
        ),
    ) + (ending("bob", r, f"l - {r}") + weight(vertical))


def particle_on_surface(draw: Draw) -> Part:
    """A particle on a surface of revolution about the vertical."""
    psi, r = draw.one_of(("psi", "phi")), draw.one_of(("r", "s"))
    surface, height, kinds = draw.one_of(
        (
            ("cone", f"{r}*tan(beta)", {"beta": INCLINATION}),
            ("paraboloid", f"a*{r}^2", {"a": CURVATURE}),
            ("gutter", f"a*{r}^3", {"a": Kind("1/m^2", (0.5, 0.8, 1.0))}),
        )
    )
    whole = Part(
        title=f"particle-on-{surface}",
        told=told("particle-on-surface", mass="m", height=f"z = {height}", r=r, psi=psi),
        kinds=kinds,
        coordinates=(length(r, 0.8, 1.4, least=0.1), angle(psi, 0.0, rate=2.5)),
        points=(point("origin", "0", "0", "0"),),
        bodies=(particle("bead", "m", f"{r}*cos({psi})", f"{r}*sin({psi})", height),),
        elements=(
            element("wire", at="bead", coordinate=r),
            element("wire", at="bead", coordinate=psi),
            element("azimuth", at="origin", to="bead", coordinate=psi),
            element("bob", at="bead"),
            element("trail", at="bead"),
            element("weight", at="bead"),
        ),
    )
    spring = Part(
        told=told("axis-spring-particle", k="k", r=r),
        adds=("spring",),
        loads=(potential("spring", f"k*{r}^2/2"),),
    )
    return sum(draw.some_of((spring,), 1), whole + weight("up", 3))


def particle_on_round_wall(draw: Draw) -> Part:
    """A particle on a sphere or a cylinder, by angles or by height and angle."""
    psi = draw.one_of(("psi", "phi"))
    if draw.chance(0.5):
        vertical: Vertical = "down"  # from which the drawing counts the angle
        place = (f"l*sin(theta)*cos({psi})", f"l*sin(theta)*sin({psi})", below(vertical, "l*cos(theta)"))
        return Part(
            title="spherical-pendulum",
            vertical=vertical,
            told=told("spherical-pendulum", mass="m", l="l", theta="theta", psi=psi),
            coordinates=(angle("theta", 0.8), angle(psi, 0.0, rate=2.5)),
            points=(point("pivot", "0", "0", "0"),),
            bodies=(particle("bob", "m", *place),),
            elements=(
                element("rod", start="pivot", to="bob"),
                element("polar", start="pivot", to="bob", coordinate="theta"),
                element("azimuth", at="pivot", to="bob", coordinate=psi),
                element("bob", at="bob"),
                element("trail", at="bob"),
                element("weight", at="bob"),
            ),
        ) + weight(vertical, 3)
    z = draw.one_of(("z", "s"))
    spring = {"name": "spring", "kind": "spring", "from": "origin", "to": "bead", "stiffness": "k"}
    return Part(
        title="particle-on-cylinder",
        told=told("particle-on-cylinder", mass="m", R="R", z=z, psi=psi) + told("soft-spring-particle", k="k"),
        adds=("spring",),
        coordinates=(length(z, 0.3), angle(psi, 0.0, rate=2.0)),
        points=(point("origin", "0", "0", "0"),),
        bodies=(particle("bead", "m", f"R*cos({psi})", f"R*sin({psi})", z),),
        loads=(spring,),
        elements=(
            element("wire", at="bead", coordinate=psi),
            element("spring", start="origin", to="bead", load="spring"),
            element("bob", at="bead"),
            element("trail", at="bead"),
            element("weight", at="bead"),
        ),
    ) + weight("up", 3)


def two_springs_in_plane(draw: Draw) -> Part:
    """A particle in a plane, held by soft springs."""
    x, y = "x", "y"
    names, points = ("first_spring", "second_spring"), ("left", "right")
    springs = [
        {"name": name, "kind": "spring", "from": at, "to": "bead", "stiffness": k}
        for name, at, k in zip(names, points, ("k1", "k2"), strict=True)
    ]
    whole = Part(
        title="particle-in-plane",
        told=told("particle-in-plane", mass="m", k1="k1", k2="k2", a="a", x=x, y=y),
        coordinates=(length(x, 0.3), length(y, -0.4)),
        points=(point("left", "-a", "0"), point("right", "a", "0")),
        bodies=(particle("bead", "m", x, y),),
        loads=tuple(springs),
        elements=(
            *(element("ground", at=at) for at in points),
            *(element("spring", start=at, to="bead", load=name) for at, name in zip(points, names, strict=True)),
            element("bob", at="bead"),
            element("trail", at="bead"),
            element("force", load="weight"),
        ),
    )
    drag = Part(
        told=told("drag-particle", body="c"),
        adds=("drag",),
        loads=(force("drag", "bead", f"-c*dot({x})", f"-c*dot({y})"),),
    )
    return sum(draw.some_of((drag,), 1), whole + weight("up"))


FAMILIES = (
    spring_pendulum,
    hole_in_table,
    swinging_atwood,
    particle_on_surface,
    particle_on_round_wall,
    two_springs_in_plane,
)
