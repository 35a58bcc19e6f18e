"""The places of a C++ source that can be mutated, found in its syntax tree by libclang.

A point is an operator, a literal, a condition, a statement or a pair of arguments. It has one or more
changes, which are its mutants, and edits, which make all of them selectable at run time by the functions
of mutant.h.
"""

import collections
import dataclasses
import pathlib
import re

import clang.cindex
from clang.cindex import CursorKind, TypeKind

COMPARISONS = {"<": ["<=", ">="], "<=": ["<", ">"], ">": [">=", "<="], ">=": [">", "<"], "==": ["!="], "!=": ["=="]}
ARITHMETIC = {"+": "-", "-": "+", "*": "+", "/": "*", "%": "*", "<<": ">>", ">>": "<<", "&": "|", "|": "&", "^": "|"}
SWAPPABLE = ["-", "/", "%"]
ASSIGNMENTS = {f"{operator}=": f"{other}=" for operator, other in ARITHMETIC.items()}
INTEGER = re.compile(r"([0-9][0-9']*|0[xX][0-9a-fA-F']+)([uUlLzZ]*)")
COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.DOTALL)

LOOPS = (CursorKind.FOR_STMT, CursorKind.WHILE_STMT, CursorKind.CXX_FOR_RANGE_STMT)
JUMPS = (CursorKind.RETURN_STMT, CursorKind.BREAK_STMT, CursorKind.CONTINUE_STMT)
EFFECTS = (CursorKind.CALL_EXPR, CursorKind.BINARY_OPERATOR, CursorKind.COMPOUND_ASSIGNMENT_OPERATOR,
           CursorKind.UNARY_OPERATOR)
FUNCTIONS = (CursorKind.FUNCTION_DECL, CursorKind.FUNCTION_TEMPLATE, CursorKind.CXX_METHOD)
NAMES = (CursorKind.DECL_REF_EXPR, CursorKind.MEMBER_REF_EXPR)
ARITHMETIC_TYPES = range(TypeKind.BOOL.value, TypeKind.LONGDOUBLE.value + 1)


@dataclasses.dataclass(frozen=True)
class Change:
    """One mutant: its kind, and the source text that it replaces."""
    kind: str
    begin: int
    end: int
    text: str


@dataclasses.dataclass(frozen=True)
class Edit:
    """A replacement that does not depend on others. At one offset the ends of what is inside come first, then
    the beginnings of what is outside; `#` stands for the number of the first mutant of the point."""
    begin: int
    end: int
    text: str
    is_end: bool = False


@dataclasses.dataclass(frozen=True)
class Point:
    changes: tuple
    edits: tuple


def find_points(path, arguments):
    """The points of a source, in the order of the tree, and how many places were skipped, by reason."""
    index = clang.cindex.Index.create()
    unit = index.parse(str(path), args=["-x", "c++", *arguments])
    errors = [str(each) for each in unit.diagnostics if each.severity >= clang.cindex.Diagnostic.Error]
    if errors:
        raise RuntimeError("\n".join(errors))
    finder = _Finder(str(path))
    for cursor in unit.cursor.get_children():
        if cursor.location.file and cursor.location.file.name == str(path):
            finder.visit(cursor, None)
    return finder.points, finder.skipped


class _Finder:
    def __init__(self, path):
        self.path = path
        # Offsets of libclang count bytes.
        self.source = pathlib.Path(path).read_bytes().decode("latin-1")
        self.points = []
        self.skipped = collections.Counter()
        self.seen = set()
        self.fixed = set()  # where literals are that must stay literals

    # Positions --------------------------------------------------------------------------------------

    def range_of(self, cursor):
        return cursor.extent.start.offset, cursor.extent.end.offset

    def text_of(self, cursor):
        begin, end = self.range_of(cursor)
        return self.source[begin:end]

    def is_here(self, cursor):
        start = cursor.extent.start
        return start.file is not None and start.file.name == self.path

    def gap(self, begin, end):
        """The only word between two offsets, comments left out, with its place."""
        text = COMMENT.sub(lambda found: " " * len(found[0]), self.source[begin:end])
        word = text.strip()
        return word, begin + text.find(word) if word else begin

    def after_parentheses(self, cursor):
        """The offset after the `)` that closes the head of an if, for, while or switch."""
        begin, end = self.range_of(cursor)
        depth = 0
        for offset in range(begin, end):
            if self.source[offset] == "(":
                depth += 1
            elif self.source[offset] == ")":
                depth -= 1
                if depth == 0:
                    return offset + 1
        return end

    # The walk ---------------------------------------------------------------------------------------

    def visit(self, cursor, reason):
        """`reason`: why nothing in this part of the tree can be mutated at run time, or None."""
        if not self.is_here(cursor):
            return
        kind = cursor.kind
        if kind == CursorKind.BINARY_OPERATOR:
            self.note_binary(cursor, reason)
        elif kind == CursorKind.COMPOUND_ASSIGNMENT_OPERATOR:
            self.note_assignment(cursor, reason)
        elif kind == CursorKind.UNARY_OPERATOR:
            self.note_unary(cursor, reason)
        elif kind == CursorKind.CALL_EXPR:
            self.note_call(cursor, reason)
        elif kind == CursorKind.INTEGER_LITERAL:
            self.note_integer(cursor, reason)
        elif kind == CursorKind.CXX_BOOL_LITERAL_EXPR:
            self.note_flag(cursor, reason)
        elif kind == CursorKind.CONDITIONAL_OPERATOR:
            self.note_condition(next(cursor.get_children()), reason)
        self.note_statements(cursor, reason)
        for child in cursor.get_children():
            self.visit(child, reason or self.reason_to_skip(cursor, child))

    def reason_to_skip(self, cursor, child):
        kind = cursor.kind
        begin, end = self.range_of(child)
        if kind in (CursorKind.VAR_DECL, CursorKind.FIELD_DECL):
            before = self.source[self.range_of(cursor)[0]:cursor.location.offset]
            if end <= cursor.location.offset or cursor.type.kind == TypeKind.CONSTANTARRAY:
                return "in a type"
            if "constexpr" in before.split():
                return "constant expression"
            if kind == CursorKind.FIELD_DECL:
                return "initial value of a member"
        elif kind in (CursorKind.STATIC_ASSERT, CursorKind.ENUM_CONSTANT_DECL):
            return "constant expression"
        elif kind == CursorKind.PARM_DECL:
            return "default argument"
        elif kind == CursorKind.CASE_STMT and begin == min(self.range_of(each)[0] for each in cursor.get_children()):
            return "constant expression"
        elif kind in NAMES and begin > cursor.location.offset:
            return "in a type"
        elif kind == CursorKind.CALL_EXPR and cursor.spelling == "reserve":
            return "amount of reserved memory"
        elif kind in (CursorKind.CXX_UNARY_EXPR, CursorKind.TEMPLATE_NON_TYPE_PARAMETER):
            return "constant expression"
        elif kind in FUNCTIONS and child.kind.is_expression():  # noexcept and requires
            return "constant expression"
        elif kind == CursorKind.IF_STMT and self.text_of(cursor).startswith("if constexpr"):
            return "constant expression" if begin < self.after_parentheses(cursor) else None
        return None

    def add(self, cursor, reason, changes, edits):
        key = (changes[0].kind, changes[0].begin, changes[0].text)
        if key in self.seen:
            return
        self.seen.add(key)
        if reason:
            self.skipped[reason] += len(changes)
        else:
            self.points.append(Point(tuple(changes), tuple(edits)))

    # Operators --------------------------------------------------------------------------------------

    def note_binary(self, cursor, reason):
        children = list(cursor.get_children())
        if len(children) == 2:
            self.note_operator(cursor, children[0], children[1], reason)

    def note_operator(self, cursor, left, right, reason):
        if not (self.is_here(left) and self.is_here(right)):
            return
        (begin, left_end), (right_begin, end) = sorted([self.range_of(left), self.range_of(right)])
        operator, place = self.gap(left_end, right_begin)
        operator_end = place + len(operator)
        if operator in COMPARISONS and is_ordering(left, right):
            self.fixed.add(right_begin)
            self.add(cursor, reason, [Change("comparison", place, operator_end, COMPARISONS[operator][-1])], [
                Edit(begin, begin, "::cbc::mutant::truth(#, "),
                Edit(end, end, ")", is_end=True),
            ])
            return
        if operator in COMPARISONS:
            others = [("comparison", other, f"CBC_OPERATION({other})") for other in COMPARISONS[operator]]
        elif operator in ("&&", "||"):
            self.note_logic(cursor, (begin, left_end, right_begin, end), operator, place, reason)
            self.note_condition(left, reason)
            self.note_condition(right, reason)
            return
        elif operator in ARITHMETIC and is_arithmetic(left) and is_arithmetic(right):
            other = ARITHMETIC[operator]
            others = [("arithmetic", other, f"CBC_OPERATION({other})")]
        else:
            return
        changes = [Change(kind, place, operator_end, other) for kind, other, _ in others]
        operations = [f"CBC_OPERATION({operator})", *(text for _, _, text in others)]
        if operator in SWAPPABLE:
            swapped = f"{self.source[right_begin:end]} {operator} {self.source[begin:left_end]}"
            changes.append(Change("swap", begin, end, swapped))
            operations.append(f"CBC_SWAPPED({operator})")
        self.add(cursor, reason, changes, [
            Edit(begin, begin, "::cbc::mutant::apply(#, "),
            Edit(place, operator_end, ","),
            Edit(end, end, f", {', '.join(operations)})", is_end=True),
        ])

    def note_logic(self, cursor, offsets, operator, place, reason):
        begin, _, _, end = offsets
        ends, result, other = ("and", "", "||") if operator == "&&" else ("or", "!", "&&")
        self.add(cursor, reason, [Change("comparison", place, place + 2, other)], [
            Edit(begin, begin, f"(::cbc::mutant::ends_{ends}(#, static_cast<bool>("),
            Edit(place, place + 2, f")) ? {result}::cbc::mutant::is_on(#) : static_cast<bool>("),
            Edit(end, end, "))", is_end=True),
        ])

    def note_assignment(self, cursor, reason):
        left, right = cursor.get_children()
        begin, left_end = self.range_of(left)
        right_begin, end = self.range_of(right)
        operator, place = self.gap(left_end, right_begin)
        if operator not in ASSIGNMENTS or not (is_arithmetic(left) and is_arithmetic(right)):
            return
        other = ASSIGNMENTS[operator]
        self.add(cursor, reason, [Change("arithmetic", place, place + len(operator), other)], [
            Edit(begin, begin, "::cbc::mutant::assign(#, "),
            Edit(place, place + len(operator), ","),
            Edit(end, end, f", CBC_ASSIGNMENT({operator}), CBC_ASSIGNMENT({other}))", is_end=True),
        ])

    def note_unary(self, cursor, reason):
        operand = next(cursor.get_children())
        begin, end = self.range_of(cursor)
        operator = self.source[begin:self.range_of(operand)[0]].strip()
        after = begin + len(operator)
        if operator == "!":
            inner = strip(operand)
            if self.operator_of(inner) in (*COMPARISONS, "&&", "||"):
                return  # the operator inside is negated
            self.add(cursor, reason, [Change("comparison", begin, after, "")], [
                Edit(begin, after, "::cbc::mutant::truth(#, !static_cast<bool>("),
                Edit(end, end, "))", is_end=True),
            ])
        elif operator in ("++", "--") and is_arithmetic(operand):
            other = "-=" if operator == "++" else "+="
            original = "+=" if operator == "++" else "-="
            self.add(cursor, reason, [Change("arithmetic", begin, after, "--" if operator == "++" else "++")], [
                Edit(begin, after, "::cbc::mutant::assign(#, "),
                Edit(end, end, f", 1, CBC_ASSIGNMENT({original}), CBC_ASSIGNMENT({other}))", is_end=True),
            ])
        elif operator in ("-", "~") and is_arithmetic(operand) and strip(operand).kind not in (
                CursorKind.INTEGER_LITERAL, CursorKind.FLOATING_LITERAL):
            self.add(cursor, reason, [Change("arithmetic", begin, after, "")], [
                Edit(begin, after, f"::cbc::mutant::apply(#, {operator}("),
                Edit(end, end, f"), {operator}1, [](auto a, auto) {{ return a; }}, [](auto a, auto) "
                               f"{{ return {operator}a; }})", is_end=True),
            ])

    def operator_of(self, cursor):
        children = [each for each in cursor.get_children() if each.kind not in NAMES]
        if cursor.kind == CursorKind.CALL_EXPR and cursor.spelling.startswith("operator"):
            children = list(cursor.get_children())
            children = [children[0], children[-1]] if len(children) == 3 else []
        elif cursor.kind == CursorKind.BINARY_OPERATOR:
            children = list(cursor.get_children())
        else:
            return ""
        if len(children) != 2:
            return ""
        (_, left_end), (right_begin, _) = sorted(self.range_of(each) for each in children)
        return self.gap(left_end, right_begin)[0]

    # Literals and conditions --------------------------------------------------------------------------

    def note_integer(self, cursor, reason):
        begin, end = self.range_of(cursor)
        found = INTEGER.fullmatch(self.source[begin:end])
        if not found or begin in self.fixed:
            return
        value = int(found[1].replace("'", ""), 0 if found[1][:2].lower() == "0x" else 10)
        others = [f"{other}{found[2]}" for other in (value + 1, value - 1) if other >= 0]
        self.add(cursor, reason, [Change("constant", begin, end, other) for other in others], [
            Edit(begin, end, f"::cbc::mutant::constant(#, {found[0]}, {', '.join(others)})"),
        ])

    def note_flag(self, cursor, reason):
        begin, end = self.range_of(cursor)
        other = {"true": "false", "false": "true"}.get(self.source[begin:end])
        if other:
            self.add(cursor, reason, [Change("constant", begin, end, other)], [
                Edit(begin, end, f"::cbc::mutant::constant(#, {self.source[begin:end]}, {other})"),
            ])

    def note_condition(self, cursor, reason):
        """A condition that has no operator of its own."""
        inner = strip(cursor)
        begin, end = self.range_of(cursor)
        if inner.kind not in (*NAMES, CursorKind.CALL_EXPR, CursorKind.ARRAY_SUBSCRIPT_EXPR):
            return
        if not self.is_here(cursor) or self.operator_of(inner) in COMPARISONS or begin == end:
            return
        self.add(cursor, reason, [Change("comparison", begin, begin, "!")], [
            Edit(begin, begin, "::cbc::mutant::truth(#, static_cast<bool>("),
            Edit(end, end, "))", is_end=True),
        ])

    def note_call(self, cursor, reason):
        children = list(cursor.get_children())
        if cursor.spelling.startswith("operator") and len(children) == 3:
            operator = self.gap(*self.range_of(children[1]))[0]
            if operator in COMPARISONS:
                self.note_operator(cursor, children[0], children[2], reason)
            return
        arguments = list(cursor.get_arguments())
        for first, second in zip(arguments, arguments[1:]):
            self.note_arguments(first, second, reason)

    def note_arguments(self, first, second, reason):
        """Two arguments of one type, next to one another, which nothing but their order tells apart."""
        if first is None or second is None or not (self.is_plain(first) and self.is_plain(second)):
            return
        (begin, end), (next_begin, next_end) = self.range_of(first), self.range_of(second)
        one, other = self.source[begin:end], self.source[next_begin:next_end]
        if one == other or self.gap(end, next_begin)[0] != "," or plain_type(first) != plain_type(second):
            return
        self.add(first, reason, [Change("swap", begin, next_end, f"{other}, {one}")], [
            Edit(begin, begin, "::cbc::mutant::constant(#, "),
            Edit(end, end, f", {other})", is_end=True),
            Edit(next_begin, next_begin, "::cbc::mutant::constant(#, "),
            Edit(next_end, next_end, f", {one})", is_end=True),
        ])

    def is_plain(self, cursor):
        """Whether an argument is a value that is read, and reading it twice changes nothing."""
        if not self.is_here(cursor) or cursor.kind != CursorKind.UNEXPOSED_EXPR or not is_arithmetic(cursor):
            return False
        return re.fullmatch(r"[\w.\[\]]+", self.text_of(cursor)) is not None

    # Statements -------------------------------------------------------------------------------------

    def note_statements(self, cursor, reason):
        kind = cursor.kind
        children = list(cursor.get_children())
        if kind == CursorKind.COMPOUND_STMT:
            for child in children:
                self.note_statement(child, reason)
        elif kind in (CursorKind.CASE_STMT, CursorKind.DEFAULT_STMT) and children:
            self.note_statement(children[-1], reason)
        elif kind in (CursorKind.IF_STMT, *LOOPS, CursorKind.SWITCH_STMT):
            head_end = self.after_parentheses(cursor)
            body = [child for child in children if self.range_of(child)[0] >= head_end]
            for child in body:
                self.note_statement(child, reason)
            if kind == CursorKind.FOR_STMT:
                return  # its condition is a comparison
            head = [child for child in children if self.range_of(child)[0] < head_end]
            if kind in (CursorKind.IF_STMT, CursorKind.WHILE_STMT) and head and head[-1].kind.is_expression():
                self.note_condition(head[-1], reason or self.reason_to_skip_condition(cursor, head[-1]))

    def reason_to_skip_condition(self, cursor, condition):
        if self.text_of(cursor).startswith("if constexpr"):
            return "constant expression"
        before = self.source[:self.range_of(condition)[0]].rstrip()
        return None if before.endswith(("(", ";")) else "declaration in a condition"

    def note_statement(self, cursor, reason):
        inner = strip(cursor)
        begin, end = self.range_of(cursor)
        if not (cursor.kind in JUMPS or inner.kind in EFFECTS):
            return
        semicolon = re.compile(r"\s*;").match(self.source, end)
        if not self.is_here(cursor) or semicolon is None:
            return
        if cursor.kind == CursorKind.RETURN_STMT and self.ends_function(semicolon.end()):
            return
        self.add(cursor, reason, [Change("statement", begin, semicolon.end(), "{}")], [
            Edit(begin, begin, "{if (!::cbc::mutant::is_on(#)) "),
            Edit(semicolon.end(), semicolon.end(), "}", is_end=True),
        ])

    def ends_function(self, offset):
        """Whether a function ends after this return: in the style of the project, its brace is the first of its
        line, and not indented, or it is the only statement of a short body or of a lambda."""
        rest = self.source[offset:offset + 200]
        return re.match(r"\s*}", rest) is not None and not self.is_in_branch(offset)

    def is_in_branch(self, offset):
        """Whether the block that ends next after this offset is that of an if, a loop or a switch."""
        depth = 0
        for place in range(offset - 1, -1, -1):
            if self.source[place] == "}":
                depth += 1
            elif self.source[place] == "{":
                if depth == 0:
                    line = self.source[self.source.rfind("\n", 0, place) + 1:place]
                    return re.search(r"\b(if|for|while|switch|else|do|case|default)\b", line) is not None
                depth -= 1
        return False


def strip(cursor):
    """Without parentheses and what the compiler adds."""
    while cursor.kind in (CursorKind.UNEXPOSED_EXPR, CursorKind.PAREN_EXPR):
        children = list(cursor.get_children())
        if len(children) != 1:
            break
        cursor = children[0]
    return cursor


def is_arithmetic(cursor):
    return cursor.type.get_canonical().kind.value in ARITHMETIC_TYPES


def is_ordering(*cursors):
    """Whether one of them is the result of `<=>`, which can only be compared with a literal 0."""
    return any("ordering" in cursor.type.get_canonical().spelling for cursor in cursors)


def plain_type(cursor):
    return cursor.type.get_canonical().spelling.replace("const ", "")


def write_mutated(source, points, first_number):
    """The source (bytes as latin-1) in which all points can be selected; their mutants have the numbers from
    `first_number` on."""
    edits = []
    number = first_number
    for order, point in enumerate(points):
        for edit in point.edits:
            # Ends of later points, which are inside, come first; of beginnings those of earlier points.
            rank = (0, -order) if edit.is_end else (1, order)
            edits.append((edit.begin, rank, edit.end, edit.text.replace("#", str(number))))
        number += len(point.changes)
    edits.sort()
    parts = []
    offset = 0
    for begin, _, end, text in edits:
        parts += [source[offset:begin], text]
        offset = max(offset, end)
    parts.append(source[offset:])
    return "".join(parts)
