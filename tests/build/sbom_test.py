# SPDX-License-Identifier: MIT
# sbom_test.py SOURCE BILL: the bill of materials holds the fields that SPDX 2.3 demands, the version of the header, and
# each file of the library with its hashes, computed here by another library.
import glob
import hashlib
import json
import os
import re
import sys

source, bill = sys.argv[1:]
with open(bill, encoding="utf-8") as file:
    document = json.load(file)


def digest(algorithm, path):
    with open(os.path.join(source, path), "rb") as file:
        return hashlib.new(algorithm, file.read()).hexdigest()


def check(holds, message):
    if not holds:
        sys.exit("sbom_test: " + message)


for key in ("spdxVersion", "dataLicense", "SPDXID", "name", "documentNamespace", "creationInfo"):
    check(document.get(key), "no " + key)
check(re.fullmatch(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ", document["creationInfo"]["created"]), "no date")

with open(os.path.join(source, "include/topoadapt.h"), encoding="utf-8") as file:
    header = file.read()
version = ".".join(re.search(f"TPA_VERSION_{part} (\\d+)", header)[1] for part in ("MAJOR", "MINOR", "PATCH"))
packages = {package["name"]: package for package in document["packages"]}
check(packages["topoadapt"]["versionInfo"] == version, "version is not " + version)

paths = ["LICENSE"]
for pattern in ("include/*.h", "include/*.hpp", "src/*/*.h", "src/*/*.cpp"):
    paths += (os.path.relpath(path, source) for path in glob.glob(os.path.join(source, pattern)))
listed = {entry["fileName"]: entry for entry in document["files"]}
check(sorted(listed) == sorted("./" + path for path in paths), "other files than those of the library")
for path in paths:
    hashes = {sum["algorithm"]: sum["checksumValue"] for sum in listed["./" + path]["checksums"]}
    check(hashes == {"SHA1": digest("sha1", path), "SHA256": digest("sha256", path)}, "wrong hash of " + path)
code = hashlib.sha1("".join(sorted(digest("sha1", path) for path in paths)).encode()).hexdigest()
check(packages["topoadapt"]["packageVerificationCode"]["packageVerificationCodeValue"] == code, "wrong code")

names = [entry["SPDXID"] for part in ("packages", "files") for entry in document[part]] + ["SPDXRef-DOCUMENT"]
check(len(names) == len(set(names)), "an id twice")
for name in names:
    check(re.fullmatch(r"SPDXRef-[A-Za-z0-9.-]+", name), "bad id " + name)
for relationship in document["relationships"]:
    for key in ("spdxElementId", "relatedSpdxElement"):
        check(relationship[key] in names, "unknown id " + relationship[key])
