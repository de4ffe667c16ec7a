"""Systems whose integrals of motion textbooks state: what they are called, and what they are."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from deltaq.mechanics.document import read_scene
from deltaq.mechanics.library import load_scene
from deltaq.mechanics.scene import Scene


@dataclass(frozen=True)
class Published:
    """`meanings` of all integrals, and as formulas those that are no cyclic momentum and not the energy."""

    source: str
    scene: Scene
    meanings: str
    integrals: tuple[str, ...] = ()


def scene(
    coordinates: Sequence[str],
    parameters: Mapping[str, float],
    bodies: Sequence[Mapping[str, object]],
    *loads: Mapping[str, object],
    dimension: int = 2,
) -> Scene:
    """Without units; parameters with their values."""
    return read_scene(
        {
            "id": "textbook",
            "dimension": dimension,
            "coordinates": [{"name": q, "value": 0.6, "rate": 0.2} for q in coordinates],
            "parameters": [{"name": name, "value": value} for name, value in parameters.items()],
            "bodies": list(bodies),
            "loads": [{"name": f"load{i}", **load} for i, load in enumerate(loads)],
        }
    )


def mass(name: str, *position: str, value: str = "m") -> Mapping[str, object]:
    return {"name": name, "kind": "particle", "mass": value, "position": list(position)}


def potential(energy: str) -> Mapping[str, object]:
    return {"kind": "potential", "energy": energy}


def force(*components: str, at: str = "bob") -> Mapping[str, object]:
    return {"kind": "force", "at": at, "force": list(components)}


def plane(parameters: Mapping[str, float], *loads: Mapping[str, object]) -> Scene:
    return scene("xy", {"m": 1.3, **parameters}, [mass("bob", "x", "y")], *loads)


def space(parameters: Mapping[str, float], *loads: Mapping[str, object]) -> Scene:
    return scene("xyz", {"m": 1.3, **parameters}, [mass("bob", "x", "y", "z")], *loads, dimension=3)


def line(parameters: Mapping[str, float], *loads: Mapping[str, object]) -> Scene:
    return scene("x", {"m": 1.3, **parameters}, [mass("bob", "x", "0")], *loads)


R2, R3 = "sqrt(x^2+y^2)", "sqrt(x^2+y^2+z^2)"
PAIR = [mass("a", "x1", "y1", value="m1"), mass("b", "x2", "y2", value="m2")]
PAIR3 = [mass("a", "x1", "y1", "z1", value="m1"), mass("b", "x2", "y2", "z2", value="m2")]
ROW = [mass(f"b{i}", f"x{i}", "0", value=f"m{i}") for i in (1, 2, 3)]
LL, GPS = "Landau, Lifshitz, Mechanics", "Goldstein, Poole, Safko, 3rd ed."
L_X, L_Y, L_Z = "m*(y*dot(z)-z*dot(y))", "m*(x*dot(z)-z*dot(x))", "m*(x*dot(y)-y*dot(x))"

OMEGA = (
    "(dot(psi)*sin(theta)*sin(phi)+dot(theta)*cos(phi))",
    "(dot(psi)*sin(theta)*cos(phi)-dot(theta)*sin(phi))",
    "(dot(psi)*cos(theta)+dot(phi))",
)


def rigid(x: str, y: str, z: str, *loads: Mapping[str, object]) -> Scene:
    """An asymmetric rigid body in Euler angles, its centre of mass there."""
    body = {"name": "body", "kind": "rigid", "mass": "m", "position": [x, y, z], "inertia": ["A", "B", "C"]}
    values = {"m": 1.3, "A": 1, "B": 2, "C": 2.5} | ({"g": 9.81} if loads else {})
    names = [*(q for q in (x, y, z) if q != "0"), "theta", "psi", "phi"]
    return scene(names, values, [body | {"angular_velocity": list(OMEGA)}], *loads, dimension=3)


def spherical(parameters: Mapping[str, float], *loads: Mapping[str, object]) -> Scene:
    place = "r*sin(theta)*cos(psi)", "r*sin(theta)*sin(psi)", "r*cos(theta)"
    names = ["r", "theta", "psi"]
    return scene(names, {"m": 1.3, **parameters}, [mass("bob", *place)], *loads, dimension=3)


# The angular momentum in space, from that in the body by the transposed matrix of the Euler angles.
SPIN_X = (
    f"A*{OMEGA[0]}*(cos(psi)*cos(phi)-cos(theta)*sin(phi)*sin(psi))"
    f"-B*{OMEGA[1]}*(cos(psi)*sin(phi)+cos(theta)*cos(phi)*sin(psi))+C*{OMEGA[2]}*sin(theta)*sin(psi)"
)
SPIN_Y = (
    f"A*{OMEGA[0]}*(sin(psi)*cos(phi)+cos(theta)*sin(phi)*cos(psi))"
    f"-B*{OMEGA[1]}*(sin(psi)*sin(phi)-cos(theta)*cos(phi)*cos(psi))-C*{OMEGA[2]}*sin(theta)*cos(psi)"
)

SYSTEMS: Mapping[str, Published] = {
    "free in the plane": Published(
        f"{LL} §7", plane({}), "translation-x translation-y time rotation-origin boost-x", (L_Z, "m*(t*dot(x)-x)")
    ),
    "free in space": Published(
        "Arnold, 2nd ed., §2 (Galilean group)",
        space({}),
        "translation-x translation-y translation-z time rotation-z rotation-y boost-x",
        (L_Z, L_Y, "m*(t*dot(x)-x)"),
    ),
    "projectile": Published(
        f"{LL} §9",
        space({"g": 9.81}, potential("m*g*z")),
        "translation-x translation-y time translation-z rotation-z boost-x",
        ("m*(dot(z)+g*t)", L_Z, "m*(t*dot(x)-x)"),
    ),
    "Kepler, plane": Published(f"{GPS} §3.2", plane({"k": 2}, potential(f"-k/{R2}")), "time rotation-origin", (L_Z,)),
    "Kepler, space": Published(
        f"{GPS} §3.1", space({"k": 2}, potential(f"-k/{R3}")), "time rotation-x rotation-y rotation-z", (L_X, L_Y, L_Z)
    ),
    "Kepler, polar": Published(
        f"{GPS} §3.2",
        scene(["r", "phi"], {"m": 1.3, "k": 2}, [mass("bob", "r*cos(phi)", "r*sin(phi)")], potential("-k/r")),
        "rotation-origin time",
    ),
    "Kepler about another centre": Published(
        f"{GPS} §3.1",
        plane({"k": 2, "a": 0.3}, potential("-k/sqrt((x-a)^2+y^2)")),
        "time rotation-point",
        ("m*((x-a)*dot(y)-y*dot(x))",),
    ),
    "isotropic oscillator": Published(
        f"{GPS} §9.7",
        space({"k": 2}, potential("k*(x^2+y^2+z^2)/2")),
        "time rotation-x rotation-y rotation-z",
        (L_X, L_Y, L_Z),
    ),
    "oscillator, κ = 1": Published(
        "Scheck, Mechanics, 5th ed., §2.34",
        plane({"k": 2, "kappa": 1}, potential("k*(x^2+kappa*y^2)/2")),
        "time rotation-origin",
        (L_Z,),
    ),
    "oscillator, κ = 2": Published(
        "Scheck, Mechanics, 5th ed., §2.34", plane({"k": 2, "kappa": 2}, potential("k*(x^2+kappa*y^2)/2")), "time"
    ),
    "Hénon and Heiles": Published(f"{GPS} §11.5", plane({"k": 1}, potential("(x^2+y^2)/2+k*(x^2*y-y^3/3)")), "time"),
    "field of a plane": Published(
        f"{LL} §9, problem 3a",
        space({"k": 2}, potential("k*z^4")),
        "translation-x translation-y time rotation-z boost-x",
        (L_Z, "m*(t*dot(x)-x)"),
    ),
    "field of a cylinder": Published(
        f"{LL} §9, problem 3b",
        space({"k": 2}, potential("k*log(x^2+y^2)")),
        "translation-z time rotation-z boost-z",
        (L_Z, "m*(t*dot(z)-z)"),
    ),
    "field of a prism": Published(
        f"{LL} §9, problem 3c",
        space({"k": 2}, potential("k*(x^4+2*y^6)")),
        "translation-z time boost-z",
        ("m*(t*dot(z)-z)",),
    ),
    "field of two points": Published(
        f"{LL} §9, problem 3d",
        space({"k": 2, "a": 1}, potential("-k/sqrt(x^2+y^2+(z-a)^2)-2*k/sqrt(x^2+y^2+(z+a)^2)")),
        "time rotation-z",
        (L_Z,),
    ),
    "field of a half-plane": Published(
        f"{LL} §9, problem 3e",
        space({"k": 2}, potential("k*(sqrt(x^2+z^2)+x)^2")),
        "translation-y time boost-y",
        ("m*(t*dot(y)-y)",),
    ),
    "field of a cone": Published(
        f"{LL} §9, problem 3f", space({"k": 2}, potential("k*(x^2+y^2)/(1+z^2)+k*z^3")), "time rotation-z", (L_Z,)
    ),
    "field of a torus": Published(
        f"{LL} §9, problem 3g",
        space({"k": 2, "a": 1}, potential("k*((sqrt(x^2+y^2)-a)^2+z^2)")),
        "time rotation-z",
        (L_Z,),
    ),
    "field of a helix": Published(
        f"{LL} §9, problem 3h",
        scene(
            ["r", "phi", "z"],
            {"m": 1.3, "k": 2, "h": 0.7},
            [mass("bob", "r*cos(phi)", "r*sin(phi)", "z")],
            potential("k*r^2+k*cos(phi-2*pi*z/h)"),
            dimension=3,
        ),
        "time screw-z",
        ("m*r^2*dot(phi)+h/(2*pi)*m*dot(z)",),
    ),
    "magnetic field, plane": Published(
        "Kuypers, Klassische Mechanik, §6.3",
        plane({"b": 2}, force("b*dot(y)", "-b*dot(x)")),
        "time translation-x translation-y",
        ("m*dot(x)-b*y", "m*dot(y)+b*x"),
    ),
    "magnetic field, space": Published(
        f"{GPS} §2.6",
        space({"b": 2}, force("b*dot(y)", "-b*dot(x)", "0")),
        "translation-z time translation-x translation-y boost-z",
        ("m*dot(x)-b*y", "m*dot(y)+b*x", "m*(t*dot(z)-z)"),
    ),
    "crossed fields": Published(
        f"{LL}, The Classical Theory of Fields, §22",
        plane({"b": 2, "F0": 1}, force("b*dot(y)", "-b*dot(x)"), potential("-F0*y")),
        "time translation-x translation-y",
        ("m*dot(x)-b*y", "m*dot(y)+b*x-F0*t"),
    ),
    "two masses and a spring": Published(
        f"{LL} §§7–9",
        scene(
            ["x1", "y1", "x2", "y2"],
            {"m1": 1, "m2": 2.3, "k": 3, "s": 0.4},
            PAIR,
            {"kind": "spring", "from": "a", "to": "b", "stiffness": "k", "rest_length": "s"},
        ),
        "time translation-x translation-y rotation-origin boost-x boost-y",
        (
            "m1*dot(x1)+m2*dot(x2)",
            "m1*dot(y1)+m2*dot(y2)",
            "m1*(x1*dot(y1)-y1*dot(x1))+m2*(x2*dot(y2)-y2*dot(x2))",
            "t*(m1*dot(x1)+m2*dot(x2))-m1*x1-m2*x2",
            "t*(m1*dot(y1)+m2*dot(y2))-m1*y1-m2*y2",
        ),
    ),
    "two bodies in space": Published(
        "Arnold, 2nd ed., §10 (ten classical integrals)",
        scene(
            ["x1", "y1", "z1", "x2", "y2", "z2"],
            {"m1": 1, "m2": 2.3, "G": 3},
            PAIR3,
            potential("-G*m1*m2/sqrt((x1-x2)^2+(y1-y2)^2+(z1-z2)^2)"),
            dimension=3,
        ),
        "time translation-x translation-y translation-z rotation-x rotation-y rotation-z boost-x boost-y boost-z",
        (
            "m1*dot(x1)+m2*dot(x2)",
            "m1*dot(z1)+m2*dot(z2)",
            "m1*(x1*dot(y1)-y1*dot(x1))+m2*(x2*dot(y2)-y2*dot(x2))",
            "m1*(y1*dot(z1)-z1*dot(y1))+m2*(y2*dot(z2)-z2*dot(y2))",
            "t*(m1*dot(y1)+m2*dot(y2))-m1*y1-m2*y2",
        ),
    ),
    "linear molecule": Published(
        f"{GPS} §6.4",
        scene(["x1", "x2", "x3"], {"m1": 1, "m2": 2, "m3": 1.5, "k": 3}, ROW, potential("k*((x1-x2)^2+(x2-x3)^2)/2")),
        "time translation-x boost-x",
        ("m1*dot(x1)+m2*dot(x2)+m3*dot(x3)", "t*(m1*dot(x1)+m2*dot(x2)+m3*dot(x3))-m1*x1-m2*x2-m3*x3"),
    ),
    "Toda lattice": Published(
        "Arnold, 2nd ed., appendix 13",
        scene(
            ["x1", "x2", "x3"], dict.fromkeys(("m1", "m2", "m3", "k"), 1), ROW, potential("k*exp(x1-x2)+k*exp(x2-x3)")
        ),
        "time translation-x boost-x",
        ("m1*dot(x1)+m2*dot(x2)+m3*dot(x3)",),
    ),
    "pendulum on a cart": Published(
        f"{LL} §5, problem 2",
        load_scene("cart-pendulum"),
        "translation-x time boost-x",
        ("t*((M+m)*dot(x)+m*l*cos(phi)*dot(phi))-(M+m)*x-m*l*sin(phi)",),
    ),
    "Foucault": Published(
        f"{LL} §39, problem 3",
        load_scene("foucault"),
        "time rotation-origin",
        ("m*(x*dot(y)-y*dot(x))+m*Omega*sin(beta)*(x^2+y^2)",),
    ),
    "inverse cube force": Published(
        "Jackiw, Physics Today 25 (1972) 23",
        plane({"k": 2}, potential("k/(x^2+y^2)")),
        "time rotation-origin scaling",
        (L_Z, "m*(x*dot(x)+y*dot(y))-2*t*(m*(dot(x)^2+dot(y)^2)/2+k/(x^2+y^2))"),
    ),
    "turning field": Published(
        "Arnold, 2nd ed., §27; Jacobi's integral",
        plane({"k": 2, "Omega": 0.7}, potential("k*(x*cos(Omega*t)+y*sin(Omega*t))^2/2")),
        "time-and-shift",
        (f"m*(dot(x)^2+dot(y)^2)/2+k*(x*cos(Omega*t)+y*sin(Omega*t))^2/2-Omega*{L_Z}",),
    ),
    "linear drag": Published(
        "Kuypers, Klassische Mechanik, §1.3",
        plane({"c": 0.4}, force("-c*dot(x)", "-c*dot(y)")),
        "translation-x translation-y",
        ("m*dot(x)+c*x", "m*dot(y)+c*y"),
    ),
    "quadratic drag": Published(
        "Kuypers, Klassische Mechanik, §1.3",
        plane({"c": 0.4}, force(f"-c*{'sqrt(dot(x)^2+dot(y)^2)'}*dot(x)", "-c*sqrt(dot(x)^2+dot(y)^2)*dot(y)")),
        "",
    ),
    "Kepler with drag": Published(
        f"{GPS} §1.5", plane({"c": 0.4, "k": 2}, potential(f"-k/{R2}"), force("-c*dot(x)", "-c*dot(y)")), ""
    ),
    "damped oscillator": Published(
        f"{LL} §25", line({"c": 0.4, "k": 2}, potential("k*x^2/2"), force("-c*dot(x)", "0")), ""
    ),
    "driven particle": Published(
        f"{LL} §22",
        line({"F0": 2, "omega": 1.4}, potential("-F0*cos(omega*t)*x")),
        "translation-x boost-x",
        ("m*dot(x)-F0*sin(omega*t)/omega", "m*(t*dot(x)-x)-F0*(t*sin(omega*t)/omega+cos(omega*t)/omega^2)"),
    ),
    "Atwood's machine": Published(f"{GPS} §1.6", load_scene("atwood"), "time shift"),
    "spherical pendulum": Published(f"{LL} §14, problem 1", load_scene("spherical-pendulum"), "rotation-z time"),
    "heavy symmetric top": Published(f"{LL} §35, problem 1", load_scene("heavy-top"), "rotation-z shift time"),
    "double pendulum": Published(f"{LL} §5, problem 1", load_scene("double-pendulum"), "time"),
    "bead on a turning hoop": Published("Arnold, 2nd ed., §16", load_scene("bead-on-rotating-hoop"), "time"),
    "oscillator with growing stiffness": Published("Arnold, 2nd ed., §25", line({"k": 2}, potential("k*t*x^2/2")), ""),
    "free rigid body": Published(
        f"{LL} §§33, 35; {GPS} §5.6", rigid("0", "0", "0"), "rotation-x rotation-y rotation-z time", (SPIN_X, SPIN_Y)
    ),
    "thrown body": Published(
        f"{LL} §34",
        rigid("x", "y", "z", potential("m*g*z")),
        "translation-x translation-y translation-z boost-x boost-z spin-x spin-y spin-z shift time",
        (SPIN_X, SPIN_Y),
    ),
    "Kepler in spherical coordinates": Published(
        f"{GPS} §3.1",
        spherical({"k": 2}, potential("-k/r")),
        "rotation-x rotation-y rotation-z time",
        ("m*r^2*(sin(psi)*dot(theta)+sin(theta)*cos(theta)*cos(psi)*dot(psi))",),
    ),
    "free in polar coordinates": Published(
        f"{LL} §4",
        scene(["r", "phi"], {"m": 1.3}, [mass("bob", "r*cos(phi)", "r*sin(phi)")]),
        "rotation-origin time translation-x scaling",
        ("m*(dot(r)*cos(phi)-r*sin(phi)*dot(phi))",),
    ),
}
