"""What commands found, in lines for people; and of a check, for programs."""

from __future__ import annotations

import dataclasses
import math
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from shapeviz_report.cli.terminal import say
from shapeviz_report.order import classes_of
from shapeviz_report.pruning import DAY, Entry
from shapeviz_report.types import Database, Failure, Report

if TYPE_CHECKING:
    from shapeviz_report.building.check import CheckResult
    from shapeviz_report.building.query import QueryResult

MOST_LISTED = 20
"""Shapes of a group that are named."""


def print_summary(report: Report, destination: Path) -> None:
    classes = len(classes_of(report.labels))
    rows = [
        ("shapes", f"{len(report.shapes):,}"),
        ("classes", f"{classes:,}" if classes else "none: no labels"),
        ("failures", f"{len(report.failures):,}"),
    ]
    for name, (_, quality) in report.projections.items():
        if quality.nh_s is not None and quality.null_mean is not None:
            beside = f"random labels: {quality.null_mean:.3f}"
            if quality.range.highest is not None and quality.range.highest < 1:
                beside += f", at most {quality.range.highest:.3f}"
            without = report.without_copies
            if without is not None and (distinct := without.nh_s[name]) is not None:
                beside += f", without {counted(without.copies, 'copy', 'copies')}: {distinct:.3f}"
            rows.append((f"NH_s {name}", f"{quality.nh_s:.3f}  ({beside})"))
    total, total_cpu = sum(report.seconds.values()), sum(report.cpu_seconds.values())
    stages = "  ".join(f"{name} {seconds:.1f}" for name, seconds in report.seconds.items())
    rows.append(("seconds", f"{total:.1f}  ({stages})"))
    rows.append(("CPU seconds", f"{total_cpu:.1f}"))
    say("")
    for name, value in rows:
        say(f"{name:>12}  {value}")
    print_failures(report.failures, most=10)
    for warning in report.database.warnings:
        say("", f"Note: {warning}")
    page = destination if destination.is_file() else destination / "index.html"
    say("", f"The site is ready. Open {page.absolute()}")


def print_check(result: CheckResult) -> None:
    usable = tuple(shape for shape in result.database.shapes if shape.id in result.repairs)
    print_database(dataclasses.replace(result.database, shapes=usable))
    mended = Counter(what for repairs in result.repairs.values() for what in repairs)
    if mended:
        say("", "Would be repaired, in so many files:")
        for what, count in sorted(mended.items(), key=lambda item: (-item[1], item[0])):
            say(f"  {count:6,}  {what}")
    if result.lost:
        say("", f"Colours are left out of {counted(len(result.lost), 'shape', 'shapes')}:")
        losing: dict[str, list[str]] = {}
        for shape, lost in result.lost.items():
            for what in lost:
                losing.setdefault(what, []).append(shape)
        say(*(f"  {listed(shapes)}: {what}" for what, shapes in losing.items()))
    if result.copies:
        copies = sum(len(group.shapes) - 1 for group in result.copies)
        groups = counted(len(result.copies), "group", "groups")
        say("", f"The same shape again: {counted(copies, 'copy', 'copies')}, in {groups}")
        for group in result.copies:
            say(f"  {listed(group.shapes)}: {group.words}")
    print_failures(result.failures)
    if not result.failures:
        say("", "All files can be used.")


def checked_record(result: CheckResult) -> dict[str, object]:
    """What a check found, for programs."""
    from shapeviz_report.building.runner import name_files

    database = result.database
    files = name_files(database)
    return {
        "database": database.name,
        "root": str(database.root),
        "layout": database.layout,
        "labelings": {
            labeling: Counter(s.labels[labeling] for s in database.shapes if labeling in s.labels)
            for labeling in database.labelings
        },
        "shapes": [
            {
                "id": shape.id,
                "name": shape.name,
                "file": files[shape.id],
                "labels": shape.labels,
                "metadata": shape.metadata,
                "usable": shape.id in result.repairs,
                "repairs": result.repairs.get(shape.id, {}),
                "lost_colours": list(result.lost.get(shape.id, ())),
            }
            for shape in database.shapes
        ],
        "failures": [{"file": failure.path, "reason": failure.reason} for failure in result.failures],
        "copies": [
            {
                "shapes": list(group.shapes),
                "match": group.words,
                "pairs": [
                    {"first": copy.first, "second": copy.second, "match": copy.match.words}
                    for copy in group.copies
                ],
            }
            for group in result.copies
        ],
        "warnings": list(database.warnings),
    }


def print_database(database: Database) -> None:
    shapes = counted(len(database.shapes), "shape", "shapes")
    say(f"{database.name}: {shapes}, read as {database.layout} from {database.root}")

    for labeling in database.labelings:
        sizes = Counter(s.labels[labeling] for s in database.shapes if labeling in s.labels)
        missing = len(database.shapes) - sum(sizes.values())
        without = f", {counted(missing, 'shape', 'shapes')} without" if missing else ""
        say("", f"Labeling {labeling!r}: {counted(len(sizes), 'class', 'classes')}{without}")
        for label in classes_of(sizes):
            say(f"  {sizes[label]:6,}  {label}")
    if not database.labelings:
        say("", "No labels: clusters of the features stand in for classes, if the shapes fall into any.")
    for warning in database.warnings:
        say("", f"Note: {warning}")


def print_failures(failures: Sequence[Failure], most: int | None = None) -> None:
    """What cannot be used, and why; of a site, whose About page has all of it, so many at most."""
    if not failures:
        return
    say("", f"Cannot be used: {counted(len(failures), 'file', 'files')}")
    for failure in failures[:most]:
        say(f"  {failure.path}: {failure.reason}")
    if most is not None and len(failures) > most:
        say(f"  ... and {len(failures) - most} more: see the About page")


def print_found(result: QueryResult, mesh: Path) -> None:
    """A table of the shapes found: place, distance, class, the reasons feature by feature, and the shape's id."""
    if result.bins is not None:
        what = result.bins[0] if len(result.bins) == 1 else f"{len(result.bins)} bins"
    else:
        what = ", ".join(result.features or ())
    among = f"{counted(result.shapes, 'shape', 'shapes')} of {result.database}"
    say(f"{mesh}: the most similar of {among}, by {what}.")
    if result.left_out:
        say(f"Left out, for a mesh alone has no value for it: {', '.join(result.left_out)}.")
    say(
        f"Two shapes of the database are typically {result.typical:.3f} apart. Below a feature: how many percent of",
        "the database are farther from the mesh than this shape, by that feature alone.",
        "",
    )
    features = list(result.found[0].closer)
    labels = [found.label or "" for found in result.found]
    width = max(len("class"), *map(len, labels)) if any(labels) else 0
    heading = f"{'class':{width}}  " if width else ""
    say(f"{'':4}  distance  {heading}{'  '.join(f'{name:>4}' for name in features)}  shape")
    for place, (found, label) in enumerate(zip(result.found, labels), start=1):
        shares = "  ".join(f"{100 * found.closer[name]:{max(4, len(name))}.0f}" for name in features)
        said = f"{label:{width}}  " if width else ""
        say(f"{place:4}  {found.distance:8.3f}  {said}{shares}  {found.id}")


def print_entries(entries: Sequence[Entry], now: float) -> None:
    """A line for every stage, and how much was not used for how long."""
    if not entries:
        return
    say("", f"  {'':<20}{'results':>10}  {'size':>9}  last used")
    for stage in sorted({entry.stage for entry in entries}):
        own = [entry for entry in entries if entry.stage == stage]
        used = [days_ago(now - entry.used) for entry in (own[-1], own[0])]
        span = used[0] if used[0] == used[1] else " to ".join(used)
        say(f"  {stage:<20}{len(own):>10,}  {in_bytes(sum(entry.size for entry in own)):>9}  {span}")
    say("")
    for days in (30, 90):
        old = [entry for entry in entries if now - entry.used > days * DAY]
        if old:
            say(
                f"Not used for {days} days: {counted(len(old), 'result', 'results')}, "
                f"{in_bytes(sum(entry.size for entry in old))}; --unused {days} removes them."
            )


def listed(names: Sequence[str]) -> str:
    """Some names, and how many more there are."""
    more = len(names) - MOST_LISTED
    return ", ".join(names[:MOST_LISTED]) + (f" and {more:,} more" if more > 0 else "")


def counted(number: int, one: str, many: str) -> str:
    return f"{number:,} {one if number == 1 else many}"


def in_bytes(size: float) -> str:
    if size < 1000:
        return f"{size:.0f} bytes"
    power = min(int(math.log10(size)) // 3, 3)
    number = size / 1000**power
    return f"{number:.{0 if number >= 100 else 1}f} {('kB', 'MB', 'GB')[power - 1]}"


def days_ago(seconds: float) -> str:
    days = int(max(seconds, 0) // DAY)
    return ("today", "yesterday")[days] if days < 2 else f"{days:,} days ago"
