"""Energies and equations of common systems as textbooks print them, in the plain language of δq.

A system is given by its coordinates, parameters, bodies and loads; a line by the quantity it is of: E, V, the momentum
`p q` or the left side of the equation of a coordinate, `eq q`. Where a book divides an equation by a constant or has
letters of its own, the line is what the book's line is before and with the letters of the scene. What is printed is
compared with δq's result by the tests, so that a slip in copying is seen.

Sources: LL Landau, Lifshitz, Mechanics, 3rd ed.; GPS Goldstein, Poole, Safko, Classical Mechanics, 3rd ed.; T Taylor,
Classical Mechanics; TM Thornton, Marion, Classical Dynamics, 5th ed.; M Morin, Introduction to Classical Mechanics;
GHW Gross, Hauger, Schröder, Wall, Technische Mechanik 3 and 4; MP Magnus, Popp, Schwingungen; DH Den Hartog,
Mechanical Vibrations; TMW Thomsen, Vibrations and Stability; TAG Tufillaro, Abbott, Griffiths, Am. J. Phys. 52 (1984).
"""

from __future__ import annotations

from dataclasses import dataclass, field


@dataclass(frozen=True, eq=False)
class Book:
    """A system and its lines: quantity → line. Names are separated by blanks, components by semicolons."""

    id: str
    source: str
    coordinates: str
    parameters: str
    bodies: tuple[tuple[str, ...], ...]
    loads: tuple[dict[str, object], ...]
    lines: dict[str, str]
    guides: dict[str, str] = field(default_factory=dict)
    points: dict[str, str] = field(default_factory=dict)
    signed: str = ""


def body(mass: str, position: str, inertia: str = "", turning: str = "") -> tuple[str, ...]:
    """A particle, or a rigid body with its inertia and angle (in space: angular velocity)."""
    return (mass, position, inertia, turning)


def falling(*acceleration: str) -> dict[str, object]:
    """The weight."""
    return {"kind": "gravity", "name": "weight", "acceleration": list(acceleration)}


def potential(energy: str, name: str = "spring") -> dict[str, object]:
    """A potential energy."""
    return {"kind": "potential", "name": name, "energy": energy}


def spring(start: str, end: str, stiffness: str, rest: str = "0", name: str = "spring") -> dict[str, object]:
    """A spring between two places."""
    return {"kind": "spring", "name": name, "from": start, "to": end, "stiffness": stiffness, "rest_length": rest}


def dissipation(function: str, name: str = "damper") -> dict[str, object]:
    """Rayleigh's function."""
    return {"kind": "dissipation", "name": name, "function": function}


DOWN = falling("0", "g")
UP = falling("0", "-g")

BOOKS = (
    Book(
        "simple-pendulum", "LL §5", "phi", "m l g", (body("m", "l*sin(phi); l*cos(phi)"),), (DOWN,),
        {
            "E": "m*l^2*dot(phi)^2/2",
            "V": "-m*g*l*cos(phi)",
            "eq phi": "m*l^2*ddot(phi) + m*g*l*sin(phi)",
        },
    ),
    Book(
        "double-pendulum", "LL §5, problem 1; T §11.4", "phi1 phi2", "m1 m2 l1 l2 g",
        (
            body("m1", "l1*sin(phi1); l1*cos(phi1)"),
            body("m2", "l1*sin(phi1) + l2*sin(phi2); l1*cos(phi1) + l2*cos(phi2)"),
        ),
        (DOWN,),
        {
            "E": "(m1 + m2)*l1^2*dot(phi1)^2/2 + m2*l2^2*dot(phi2)^2/2"
            " + m2*l1*l2*dot(phi1)*dot(phi2)*cos(phi1 - phi2)",
            "V": "-(m1 + m2)*g*l1*cos(phi1) - m2*g*l2*cos(phi2)",
            "eq phi1": "(m1 + m2)*l1^2*ddot(phi1) + m2*l1*l2*ddot(phi2)*cos(phi1 - phi2)"
            " + m2*l1*l2*dot(phi2)^2*sin(phi1 - phi2) + (m1 + m2)*g*l1*sin(phi1)",
            "eq phi2": "m2*l2^2*ddot(phi2) + m2*l1*l2*ddot(phi1)*cos(phi1 - phi2)"
            " - m2*l1*l2*dot(phi1)^2*sin(phi1 - phi2) + m2*g*l2*sin(phi2)",
            "p phi1": "(m1 + m2)*l1^2*dot(phi1) + m2*l1*l2*dot(phi2)*cos(phi1 - phi2)",
        },
    ),
    Book(
        "pendulum-on-slider", "LL §5, problem 2", "x phi", "m1 m2 l g",
        (body("m1", "x; 0"), body("m2", "x + l*sin(phi); l*cos(phi)")), (DOWN,),
        {
            "E": "(m1 + m2)*dot(x)^2/2 + m2*(l^2*dot(phi)^2 + 2*l*dot(x)*dot(phi)*cos(phi))/2",
            "V": "-m2*g*l*cos(phi)",
            "eq x": "(m1 + m2)*ddot(x) + m2*l*ddot(phi)*cos(phi) - m2*l*dot(phi)^2*sin(phi)",
            "eq phi": "m2*l^2*ddot(phi) + m2*l*ddot(x)*cos(phi) + m2*g*l*sin(phi)",
            "p x": "(m1 + m2)*dot(x) + m2*l*dot(phi)*cos(phi)",
        },
    ),
    Book(
        "pendulum-on-circle", "LL §5, problem 3a", "phi", "m l a omega g",
        (body("m", "a*cos(omega*t) + l*sin(phi); -a*sin(omega*t) + l*cos(phi)"),), (DOWN,),
        {
            "E": "m*(l^2*dot(phi)^2 + a^2*omega^2 + 2*l*a*omega*dot(phi)*sin(phi - omega*t))/2",
            "eq phi": "m*l^2*ddot(phi) - m*l*a*omega^2*cos(phi - omega*t) + m*g*l*sin(phi)",
        },
    ),
    Book(
        "kapitza", "LL §30, problem 1", "phi", "m l a omega g",
        (body("m", "l*sin(phi); l*cos(phi) + a*cos(omega*t)"),), (DOWN,),
        {"eq phi": "m*l^2*ddot(phi) + m*l*(g + a*omega^2*cos(omega*t))*sin(phi)"},
    ),
    Book(
        "governor", "LL §5, problem 4", "theta psi", "m1 m2 a Omega g",
        (
            body("m1", "a*sin(theta)*cos(psi); a*sin(theta)*sin(psi); a*cos(theta)"),
            body("m1", "-a*sin(theta)*cos(psi); -a*sin(theta)*sin(psi); a*cos(theta)"),
            body("m2", "0; 0; 2*a*cos(theta)"),
        ),
        (falling("0", "0", "g"),),
        {
            "E": "m1*a^2*(dot(theta)^2 + Omega^2*sin(theta)^2) + 2*m2*a^2*dot(theta)^2*sin(theta)^2",
            "V": "-2*(m1 + m2)*g*a*cos(theta)",
        },
        guides={"psi": "Omega*t"},
    ),
    Book(
        "heavy-top", "LL §35, problem 1; GPS §5.7", "psi theta phi", "m A C l g",
        (
            body(
                "m", "l*sin(theta)*sin(psi); -l*sin(theta)*cos(psi); l*cos(theta)", "A; A; C",
                "dot(psi)*sin(theta)*sin(phi) + dot(theta)*cos(phi);"
                " dot(psi)*sin(theta)*cos(phi) - dot(theta)*sin(phi); dot(psi)*cos(theta) + dot(phi)",
            ),
        ),
        (falling("0", "0", "-g"),),
        {
            "E": "(A + m*l^2)*(dot(theta)^2 + dot(psi)^2*sin(theta)^2)/2 + C*(dot(phi) + dot(psi)*cos(theta))^2/2",
            "V": "m*g*l*cos(theta)",
            "p phi": "C*(dot(phi) + dot(psi)*cos(theta))",
            "p psi": "((A + m*l^2)*sin(theta)^2 + C*cos(theta)^2)*dot(psi) + C*dot(phi)*cos(theta)",
        },
    ),
    Book(
        "foucault", "LL §39, problem 3", "x y psi", "m l g Omega beta",
        (body("m", "x*cos(psi) - y*sin(psi); x*sin(psi) + y*cos(psi)"),),
        (potential("m*g*(x^2 + y^2)/(2*l)", "weight"),),
        {
            "E": "m*((dot(x) - y*Omega*sin(beta))^2 + (dot(y) + x*Omega*sin(beta))^2)/2",
            "V": "m*g*(x^2 + y^2)/(2*l)",
            "eq x": "m*ddot(x) - 2*m*Omega*sin(beta)*dot(y) - m*Omega^2*sin(beta)^2*x + m*g*x/l",
            "eq y": "m*ddot(y) + 2*m*Omega*sin(beta)*dot(x) - m*Omega^2*sin(beta)^2*y + m*g*y/l",
        },
        guides={"psi": "Omega*sin(beta)*t"},
    ),
    Book(
        "rotating-frame", "LL §39; T §9.5", "x y psi", "m W",
        (body("m", "x*cos(psi) - y*sin(psi); x*sin(psi) + y*cos(psi)"),), (potential("m*W^2*(x^2 + y^2)/2"),),
        {
            "E": "m*((dot(x) - W*y)^2 + (dot(y) + W*x)^2)/2",
            "p x": "m*(dot(x) - W*y)",
            "eq x": "m*ddot(x) - 2*m*W*dot(y)",
        },
        guides={"psi": "W*t"},
    ),
    Book(
        "kepler-polar", "GPS §3.2; T §8.3", "r phi", "m k", (body("m", "r*cos(phi); r*sin(phi)"),),
        (potential("-k/r", "gravitation"),),
        {
            "E": "m*(dot(r)^2 + r^2*dot(phi)^2)/2",
            "V": "-k/r",
            "eq r": "m*ddot(r) - m*r*dot(phi)^2 + k/r^2",
            "eq phi": "m*r^2*ddot(phi) + 2*m*r*dot(r)*dot(phi)",
            "p phi": "m*r^2*dot(phi)",
        },
    ),
    Book(
        "kepler-cartesian", "T §8.1; GPS §3.1", "x y", "m M G", (body("m", "x; y"),),
        (potential("-G*M*m/sqrt(x^2 + y^2)", "gravitation"),),
        {
            "E": "m*(dot(x)^2 + dot(y)^2)/2",
            "V": "-G*M*m/sqrt(x^2 + y^2)",
            "eq x": "m*ddot(x) + G*M*m*x/(x^2 + y^2)^(3/2)",
            "eq y": "m*ddot(y) + G*M*m*y/(x^2 + y^2)^(3/2)",
        },
    ),
    Book(
        "spherical-particle", "GPS §1.6; LL §4", "r theta phi", "m k",
        (body("m", "r*sin(theta)*cos(phi); r*sin(theta)*sin(phi); r*cos(theta)"),), (potential("k*r^2/2"),),
        {
            "E": "m*(dot(r)^2 + r^2*dot(theta)^2 + r^2*sin(theta)^2*dot(phi)^2)/2",
            "eq r": "m*ddot(r) - m*r*dot(theta)^2 - m*r*sin(theta)^2*dot(phi)^2 + k*r",
            "p phi": "m*r^2*sin(theta)^2*dot(phi)",
        },
    ),
    Book(
        "spherical-pendulum", "LL §14, problem 1", "theta phi", "m l g",
        (body("m", "l*sin(theta)*cos(phi); l*sin(theta)*sin(phi); -l*cos(theta)"),), (falling("0", "0", "-g"),),
        {
            "E": "m*l^2*(dot(theta)^2 + sin(theta)^2*dot(phi)^2)/2",
            "V": "-m*g*l*cos(theta)",
            "eq theta": "m*l^2*ddot(theta) - m*l^2*sin(theta)*cos(theta)*dot(phi)^2 + m*g*l*sin(theta)",
        },
    ),
    Book(
        "cone", "LL §14, problem 2; GPS §1.6", "r phi", "m g alpha",
        (body("m", "r*sin(alpha)*cos(phi); r*sin(alpha)*sin(phi); r*cos(alpha)"),), (falling("0", "0", "-g"),),
        {
            "E": "m*(dot(r)^2 + r^2*dot(phi)^2*sin(alpha)^2)/2",
            "V": "m*g*r*cos(alpha)",
            "eq r": "m*ddot(r) - m*r*dot(phi)^2*sin(alpha)^2 + m*g*cos(alpha)",
        },
    ),
    Book(
        "cone-by-slope", "T problem 7.17; M §6", "r phi", "m g c",
        (body("m", "r*cos(phi); r*sin(phi); c*r"),), (falling("0", "0", "-g"),),
        {
            "E": "m*((1 + c^2)*dot(r)^2 + r^2*dot(phi)^2)/2",
            "eq r": "(1 + c^2)*m*ddot(r) - m*r*dot(phi)^2 + m*g*c",
        },
    ),
    Book(
        "atwood", "GPS §1.6; T §7.2", "x", "M1 M2 l g", (body("M1", "0; x"), body("M2", "0; l - x")), (DOWN,),
        {"E": "(M1 + M2)*dot(x)^2/2", "eq x": "(M1 + M2)*ddot(x) - (M1 - M2)*g"},
    ),
    Book(
        "atwood-with-pulley", "T ch. 7; GHW TM3 ch. 4", "x", "m1 m2 R J g",
        (body("m1", "0; x"), body("m2", "0; -x"), body("m1", "0; 0", "J", "x/R")), (DOWN,),
        {
            "E": "(m1 + m2 + J/R^2)*dot(x)^2/2",
            "eq x": "(m1 + m2 + J/R^2)*ddot(x) - (m1 - m2)*g",
        },
    ),
    Book(
        "bead-on-turning-wire", "GPS §1.6; LL §5", "r phi", "m omega", (body("m", "r*cos(phi); r*sin(phi)"),), (),
        {"E": "m*(dot(r)^2 + r^2*omega^2)/2", "eq r": "m*ddot(r) - m*r*omega^2"},
        guides={"phi": "omega*t"},
    ),
    Book(
        "bead-on-hoop", "T example 7.6", "theta psi", "m R omega g",
        (body("m", "R*sin(theta)*cos(psi); R*sin(theta)*sin(psi); -R*cos(theta)"),), (falling("0", "0", "-g"),),
        {
            "E": "m*R^2*(dot(theta)^2 + omega^2*sin(theta)^2)/2",
            "eq theta": "m*R^2*ddot(theta) - m*R^2*omega^2*sin(theta)*cos(theta) + m*g*R*sin(theta)",
        },
        guides={"psi": "omega*t"},
    ),
    Book(
        "bead-on-parabola", "TM example 7.5", "r phi", "m c omega g",
        (body("m", "r*cos(phi); r*sin(phi); c*r^2"),), (falling("0", "0", "-g"),),
        {
            "E": "m*(dot(r)^2 + 4*c^2*r^2*dot(r)^2 + r^2*omega^2)/2",
            "V": "m*g*c*r^2",
            "eq r": "m*(1 + 4*c^2*r^2)*ddot(r) + 4*m*c^2*r*dot(r)^2 - m*r*omega^2 + 2*m*g*c*r",
        },
        guides={"phi": "omega*t"},
    ),
    Book(
        "block-on-wedge", "T example 7.5; M §6.1", "x s", "M m alpha g",
        (body("M", "x; 0"), body("m", "x + s*cos(alpha); s*sin(alpha)")), (DOWN,),
        {
            "E": "(M + m)*dot(x)^2/2 + m*(dot(s)^2 + 2*dot(x)*dot(s)*cos(alpha))/2",
            "V": "-m*g*s*sin(alpha)",
            "eq x": "(M + m)*ddot(x) + m*cos(alpha)*ddot(s)",
            "eq s": "m*ddot(s) + m*cos(alpha)*ddot(x) - m*g*sin(alpha)",
        },
    ),
    Book(
        "spring-pendulum", "M §6.1; T ch. 11", "r theta", "m k l g",
        (body("m", "r*sin(theta); r*cos(theta)"),), (DOWN, potential("k*(r - l)^2/2")),
        {
            "E": "m*(dot(r)^2 + r^2*dot(theta)^2)/2",
            "V": "k*(r - l)^2/2 - m*g*r*cos(theta)",
            "eq r": "m*ddot(r) - m*r*dot(theta)^2 + k*(r - l) - m*g*cos(theta)",
            "eq theta": "m*r^2*ddot(theta) + 2*m*r*dot(r)*dot(theta) + m*g*r*sin(theta)",
        },
    ),
    Book(
        "stretched-pendulum", "M §6.1, l + x", "x theta", "m k l g",
        (body("m", "(l + x)*sin(theta); (l + x)*cos(theta)"),), (DOWN, potential("k*x^2/2")),
        {
            "E": "m*(dot(x)^2 + (l + x)^2*dot(theta)^2)/2",
            "V": "k*x^2/2 - m*g*(l + x)*cos(theta)",
            "eq x": "m*ddot(x) - m*(l + x)*dot(theta)^2 + k*x - m*g*cos(theta)",
            "eq theta": "m*(l + x)^2*ddot(theta) + 2*m*(l + x)*dot(x)*dot(theta) + m*g*(l + x)*sin(theta)",
            "p theta": "m*(l + x)^2*dot(theta)",
        },
    ),
    Book(
        "shortened-cable", "GHW TM3 ch. 4; M ch. 6", "phi", "m L v g",
        (body("m", "(L - v*t)*sin(phi); (L - v*t)*cos(phi)"),), (DOWN,),
        {
            "E": "m*((L - v*t)^2*dot(phi)^2 + v^2)/2",
            "V": "-m*g*(L - v*t)*cos(phi)",
            "eq phi": "m*(L - v*t)^2*ddot(phi) - 2*m*v*(L - v*t)*dot(phi) + m*g*(L - v*t)*sin(phi)",
            "p phi": "m*(L - v*t)^2*dot(phi)",
        },
    ),
    Book(
        "pumped-swing", "MP ch. 4; TMW ch. 4", "phi", "m l epsilon omega g",
        (body("m", "l*(1 + epsilon*cos(omega*t))*sin(phi); l*(1 + epsilon*cos(omega*t))*cos(phi)"),), (DOWN,),
        {
            "E": "m*l^2*((1 + epsilon*cos(omega*t))^2*dot(phi)^2 + epsilon^2*omega^2*sin(omega*t)^2)/2",
            "V": "-m*g*l*(1 + epsilon*cos(omega*t))*cos(phi)",
            "eq phi": "m*l^2*(1 + epsilon*cos(omega*t))^2*ddot(phi)"
            " - 2*m*l^2*epsilon*omega*sin(omega*t)*(1 + epsilon*cos(omega*t))*dot(phi)"
            " + m*g*l*(1 + epsilon*cos(omega*t))*sin(phi)",
        },
    ),
    Book(
        "swinging-atwood", "TAG", "r theta", "m M l g",
        (body("m", "r*sin(theta); r*cos(theta)"), body("M", "0; l - r")), (DOWN,),
        {
            "E": "(M + m)*dot(r)^2/2 + m*r^2*dot(theta)^2/2",
            "eq r": "(M + m)*ddot(r) - m*r*dot(theta)^2 + g*(M - m*cos(theta))",
            "eq theta": "m*r^2*ddot(theta) + 2*m*r*dot(r)*dot(theta) + m*g*r*sin(theta)",
        },
    ),
    Book(
        "masses-on-rails", "GHW TM4 ch. 3; LL §21, problem 1", "x1 x2", "m1 m2 k s0 h",
        (body("m1", "x1; 0"), body("m2", "x2; h")), (spring("body1", "body2", "k", "s0"),),
        {
            "E": "m1*dot(x1)^2/2 + m2*dot(x2)^2/2",
            "V": "k*(sqrt((x2 - x1)^2 + h^2) - s0)^2/2",
            "eq x1": "m1*ddot(x1) - k*(x2 - x1)*(1 - s0/sqrt((x2 - x1)^2 + h^2))",
            "eq x2": "m2*ddot(x2) + k*(x2 - x1)*(1 - s0/sqrt((x2 - x1)^2 + h^2))",
        },
    ),
    Book(
        "truss", "GHW TM4 ch. 7 (von Mises)", "w", "m c a h L",
        (body("m", "0; h - w"),), (potential("c*(sqrt(a^2 + (h - w)^2) - L)^2", "bars"),),
        {
            "V": "c*(sqrt(a^2 + (h - w)^2) - L)^2",
            "eq w": "m*ddot(w) - 2*c*(h - w)*(1 - L/sqrt(a^2 + (h - w)^2))",
        },
    ),
    Book(
        "slider-on-spring", "LL §21, problem 1; TMW ch. 3", "x", "m k h s0",
        (body("m", "x; 0"),), (potential("k*(sqrt(x^2 + h^2) - s0)^2/2"),),
        {
            "V": "k*(sqrt(x^2 + h^2) - s0)^2/2",
            "eq x": "m*ddot(x) + k*x*(1 - s0/sqrt(x^2 + h^2))",
        },
    ),
    Book(
        "spring-in-plane", "T §8.1", "x y", "m k s0", (body("m", "x; y"),),
        (potential("k*(sqrt(x^2 + y^2) - s0)^2/2"),),
        {"eq x": "m*ddot(x) + k*x*(1 - s0/sqrt(x^2 + y^2))", "eq y": "m*ddot(y) + k*y*(1 - s0/sqrt(x^2 + y^2))"},
    ),
    Book(
        "masses-on-line", "GHW TM4 ch. 3", "x1 x2", "m1 m2 k s0",
        (body("m1", "x1; 0"), body("m2", "x2; 0")), (potential("k*(x2 - x1 - s0)^2/2"),),
        {
            "V": "k*(x2 - x1 - s0)^2/2",
            "eq x1": "m1*ddot(x1) - k*(x2 - x1 - s0)",
            "eq x2": "m2*ddot(x2) + k*(x2 - x1 - s0)",
        },
    ),
    Book(
        "two-carts", "T §11.1", "x1 x2", "m1 m2 k1 k2 k3",
        (body("m1", "x1; 0"), body("m2", "x2; 0")),
        (
            potential("k1*x1^2/2", "left"),
            potential("k2*(x1 - x2)^2/2", "middle"),
            potential("k3*x2^2/2", "right"),
        ),
        {
            "E": "m1*dot(x1)^2/2 + m2*dot(x2)^2/2",
            "V": "k1*x1^2/2 + k2*(x1 - x2)^2/2 + k3*x2^2/2",
            "eq x1": "m1*ddot(x1) + (k1 + k2)*x1 - k2*x2",
            "eq x2": "m2*ddot(x2) - k2*x1 + (k2 + k3)*x2",
        },
    ),
    Book(
        "triatomic", "GPS §6.4", "x1 x2 x3", "m M k b",
        (body("m", "x1; 0"), body("M", "x2; 0"), body("m", "x3; 0")),
        (potential("k*(x2 - x1 - b)^2/2", "first"), potential("k*(x3 - x2 - b)^2/2", "second")),
        {
            "E": "m*(dot(x1)^2 + dot(x3)^2)/2 + M*dot(x2)^2/2",
            "V": "k*(x2 - x1 - b)^2/2 + k*(x3 - x2 - b)^2/2",
            "eq x1": "m*ddot(x1) - k*(x2 - x1 - b)",
        },
    ),
    Book(
        "coupled-pendulums", "T problem 11.14; MP ch. 6", "phi1 phi2", "m l k g",
        (body("m", "l*sin(phi1); l*cos(phi1)"), body("m", "l*sin(phi2); l*cos(phi2)")),
        (DOWN, potential("k*l^2*(sin(phi1) - sin(phi2))^2/2")),
        {
            "E": "m*l^2*(dot(phi1)^2 + dot(phi2)^2)/2",
            "V": "-m*g*l*(cos(phi1) + cos(phi2)) + k*l^2*(sin(phi1) - sin(phi2))^2/2",
            "eq phi1": "m*l^2*ddot(phi1) + m*g*l*sin(phi1) + k*l^2*(sin(phi1) - sin(phi2))*cos(phi1)",
        },
    ),
    Book(
        "ball-in-bowl", "TM problem 7.3; GHW TM3", "theta", "m R r g",
        (body("m", "(R - r)*sin(theta); (R - r)*cos(theta)", "2*m*r^2/5", "(R - r)*theta/r"),), (DOWN,),
        {
            "E": "7*m*(R - r)^2*dot(theta)^2/10",
            "V": "-m*g*(R - r)*cos(theta)",
            "eq theta": "7*m*(R - r)^2*ddot(theta)/5 + m*g*(R - r)*sin(theta)",
        },
    ),
    Book(
        "cylinder-in-trough", "GHW TM3 ch. 4", "phi", "m R r g",
        (body("m", "(R - r)*sin(phi); (R - r)*cos(phi)", "m*r^2/2", "(R - r)*phi/r"),), (DOWN,),
        {
            "E": "3*m*(R - r)^2*dot(phi)^2/4",
            "eq phi": "3*m*(R - r)^2*ddot(phi)/2 + m*g*(R - r)*sin(phi)",
        },
    ),
    Book(
        "planet-gear", "GHW TM3 ch. 4", "phi", "m J J0 R r",
        (
            body("m", "0; 0", "J0", "phi"),
            body("m", "(R + r)*cos(phi); (R + r)*sin(phi)", "J", "(R + r)*phi/r"),
        ),
        (),
        {
            "E": "(J0 + m*(R + r)^2 + J*(R + r)^2/r^2)*dot(phi)^2/2",
            "eq phi": "(J0 + m*(R + r)^2 + J*(R + r)^2/r^2)*ddot(phi)",
        },
    ),
    Book(
        "torus", "M ch. 6; GPS ch. 2 (geodesics)", "theta phi", "m R r g",
        (body("m", "(R + r*cos(theta))*cos(phi); (R + r*cos(theta))*sin(phi); r*sin(theta)"),),
        (falling("0", "0", "-g"),),
        {
            "E": "m*((R + r*cos(theta))^2*dot(phi)^2 + r^2*dot(theta)^2)/2",
            "p phi": "m*(R + r*cos(theta))^2*dot(phi)",
            "eq theta": "m*r^2*ddot(theta) + m*r*(R + r*cos(theta))*sin(theta)*dot(phi)^2 + m*g*r*cos(theta)",
        },
    ),
    Book(
        "merry-go-round", "TM ch. 7; GHW TM3", "theta psi", "m a l Omega g",
        (body("m", "(a + l*sin(theta))*cos(psi); (a + l*sin(theta))*sin(psi); -l*cos(theta)"),),
        (falling("0", "0", "-g"),),
        {
            "E": "m*(l^2*dot(theta)^2 + (a + l*sin(theta))^2*Omega^2)/2",
            "eq theta": "m*l^2*ddot(theta) - m*l*Omega^2*(a + l*sin(theta))*cos(theta) + m*g*l*sin(theta)",
        },
        guides={"psi": "Omega*t"},
    ),
    Book(
        "cycloid", "LL §11; TM ch. 7", "theta", "m a g",
        (body("m", "a*(theta + sin(theta)); a*(1 - cos(theta))"),), (UP,),
        {
            "E": "m*a^2*(1 + cos(theta))*dot(theta)^2",
            "V": "-m*g*a*cos(theta)",
            "eq theta": "2*m*a^2*(1 + cos(theta))*ddot(theta) - m*a^2*sin(theta)*dot(theta)^2 + m*g*a*sin(theta)",
        },
    ),
    Book(
        "physical-pendulum", "GHW TM3 ch. 3", "phi", "m s J g",
        (body("m", "s*sin(phi); s*cos(phi)", "J", "phi"),), (DOWN,),
        {
            "E": "(J + m*s^2)*dot(phi)^2/2",
            "eq phi": "(J + m*s^2)*ddot(phi) + m*g*s*sin(phi)",
        },
    ),
    Book(
        "rolling-disc-with-pendulum", "GHW TM3 ch. 4", "x phi", "M m R l g",
        (body("M", "x; 0", "M*R^2/2", "x/R"), body("m", "x + l*sin(phi); l*cos(phi)")), (DOWN,),
        {
            "E": "(3*M/2 + m)*dot(x)^2/2 + m*(l^2*dot(phi)^2 + 2*l*dot(x)*dot(phi)*cos(phi))/2",
            "eq x": "(3*M/2 + m)*ddot(x) + m*l*ddot(phi)*cos(phi) - m*l*dot(phi)^2*sin(phi)",
        },
    ),
    Book(
        "damped-oscillator", "MP ch. 3; LL §25", "x", "m b k", (body("m", "x; 0"),),
        (potential("k*x^2/2"), dissipation("b*dot(x)^2/2")),
        {"eq x": "m*ddot(x) + b*dot(x) + k*x"},
    ),
    Book(
        "absorber", "DH §3.2", "x1 x2", "M m K k F0 omega",
        (body("M", "x1; 0"), body("m", "x2; 0")),
        (
            potential("K*x1^2/2", "ground"),
            potential("k*(x2 - x1)^2/2", "absorber"),
            {"kind": "force", "name": "drive", "at": "body1", "force": ["F0*sin(omega*t)", "0"]},
        ),
        {
            "V": "K*x1^2/2 + k*(x2 - x1)^2/2 - F0*x1*sin(omega*t)",
            "eq x1": "M*ddot(x1) + K*x1 - k*(x2 - x1) - F0*sin(omega*t)",
            "eq x2": "m*ddot(x2) + k*(x2 - x1)",
        },
    ),
    Book(
        "quarter-car", "MP ch. 6; DH §3", "x1 x2", "m1 m2 k c b h omega",
        (body("m1", "0; x1"), body("m2", "0; x2")),
        (
            potential("k*(x1 - h*cos(omega*t))^2/2", "tyre"),
            potential("c*(x2 - x1)^2/2", "spring"),
            dissipation("b*(dot(x2) - dot(x1))^2/2"),
        ),
        {
            "V": "k*(x1 - h*cos(omega*t))^2/2 + c*(x2 - x1)^2/2",
            "eq x1": "m1*ddot(x1) - b*(dot(x2) - dot(x1)) - c*(x2 - x1) + k*(x1 - h*cos(omega*t))",
            "eq x2": "m2*ddot(x2) + b*(dot(x2) - dot(x1)) + c*(x2 - x1)",
        },
    ),
    Book(
        "duffing", "TMW ch. 3; MP ch. 3", "x", "m k alpha", (body("m", "x; 0"),),
        (potential("k*x^2/2 + alpha*x^4/4"),),
        {"V": "k*x^2/2 + alpha*x^4/4", "eq x": "m*ddot(x) + k*x + alpha*x^3"},
    ),
    Book(
        "cubic-with-sign", "MP ch. 2", "x", "m c", (body("m", "x; 0"),), (potential("c*abs(x)^3/3"),),
        {"V": "c*abs(x)^3/3", "eq x": "m*ddot(x) + c*x*abs(x)"},
    ),
    Book(
        "points-on-a-line", "GHW TM4 ch. 3", "x1 x2", "m1 m2 k s0",
        (body("m1", "x1; 0"), body("m2", "x2; 0")), (spring("body1", "body2", "k", "s0"),),
        {
            "V": "k*(abs(x2 - x1) - s0)^2/2",
            "eq x1": "m1*ddot(x1) - k*(x2 - x1 - s0*sign(x2 - x1))",
        },
    ),
    Book(
        "morse", "LL §23; GPS ch. 6", "x", "m D a", (body("m", "x; 0"),),
        (potential("D*(1 - exp(-a*x))^2", "bond"),),
        {"V": "D*(1 - exp(-a*x))^2", "eq x": "m*ddot(x) + 2*a*D*exp(-a*x)*(1 - exp(-a*x))"},
    ),
    Book(
        "lennard-jones", "T ch. 4; GPS ch. 3", "r", "m A B", (body("m", "r; 0"),),
        (potential("A/r^12 - B/r^6", "bond"),),
        {"V": "A/r^12 - B/r^6", "eq r": "m*ddot(r) - 12*A/r^13 + 6*B/r^7"},
    ),
    Book(
        "string-through-table", "GPS ch. 1; T problem 7.38", "r phi", "m M l g",
        (body("m", "r*cos(phi); r*sin(phi); 0"), body("M", "0; 0; r - l")), (falling("0", "0", "-g"),),
        {
            "E": "(m + M)*dot(r)^2/2 + m*r^2*dot(phi)^2/2",
            "eq r": "(m + M)*ddot(r) - m*r*dot(phi)^2 + M*g",
        },
    ),
    Book(
        "inverted-on-cart", "GHW TM3; MP ch. 4", "x phi", "M m l k g",
        (body("M", "x; 0"), body("m", "x + l*sin(phi); l*cos(phi)")), (UP, potential("k*x^2/2")),
        {
            "V": "k*x^2/2 + m*g*l*cos(phi)",
            "eq x": "(M + m)*ddot(x) + m*l*ddot(phi)*cos(phi) - m*l*dot(phi)^2*sin(phi) + k*x",
            "eq phi": "m*l^2*ddot(phi) + m*l*ddot(x)*cos(phi) - m*g*l*sin(phi)",
        },
    ),
    Book(
        "rod-with-torsion-spring", "GHW TM4 ch. 7", "phi", "J k F l",
        (body("J/l^2", "l*sin(phi); l*cos(phi)"),),
        (potential("k*phi^2/2"), potential("F*l*cos(phi)", "load")),
        {"V": "k*phi^2/2 + F*l*cos(phi)", "eq phi": "J*ddot(phi) + k*phi - F*l*sin(phi)"},
    ),
    Book(
        "two-springs-in-row", "MP ch. 2", "x", "m k1 k2", (body("m", "x; 0"),),
        (potential("k1*k2*x^2/(2*(k1 + k2))"),),
        {"V": "k1*k2*x^2/(2*(k1 + k2))", "eq x": "m*ddot(x) + k1*k2*x/(k1 + k2)"},
    ),
    Book(
        "parallel-springs", "MP ch. 2", "x", "m k1 k2", (body("m", "x; 0"),),
        (potential("k1*x^2/2", "first"), potential("k2*x^2/2", "second")),
        {"V": "(k1 + k2)*x^2/2", "eq x": "m*ddot(x) + (k1 + k2)*x"},
    ),
    Book(
        "charge-between-charges", "T ch. 4", "x", "m k a", (body("m", "x; 0"),),
        (potential("k/(a - x) + k/(a + x)", "field"),),
        {"V": "k/(a - x) + k/(a + x)", "eq x": "m*ddot(x) + k/(a - x)^2 - k/(a + x)^2"},
    ),
    Book(
        "dipole-pair", "GPS ch. 3", "r", "m G M J", (body("m", "r; 0"),),
        (potential("J^2/(2*m*r^2) - G*M*m/r", "effective"),),
        {"V": "J^2/(2*m*r^2) - G*M*m/r", "eq r": "m*ddot(r) - J^2/(m*r^3) + G*M*m/r^2"},
    ),
    Book(
        "paraboloid", "GPS ch. 2; LL §4", "rho phi", "m c g",
        (body("m", "rho*cos(phi); rho*sin(phi); rho^2/(2*c)"),), (falling("0", "0", "-g"),),
        {
            "E": "m*((1 + rho^2/c^2)*dot(rho)^2 + rho^2*dot(phi)^2)/2",
            "V": "m*g*rho^2/(2*c)",
        },
    ),
    Book(
        "elastic-pendulum", "the lecture", "y phi", "m l k g F0",
        (body("m", "l*sin(phi); y + l*cos(phi)"),),
        (
            DOWN, potential("k*y^2/2"),
            {"kind": "force", "name": "drive", "at": "body1", "force": ["F0*cos(phi)", "-F0*sin(phi)"]},
        ),
        {
            "E": "m*(l^2*dot(phi)^2 + dot(y)^2 - 2*l*dot(y)*dot(phi)*sin(phi))/2",
            "V": "k*y^2/2 - m*g*(y + l*cos(phi))",
            "eq y": "m*ddot(y) - m*l*ddot(phi)*sin(phi) - m*l*dot(phi)^2*cos(phi) + k*y - m*g + F0*sin(phi)",
            "eq phi": "m*l^2*ddot(phi) - m*l*ddot(y)*sin(phi) + m*g*l*sin(phi) - F0*l",
        },
    ),
    Book(
        "double-rod", "GHW TM3 ch. 4", "phi1 phi2", "m1 m2 l1 l2 J1 J2 a1 a2",
        (
            body("m1", "a1*sin(phi1); a1*cos(phi1)", "J1", "phi1"),
            body("m2", "l1*sin(phi1) + a2*sin(phi2); l1*cos(phi1) + a2*cos(phi2)", "J2", "phi2"),
        ),
        (),
        {
            "E": "(J1 + m1*a1^2 + m2*l1^2)*dot(phi1)^2/2 + (J2 + m2*a2^2)*dot(phi2)^2/2"
            " + m2*l1*a2*dot(phi1)*dot(phi2)*cos(phi1 - phi2)",
            "eq phi2": "(J2 + m2*a2^2)*ddot(phi2) + m2*l1*a2*ddot(phi1)*cos(phi1 - phi2)"
            " - m2*l1*a2*dot(phi1)^2*sin(phi1 - phi2)",
        },
    ),
    Book(
        "driven-cart-spring", "MP ch. 5", "x", "m k b u omega", (body("m", "x; 0"),),
        (
            potential("k*(x - u*sin(omega*t))^2/2"),
            dissipation("b*dot(x)^2/2"),
        ),
        {"eq x": "m*ddot(x) + b*dot(x) + k*(x - u*sin(omega*t))"},
    ),
    Book(
        "turning-table-spring", "TM ch. 10; LL §39", "r phi", "m k a Omega", (body("m", "r*cos(phi); r*sin(phi)"),),
        (potential("k*(r - a)^2/2"),),
        {
            "E": "m*(dot(r)^2 + Omega^2*r^2)/2",
            "eq r": "m*ddot(r) - m*Omega^2*r + k*(r - a)",
        },
        guides={"phi": "Omega*t"},
    ),
    Book(
        "rolling-hoop-on-wedge", "GHW TM3 ch. 4; M ch. 8", "x s", "M m alpha g R",
        (body("M", "x; 0"), body("m", "x + s*cos(alpha); s*sin(alpha)", "m*R^2", "s/R")), (DOWN,),
        {
            "E": "(M + m)*dot(x)^2/2 + m*dot(s)^2 + m*dot(x)*dot(s)*cos(alpha)",
            "eq s": "2*m*ddot(s) + m*cos(alpha)*ddot(x) - m*g*sin(alpha)",
        },
    ),
)  # fmt: skip
