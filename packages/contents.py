#!/usr/bin/env python3
"""What a program or a Python package is made of: the notices that its parts ask for, and a list for machines.

    packages/contents.py PACKAGE TARGET FOLDER [--manifest-path Cargo.toml] [--node node_modules/NAME]

writes FOLDER/THIRD-PARTY-NOTICES.txt, with the licence texts of every crate that PACKAGE links to for TARGET, of the
fonts within them and of each package of Node that is named, and FOLDER/PACKAGE.cdx.json, a CycloneDX list with versions, checksums and who needs whom. Both
follow from the lock file alone: the same sources give the same bytes. A crate without a licence text is an error.
"""

import argparse
import datetime
import json
import os
import pathlib
import re
import subprocess
import tomllib
import uuid

ROOT = pathlib.Path(__file__).parent.parent
# Names of files that hold a licence or a notice.
TEXTS = re.compile(r"(licen[cs]e|copying|copyright|notice|unlicense)([-._].*)?", re.I)
# Code is no licence text, though a file may be called licence.rs.
CODE = (".rs", ".toml", ".py")
RUST = "the Rust standard library"


def metadata(manifest, target):
    command = ["cargo", "metadata", "--locked", "--format-version", "1", "--manifest-path", manifest,
               "--filter-platform", target]
    return json.loads(subprocess.run(command, check=True, stdout=subprocess.PIPE).stdout)


def linked(known, package):
    """What `package` links to: the packages by id, and what each needs."""
    packages = {p["id"]: p for p in known["packages"]}
    nodes = {n["id"]: n for n in known["resolve"]["nodes"]}
    first = next(i for i, p in packages.items() if p["name"] == package and p["source"] is None)
    needs, left = {}, [first]
    while left:
        at = left.pop()
        if at not in needs:
            is_linked = [d for d in nodes[at]["deps"] if any(k["kind"] is None for k in d["dep_kinds"])]
            needs[at] = sorted(d["pkg"] for d in is_linked)
            left += needs[at]
    return {i: packages[i] for i in sorted(needs, key=lambda i: order(packages[i]))}, needs, first


def of_node(folder):
    """A package of Node, as Cargo would describe it."""
    about = json.loads((folder / "package.json").read_text())
    return {"name": about["name"], "version": about["version"], "license": about["license"], "registry": "npm",
            "manifest_path": str(folder / "package.json")}


def order(package):
    return package["name"], package["version"]


def licence(package):
    """An SPDX expression; older crates write / for OR."""
    return package["license"].replace("/", " OR ") if package["license"] else None


def texts(package):
    """Licence texts in the folder of a crate, by their path in it."""
    folder = pathlib.Path(package["manifest_path"]).parent
    found = {}
    for path in sorted(p for p in folder.rglob("*") if "node_modules" not in p.relative_to(folder).parts):
        if path.is_file() and TEXTS.fullmatch(path.name) and path.suffix not in CODE:
            text = path.read_text(errors="replace").replace("\r\n", "\n").strip()
            if text and text not in found.values():
                found[str(path.relative_to(folder))] = text
    return found


def notices(packages, rust):
    """The notices: each part with its texts, a text that several share once."""
    apache = (ROOT / "LICENSE-APACHE").read_text().strip()
    numbers, parts, missing = {apache: 1}, [], []
    parts.append((RUST, rust, "MIT OR Apache-2.0", [1]))
    for package in packages:
        found = list(texts(package).values())
        if not found and "Apache-2.0" in (licence(package) or ""):
            found = [apache]
        if not found:
            missing.append(f"{package['name']} {package['version']}")
        used = [numbers.setdefault(text, len(numbers) + 1) for text in found]
        parts.append((package["name"], package["version"], licence(package), used))
    if missing:
        raise SystemExit(f"no licence text: {', '.join(missing)}")
    lines = ["stickslip is built from these parts, under these licences; the texts, by number, are below.", ""]
    lines += [f"{name} {version}: {terms} [{', '.join(map(str, used))}]" for name, version, terms, used in parts]
    for text, number in numbers.items():
        lines += ["", "=" * 100, f"[{number}]", "", text]
    return "\n".join(lines) + "\n"


def component(package, checksums):
    about = {"type": "library", "bom-ref": reference(package), "name": package["name"], "version": package["version"],
             "purl": reference(package)}
    if licence(package):
        about["licenses"] = [{"expression": licence(package)}]
    if order(package) in checksums:
        about["hashes"] = [{"alg": "SHA-256", "content": checksums[order(package)]}]
    return about


def reference(package):
    return f"pkg:{package.get('registry', 'cargo')}/{package['name']}@{package['version']}"


def bill(packages, needs, first, more, checksums, target):
    """The list of parts as CycloneDX 1.5; `more` are those beside the crates."""
    made = datetime.datetime.fromtimestamp(int(os.environ.get("SOURCE_DATE_EPOCH", "0")), datetime.timezone.utc)
    parts = [component(p, checksums) for i, p in packages.items() if i != first]
    parts += [component(p, checksums) for p in more]
    needed = [{"ref": reference(p), "dependsOn": [reference(packages[n]) for n in needs[i]]} for i, p in packages.items()]
    own = component(packages[first], checksums) | {"type": "application"}
    number = uuid.uuid5(uuid.NAMESPACE_URL, json.dumps([target, own, parts, needed], sort_keys=True))
    return {"bomFormat": "CycloneDX", "specVersion": "1.5", "serialNumber": f"urn:uuid:{number}", "version": 1,
            "metadata": {"timestamp": made.strftime("%Y-%m-%dT%H:%M:%SZ"), "component": own},
            "components": parts, "dependencies": needed}


def main():
    reader = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    reader.add_argument("package")
    reader.add_argument("target")
    reader.add_argument("folder", type=pathlib.Path)
    reader.add_argument("--manifest-path", default=str(ROOT / "Cargo.toml"))
    reader.add_argument("--node", type=pathlib.Path, action="append", default=[])
    asked = reader.parse_args()
    known = metadata(asked.manifest_path, asked.target)
    packages, needs, first = linked(known, asked.package)
    lock = tomllib.loads((pathlib.Path(known["workspace_root"]) / "Cargo.lock").read_text())
    checksums = {order(p): p["checksum"] for p in lock["package"] if "checksum" in p}
    rust = subprocess.run([os.environ.get("RUSTC", "rustc"), "--version"], check=True, text=True, stdout=subprocess.PIPE)
    more = [of_node(folder) for folder in asked.node]
    others = [p for p in packages.values() if p["source"] is not None] + more
    asked.folder.mkdir(parents=True, exist_ok=True)
    (asked.folder / "THIRD-PARTY-NOTICES.txt").write_text(notices(others, rust.stdout.split()[1]))
    parts = json.dumps(bill(packages, needs, first, more, checksums, asked.target), indent=1)
    (asked.folder / f"{asked.package}.cdx.json").write_text(parts + "\n")


if __name__ == "__main__":
    main()
