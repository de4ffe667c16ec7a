"""Scene documents of format 1 as the description shows them.

What reads them is `mechanics/document.py`, which tells all that is wrong with a document at once and in the client's
language; here stands only which fields there are, so that generated clients have types.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, GetCoreSchemaHandler
from pydantic_core import CoreSchema, PydanticCustomError, PydanticKnownError, core_schema
from typing_extensions import TypeAliasType

LONGEST_ID = 64  # characters of the name of a built-in scene


class Part(BaseModel):
    """A part of a document."""

    model_config = ConfigDict(extra="allow", serialize_by_alias=True)


Text = Annotated[str | dict[str, str], Field(description="a text, or one by language", examples=[{"en": "Pendulum"}])]
Expression = Annotated[str, Field(description="an expression in the names of the scene", examples=["l*sin(phi)"])]
Vector = Annotated[list[Expression], Field(description="components", examples=[["l*sin(phi)", "l*cos(phi)"]])]
Tensor = Annotated[
    list[Vector], Field(description="rows", examples=[[["A", "-D", "0"], ["-D", "B", "0"], ["0", "0", "C"]]])
]
Size = Annotated[float | str | None, Field(description="in metres, or a parameter by its name")]


class SceneCoordinate(Part):
    """A generalized coordinate, with where it begins."""

    name: str = Field(description="as expressions call it", examples=["phi"])
    latex: str | None = Field(None, description="how it is written")
    unit: str | None = Field(None, description="of its value", examples=["rad"])
    value: float | None = Field(None, description="at t = 0; 0 if empty")
    rate: float | None = Field(None, description="its derivative at t = 0; 0 if empty")
    min: float | None = Field(None, description="least value of the slider")
    max: float | None = Field(None, description="largest value of the slider")


class SceneParameter(Part):
    """A constant of the scene."""

    name: str = Field(description="as expressions call it", examples=["l"])
    latex: str | None = Field(None, description="how it is written", examples=["\\ell"])
    unit: str | None = Field(None, description="of its value", examples=["m"])
    value: float | None = Field(None, description="1 if empty")
    min: float | None = Field(None, description="least value of the slider")
    max: float | None = Field(None, description="largest value of the slider")
    positive: bool | None = Field(None, description="whether formulas may rely on its being positive; true if empty")


class ScenePoint(Part):
    """A point that bodies, loads and the drawing refer to."""

    name: str = Field(description="as loads and elements call it", examples=["pivot"])
    position: Vector = Field(description="components", examples=[["0", "0"]])


class MaterialCoordinate(Part):
    """A coordinate that tells the particles of a continuum apart."""

    name: str = Field(description="as expressions call it", examples=["s"])
    start: Expression = Field(alias="from", description="lower bound, of parameters alone", examples=["0"])
    to: Expression = Field(description="upper bound, of parameters alone", examples=["l"])


class SceneBody(Part):
    """What has mass; its kind decides which fields it has."""

    name: str | None = Field(None, description="as loads and elements call it", examples=["bob"])
    kind: Literal["particle", "rigid", "continuum"] = Field(description="of body")
    mass: Expression | None = Field(None, description="of a particle or rigid body", examples=["m"])
    position: Vector = Field(description="of the particle, of the centre of mass, or by the material coordinates")
    inertia: Expression | Vector | Tensor | None = Field(
        None,
        description="of a rigid body about its centre of mass: in space principal moments, or the rows of a tensor",
    )
    angle: Expression | None = Field(None, description="of a rigid body in the plane", examples=["phi"])
    angular_velocity: Vector | None = Field(None, description="of a rigid body in space, along the axes of its inertia")
    material: list[MaterialCoordinate] | None = Field(None, description="of a continuum")
    density: Expression | None = Field(None, description="of a continuum, by unit of the material coordinates")


class SceneLoad(Part):
    """What does work; its kind decides which fields it has."""

    name: str | None = Field(None, description="as steps and elements call it", examples=["weight"])
    kind: Literal[
        "gravity",
        "force",
        "moment",
        "spring",
        "damper",
        "dissipation",
        "potential",
        "generalized-potential",
        "friction",
        "distributed",
    ] = Field(description="of load")
    acceleration: Vector | None = Field(None, description="of gravity", examples=[["0", "g"]])
    at: str | None = Field(None, description="the point or body that a force acts on")
    force: Vector | Expression | None = Field(None, description="components of a force, or friction while it slips")
    coordinate: str | None = Field(None, description="that friction acts on, or what slips", examples=["x", "x - y"])
    static: Expression | None = Field(None, description="the most that friction holds with; its force if empty")
    surface_rate: Expression | None = Field(None, description="rate of the surface that it rubs on; 0 if empty")
    angle: Expression | None = Field(None, description="that a moment does work on")
    moment: Expression | None = Field(None, description="its value")
    start: str | None = Field(None, alias="from", description="where a spring or damper begins")
    to: str | None = Field(None, description="where a spring or damper ends")
    stiffness: Expression | None = Field(None, description="of a spring")
    rest_length: Expression | None = Field(None, description="of a spring; 0 if empty")
    coefficient: Expression | None = Field(None, description="of a damper")
    function: Expression | None = Field(None, description="Rayleigh's dissipation function")
    energy: Expression | None = Field(None, description="of a potential, or U(q, q̇, t) of a generalized one")
    material: list[MaterialCoordinate] | None = Field(None, description="of a distributed load")
    position: Vector | None = Field(None, description="of a distributed load, by the material coordinates")
    density: Vector | None = Field(None, description="of a distributed load, by unit of the material coordinates")


class SceneGuide(Part):
    """A coordinate that is a given function of time."""

    coordinate: str = Field(description="which one", examples=["y"])
    value: Expression = Field(description="its function of time", examples=["y0*sin(omega*t)"])


class SceneConstraint(Part):
    """What the motion keeps to, by a reaction that does no virtual work; its kind decides which fields it has."""

    name: str | None = Field(None, description="as steps and answers call it", examples=["rod"])
    kind: Literal["equation", "distance"] = Field(description="of constraint")
    equation: Expression | None = Field(
        None,
        description="between coordinates, t and parameters, or linear in the rates",
        examples=["x^2 + y^2 - l^2 = 0"],
    )
    start: str | None = Field(None, alias="from", description="the point or body where a rod begins")
    to: str | None = Field(None, description="the point or body where it ends")
    length: Expression | None = Field(None, description="of the rod: the multiplier is its force, positive in tension")
    multiplier: str | None = Field(None, description="what expressions call its multiplier", examples=["lambda"])
    latex: str | None = Field(None, description="how the multiplier is written", examples=["\\lambda"])


class SceneEvent(Part):
    """What ends the motion: an expression that passes through zero."""

    name: str = Field(description="as answers call it", examples=["slack"])
    value: Expression = Field(description="that passes through zero")
    title: Text | None = Field(None, description="what happens")
    at: str | None = Field(None, description="the body or point it happens to")
    then: Literal["end", "bounce"] | None = Field(None, description="what happens then: the motion ends, or an impact")
    restitution: Expression | None = Field(None, description="of an impact: rate behind over rate before, 0 to 1")


class DrawnElement(Part):
    """One primitive of the drawing; its kind decides which fields it has."""

    kind: str = Field(description="of primitive", examples=["rod"])
    at: str | None = Field(None, description="the point or body it is drawn at")
    start: str | None = Field(None, alias="from", description="the point or body where it begins")
    to: str | None = Field(None, description="the point or body where it ends")
    load: str | None = Field(None, description="that an arrow shows")
    coordinate: str | None = Field(None, description="that a dimension or angle shows")
    direction: str | None = Field(None, description="of a guide, a ground or an axis")
    label: str | None = Field(None, description="in LaTeX")
    radius: Size = None
    width: Size = None
    height: Size = None
    offset: Size = None


class SceneDrawing(Part):
    """How the scene is drawn."""

    vertical: Literal["up", "down"] | None = Field(
        None, description="where the last axis points; if empty, so that weights point down"
    )
    view: list[float] | None = Field(None, description="least and largest x, least and largest y")
    elements: list[DrawnElement] | None = Field(None, description="from back to front")


EXAMPLE: dict[str, Any] = {
    "format": 1,
    "id": "my-pendulum",
    "title": {"de": "Mein Pendel", "en": "My pendulum"},
    "summary": {"de": "Ein ebenes Pendel.", "en": "A plane pendulum."},
    "dimension": 2,
    "coordinates": [{"name": "phi", "unit": "rad", "value": 0.5, "rate": 0.0}],
    "parameters": [
        {"name": "m", "unit": "kg", "value": 1.0},
        {"name": "l", "latex": "\\ell", "unit": "m", "value": 1.0},
        {"name": "g", "unit": "m/s^2", "value": 9.81},
    ],
    "points": [{"name": "pivot", "position": ["0", "0"]}],
    "bodies": [{"name": "bob", "kind": "particle", "mass": "m", "position": ["l*sin(phi)", "l*cos(phi)"]}],
    "loads": [{"name": "weight", "kind": "gravity", "acceleration": ["0", "g"]}],
}


class SceneDocument(Part):
    """A mechanical system as data, format 1."""

    format: Annotated[int, Field(ge=1, le=1)] | None = Field(1, description="of the document; 1 if empty")
    id: str | None = Field(None, description="lower-case letters, digits and hyphens", examples=["my-pendulum"])
    title: Text | None = Field(None, description="what the scene is called")
    summary: Text | None = Field(None, description="what the scene is about")
    dimension: Literal[2, 3] | None = Field(None, description="of the space; told by the positions if empty")
    coordinates: list[SceneCoordinate] = Field(description="generalized coordinates")
    parameters: list[SceneParameter] | None = Field(None, description="constants")
    points: list[ScenePoint] | None = Field(None, description="places without mass")
    bodies: list[SceneBody] | None = Field(None, description="all that has mass; a motion needs one")
    loads: list[SceneLoad] | None = Field(None, description="all that does work")
    guides: list[SceneGuide] | None = Field(None, description="coordinates that are given functions of time")
    constraints: list[SceneConstraint] | None = Field(None, description="what reactions keep, besides the coordinates")
    events: list[SceneEvent] | None = Field(None, description="what ends the motion")
    labels: dict[str, Text] | None = Field(None, description="what parts are called, by their names")
    drawing: SceneDrawing | None = Field(None, description="how it is drawn")

    model_config = ConfigDict(json_schema_extra={"examples": [EXAMPLE]})


class ReadElsewhere:
    """A document that its own reader checks: here only `check` looks at it, and the description shows the type."""

    def __init__(self, shown: Any, check: Callable[[Any], Any]) -> None:
        self.shown, self.check = shown, check

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        """The type, of which the description is made; it neither validates nor serializes."""
        return core_schema.no_info_wrap_validator_function(
            lambda value, _: self.check(value),
            handler.generate_schema(self.shown),
            serialization=core_schema.plain_serializer_function_ser_schema(lambda value: value),
        )


def _object(value: Any) -> Any:
    if isinstance(value, dict):
        return value
    raise PydanticKnownError("dict_type")


def _scene(value: Any) -> Any:
    if isinstance(value, str) and len(value) > LONGEST_ID:
        raise PydanticKnownError("string_too_long", {"max_length": LONGEST_ID})
    if isinstance(value, (str, dict)):
        return value
    raise PydanticCustomError("request-scene-type", "a scene is given by its id or as a document")


SceneId = TypeAliasType(
    "SceneId", Annotated[str, Field(max_length=LONGEST_ID, description="id of a built-in scene", examples=["pendulum"])]
)
Scene = TypeAliasType("Scene", Annotated[Any, ReadElsewhere(SceneId | SceneDocument, _scene)])
Draft = TypeAliasType("Draft", Annotated[Any, ReadElsewhere(SceneId | SceneDocument | dict[str, Any], _scene)])
DraftReference = Annotated[
    Draft,
    Field(description="a built-in scene by its id, or a scene document, even an unfinished one", examples=["pendulum"]),
]
SceneReference = Annotated[
    Scene,
    Field(description="a built-in scene by its id, or a scene document of format 1", examples=["elastic-pendulum"]),
]
GivenScene = Annotated[dict[str, Any], ReadElsewhere(SceneDocument, _object)]
GivenDraft = Annotated[dict[str, Any], ReadElsewhere(SceneDocument | dict[str, Any], _object)]
