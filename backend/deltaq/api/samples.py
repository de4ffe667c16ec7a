"""Each call of the API as a line for a shell and as a cell for a notebook, made from the examples of its description.

Both can be copied as they are; ADDRESS stands where the service is.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

Json = Mapping[str, Any]

ADDRESS = "http://localhost:8000"
JSON = "application/json"
LONGEST = 300  # seconds that a notebook waits for an experiment
WIDTH = 96

# What one looks at first in an answer.
SHOWN = {
    "list_scenes": '[scene["id"] for scene in answer["scenes"]]',
    "get_scene": 'answer["bodies"]',
    "validate_scene": 'answer["valid"]',
    "read_toml_scene": 'answer["scene"]',
    "derive": '[equation["plain"] for equation in answer["result"]["equations"]]',
    "get_derivation": '[equation["plain"] for equation in answer["result"]["equations"]]',
    "simulate": 'answer["coordinates"]["phi"][-1], answer["error"]["estimate"][-1]',
    "vary": 'answer["result"]["first_variation"]["plain"]',
    "list_proofs": '[proof["title"] for proof in answer["proofs"]]',
    "get_proof": '[step["latex"] for chapter in answer["chapters"] for step in chapter["steps"]]',
    "list_methods": '{method["id"]: method["order"] for method in answer["methods"]}',
    "list_tasks_of_scene": '{task["id"]: task["statement"] for task in answer["tasks"]}',
    "list_tasks": '{task["id"]: task["statement"] for task in answer["tasks"]}',
    "solve_task": 'answer["plain"]',
    "check": 'answer["outcome"], answer["feedback"]',
    "check_lines": '[line["outcome"] for line in answer["lines"]], answer["points"], answer["of"]',
    "check_table": 'answer["students"], answer["points"], answer["of"]',
    "check_batch": '[verdict["outcome"] for verdict in answer["verdicts"]]',
    "read_answer": 'answer["plain"]',
    "answered_motion": 'answer["scene"]["loads"]',
    "open_assignment": '[task["task"]["statement"] for task in answer["tasks"]]',
    "get_catalog": 'answer["methods"]',
    "list_experiments": '{one["id"]: [option["name"] for option in one["options"]] for one in answer["experiments"]}',
    "work_precision": '[(chart["title"], chart["caption"]) for chart in answer["charts"]]',
    "convergence": 'answer["orders"]',
}
# The same by the subject of a call that is not named above.
SHOWN_BY_SUBJECT = {"experiments": '[chart["caption"] for chart in answer["charts"]]'}

# The id of a derivation is known only when there was one.
_DERIVED_SHELL = r"""ID=$(curl -s {0}/api/v1/derivations -H 'content-type: application/json' \
  --data-binary '{{"scene": "pendulum"}}' | sed 's/.*"id": *"\([0-9a-f]*\)".*/\1/')
curl {0}/api/v1/derivations/$ID"""
_DERIVED_PYTHON = """import httpx

derived = httpx.post("{0}/api/v1/derivations", json={{"scene": "pendulum"}}, timeout=60).json()
answer = httpx.get(f"{0}/api/v1/derivations/{{derived['id']}}", timeout=60).json()
{1}"""
BY_ID = {
    "x-codeSamples": [
        {"lang": "Shell", "source": _DERIVED_SHELL.format(ADDRESS)},
        {"lang": "Python", "source": _DERIVED_PYTHON.format(ADDRESS, SHOWN["get_derivation"])},
    ]
}


def samples(method: str, path: str, operation: Json, components: Json) -> list[dict[str, str]]:
    """The samples of a call, in the form of `x-codeSamples` that readers of OpenAPI know."""
    address = ADDRESS + path_of(path, operation)
    media_type, body = body_of(operation, components)
    is_json = JSON in operation["responses"]["200"]["content"]
    looked_at = SHOWN.get(operation["operationId"]) or SHOWN_BY_SUBJECT.get(operation["tags"][0], "answer")
    return [
        {"lang": "Shell", "source": shell(address, media_type, body)},
        {"lang": "Python", "source": notebook(method, address, media_type, body, looked_at if is_json else None)},
    ]


def path_of(path: str, operation: Json) -> str:
    """The path with the examples of its parameters."""
    for parameter in operation.get("parameters", []):
        schema = parameter["schema"]
        if parameter["in"] == "path":
            example = (schema.get("examples") or schema["enum"])[0]
            path = path.replace(f"{{{parameter['name']}}}", example)
    return path


def body_of(operation: Json, components: Json) -> tuple[str, Any]:
    """Media type and first example of the request's body; ("", None) where it has none."""
    for media_type, content in operation.get("requestBody", {}).get("content", {}).items():
        schema = content["schema"]
        name = schema.get("$ref", "").rpartition("/")[2]
        model = components[name] if name else schema
        example = model["examples"][0]
        fields = model.get("properties")  # in the order in which they are explained
        return media_type, {name: example[name] for name in fields if name in example} if fields else example
    return "", None


def shell(address: str, media_type: str, body: Any) -> str:
    """A line for a shell."""
    if body is None:
        return f"curl {address}"
    data = body if isinstance(body, str) else json.dumps(body, ensure_ascii=False)
    return f"curl {address} -H 'content-type: {media_type}' \\\n  --data-binary '{_quoted(data)}'"


def _quoted(text: str) -> str:
    return text.replace("'", "'\\''")


def notebook(method: str, address: str, media_type: str, body: Any, looked_at: str | None) -> str:
    """A cell for a notebook; it shows what its last line says, or the answer's text."""
    arguments = _arguments([json.dumps(address), *_sent(media_type, body), f"timeout={LONGEST}"])
    call = f"httpx.{method}({arguments})"
    if looked_at is None:
        return f"import httpx\n\nprint({call}.text)"
    return f"import httpx\n\nanswer = {call}.json()\n{looked_at}"


def _arguments(arguments: list[str]) -> str:
    line = ", ".join(arguments)
    if len(line) <= WIDTH and "\n" not in line:
        return line
    return "\n" + "".join(f"    {argument},\n" for argument in arguments)


def _sent(media_type: str, body: Any) -> list[str]:
    if body is None:
        return []
    if isinstance(body, str):
        return [f'content="""{body}"""', f'headers={{"content-type": "{media_type}"}}']
    return [f"json={literal(body, 4)}"]


def literal(value: Any, indent: int = 0) -> str:
    """A JSON value as Python writes it, on several lines where one is too long."""
    match value:
        case dict():
            parts, brackets = [(f"{json.dumps(key)}: ", one) for key, one in value.items()], "{}"
        case list():
            parts, brackets = [("", one) for one in value], "[]"
        case str():
            return json.dumps(value, ensure_ascii=False)
        case _:
            return repr(value)
    line = ", ".join(name + literal(one) for name, one in parts)
    if indent + len(line) <= WIDTH and "\n" not in line:
        return brackets[0] + line + brackets[1]
    inner = "".join(f"{' ' * (indent + 4)}{name}{literal(one, indent + 4)},\n" for name, one in parts)
    return f"{brackets[0]}\n{inner}{' ' * indent}{brackets[1]}"
