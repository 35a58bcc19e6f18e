"""check_sbom.py PACKAGE: checks the software bill of materials in the Debian package. It has the form of SPDX 2.3, and
names all that the program is linked with, all packages that the Debian package depends on, and the libraries whose
headers the sources include."""

import hashlib
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
DOCUMENT = {"spdxVersion", "dataLicense", "SPDXID", "name", "documentNamespace", "creationInfo", "packages",
            "relationships", "documentDescribes"}
PACKAGE = {"SPDXID", "name", "versionInfo", "supplier", "downloadLocation", "filesAnalyzed", "licenseConcluded",
           "licenseDeclared", "copyrightText"}
MORE = {"checksums", "comment", "externalRefs", "homepage", "primaryPackagePurpose", "sourceInfo"}
LICENSE = re.compile(r"NOASSERTION|[A-Za-z0-9.-]+( WITH [A-Za-z0-9.-]+)?")
# Libraries that come as headers, and a name in the package of Debian that has them.
HEADERS = {"CLI/": "libcli11-dev", "boost/": "boost", "flatbuffers/": "libflatbuffers-dev", "fmt/": "libfmt-dev",
           "nlohmann/": "nlohmann-json3-dev", "xxhash.h": "libxxhash-dev", "yaml-cpp/": "libyaml-cpp-dev"}


def output_of(*command):
    return subprocess.run(command, stdout=subprocess.PIPE, check=True, text=True).stdout


def check(condition, what):
    if not condition:
        sys.exit(f"check_sbom.py: FAILED: {what}")


def check_form(bill):
    check(set(bill) == DOCUMENT, f"the document has the keys {sorted(bill)}")
    check(bill["spdxVersion"] == "SPDX-2.3" and bill["dataLicense"] == "CC0-1.0", "version and license of the data")
    check(bill["SPDXID"] == "SPDXRef-DOCUMENT", "the name of the document")
    check(re.fullmatch(r"[a-z][a-z0-9+.-]*:[^#\s]+", bill["documentNamespace"]), "the namespace is no URI")
    creation = bill["creationInfo"]
    check(re.fullmatch(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ", creation["created"]), creation["created"])
    check(all(re.match("(Person|Organization|Tool): .", one) for one in creation["creators"]), "who made it")
    names = [bill["SPDXID"], *(package["SPDXID"] for package in bill["packages"])]
    check(len(set(names)) == len(names), "a name is given twice")
    for package in bill["packages"]:
        check(PACKAGE <= set(package) <= PACKAGE | MORE, f"a package has the keys {sorted(package)}")
        check(re.fullmatch(r"SPDXRef-[A-Za-z0-9.-]+", package["SPDXID"]), package["SPDXID"])
        check(package["filesAnalyzed"] is False and package["versionInfo"], package["name"])
        check(re.match("(Person|Organization): .|NOASSERTION$", package["supplier"]), package["supplier"])
        for key in ("licenseConcluded", "licenseDeclared"):
            check(LICENSE.fullmatch(package[key]), package[key])
        for reference in package.get("externalRefs", []):
            check(reference["referenceCategory"] == "PACKAGE-MANAGER" and reference["referenceType"] == "purl", reference)
            check(re.fullmatch(r"pkg:(deb/debian/[a-z0-9.%B-]+@[A-Za-z0-9.%~-]+\?arch=\w+|npm/(%40)?[a-z0-9/-]+@[0-9.]+)",
                               reference["referenceLocator"]),
                  reference["referenceLocator"])
    for relation in bill["relationships"]:
        check({relation["spdxElementId"], relation["relatedSpdxElement"]} <= set(names), relation)
        check(relation["relationshipType"] in ("DESCRIBES", "DYNAMIC_LINK", "STATIC_LINK", "CONTAINS"), relation)
    related = {relation["relatedSpdxElement"] for relation in bill["relationships"]}
    check(related == {*names} - {bill["SPDXID"]}, "a package is related to nothing")


def names_related(bill, kind):
    names = {package["SPDXID"]: package["name"] for package in bill["packages"]}
    return {names[one["relatedSpdxElement"]] for one in bill["relationships"] if one["relationshipType"] == kind}


def main():
    deb = sys.argv[1]
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(["dpkg-deb", "-x", deb, folder], check=True)
        name = output_of("dpkg-deb", "-f", deb, "Package").strip()
        program = pathlib.Path(folder, "usr/bin/cbc")
        bill = json.loads(pathlib.Path(folder, "usr/share/doc", name, "sbom.spdx.json").read_text())
        check_form(bill)
        main_package = bill["packages"][0]
        check((main_package["name"], main_package["versionInfo"]) ==
              (name, output_of("dpkg-deb", "-f", deb, "Version").rsplit("-", 1)[0]), "the package itself")
        digest = hashlib.sha256(program.read_bytes()).hexdigest()
        check(main_package["checksums"] == [{"algorithm": "SHA256", "checksumValue": digest}], "the digest of the program")
        loader = output_of("env", "LD_TRACE_LOADED_OBJECTS=1", str(program))  # as ldd, which knows one processor
        loaded = {line.split()[2] for line in loader.splitlines() if " => /" in line}

    linked, compiled = names_related(bill, "DYNAMIC_LINK"), names_related(bill, "STATIC_LINK")
    depends = {one.split()[0] for one in output_of("dpkg-deb", "-f", deb, "Depends").split(",")}
    check(depends == linked, f"the package depends on {sorted(depends)}, but the list has {sorted(linked)}")
    check(loaded and {os.path.basename(path).split(".so")[0] for path in loaded} >= {"libfmt", "libyaml-cpp"}, loaded)
    sources = "\n".join(path.read_text() for kind in ("*.cpp", "*.h") for path in (ROOT / "src").rglob(kind))
    included = set(re.findall(r"^#include <([^>]*)>", sources, re.MULTILINE))
    for header, package in HEADERS.items():
        check(any(one.startswith(header) for one in included), f"nothing includes <{header}> any more")
        check(any(package in one for one in compiled), f"{package} is missing in {sorted(compiled)}")
    print(f"check_sbom.py: {len(linked)} linked, {len(compiled)} compiled in: all is well")


if __name__ == "__main__":
    main()
