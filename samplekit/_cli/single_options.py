"""Commands whose options are given once, since of two values the last would win, and stand together in their help."""

from __future__ import annotations

from collections import Counter
from typing import Any

from typer.core import TyperCommand, TyperOption

from samplekit._cli.panels import arranged
from samplekit._errors import UsageError


class SingleOptionsCommand(TyperCommand):
    """A command that refuses a second value of an option that takes one."""

    def get_params(self, ctx: Any) -> list[Any]:
        """Its parameters, arranged for its help."""
        return arranged(super().get_params(ctx))

    def parse_args(self, ctx: Any, args: list[str]) -> Any:
        """Count what is given, then read it."""
        if not ctx.resilient_parsing:
            _, _, order = self.make_parser(ctx).parse_args(args=list(args))
            given = Counter(
                parameter.opts[0]
                for parameter in order
                if isinstance(parameter, TyperOption) and not (parameter.multiple or parameter.is_flag)
            )
            for name, times in given.items():
                if times > 1:
                    raise UsageError(f"{name} is given {times} times: expected it once")
        return super().parse_args(ctx, args)
