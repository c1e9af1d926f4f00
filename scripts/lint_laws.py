#!/usr/bin/env python3
"""Checks that src/laws/*.law.glsl use only portable arithmetic (docs/architecture.md, "Rules").

A law gives the same bits on every machine only if it consists of +, -, *, comparison and choice. Compilers reject most
violations; this script finds the rest:
  - built-in functions, whose precision depends on the device, or which a compiler may contract;
  - division, which Vulkan does not round correctly;
  - swizzles other than .x .y .z .w, which C++ does not have;
  - literals that are not float, or whose digits are not those of the float.
"""

import re
import struct
import sys
from decimal import Decimal
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent

# Built-ins of GLSL with float arguments or results.
BUILT_INS = """
    abs acos acosh all any asin asinh atan atanh ceil clamp cos cosh cross degrees distance dot equal exp exp2
    faceforward floor fma fract frexp greaterThan greaterThanEqual inversesqrt isinf isnan ldexp length lessThan
    lessThanEqual log log2 max min mix mod modf normalize not notEqual outerProduct pow radians reflect refract round
    roundEven sign sin sinh smoothstep sqrt step tan tanh transpose trunc
""".split()

FLOAT_LITERAL = re.compile(r"(?<![\w.])(\d+\.\d*|\.\d+|\d+(?=[eEfF]))([eE][+-]?\d+)?(\w*)")
CALL = re.compile(r"(?<![\w.])(" + "|".join(BUILT_INS) + r")\s*\(")
SWIZZLE = re.compile(r"\.\s*([xyzw]{1,4}|[rgba]{1,4}|[stpq]{1,4})\b(?!\s*\()")
DIVISION = re.compile(r"/")

# A literal that is not exact in binary must have the digits of the rounded number, such as 0.33333334f and
# 5.421011e-20f (2^-64).
DIGITS_OF_A_ROUNDED_LITERAL = 7


def without_comments(text):
    """The same text with comments and preprocessor lines blanked, so that positions do not change."""
    blank = lambda match: re.sub(r"[^\n]", " ", match.group())
    text = re.sub(r"//[^\n]*|/\*.*?\*/", blank, text, flags=re.DOTALL)
    return re.sub(r"^[ \t]*#[^\n]*", blank, text, flags=re.MULTILINE)


def to_float32(number):
    try:
        return struct.unpack("f", struct.pack("f", number))[0]
    except OverflowError:
        return float("inf")


def shortest(value):
    """The shortest decimal that reads back as the same float32."""
    return next(text for digits in range(1, 18) if to_float32(float(text := f"{value:.{digits}g}")) == value)


def literal_problem(number, suffix):
    if suffix != "f":
        return f"the literal {number}{suffix} must end in f"
    value = to_float32(float(number))
    if value == float("inf"):
        return f"the literal {number}f is beyond all floats"
    if Decimal(number) == Decimal(value):
        return None
    nearest = shortest(value)
    if Decimal(number) != Decimal(nearest):
        return f"the literal {number}f is not the float it names: that is {nearest}f"
    digits = len(Decimal(number).as_tuple().digits)
    if digits < DIGITS_OF_A_ROUNDED_LITERAL:
        return f"the literal {number}f is not exact in binary"
    return None


def problems_of(text):
    """Yields (position, message) for each problem."""
    text = without_comments(text)
    for match in FLOAT_LITERAL.finditer(text):
        message = literal_problem(match[1] + (match[2] or ""), match[3])
        if message:
            yield match.start(), message
    for match in CALL.finditer(text):
        yield match.start(), f"the built-in {match[1]}() is not portable: use a law of arithmetic.law.glsl"
    for match in DIVISION.finditer(text):
        yield match.start(), "division is not portable: multiply, or use inverse_sqrt()"
    for match in SWIZZLE.finditer(text):
        if len(match[1]) > 1 or match[1] not in "xyzw":
            yield match.start(), f"the swizzle .{match[1]} does not exist in C++: only .x .y .z .w do"


def main():
    files = sorted((ROOT / "src" / "laws").glob("*.law.glsl"))
    count = 0
    for file in files:
        text = file.read_text(encoding="utf-8")
        for place, message in sorted(problems_of(text)):
            count += 1
            line = text.count("\n", 0, place) + 1
            print(f"{file.relative_to(ROOT)}:{line}: {message}")
    print(f"{len(files)} law files, {count} problems")
    return 1 if count or not files else 0


if __name__ == "__main__":
    sys.exit(main())
