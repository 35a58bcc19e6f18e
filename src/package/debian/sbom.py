"""Writes the software bill of materials of the Debian package, as SPDX 2.3 in JSON.

    sbom.py --name NAME --version VERSION --program PROGRAM --build FOLDER [--page LOCK] [--emulator EMULATOR] --output FILE

It lists what the program really has in it: the shared libraries that it is linked with, and the Debian packages of the
headers that were compiled into it, by the records of Ninja. With --page LOCK also the packages of npm in the page of
the simulator, by its lock file. EMULATOR loads a program for another processor. The time is that of
SOURCE_DATE_EPOCH, if that is set: then the same build gives the same bytes.
"""

import argparse
import datetime
import hashlib
import json
import os
import pathlib
import re
import subprocess
import time

# Licenses by names of Debian's source packages, without their versions; NOASSERTION for others.
LICENSES = {
    "boost": "BSL-1.0",
    "cli11": "BSD-3-Clause",
    "flatbuffers": "Apache-2.0",
    "fmtlib": "MIT",
    "gcc": "GPL-3.0-or-later WITH GCC-exception-3.1",
    "glibc": "LGPL-2.1-or-later",
    "linux": "GPL-2.0-only WITH Linux-syscall-note",
    "nlohmann-json": "MIT",
    "xxhash": "BSD-2-Clause",
    "yaml-cpp": "MIT",
}
OBJECTS = "CMakeFiles/cbc"  # of the program: cbc_core and so on; those of the tests are in tests/CMakeFiles


def output_of(*command):
    return subprocess.run(command, stdout=subprocess.PIPE, check=True, text=True).stdout


def linked_files(program, emulator):
    """The shared libraries that the program itself names, where the loader finds them."""
    needed = re.findall(r"\(NEEDED\) +Shared library: \[(.+)\]", output_of("readelf", "--dynamic", "-W", program))
    # "libfmt.so.9 => /lib/libfmt.so.9 (0x7f…)"; the loader itself has only a path.
    loaded = output_of("env", "LD_TRACE_LOADED_OBJECTS=1", *emulator, program)  # as ldd does, which knows one processor
    found = re.findall(r"^\s+(?:\S+ => )?(/\S+) \(0x", loaded, re.MULTILINE)
    places = {pathlib.Path(path).name: path for path in found}
    return {places[name] for name in needed}


def compiled_files(build):
    """The files outside of the project that were read to compile the program."""
    paths, is_of_program = set(), False
    for line in output_of("ninja", "-C", build, "-t", "deps").splitlines():
        if not line.startswith(" "):
            is_of_program = line.startswith(OBJECTS)
        elif is_of_program and line.strip().startswith("/usr/"):
            paths.add(line.strip())
    return paths


def packages_of(paths):
    """The installed Debian packages that have the files."""
    names = set()
    # Debian's /lib is a link to /usr/lib, and either name may be in the lists of packages.
    known = {real for path in paths for real in (path, os.path.realpath(path))}
    known |= {path.removeprefix("/usr") for path in known if path.startswith("/usr/lib")}
    done = subprocess.run(["dpkg-query", "--search", *sorted(known)], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                          check=False, text=True)
    owned = set()
    for line in done.stdout.splitlines():
        if re.match(r"(local )?diversion ", line):  # of a file that another package had, and has no more
            continue
        owners, path = line.split(": ", 1)
        names.update(owners.split(", "))
        owned.add(os.path.realpath(path))
    missing = {path for path in paths if os.path.realpath(path) not in owned}
    if missing:
        raise SystemExit(f"sbom.py: of no Debian package: {', '.join(sorted(missing))}")
    return names


def describe(package):
    """A package of SPDX for an installed Debian package."""
    form = "${Package}\n${Version}\n${Architecture}\n${source:Package}\n${source:Version}\n${Maintainer}\n${Homepage}\n"
    name, version, architecture, source, source_version, maintainer, homepage = output_of(
        "dpkg-query", "--show", "--showformat", form, package).split("\n")[:7]
    person = re.match(r"(.*) <(.*)>", maintainer)
    described = {
        "SPDXID": "SPDXRef-" + re.sub(r"[^A-Za-z0-9.-]", "-", name),
        "name": name,
        "versionInfo": version,
        "supplier": f"Organization: {person[1]} ({person[2]})" if person else "NOASSERTION",
        "downloadLocation": "NOASSERTION",
        "filesAnalyzed": False,
        "sourceInfo": f"built from the Debian source package {source} {source_version}",
        "licenseConcluded": "NOASSERTION",
        "licenseDeclared": LICENSES.get(re.sub(r"-?[0-9.]+$", "", source), "NOASSERTION"),
        "copyrightText": "NOASSERTION",
        "externalRefs": [reference("debian", name, version, architecture)],
    }
    if homepage:
        described["homepage"] = homepage
    return described


def describe_module(path, module):
    """A package of SPDX for a package of npm, as a lock file has it."""
    name = path.removeprefix("node_modules/")
    return {
        "SPDXID": "SPDXRef-npm-" + re.sub(r"[^A-Za-z0-9.-]", "-", name.lstrip("@")),
        "name": name,
        "versionInfo": module["version"],
        "supplier": "NOASSERTION",
        "downloadLocation": "NOASSERTION",
        "filesAnalyzed": False,
        "comment": "In the page of the simulator, cbc-play.html.",
        "licenseConcluded": "NOASSERTION",
        "licenseDeclared": module["license"],
        "copyrightText": "NOASSERTION",
        "externalRefs": [{"referenceCategory": "PACKAGE-MANAGER", "referenceType": "purl",
                          "referenceLocator": f"pkg:npm/{name.replace('@', '%40')}@{module['version']}"}],
    }


def modules_of(lock):
    """What goes into the page: not what only makes it."""
    packages = json.loads(pathlib.Path(lock).read_text())["packages"]
    return [describe_module(path, module) for path, module in packages.items() if path and not module.get("dev")]


def reference(vendor, name, version, architecture):
    """A package URL, as scanners for known weaknesses look it up."""
    version = version.replace("+", "%2B").replace(":", "%3A")
    return {"referenceCategory": "PACKAGE-MANAGER", "referenceType": "purl",
            "referenceLocator": f"pkg:deb/{vendor}/{name.replace('+', '%2B')}@{version}?arch={architecture}"}


def bill(arguments):
    program = pathlib.Path(arguments.program)
    digest = hashlib.sha256(program.read_bytes()).hexdigest()
    created = datetime.datetime.fromtimestamp(int(os.environ.get("SOURCE_DATE_EPOCH", time.time())), datetime.timezone.utc)
    linked = packages_of(linked_files(program, arguments.emulator))
    compiled = packages_of(compiled_files(arguments.build)) - linked
    main = {
        "SPDXID": "SPDXRef-Package",
        "name": arguments.name,
        "versionInfo": arguments.version,
        "supplier": "Organization: The cbc authors",
        "downloadLocation": "NOASSERTION",
        "filesAnalyzed": False,
        "primaryPackagePurpose": "APPLICATION",
        "checksums": [{"algorithm": "SHA256", "checksumValue": digest}],
        "comment": f"The checksum is that of {program.name}, the program in the package.",
        "licenseConcluded": "BSD-3-Clause",
        "licenseDeclared": "BSD-3-Clause",
        "copyrightText": "NOASSERTION",
    }
    relations = [("SPDXRef-DOCUMENT", "DESCRIBES", main)]
    packages = [main]
    for names, kind in ((linked, "DYNAMIC_LINK"), (compiled, "STATIC_LINK")):
        for described in sorted((describe(name) for name in names), key=lambda one: one["name"]):
            packages.append(described)
            relations.append(("SPDXRef-Package", kind, described))
    for described in modules_of(arguments.page) if arguments.page else []:
        packages.append(described)
        relations.append(("SPDXRef-Package", "CONTAINS", described))
    return {
        "spdxVersion": "SPDX-2.3",
        "dataLicense": "CC0-1.0",
        "SPDXID": "SPDXRef-DOCUMENT",
        "name": f"{arguments.name}-{arguments.version}",
        "documentNamespace": f"urn:{arguments.name}:{arguments.version}:{digest}",
        "creationInfo": {"created": created.strftime("%Y-%m-%dT%H:%M:%SZ"),
                         "creators": ["Organization: The cbc authors", "Tool: sbom.py"]},
        "documentDescribes": ["SPDXRef-Package"],
        "packages": packages,
        "relationships": [{"spdxElementId": one, "relationshipType": kind, "relatedSpdxElement": other["SPDXID"]}
                          for one, kind, other in relations],
    }


def main():
    parser = argparse.ArgumentParser()
    for option in ("name", "version", "program", "build", "output"):
        parser.add_argument("--" + option, required=True)
    parser.add_argument("--page")
    parser.add_argument("--emulator", nargs=1, default=[])
    arguments = parser.parse_args()
    pathlib.Path(arguments.output).write_text(json.dumps(bill(arguments), indent=1) + "\n")


if __name__ == "__main__":
    main()
