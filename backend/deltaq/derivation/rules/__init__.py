"""The laws. One law, one file: its docstring states it, `RULE` names it, `apply` takes it one step."""
