"""A program in TypeScript that asks the service for all that its description shows, over types that are made of it.

The types are those of openapi-typescript, the calls those of openapi-fetch, each as it is without any option. Nothing
in the program is cast: what does not fit the types does not compile.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from tests.frontend.node import frontend_with_tools, run

JSON = "application/json"
BY_ID = "get_derivation"  # by an id that no example can know
STRICT = {
    "compilerOptions": {
        "strict": True,
        "module": "NodeNext",
        "target": "ES2022",
        "lib": ["ES2022", "DOM", "DOM.Iterable"],
        "types": ["node"],
    }
}
Document = Mapping[str, Any]


@dataclass(frozen=True)
class Call:
    """A call as the program writes it."""

    name: str
    method: str
    path: str
    options: Mapping[str, Any]

    def __str__(self) -> str:
        texts = [
            f"{key}: {value if key == 'bodySerializer' else json.dumps(value)}" for key, value in self.options.items()
        ]
        return f"client.{self.method}({json.dumps(self.path)}, {{ {', '.join(texts)} }})"


def calls(document: Document) -> Iterator[Call]:
    """One for each documented example of a body; of addresses without a body, one for the examples in the address."""
    for path, methods in document["paths"].items():
        for method, operation in methods.items():
            name = operation["operationId"]
            if name == BY_ID:
                continue
            options = _of_address(operation) | _of_answer(operation)
            bodies = [*_bodies(document, operation)]
            for number, body in enumerate(bodies):
                yield Call(f"{name}-{number}", method.upper(), path, options | body)
            if not bodies:
                yield Call(name, method.upper(), path, options)


def with_scene(call: Call, scene: Mapping[str, Any]) -> Call | None:
    """The same call on another scene; None if it names none."""
    body = call.options.get("body")
    if not isinstance(body, dict) or "scene" not in body:
        return None
    return Call(f"{call.name}-own", call.method, call.path, {**call.options, "body": {**body, "scene": scene}})


def _of_address(operation: Document) -> dict[str, Any]:
    inside = [one for one in operation.get("parameters", ()) if one["in"] == "path"]
    schemas = {one["name"]: one["schema"] for one in inside}
    given = {name: [*schema.get("examples", ()), *schema.get("enum", ())][0] for name, schema in schemas.items()}
    return {"params": {"path": given}} if given else {}


def _of_answer(operation: Document) -> dict[str, Any]:
    return {} if JSON in operation["responses"]["200"]["content"] else {"parseAs": "text"}


def _bodies(document: Document, operation: Document) -> Iterator[dict[str, Any]]:
    for media, content in operation.get("requestBody", {}).get("content", {}).items():
        model = content["schema"].get("$ref", "").rpartition("/")[2]
        schema = document["components"]["schemas"][model] if model else content["schema"]
        for body in schema.get("examples", ()):
            as_it_is = {"bodySerializer": "(body: string) => body", "headers": {"content-type": media}}
            yield {"body": body} | ({} if isinstance(body, dict) else as_it_is)


def program(asked: list[Call], typed: list[Call]) -> str:
    """It sends what is `asked` and prints the status of each answer; what is `typed` besides has but to compile."""
    entries = "\n".join(f"  {json.dumps(one.name)}: () => {one}," for one in asked)
    besides = "\n".join(f"  {one};" for one in typed)
    return f"""
import createClient from "openapi-fetch";
import type {{ paths }} from "./api.js";

const client = createClient<paths>({{ baseUrl: process.argv[2] }});
const asked: Record<string, () => Promise<{{ response: Response }}>> = {{
{entries}
}};
export function typed() {{
{besides}
}}
export async function refused() {{
  // @ts-expect-error  a method is text
  await client.POST("/api/v1/simulations", {{ body: {{ scene: "pendulum", t_end: 1, method: 4 }} }});
  // @ts-expect-error  there is no such coordinate's member
  await client.POST("/api/v1/derivations", {{ body: {{ scene: {{ coordinates: [{{ name: 1 }}] }} }} }});
  // @ts-expect-error  the time is not left out
  await client.POST("/api/v1/simulations", {{ body: {{ scene: "pendulum" }} }});
  const {{ data }} = await client.POST("/api/v1/derivations", {{ body: {{ scene: "pendulum" }} }});
  // @ts-expect-error  an equation is text
  const equation: number | undefined = data?.result.equations[0]?.plain;
  return equation;
}}

const told = Object.entries(asked).map(async ([name, ask]) => {{
  const {{ response }} = await ask();
  return [name, response.status];
}});
console.log(JSON.stringify(Object.fromEntries(await Promise.all(told))));
"""


def build(folder: Path, document: Document, text: str) -> Path:
    """The program of this text, compiled; the AssertionError says what does not compile."""
    (folder / "node_modules").symlink_to(frontend_with_tools() / "node_modules")
    files = {"package.json": {"type": "module"}, "tsconfig.json": STRICT, "openapi.json": document}
    for name, content in files.items():
        (folder / name).write_text(json.dumps(content), encoding="utf-8")
    (folder / "client.ts").write_text(text, encoding="utf-8")
    for tool in ("openapi-typescript/bin/cli.js openapi.json --output api.d.ts", "typescript/bin/tsc --project ."):
        done = run("node", *f"node_modules/{tool}".split(), cwd=folder)
        assert done.returncode == 0, done.stdout + done.stderr
    return folder / "client.js"
