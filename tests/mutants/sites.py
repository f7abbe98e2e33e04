"""Finds where a small change would be a fault: operators, conditions, statements, constants and arguments, from clang's syntax tree.

A site is an extent of a file with the texts that may stand in its place. Skipped are what a macro has written, what the compiler
evaluates, and whatever depends on a template's parameter in a way that the syntax alone does not tell.
"""
import dataclasses
import pathlib

from clang import cindex
from clang.cindex import CursorKind as Kind
from clang.cindex import TypeKind

SWAPS = {"<": ("<=", ">"), "<=": ("<", ">"), ">": (">=", "<"), ">=": (">", "<"), "==": ("!=",), "!=": ("==",), "+": ("-",), "-": ("+",),
         "*": ("+",), "/": ("*",), "%": ("*",), "&": ("|",), "|": ("&",), "<<": (">>",), ">>": ("<<",)}
ASSIGNMENTS = {"+=": "-=", "-=": "+=", "*=": "+=", "/=": "*=", "|=": "&=", "&=": "|="}
OTHER_NAMES = {"min": "max", "max": "min", "floor": "ceil", "ceil": "floor", "lower_bound": "upper_bound", "upper_bound": "lower_bound"}
PAIRS = (("first", "second"), ("x", "y"), ("left", "right"), ("low", "high"), ("lowest", "highest"), ("front", "back"), ("begin", "end"))
OTHER_MEMBERS = {a: b for pair in PAIRS for a, b in (pair, pair[::-1])}
NOT_ENTERED = {Kind.STATIC_ASSERT, Kind.ENUM_DECL, Kind.TYPE_ALIAS_DECL, Kind.TYPEDEF_DECL, Kind.TYPE_ALIAS_TEMPLATE_DECL,
               Kind.USING_DECLARATION, Kind.NAMESPACE_ALIAS}
NUMBERS = {TypeKind.INT, TypeKind.UINT, TypeKind.LONG, TypeKind.ULONG, TypeKind.LONGLONG, TypeKind.ULONGLONG, TypeKind.FLOAT,
           TypeKind.DOUBLE, TypeKind.LONGDOUBLE, TypeKind.SHORT, TypeKind.USHORT, TypeKind.UCHAR, TypeKind.SCHAR}
FLOATS = {TypeKind.FLOAT, TypeKind.DOUBLE, TypeKind.LONGDOUBLE}
if not hasattr(Kind, "BUILTIN_BIT_CAST_EXPR"):
    Kind.BUILTIN_BIT_CAST_EXPR = Kind(280)  # of CXCursorKind; Python's module of clang 14 has no name for it
WRAPPERS = {Kind.UNEXPOSED_EXPR, Kind.PAREN_EXPR}


@dataclasses.dataclass
class Site:
    file: str
    line: int
    last_line: int
    begin: int  # offsets in bytes
    end: int
    is_statement: bool  # not an expression
    original: str
    changed: list  # of texts; "" drops a statement
    kind: str
    is_condition: bool = False  # of whatever type converts to bool


class File:
    def __init__(self, unit, path, name):
        self.unit, self.name = unit, name
        self.bytes = path.read_bytes()
        self.handle = cindex.File.from_name(unit, str(path))
        self.sites = {}

    def tokens(self, begin, end):
        """The words from one offset to another, without comments."""
        extent = cindex.SourceRange.from_locations(cindex.SourceLocation.from_offset(self.unit, self.handle, begin),
                                                   cindex.SourceLocation.from_offset(self.unit, self.handle, end))
        return [token for token in self.unit.get_tokens(extent=extent)
                if token.kind != cindex.TokenKind.COMMENT and begin <= token.extent.start.offset and token.extent.end.offset <= end]

    def words(self, begin, end):
        return " ".join(token.spelling for token in self.tokens(begin, end))

    def text(self, cursor):
        return self.words(*span(cursor))

    def add(self, cursor, changed, kind, is_statement=False):
        begin, end = span(cursor)
        text = self.words(begin, end)
        if not text or text.startswith("#") or " # " in text:
            return
        key = begin, end, is_statement
        original = " ".join(self.bytes[begin:end].decode().split())
        site = self.sites.setdefault(key, Site(self.name, cursor.extent.start.line, cursor.extent.end.line, begin, end, is_statement,
                                               original, [], kind))
        site.is_condition |= kind in ("condition", "logical operator") or kind == "sign" and text.startswith("!")
        for one in changed:
            if one not in site.changed and one != text:
                site.changed.append(one)


def span(cursor):
    return cursor.extent.start.offset, cursor.extent.end.offset


def bare(cursor):
    """The expression inside of parentheses and of what the syntax tree does not name."""
    while cursor.kind in WRAPPERS:
        inside = list(cursor.get_children())
        if len(inside) != 1:
            break
        cursor = inside[0]
    return cursor


def type_of(cursor):
    return cursor.type.get_canonical().kind


def is_in(cursor, file):
    return cursor.extent.start.file is not None and cursor.extent.start.file.name == file.handle.name


def is_written_by_a_macro(cursor, file):
    """A macro's words have the place where it is used, all of them."""
    begin, end = span(cursor)
    return end <= begin or not file.tokens(begin, end)


class Finder:
    def __init__(self, file):
        self.file = file

    def visit(self, cursor):
        kind = cursor.kind
        if kind in NOT_ENTERED or self.is_constant(cursor):
            return
        if kind.is_expression() and is_written_by_a_macro(cursor, self.file):
            return
        children = [child for child in cursor.get_children() if is_in(child, self.file)]
        handler = getattr(self, kind.name.lower(), None)
        if handler:
            handler(cursor, children)
        if kind == Kind.COMPOUND_STMT:
            self.statements(children)
        if kind in (Kind.VAR_DECL, Kind.FIELD_DECL, Kind.PARM_DECL):  # what stands before the name is the type
            children = [child for child in children if child.extent.start.offset >= cursor.location.offset]
        if kind == Kind.CASE_STMT:
            children = children[1:]
        if kind in (Kind.DECL_REF_EXPR, Kind.MEMBER_REF_EXPR, Kind.TEMPLATE_REF, Kind.TYPE_REF, Kind.OVERLOADED_DECL_REF):
            children = [child for child in children if not child.kind.is_expression() or kind == Kind.MEMBER_REF_EXPR and
                        child.extent.start.offset == cursor.extent.start.offset]
        for child in children:
            self.visit(child)

    def is_constant(self, cursor):
        """True for variables and functions that the compiler alone evaluates."""
        words = {Kind.VAR_DECL: {"constexpr", "constinit"}, Kind.FUNCTION_DECL: {"consteval"}}.get(cursor.kind)
        return bool(words) and not words.isdisjoint(self.file.words(cursor.extent.start.offset, cursor.location.offset).split())

    # Conditions.
    def if_stmt(self, cursor, children):
        words = self.file.tokens(*span(cursor))[:3]
        # A declaration before the condition, or in its place, is not an expression.
        if len(words) < 3 or words[1].spelling == "constexpr" or not children or not children[0].kind.is_expression():
            return
        self.file.add(children[0], ["false", "true"], "condition")

    def while_stmt(self, cursor, children):
        if children and children[0].kind.is_expression():
            self.file.add(children[0], ["false"], "condition")

    def conditional_operator(self, cursor, children):
        if len(children) == 3:
            self.file.add(children[0], ["false", "true"], "condition")

    # Operators.
    def binary_operator(self, cursor, children):
        if len(children) != 2:
            return
        left, right = children
        between = self.file.tokens(left.extent.end.offset, right.extent.start.offset)
        sign = " ".join(token.spelling for token in between)
        a, b = self.file.text(left), self.file.text(right)
        if sign in ("&&", "||"):
            self.file.add(cursor, [f"( {a} ) {'||' if sign == '&&' else '&&'} ( {b} )", a, b], "logical operator")
        elif sign in SWAPS:
            compared = sign in ("<", "<=", ">", ">=", "==", "!=")
            if not compared and (type_of(left) not in NUMBERS or type_of(right) not in NUMBERS):
                return
            self.file.add(cursor, [f"( {a} ) {other} ( {b} )" for other in SWAPS[sign]] + ([] if compared else [a]), "operator")
            for side in children:
                self.moved(side)

    def moved(self, cursor):
        """A number or a named constant, where it is compared or computed with: the bound beside it."""
        inner = bare(cursor)
        if inner.kind == Kind.DECL_REF_EXPR and inner.referenced is not None and inner.referenced.kind == Kind.VAR_DECL:
            declared = inner.referenced
            before = [token.spelling for token in declared.get_tokens()][:6]
            if "constexpr" in before and type_of(inner) in NUMBERS:
                text = self.file.text(inner)
                self.file.add(inner, [f"{text} * 1.1F" if type_of(inner) == TypeKind.FLOAT else f"{text} * 1.1"
                                      if type_of(inner) in FLOATS else f"{text} + 1"], "bound")

    def integer_literal(self, cursor, children):
        text = self.file.text(cursor)
        if text.isdigit() and type_of(cursor) in NUMBERS:
            self.file.add(cursor, [str(int(text) + 1)], "number")

    def floating_literal(self, cursor, children):
        text = self.file.text(cursor)
        if text and type_of(cursor) in FLOATS:
            self.file.add(cursor, [f"{text} * 2"], "number")

    def cxx_bool_literal_expr(self, cursor, children):
        text = self.file.text(cursor)
        if text in ("true", "false"):
            self.file.add(cursor, ["false" if text == "true" else "true"], "number")

    def unary_operator(self, cursor, children):
        text = self.file.text(cursor)
        if len(children) == 1 and text.startswith(("! ", "- ")) and type_of(cursor) in NUMBERS | {TypeKind.BOOL}:
            self.file.add(cursor, [self.file.text(children[0])], "sign")

    def decl_ref_expr(self, cursor, children):
        declared = cursor.referenced
        if declared is None or declared.kind != Kind.ENUM_CONSTANT_DECL:
            return
        others = [one.spelling for one in declared.semantic_parent.get_children() if one.kind == Kind.ENUM_CONSTANT_DECL]
        self.renamed(cursor, declared.spelling, others[(others.index(declared.spelling) + 1) % len(others)])

    def member_ref_expr(self, cursor, children):
        if cursor.spelling in OTHER_MEMBERS:
            self.renamed(cursor, cursor.spelling, OTHER_MEMBERS[cursor.spelling])

    def renamed(self, cursor, name, other):
        words = self.file.text(cursor).split()
        if words and words[-1] == name:
            self.file.add(cursor, [" ".join(words[:-1] + [other])], "name")

    def return_stmt(self, cursor, children):
        if len(children) == 1 and type_of(children[0]) == TypeKind.BOOL and bare(children[0]).kind in (Kind.CALL_EXPR, Kind.DECL_REF_EXPR,
                                                                                                     Kind.MEMBER_REF_EXPR):
            self.file.add(children[0], [f"! ( {self.file.text(children[0])} )"], "condition")

    def call_expr(self, cursor, children):
        arguments = [argument for argument in cursor.get_arguments() if argument is not None]
        name = cursor.spelling
        if name in ("operator==", "operator!=") and len(arguments) == 2 and type_of(cursor) == TypeKind.BOOL:
            (left, right), a, b = map(span, arguments), *map(self.file.text, arguments)
            sign = self.file.words(left[1], right[0])  # since C++20 an != may be a call of operator==
            if sign in ("==", "!="):
                self.file.add(cursor, [f"( {a} ) {SWAPS[sign][0]} ( {b} )"], "operator")
            return
        if name.startswith("operator"):
            return
        text = self.file.text(cursor)
        if name not in text.split(" (")[0].split():  # a constructor's, with the name of what it makes
            return
        if name in OTHER_NAMES and text.startswith(f"std :: {name} "):
            self.file.add(cursor, [text.replace(f":: {name} ", f":: {OTHER_NAMES[name]} ", 1)], "name")
        for first, second in zip(arguments, arguments[1:]):
            same = first.type.get_canonical().spelling.replace("const ", "") == second.type.get_canonical().spelling.replace("const ", "")
            a, b = self.file.text(first), self.file.text(second)
            if same and type_of(first) in NUMBERS and a and b and a != b and name not in OTHER_NAMES:
                begin, end = span(cursor)
                before = self.file.words(begin, first.extent.start.offset)
                after = self.file.words(second.extent.end.offset, end)
                self.file.add(cursor, [f"{before} {b} , {a} {after}"], "arguments")

    # Statements.
    def statements(self, children):
        for child in children:
            inner = bare(child)
            if not child.kind.is_expression() or inner.kind == Kind.CXX_THROW_EXPR or is_written_by_a_macro(child, self.file):
                if child.kind in (Kind.BREAK_STMT, Kind.CONTINUE_STMT):
                    self.file.add(child, [""], "statement", is_statement=True)
                continue
            changed = [""]
            if inner.kind == Kind.COMPOUND_ASSIGNMENT_OPERATOR:
                left, right = list(inner.get_children())[:2]
                sign = self.file.words(left.extent.end.offset, right.extent.start.offset)
                if sign in ASSIGNMENTS:
                    changed.append(f"{self.file.text(left)} {ASSIGNMENTS[sign]} {self.file.text(right)}")
            self.file.add(child, changed, "statement", is_statement=True)


def sites_of(arguments, root, wanted):
    """The sites in those of the wanted files (names below root) that one compilation reads, by file."""
    unit = cindex.Index.create().parse(None, args=arguments)
    found = {}
    files = {str(root / name): name for name in wanted}
    of_files = {}
    for cursor in unit.cursor.get_children():
        path = cursor.extent.start.file
        path = str(pathlib.Path(path.name).resolve()) if path is not None else None
        if path in files:
            of_files.setdefault((path, cursor.extent.start.file.name), []).append(cursor)
    for (path, name), cursors in of_files.items():
        file = File(unit, pathlib.Path(name), files[path])
        finder = Finder(file)
        for cursor in cursors:
            finder.visit(cursor)
        found[files[path]] = sorted(file.sites.values(), key=lambda site: (site.begin, -site.end, not site.is_statement))
    errors = [str(diagnostic) for diagnostic in unit.diagnostics if diagnostic.severity >= cindex.Diagnostic.Error]
    return found, errors
