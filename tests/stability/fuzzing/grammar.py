"""Command lines near those that are right: made from a grammar with small sizes, then changed in some places."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING

from samplekit._registry import registry

if TYPE_CHECKING:
    from random import Random

NUMBERS = ("0", "1", "2", "3", "4", "5", "7", "8", "9", "16", "25", "2^4", "3^2", "1.5", "-1", "+1", "1e0", "0x10")
EXTREMES = ("", " ", "2^63", "2^64", "2^999", "9" * 19, "9" * 25, "1e999", "-1e-999", "nan", "inf", "-inf", "1_0")
EXTREMES += ("٣", "²", "½", "NaN", "None", "true", "1/0", "1,,2", "..", "2^0..2^2", "2^2..2^0", "0..0", "é", "\udcff")
EXTREMES += ("a\nb", "\x1b[31m", "\0", "[red]", "%s", "{x}", "$HOME", "~", "a" * 5000, "--", "-", "'", '"')
LETTERS = "0123456789abcxyz,:+=./^-_ ;@%#\\\"'\n\té\0\udc80"
FILES = ("a.csv", "b.plain.csv", "c.npy", "d.dat", "e.bin", "image.exr", "image.png", "folder", "missing", "points.svg")
OUTPUTS = (
    "out",
    "out/a.exr",
    "out/a.csv",
    "out/b.npy",
    "out/c.dat",
    "out/d.bin",
    "out/e.svg",
    "out/f.png",
    "out/g.pdf",
)
OUTPUTS += ("out/g.plain.csv", "out/missing/a.exr", "folder", "a.csv/b.exr", "/dev/null", "/proc/a.exr", "out/é.exr")
CLOSED_FORMS = ("disk", "gaussian", "bilinear", "checker", "step")
"""Scenes whose spectra are known."""


@cache
def offers(kind: str) -> dict[str, tuple]:
    return {name: offer.spec.options for name, offer in registry().all(kind).items()}


def value_of(option, random: Random) -> str:
    """A value that an option takes, most of the time, and one that keeps the work small."""
    if option.name == "path":
        return random.choice(FILES)
    if option.name == "scene":
        return random.choice(
            ["disk:radius=0.2", "disk", "bilinear", "spike:area=0.1+cx=0.5", "offset", "offset:scene=disk"]
        )
    if option.name in ("bank", "steps", "capacity"):
        return random.choice(["0", "1", "2", "3"])
    if option.choices:
        return random.choice(list(option.choices))
    low, high = option.minimum, option.maximum
    if isinstance(option.default, int) and not isinstance(option.default, bool):
        return str(random.choice([option.default, low or 0, (low or 0) + 1, 3]))
    picks = [option.default, 0.25, 0.5, low or 0.0, 1e-9, 1e-3, 7.0, 1e9, high if high and high < 1e300 else 1.0]
    return repr(random.choice(picks))


def choice(kind: str, random: Random, names: tuple[str, ...] = ()) -> str:
    name = random.choice(names or tuple(offers(kind)))
    options = offers(kind)[name]
    given = [option for option in options if option.required or random.random() < 0.4]
    # Banks of many sets take long to make, and are made once for every count.
    given += [option for option in options if option.name == "bank" and option not in given]
    text = name + ":" * bool(given) + ",".join(f"{option.name}={value_of(option, random)}" for option in given)
    if kind == "sampler" and random.random() < 0.3:
        text += f"+{random.choice(list(offers('randomizer')))}"
    return text


def sampler(random: Random) -> str:
    return choice("sampler", random)


def scene(random: Random) -> str:
    # Means of the others take a quadrature for every pixel.
    quick = tuple(
        name for name in offers("scene") if name not in ("depth-of-field", "motion-blur", "ambient-occlusion")
    )
    return choice("scene", random, () if random.random() < 0.02 else quick)


def some(random: Random, *optional: tuple[float, list[str]]) -> list[str]:
    return [word for probability, words in optional if random.random() < probability for word in words]


def render(random: Random) -> list[str]:
    size = random.choice(["1", "2", "7", "8", "8x3", "1x5", "16"])
    words = ["render", "--sampler", sampler(random), "--spp", random.choice(["1", "2", "4", "9", "16", "2^4", "25"])]
    words += ["--scene", scene(random), "--size", size, "--output", random.choice(OUTPUTS[:2])]
    flags = [(0.3, ["--" + name]) for name in ("json", "no-error", "full", "ssim", "flip", "explain")]
    crop = random.choice(["0,0,1,1", "0,0,8,3", "3,1,2,2", "7,0,1,1"])
    return words + some(
        random, (0.2, ["--crop", crop]), (0.4, ["--seed", seed(random)]), (0.3, ["-t", random.choice("12")]), *flags
    )


def seed(random: Random) -> str:
    return random.choice(["0", "1", "17", str(2**63), str(2**64 - 1)])


def points(random: Random) -> list[str]:
    words = ["points", "-s", sampler(random), "--count", random.choice(["1", "2", "4", "5", "8", "16", "25", "2^6"])]
    return words + some(
        random,
        (0.6, ["--dims", random.choice(["1", "2", "3", "4", "5", "17"])]),
        (0.3, ["--realizations", random.choice("123")]),
        (0.3, ["--seed", seed(random)]),
        (0.5, ["--output", random.choice(OUTPUTS[2:9])]),
        (0.4, ["--json"]),
    )


def compare(random: Random) -> list[str]:
    words = ["compare", "--spp", random.choice(["1", "4", "1,4", "2^0..2^2", "4^1..4^2"]), "--no-time"]
    words += ["--trials", random.choice("124"), "--size", random.choice(["1", "1", "2", "3x2"]), "-t", "1"]
    for _ in range(random.choice([1, 1, 2])):
        words += ["-s", sampler(random)]
    words += ["--scene", scene(random)]
    # With a folder it writes plots and pages, which takes most of a second.
    return words + some(
        random,
        (0.03, ["--output", "out/study"]),
        (0.03, ["--resume"]),
        (0.3, ["--seed", seed(random)]),
        (0.2, ["--cost", random.choice(["0", "100", "1e3"])]),
        (0.2, ["--target", random.choice(["1e-4", "0.1", "0"])]),
        (0.2, ["--fit", random.choice(["1..4", "4..4", "1..16"])]),
        (0.5, ["--json"]),
    )


def spectrum(random: Random) -> list[str]:
    if random.random() < 0.15:
        return ["spectrum", "--image", random.choice(FILES), "--output", "out", *some(random, (0.5, ["--json"]))]
    words = ["spectrum", "-s", sampler(random), "--count", random.choice(["1", "4", "9", "16"]), "-r", "2", "-t", "1"]
    listed = ["--frequencies", random.choice(["1,2", "1,0;0.5,2^20", "0,0", "1", "1,2,3", "2^40,1"])]
    words += ["--max-frequency", random.choice("123"), "--output", "out"]
    return words + some(
        random,
        (0.3, ["--dims", random.choice("1234")]),
        (0.3, ["--project", random.choice(["0,1", "all", "0", "1,0", "0,1,2", "3,2"])]),
        (0.3, ["--homogenize"]),
        (0.2, ["--step", random.choice(["0.5", "1", "2"])]),
        (0.2, listed),
        (0.2, ["--scale", random.choice(["1", "0.5", "1e-3"])]),
        (0.3, ["--json"]),
    )


def predict(random: Random) -> list[str]:
    # The spectra of others are sampled at four million pixels.
    integrated = scene(random) if random.random() < 0.01 else choice("scene", random, CLOSED_FORMS)
    words = ["predict", "-s", sampler(random), "--scene", integrated, "--count", random.choice(["1", "4", "4,16"])]
    words += ["--trials", random.choice(["4", "50"]), "-r", "2", "--max-frequency", "2", "--threads", "1"]
    return words + some(random, (0.4, ["--json"]), (0.3, ["--seed", seed(random)]))


def stability(random: Random) -> list[str]:
    words = ["stability", "-s", sampler(random), "--scene", scene(random), "--count", "4", "--realizations", "2"]
    return words + some(random, (0.5, ["--json"]))


def check(random: Random) -> list[str]:
    name = sampler(random) if random.random() < 0.7 else scene(random)
    only = random.choice(["range", "strata", "nets", "prefix", "seeds", "nothing"])
    return ["check", name, "--quick", "--only", only, *some(random, (0.5, ["--json"]), (0.2, ["--html", "out/a.html"]))]


def listing(random: Random) -> list[str]:
    kind = random.choice(["samplers", "scenes", "randomizers", "plugins"])
    named = sampler(random) if kind == "samplers" else random.choice(["owen", "disk", "spectrum", "halton"])
    return ["list", *some(random, (0.8, [kind])), *some(random, (0.4, [named]), (0.5, ["--json"]))]


def info(random: Random) -> list[str]:
    return ["info", random.choice(FILES), *some(random, (0.5, ["--json"]))]


def new_plugin(random: Random) -> list[str]:
    name = random.choice(["golden-ratio", "a", "class", "numpy", "x-1", "Sobol", "../x", "a.b", "1a", "test"])
    return [
        "new-plugin",
        name,
        "--directory",
        random.choice(["out", "missing", "a.csv"]),
        *some(random, (0.4, ["--json"])),
    ]


def general(random: Random) -> list[str]:
    alone = [
        "--help",
        "--version",
        "-h",
        "render --help",
        "compare -h",
        "rendr",
        "spectrum --help",
        "--json",
        "",
        "cars/x",
    ]
    return random.choice(alone).split()


COMMANDS = {
    render: 26, points: 34, compare: 8, spectrum: 8, predict: 3, stability: 0.5, check: 0.5,
    listing: 8, info: 4, new_plugin: 3, general: 4,
}  # fmt: skip
"""What makes requests, and how many of a hundred."""


def mutated(words: list[str], random: Random) -> list[str]:
    """The words with one change: of a value, of letters, of their order."""
    words = list(words)
    place = random.randrange(len(words)) if words else 0
    kind = random.choice(["number", "extreme", "letters", "drop", "double", "swap", "option", "file", "cut", "splice"])
    if not words or kind == "option":
        every = [
            "--json",
            "--full",
            "--resume",
            "--no-error",
            "--html",
            "--fresh",
            "--dask",
            "--processes",
            "--nothing",
        ]
        words.insert(place, random.choice(every))
    elif kind == "drop":
        del words[place]
    elif kind == "double":
        words.insert(place, words[place])
    elif kind == "swap":
        other = random.randrange(len(words))
        words[place], words[other] = words[other], words[place]
    elif kind == "file":
        words[place] = random.choice(FILES + OUTPUTS)
    elif kind == "cut":
        words[place] = words[place][: random.randrange(len(words[place]) + 1)]
    else:
        words[place] = _changed(words[place], kind, random)
    return words


def _changed(word: str, kind: str, random: Random) -> str:
    value = random.choice(NUMBERS if kind == "number" else EXTREMES)
    name, equals, _ = word.rpartition("=")
    if kind in ("number", "extreme"):
        return name + equals + value
    if kind == "splice":
        return word + random.choice(["+owen", "+shift", ",cx=1", ":", ":k=2", ",", "=", "..2^3", ",4", "x9", ".exr"])
    letters = list(word)
    for _ in range(random.choice([1, 1, 2, 5])):
        letters.insert(random.randrange(len(letters) + 1), random.choice(LETTERS.replace("0", "").replace("9", "")))
        if random.random() < 0.5:
            del letters[random.randrange(len(letters))]
    return "".join(letters)


def command_line(random: Random) -> list[str]:
    """A request from the grammar, then changed in none to four places."""
    make = random.choices(list(COMMANDS), list(COMMANDS.values()))[0]
    words = make(random)
    for _ in range(random.choice([0, 0, 0, 1, 1, 2, 4])):
        words = mutated(words, random)
    return words
