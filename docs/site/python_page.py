#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""python_page.py: prints a page of the public names of the package forceshade that Python finds, with their signatures and
docstrings, as Markdown. A public name, class or method without a docstring is an error.

The signatures of compiled methods are in the docstrings that the module has, and the words about a field stand below it in the
sources, where neither help() nor a tool of Debian 12 for MkDocs reads them. That is why this is a program of its own."""
import ast
import enum
import inspect
import re
import sys

import forceshade

# The sections: each is a module, with its first sentence as the heading. The last one has what is compiled or stands in no other.
MODULES = ["_subjects", "_subject", "_sessions", "_damping", "_exact", "_checks", "_recordings", "_forceshade"]
faults = []
aliases = {}  # of types, that the modules use among themselves: Rounding


class Source:
    """The words of a module's source that the imported module does not have."""

    def __init__(self, module):
        tree = ast.parse(inspect.getsource(module))
        self.order, self.words = {}, {}
        self._read(tree.body, "")
        for node in tree.body:  # Rounding = Optional[...]
            if isinstance(node, ast.Assign) and isinstance(node.value, ast.Subscript):
                aliases[node.targets[0].id] = node.value

    def _read(self, body, prefix):
        for node, following in zip(body, [*body[1:], None]):
            if isinstance(node, (ast.Assign, ast.AnnAssign)):
                target = node.target if isinstance(node, ast.AnnAssign) else node.targets[0]
                name = prefix + getattr(target, "id", "")
                if isinstance(following, ast.Expr) and isinstance(following.value, ast.Constant):
                    self.words[name] = inspect.cleandoc(following.value.value)
            elif isinstance(node, (ast.ClassDef, ast.FunctionDef)):
                name = prefix + node.name
                if isinstance(node, ast.ClassDef):
                    self._read(node.body, name + ".")
            else:
                continue
            self.order.setdefault(name, len(self.order))


class Plain(ast.NodeTransformer):
    """An annotation without the names that only the package's sources know."""

    def visit_Attribute(self, node):
        return self.visit(ast.Name(node.attr))

    def visit_Name(self, node):
        return self.visit(aliases[node.id]) if node.id in aliases else ast.Name(node.id)

    def visit_Constant(self, node):  # a name in quotation marks, but not the word of a Literal
        is_name = isinstance(node.value, str) and not node.value.islower()
        return self.visit(ast.parse(node.value, mode="eval").body) if is_name else node

    def visit_Subscript(self, node):
        node = self.generic_visit(node)
        name = node.value.id if isinstance(node.value, ast.Name) else ""
        if name not in ("Union", "Optional"):
            return node
        parts = node.slice.elts if name == "Union" else [node.slice, ast.Constant(None)]
        made = parts[0]
        for part in parts[1:]:
            made = ast.BinOp(made, ast.BitOr(), part)
        return made


def plain(annotation):
    text = getattr(annotation, "__forward_arg__", annotation)
    return re.sub(r"\| \(([^()]*)\)", r"| \1", ast.unparse(Plain().visit(ast.parse(text, mode="eval").body)))


def signature_of(thing, name):
    """Over several lines where it is long."""
    try:
        signature = inspect.signature(thing)
    except ValueError:  # pybind11 has written it into the docstring
        found = re.match(rf"{thing.__name__}\((.*)\) -> (.*)", thing.__doc__)
        return f"{name}({found[1]}) -> {found[2]}"
    words, has_star = [], False
    parameters = [each for each in signature.parameters.values() if each.name not in ("self", "cls")]
    for at, each in enumerate(parameters):
        if each.kind is each.KEYWORD_ONLY and not has_star:
            words.append("*")
            has_star = True
        text = each.name
        if each.annotation is not each.empty:
            text += ": " + plain(each.annotation)
        if each.default is not each.empty:
            value = each.default
            shown = f"{type(value).__name__}.{value.name}" if isinstance(value, enum.Enum) else repr(value)
            text += (" = " if ":" in text else "=") + shown
        words.append(text)
        if each.kind is each.POSITIONAL_ONLY and (at + 1 == len(parameters) or parameters[at + 1].kind is not each.kind):
            words.append("/")
    returns = signature.return_annotation
    end = "" if returns in (signature.empty, "None") or isinstance(thing, type) else f" -> {plain(returns)}"
    line = f"{name}({', '.join(words)}){end}"
    return line if len(line) <= 90 else f"{name}(\n    " + ",\n    ".join(words) + f",\n){end}"


def escaped(text):
    """Markdown that shows this text, where a page that it names is a link; what stands between backticks stays."""
    pieces = text.split("`")
    pieces[::2] = [re.sub(r"([\\*_<\[\]#])", r"\\\1", piece) for piece in pieces[::2]]
    return re.sub(r"\b\w+/[\w-]+\.md\b", r"[\g<0>](../\g<0>)", "`".join(pieces))


def markdown_of(words, parameters=()):
    """The paragraphs of a docstring; examples as code, and a line for each parameter that it explains."""
    for block in re.split(r"\n\s*\n", words):
        if block.startswith(">>>"):
            yield f"```python\n{block}\n```"
            continue
        names = "|".join(parameters) or "(?!)"
        pieces = re.split(rf"(?:^|(?<=\.)\s)((?:{names})(?:, (?:{names}))*): ", block, flags=re.MULTILINE)
        if pieces[0].strip():
            yield escaped(pieces[0].strip())
        if len(pieces) > 1:
            items = zip(pieces[1::2], pieces[2::2])
            yield "\n".join(f"- `{name}`: {escaped(' '.join(text.split()))}" for name, text in items)


def documentation_of(thing, name):
    words = inspect.getdoc(thing) or ""
    if not isinstance(thing, type) and callable(thing):
        words = re.sub(rf"^{thing.__name__}\(.*\) -> .*\s*", "", words)
    # A docstring that Python makes of a class's own fields says nothing, and one of a base class is that class's.
    is_made = isinstance(thing, type) and (words.startswith(thing.__name__ + "(") or not vars(thing).get("__doc__"))
    if not words or is_made:
        faults.append(f"{name} has no docstring")
    return words


def parameters_of(thing):
    try:
        return list(inspect.signature(thing).parameters)
    except ValueError:
        return re.findall(r"(\w+):", thing.__doc__.partition(" -> ")[0])


def code(text):
    return f"```python\n{text}\n```"


def members_of(thing):
    """The class's own members, and those of bases that are not public themselves."""
    found = {}
    for base in thing.__mro__:
        is_public = getattr(forceshade, base.__name__, None) is base
        if (is_public and base is not thing) or not base.__module__.startswith("forceshade"):
            break
        for name, member in vars(base).items():
            if not name.startswith("_"):
                found.setdefault(name, member)
    return found


def class_part(thing, key, source):
    bases = [base for base in thing.__mro__[1:] if getattr(forceshade, base.__name__, None) is base]
    is_called = "__init__" in vars(thing)  # to make one
    if is_called:
        yield code(signature_of(thing, key))
    yield from markdown_of(documentation_of(thing, key), parameters_of(thing) if is_called else [])
    if bases:
        yield "It also has all that " + " and ".join(f"[{base.__name__}](#{base.__name__})" for base in bases) + " has."
    members = members_of(thing)
    fields = {**getattr(thing, "__annotations__", {}), **getattr(thing, "__members__", {})}
    fields = {name: what for name, what in fields.items() if not name.startswith("_")}
    if fields:
        lines = []
        for name, what in fields.items():
            kind = f" = {what.value}" if isinstance(what, enum.Enum) else f": {plain(what)}"
            words = source.words.get(f"{key}.{name}", "")
            lines.append(f"- `{name}{kind}`" + (f" — {escaped(' '.join(words.split()))}" if words else ""))
        yield "\n".join(lines)
    order = {name: at for at, name in enumerate(members)}
    for name in sorted(members.keys() - fields.keys(), key=lambda name: source.order.get(f"{key}.{name}", -1 - order[name])):
        member = members[name]
        yield f"#### `{key}.{name}` {{ #{key}.{name} }}"
        if isinstance(member, property):
            yield code(f"{name}: {plain(member.fget.__annotations__['return'])}    # read-only")
            yield from markdown_of(documentation_of(member, f"{key}.{name}"))
        else:
            member = getattr(member, "__func__", member)  # of a class method
            yield code(signature_of(member, name))
            yield from markdown_of(documentation_of(member, f"{key}.{name}"), parameters_of(member))


def page():
    yield "# Python: reference"
    yield from markdown_of(inspect.getdoc(forceshade))
    modules = [getattr(forceshade, name) for name in MODULES]
    source_of = {module.__name__: Source(module) for module in [forceshade, forceshade._arrays, *modules[:-1]]}
    sections = {name: [] for name in MODULES}
    for key in forceshade.__all__:
        thing = getattr(forceshade, key)
        module = getattr(thing, "__module__", "").rpartition(".")[2]
        if not callable(thing):  # a value; the module that has words about it
            module = next((name for name in MODULES[:-1] if key in source_of[f"forceshade.{name}"].order), MODULES[-1])
        sections[module if module in sections else MODULES[-1]].append(key)
    for name in MODULES:
        source = source_of.get(f"forceshade.{name}", source_of["forceshade"])
        is_compiled = name == MODULES[-1]
        yield "## " + ("Errors and versions" if is_compiled else inspect.getdoc(getattr(forceshade, name)).rstrip("."))
        for key in sorted(sections[name], key=lambda key: source.order.get(key, -1)):
            thing = getattr(forceshade, key)
            yield f"### `{key}` {{ #{key} }}"
            if isinstance(thing, type):
                yield from class_part(thing, key, source)
            elif callable(thing):
                yield code(signature_of(thing, key))
                yield from markdown_of(documentation_of(thing, key), parameters_of(thing))
            else:
                if key not in source.words:
                    faults.append(f"{key} has no words below it")
                yield from markdown_of(source.words.get(key, ""))


if __name__ == "__main__":
    text = "\n\n".join(page()) + "\n"
    if faults:
        sys.exit("\n".join(faults))
    sys.stdout.write(text)
