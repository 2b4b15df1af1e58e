"""Numbers as they are read: few digits, true minus signs, units of a handy size."""

import math

MINUS = "\u2212"
THIN = "\u202f"
NOTHING = "\u2013"


def number(value: float, digits: int = 3) -> str:
    """Write ``value`` with so many significant digits and thin spaces between thousands."""
    if not math.isfinite(value):
        return NOTHING
    if value == 0:
        return "0"
    magnitude = math.floor(math.log10(abs(value)))
    if not -4 <= magnitude < 7:
        mantissa, exponent = f"{value:.{max(digits - 1, 0)}e}".split("e")
        return f"{mantissa}e{int(exponent)}".replace("-", MINUS)
    rounded = round(value, digits - 1 - magnitude)
    decimals = max(digits - 1 - magnitude, 0)
    return f"{rounded:,.{decimals}f}".replace(",", THIN).replace("-", MINUS)


def nominal(value: float) -> str:
    """Write a given value, such as a thickness, without trailing zeros."""
    text = number(value)
    return text.rstrip("0").rstrip(".") if "." in text and "e" not in text else text


def fixed(value: float, decimals: int = 2) -> str:
    """Write ``value`` with so many decimals; a dash when it is not finite."""
    if not math.isfinite(value):
        return NOTHING
    return f"{value:z.{decimals}f}".replace("-", MINUS)


def signed(value: float, decimals: int = 2) -> str:
    """Like `fixed`, with the sign written of everything that does not round to zero."""
    text = fixed(value, decimals)
    return f"+{text}" if value > 0 and text != fixed(0.0, decimals) else text


def percent(share: float, digits: int = 2) -> str:
    """Write a share of one in per cent."""
    if not math.isfinite(share):
        return NOTHING
    if abs(share) < 5e-5:
        return "0 %" if share == 0 else "below 0.01 %"
    return f"{number(100.0 * share, digits)} %"


def percent_range(low: float, high: float) -> str:
    """Write a range of shares in per cent, once when its ends read alike."""
    if percent(low) == percent(high):
        return percent(low)
    return f"{percent(low).removesuffix(' %')} to {percent(high)}"


def number_range(low: float, high: float) -> str:
    """Write a range with two significant digits, once when its ends read alike."""
    ends = dict.fromkeys((number(low, 2), number(high, 2)))
    return " to ".join(ends)


def stiffness(value: float) -> str:
    """Write a stiffness given in N/m with a unit of a handy size."""
    for factor, unit in ((1e6, "MN/m"), (1e3, "kN/m")):
        if math.isfinite(value) and abs(value) >= factor:
            return f"{number(value / factor)} {unit}"
    return f"{number(value)} N/m"


def duration(seconds: float, digits: int = 3) -> str:
    """Write a time span given in seconds in hours, minutes or seconds."""
    if not math.isfinite(seconds):
        return NOTHING
    small = (1, "s") if seconds < 90 else (60, "min")
    factor, unit = small if seconds < 90 * 60 else (3600, "h")
    return f"{number(seconds / factor, digits)} {unit}"


def times(count: int) -> str:
    """Write a small count of repetitions as an adverb."""
    return {0: "not at all", 1: "once", 2: "twice"}.get(count, f"{count} times")


def plural(count: int, noun: str) -> str:
    """Write a count with its regular noun."""
    if count == 1:
        return f"{count} {noun}"
    return f"{count} {noun}{'es' if noun.endswith('s') else 's'}"
