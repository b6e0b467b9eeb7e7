"""What must stand in a drive's header, item by item: text that is the same in all, tables made of the description, and
the signatures of functions whose bodies other checks read.
"""

import re
from collections.abc import Iterator, Sequence
from fractions import Fraction
from os.path import commonprefix

from .as_they_stand import SOLVED
from .enclosure import number_of
from .refusal import Rejected, require
from .shipped import items, opening

#: What a key's ending says of its number: inner unit and factor, in degrees of a half turn where it is an angle.
UNITS = {
    "deg": ("rad", Fraction(1, 180)),
    "arcsec": ("rad", Fraction(1, 648000)),
    "mm": ("mm", 1),
    "um": ("mm", Fraction(1, 1000)),
    "per_mm": ("1/mm", 1),
    "mm_per_rad": ("mm/rad", 1),
    "mm_per_rad2": ("mm/rad^2", 1),
    "": ("", 1),
}
BEGINS = """
#ifndef MESHWRIGHT_@_H
#define MESHWRIGHT_@_H
"""
VERSIONS = """
#if MW_MODEL_ABI != {abi}
#error "this header and one included before it are of different versions of meshwright: generate both anew"
#endif
"""
ELEMENTARY = """
#define MW_S(name) s[X_S_##name]
#ifndef MW_INLINE
#if defined(__GNUC__) && !defined(__OPTIMIZE_SIZE__)
#define MW_INLINE static inline __attribute__((always_inline))
#else
#define MW_INLINE static inline
#endif
#ifdef __GNUC__
#define MW_CALLED static __attribute__((noinline))
#else
#define MW_CALLED static
#endif
#endif
#ifndef MW_FMA
#ifdef MW_FUSED
#define MW_FMA(a, b, c) fma(a, b, c)
#define MW_FMS(a, b, c) fma(a, b, -(c))
#define MW_FNMA(a, b, c) fma(-(a), b, c)
#else
#define MW_FMA(a, b, c) ((a) * (b) + (c))
#define MW_FMS(a, b, c) ((a) * (b) - (c))
#define MW_FNMA(a, b, c) ((c) - (a) * (b))
#endif
#ifdef __GNUC__
#define MW_ABS(a) __builtin_fabs(a)
#else
#define MW_ABS(a) ((a) < 0.0 ? -(a) : (a))
#endif
typedef union mw_bits {
    double number;
    unsigned long long bits;
} mw_bits;
#endif
#ifndef MW_SIGN
#define MW_SIGN(a) ((a) < 0.0 ? -1.0 : 1.0)
#endif
MW_DEVICE MW_INLINE void X_sincos(double a, double *sine, double *cosine);
MW_DEVICE MW_INLINE void X_near_sincos(double a, double *sine, double *cosine, const double *at, double *away);
MW_DEVICE MW_CALLED void X_seldom_sincos(double a, double *sine, double *cosine)
{
    X_sincos(a, sine, cosine);
}
MW_DEVICE MW_INLINE double X_atan2(double y, double x);
#if defined(__GNUC__) && !defined(__clang__) && defined(__FMA__)
#pragma GCC push_options
#pragma GCC optimize("no-tree-slp-vectorize", "schedule-insns", "sched-pressure")
#endif
"""
SELDOM = """
#if defined(__GNUC__) && !defined(__clang__) && defined(__OPTIMIZE__) && !defined(__OPTIMIZE_SIZE__)
#pragma GCC push_options
#pragma GCC optimize("O1")
#endif
"""
OFTEN = """
#if defined(__GNUC__) && !defined(__clang__) && defined(__OPTIMIZE__) && !defined(__OPTIMIZE_SIZE__)
#pragma GCC pop_options
#endif
"""
SYSTEM = """
MW_DEVICE static inline void Y_guess(const double *q, double *y);
MW_DEVICE static inline void Y_scale(const double *q, double *y);
MW_DEVICE static inline void Y_eval(const double *q, const double *y, double *R, double *J);
"""
WATCH = "MW_DEVICE static inline double Y_watch(const double *q, const double *y);"
FILLS = """
MW_DEVICE static inline int Y_open(const double *p);
MW_DEVICE static inline void Y_fill(const double *y, double *q);
"""
STAGES = """
MW_DEVICE static inline int X_missing(const double *p, int otherwise);
MW_DEVICE static inline int X_setup(const double *p, double *s);
MW_DEVICE static inline void X_set_phi(double *s, double phi);
MW_DEVICE static inline void X_eval(const double *s, const double *x, double *R, double *J);
MW_DEVICE static inline double X_step(const double *s, double *x);
MW_DEVICE static inline double X_by_anchor(const double *s, const double *at, double phi, const double *x,
                                           double *R);
"""
PATHS = """
MW_DEVICE static inline void X_anchor(const double *s, double phi, const double *x, double *at);
MW_DEVICE static inline void X_along(const double *s, double phi, const double *x, const double *v, double *d1,
                                     double *d2);
MW_DEVICE static inline void X_guess(const double *s, double *y);
MW_DEVICE static inline void X_start_scale(const double *s, double *y);
MW_DEVICE static inline void X_start_eval(const double *s, const double *y, double *R, double *J);
MW_DEVICE static inline void X_start_solution(const double *s, const double *y, double *x);
MW_DEVICE static inline void X_scale(const double *s, double *x);
"""
SURFACE = "MW_DEVICE static inline void X_{name}(const double *s, const double *q, double *o);"
MODEL = """
#if !defined(MW_KERNELS) || defined(MW_DEVICE_ONLY)
#undef MW_KERNELS
#define MW_KERNELS NULL
#endif
MW_TABLE mw_model X_model = {{
    X_ABI, "{name}", "{family}", "{title}", X_SPEC_HASH,
    X_NX, X_NP, X_NS, X_NO, X_ND, X_NSTART, {guards},
    {error}, {wheel_angle}, X_REFERENCE, X_TEETH, X_MEMORY, {geometry},
    X_unknown_names, MW_HOST(X_parameter_names), MW_HOST(X_size_names),
    MW_HOST(X_output_names), {outputs}, MW_HOST(X_output_sizes), MW_HOST(X_guard_texts), X_bodies,
    MW_HOST(X_derive), MW_HOST(X_size), MW_HOST(X_setup), MW_HOST(X_set_phi), MW_HOST(X_eval), MW_HOST(X_step),
    X_NANCHOR, X_NEAREST, MW_HOST(X_anchor), MW_HOST(X_by_anchor), MW_HOST(X_along),
    MW_HOST(X_guess), MW_HOST(X_start_scale), MW_HOST(X_start_eval), MW_HOST(X_start_solution), MW_HOST(X_observe),
    MW_HOST(X_scale),
    {systems}, {regions},
    {functions}, MW_KERNELS
}};
#ifdef MW_DEVICE_ONLY
#ifdef MW_CALL
#error "with MW_DEVICE_ONLY a translation unit holds one drive: include one header"
#endif
#define MW_CALL(m, function) X_##function
#endif
"""
ON_HOST = "#ifndef MW_DEVICE_ONLY"
SIGNATURES = {
    "solve_design": "static inline int X_solve_design(double *p, mw_info *info)",
    "solve": "static inline int X_solve(double *s, double phi, double *x, mw_info *info)",
    "reduce": "MW_DEVICE static inline double X_reduce(const double *s, double phi, double *pair)",
    "follow": "MW_BY_TABLE static inline int X_follow(double *s, double phi, double *x, mw_info *info)",
    "cycle_setup": "static inline int X_cycle_setup(const double *p, const double *coast, double *c)",
    "cycle": "static inline int X_cycle(double *c, double phi, mw_cycle *out)",
    "self_test": "static inline int X_self_test(void)",
    "geometry": "MW_BY_TABLE static inline int X_geometry(const double *s, const double *x, double *o, "
    "mw_contact *contact)",
}
SPACE = "enum { X_NC = MWI_SIDES + 2 * (MWI_STATE + X_NS + MWI_PLACES * (1 + X_NX)) };"
#: Functions before which, or after which, what only a host has begins or ends.
ON_HOST_FROM, ON_HOST_TO = ("solve_design", "cycle_setup"), ("solve", "self_test")
ENDS = """
#ifndef MW_DEVICE_ONLY
static inline const char *X_flag(int bit)
{
    return mwi_flag(&X_model, bit);
}
static inline int X_flags(unsigned flags, const char **names)
{
    return mwi_flags(&X_model, flags, names);
}
static inline const char *X_status_word(int status)
{
    return mwi_status_word(status);
}
static inline const char *X_status_text(int status)
{
    return mwi_status_text(status);
}
#endif
#if defined(__GNUC__) && !defined(__clang__) && defined(__FMA__)
#pragma GCC pop_options
#endif
#undef MW_S
#endif
"""
#: The header of proofs after the runtime's text.
POINT_ALONE = """
#ifndef MESHWRIGHT_@_CERTIFY_H
#define MESHWRIGHT_@_CERTIFY_H
#include <math.h>
#ifndef MW_LANES
#define MW_LANES 1
#define MW_LANES_ALONE
#ifndef MWC_POINT_ALONE
#define MWC_POINT_ALONE
#endif
#endif
static inline void MWC_LANE_NAME(X_enclose_instant)(const double *s, const double *phi, double *t);
static inline void MWC_LANE_NAME(X_enclose)(const double *s, const double *t, const double *x, const double *d,
                                            double *R, double *J);
static inline void MWC_LANE_NAME(X_enclose_point)(const double *s, const double *t, const double *x, const int *rows,
                                                  double *R, double *J, double *G);
#ifdef MW_LANES_ALONE
#define X_CERTIFY_NS {slots}
static inline int X_certify_setup(const mw_wide *p, double *s);
"""
CERTIFIES = """
static inline int X_certify(double *s, mw_ball phi, const double *x, double *e, double *box)
{{
    enum {{ N = {unknowns} }};
    const double angle[2] = {{ phi.mid, phi.radius }};
    double *const t = s + {instant}, R[2 * N], J[2 * N * N], sizes[2 * N], proved[1], z[N][1], K[N][1], within[N][1];
    MWC_LANE_NAME(X_enclose_instant)(s, angle, t);
    for (int l = 0; l < 1; l++) {{
        @
    }}
    for (int i = 0; i < N; i++) box[i] = sizes[2 * i] * MWC_FIRST_BOX;
    for (int step = 0; step < MWC_SHAPING_STEPS; step++) {{
        MWC_LANE_NAME(X_enclose)(s, t, x, box, R, J);
        MWC_LANE_NAME(mwc_prove)(N, R, J, box, proved, z, K, within);
        for (int i = 0; i < N; i++) e[i] = within[i][0];
        if (proved[0] > 0.0) break;
        for (int i = 0; i < N; i++) {{
            box[i] = MWC_SHAPED(z[i][0], K[i][0]);
            if (!(box[i] <= MWC_WIDEST_BOX * sizes[2 * i])) return 0;
        }}
    }}
    if (!(proved[0] > 0.0 && s[{arithmetic}] > 0.0)) return 0;
    {domains}
    return 1;
}}
#undef MW_LANES
#undef MW_LANES_ALONE
#endif
#endif
"""


class Frame:
    """The items of one header, from its description, how many numbers its state has and which of them a misalignment
    changes, its outputs, and the messages of its guards.
    """

    def __init__(
        self,
        description: dict,
        slots: int,
        outputs: Sequence[tuple[str, str, int]],
        texts: Sequence[str],
        pose: Sequence[int],
    ):
        self.description, self.slots, self.outputs, self.texts = description, slots, outputs, texts
        self.pose = pose
        self.name = description["name"]
        self.unknowns = [unknown["name"] for unknown in description["contact"]["unknowns"]]
        self.parameters = [key["symbol"]["name"] for key in description["keys"]]
        places, at = {}, 0
        for name, _, size in outputs:
            places[name], at = at, at + size
        self.places, self.size = places, at

    def items(self) -> list[str]:
        """All of them; a function that ends in ``;`` is one whose body is read elsewhere."""
        return items(self.named("\n".join(self._texts())))

    def _texts(self) -> Iterator[str]:
        description = self.description
        yield from (ELEMENTARY, SELDOM, "MW_DEVICE static inline void X_derive(double *p);")
        for system in description["design_systems"]:
            texts = (SYSTEM, WATCH if system["regular"] else "", FILLS)
            yield "".join(texts).replace("Y_", f"X_{system['name']}_")
        yield "MW_DEVICE static inline void X_size(const double *p, double *d);"
        yield from (OFTEN, STAGES, SELDOM, PATHS, OFTEN)
        yield "MW_DEVICE static inline void X_observe(const double *s, const double *x, double *o);"
        yield SELDOM
        surfaces = [f"flank_{body['name']}" for body in description["bodies"]]
        surfaces += [f"{region['region']}_{region['member']}" for region in description["regions"]]
        for surface in surfaces:
            yield from (SURFACE.format(name=name) for name in (surface, f"curvature_{surface}"))
        yield from (SURFACE.format(name=name) for name, *_ in self.offered())
        yield from (OFTEN, *self.tables(), *self.bodies(), *self.lists(), self.model())

    def after(self) -> list[str]:
        """What follows the solver."""
        text = ""
        for name, body in SOLVED.items():
            text += f"{ON_HOST}\n" if name in ON_HOST_FROM else ""
            text += f"{SPACE}\n" if name == "cycle_setup" else ""
            text += f"{SIGNATURES[name]}\n{{{body}\n}}\n"
            text += "#endif\n" if name in ON_HOST_TO else ""
        return items(self.named(text + ENDS))

    def certify(self, slots: int, instant: int) -> list[str]:
        """What stands in the header of proofs after the runtime's text; @ for the natural sizes of the unknowns, which
        decide what boxes are tried and not what is proved.
        """
        domains = ""
        for k, unknown in enumerate(self.description["contact"]["unknowns"]):
            lower, upper = unknown["domain"]
            domains += "" if lower is None else f"if (!(x[{k}] - box[{k}] >= {literal(lower)})) return 0; "
            domains += "" if upper is None else f"if (!(x[{k}] + box[{k}] <= {literal(upper)})) return 0; "
        first = POINT_ALONE.format(slots=2 * slots + 1).replace("@", self.name.upper())
        second = CERTIFIES.format(
            unknowns=len(self.unknowns), instant=2 * instant, arithmetic=2 * slots, domains=domains
        )
        return items(self.named(first + second))

    @staticmethod
    def compare(found: Sequence[str], expected: Sequence[str]) -> None:
        """Item by item; of a function that is run elsewhere, its signature; @ stands for any statements."""
        for one, wanted in zip(found, expected, strict=False):
            signature = wanted.endswith(") ;") and one.endswith("}")
            own = f"{opening(one)} ;" if signature else one
            before, _, after = wanted.partition(" @ ")
            if own != wanted and not (after and own.startswith(before) and own.endswith(after)):
                at = max(0, len(commonprefix([own, wanted])) - 40)
                raise Rejected(f"{one[:60]} … {own[at : at + 90]!r} stands where {wanted[at : at + 90]!r} must")
        require(len(found) == len(expected), "more or fewer items than there must be")

    def named(self, text: str) -> str:
        """A text of this drive: its name for X, but in what is quoted."""
        return re.sub(r'("[^"\n]*")|\bX_', lambda found: found[1] or f"{self.name}_", text)

    def offered(self) -> Iterator[tuple[str, int, int]]:
        """Functions beside the contact: name, arguments, results; of each body's placement rows (rotation | origin) and
        axis, a point and a direction.
        """
        yield "placement", 2, 2 * (12 + 6)
        for entry in self.description["functions"]:
            yield entry["name"], len(entry["arguments"]), sum(len(result["values"]) for result in entry["results"])

    def macros(self) -> dict[str, str]:
        """Name -> value of what is defined as a number or place."""
        text = self.named("\n".join((*self.sizes(), *self.indices())))
        return {item.split()[2]: " ".join(item.split()[3:]) for item in items(text)}

    def sizes(self) -> Iterator[str]:
        description = self.description
        margins = sum(len(body["margins"]) for body in description["bodies"])
        kept = 3 + 2 * len(self.unknowns)
        yield f"#define X_NX {len(self.unknowns)}"
        yield f"#define X_NP {len(self.parameters)}"
        yield f"#define X_NS {self.slots + kept + len(self.parameters)}"
        yield f"#define X_MEMORY {self.slots}"
        yield f"#define X_NO {self.size}"
        yield f"#define X_ND {len(description['sizes'])}"
        yield f"#define X_NSTART {len(description['start']['unknowns'])}"
        yield f"#define X_NFLAGS {2 + margins}"
        signs = [k for k, key in enumerate(description["keys"]) if key["table"] == "flank"]
        reference, keys = description["contact"]["reference_angle"], [key["key"] for key in description["keys"]]
        require(reference == 0 or reference in self.parameters, "the reference angle is neither 0 nor a parameter")
        yield f"#define X_REFERENCE ({-1 if reference == 0 else self.parameters.index(reference)})"
        yield f"#define X_TEETH {keys.index(description['pinion_teeth'])}"
        yield f"#define X_OTHER_FLANK {-1 if description['flanks_apart'] or not signs else signs[0]}"

    def indices(self) -> Iterator[str]:
        for k, key in enumerate(self.description["keys"]):
            alone = sum(entry["key"] == key["key"] for entry in self.description["keys"]) == 1
            name = key["key"] if alone or key["table"] == "design" else f"{key['table']}_{key['key']}"
            yield f"#define X_P_{name} {k}"
            for word, number in key["choices"].items():
                yield f"#define X_W_{name}_{word.replace('-', '_')} ({number})"
        for k, name in enumerate(self.unknowns):
            yield f"#define X_U_{name} {k}"
        for name, place in self.places.items():
            yield f"#define X_O_{name} {place}"

    def tables(self) -> Iterator[str]:
        description = self.description
        yield listed("unknown_names", (row(u, "", "", 1) for u in description["contact"]["unknowns"]))
        yield ON_HOST
        yield listed("parameter_names", map(parameter, description["keys"]))
        sizes = ((entry, *unit_of(entry["key"])) for entry in description["sizes"])
        yield listed("size_names", (
            named(entry["key"], unit, entry["meaning"], entry["key"], "", factor) for entry, unit, factor in sizes
        ))  # fmt: skip
        yield listed("output_names", (named(name, unit, "", "", "", 1) for name, unit, _ in self.outputs))
        yield f"static const int X_output_sizes[] = {{ {', '.join(str(size) for *_, size in self.outputs)} }};"
        yield f"static const char *const X_guard_texts[] = {{ {', '.join(map(quoted, self.texts))}, }};"
        yield f"static const int X_POSE[] = {{ {', '.join(map(str, self.pose))} }};"
        yield "#endif"

    def bodies(self) -> Iterator[str]:
        rows = ""
        for body in self.description["bodies"]:
            name, surface = body["name"], body["surface"]
            own = [self.unknowns.index(q["name"]) for q in surface["parameters"]]
            margins, conditions = body["margins"], len(surface["conditions"])
            yield f"MW_TABLE int X_{name}_unknowns[] = {{ {', '.join(map(str, own))} }};"
            for key in ("flag", "event"):
                words = "".join(f"{quoted(margin[key])}, " for margin in margins)
                yield f"MW_TABLE char *const X_{name}_{key}s[] = {{ {words}NULL }};"
            tangents = self.places[f"tangent_{surface['parameters'][0]['name']}"]
            regular = self.places[f"regular_{name}"]
            size = 6 + 3 * len(own) + 1 + len(margins) + conditions * (1 + len(own))
            rows += (
                f"{{ {quoted(name)}, {len(own)}, {conditions}, {self.places[f'point_{name}']}, {tangents}, {regular}, "
                f"{regular + 1}, {len(margins)}, X_{name}_unknowns, X_{name}_flags, X_{name}_events, {size}, "
                f"MW_HOST(X_flank_{name}), MW_HOST(X_curvature_flank_{name}) }}, "
            )
        yield f"MW_TABLE mw_body X_bodies[] = {{ {rows}}};"

    def lists(self) -> Iterator[str]:
        description = self.description
        yield ON_HOST
        if description["design_systems"]:
            rows = ""
            for system in description["design_systems"]:
                y = f"X_{system['name']}"
                watch = f"{y}_watch" if system["regular"] else "NULL"
                rows += (
                    f"{{ {quoted(system['name'])}, {len(system['unknowns'])}, {y}_guess, {y}_scale, {y}_eval, {watch}, "
                    f"{y}_open, {y}_fill }}, "
                )
            yield f"static const mw_system X_systems[] = {{ {rows}}};"
        if description["regions"]:
            rows = ""
            for region in description["regions"]:
                surface, name = region["surface"], f"{region['region']}_{region['member']}"
                own, conditions = len(surface["parameters"]), len(surface["conditions"])
                size = 6 + 3 * own + 1 + len(region["margins"]) + conditions * (1 + own)
                rows += (
                    f"{{ {quoted(region['member'])}, {quoted(region['region'])}, {own}, {conditions}, {size}, "
                    f"X_{name}, X_curvature_{name} }}, "
                )
            yield f"static const mw_region X_regions[] = {{ {rows}}};"
        rows = "".join(f"{{ {quoted(name)}, {taken}, {given}, X_{name} }}, " for name, taken, given in self.offered())
        yield f"static const mw_function X_functions[] = {{ {rows}}};"
        yield "#endif"

    def model(self) -> str:
        description = self.description
        def list_of(key: str, name: str) -> str:
            return f"{len(description[key])}, {f'MW_HOST(X_{name})' if description[key] else 'NULL'}"

        return MODEL.format(
            name=self.name,
            family=description["family"],
            title=description["title"],
            guards=sum(1 for text in self.texts if not text.endswith((ALONE, TOGETHER))),
            error=self.unknowns.index(description["contact"]["error"]),
            wheel_angle=self.places["wheel_angle"],
            geometry=self.places["tangent_basis"],
            outputs=len(self.outputs),
            systems=list_of("design_systems", "systems"),
            regions=list_of("regions", "regions"),
            functions=f"{len(list(self.offered()))}, MW_HOST(X_functions)",
        )


ALONE, TOGETHER = "missing from the design: give it a value", "all missing from the design: give one a value"


def check_texts(description: dict, texts: Sequence[str]) -> None:
    """Messages of guards, of what divides, of what is missing, in this order."""
    own = [f"{guard['message']} ({', '.join(guard['keys'])})" for guard in description["guards"]]
    require(list(texts[: len(own)]) == own, "guard_texts: the messages of the description's guards are others")
    places = [key["key"] if key["table"] == "design" else f"{key['table']}.{key['key']}"
              for key in description["keys"] if key["required"]]  # fmt: skip
    missing = [f"{place}: {ALONE}" for place in places]
    missing += [f"{', '.join(group)}: {TOGETHER}" for group in description["exclusive"]]
    require(list(texts[len(texts) - len(missing) :]) == missing, "guard_texts: what is missing is said otherwise")
    for text in texts[len(own) : len(texts) - len(missing)]:
        words = r"a division by zero: .* must not be 0|a value that the contact needs is missing or not finite|.*must"
        require(re.match(words, text), f"guard_texts: {text[:60]} is no message that is foreseen")


def quoted(text: str) -> str:
    return f'"{text}"'


def listed(name: str, rows: Iterator[str]) -> str:
    return f"MW_TABLE mw_name X_{name}[] = {{ {''.join(f'{entry}, ' for entry in rows)}}};"


def named(name: str, unit: str, meaning: str, key: str, table: str, factor: object, domain: Sequence = (None, None)):
    lower, upper = ("-HUGE_VAL" if domain[0] is None else literal(domain[0]),
                    "HUGE_VAL" if domain[1] is None else literal(domain[1]))  # fmt: skip
    words = ", ".join(map(quoted, (name, unit, meaning, key, table)))
    return f"{{ {words}, {literal(factor)}, {lower}, {upper} }}"


def row(symbol: dict, key: str, table: str, factor: object) -> str:
    return named(symbol["name"], symbol["unit"], symbol["meaning"], key, table, factor, symbol["domain"])


def parameter(key: dict) -> str:
    unit, factor = unit_of(key["key"])
    words = f"{key['key']}: its ending says another unit than the description"
    require(literal(factor) == literal(key["factor"]) and unit in ("", key["symbol"]["unit"]), words)
    return row(key["symbol"], key["key"], key["table"], key["factor"])


def unit_of(key: str) -> tuple[str, object]:
    """Inner unit and factor of a key, by its ending."""
    ending = max((end for end in UNITS if key.endswith(f"_{end}")), key=len, default="")
    unit, factor = UNITS[ending]
    over = Fraction(factor)
    exact = ["/", over.numerator, over.denominator]
    return unit, ["*", exact, ["pi"]] if unit == "rad" else exact


def literal(e: object) -> str:
    """The nearest double of a product of fractions and the circle's number, as its shortest decimal."""
    exact = Fraction(1)
    for part in e[1:] if isinstance(e, list) and e[0] == "*" else [e]:
        exact *= number_of("pi").middle if part == ["pi"] else Fraction(*part[1:]) if isinstance(part, list) else part
    return repr(float(exact))
