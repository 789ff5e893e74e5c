# SPDX-License-Identifier: MIT
"""Shared libraries export the functions that the headers declare and do not define, and nothing else but the inline ones
of templates that they instantiate, vtables and types: exports_test.py NM DOXYGEN DOXYFILE FOLDER LIBRARY..."""
import pathlib
import re
import subprocess
import sys
import xml.etree.ElementTree as ElementTree

# What inline functions of the headers call.
INSIDE = {"boxstream::detail::near_exactly", "boxstream::BasicObjectSet::forget_first_pair",
          "boxstream::BasicObjectSet::visit_overlaps", "boxstream::BasicObjectSet::visit_pairs"}
HEADERS_ALONE = ("boxstream::fcl::", "boxstream::mpi::", "boxstream::TbbExecutor")
KINDS = ("vtable for ", "typeinfo for ", "typeinfo name for ")


def plain(name):
    """Without what a function returns and takes, arguments of templates, and the namespace of a precision."""
    return re.sub(r"<[\w:]*>|::float(32|64)\b", "", name.split("(")[0]).split()[-1]


def exported(nm, library):
    listed = subprocess.run([nm, "--dynamic", "--defined-only", "--demangle", library], check=True, capture_output=True,
                            text=True).stdout
    return {line.split(maxsplit=2)[2] for line in listed.splitlines()}


def reference(doxygen, doxyfile, folder):
    settings = pathlib.Path(doxyfile).read_text(encoding="utf-8").replace("out/docs", folder)
    settings += "\nGENERATE_HTML = NO\nGENERATE_XML = YES\n"
    pathlib.Path(folder).mkdir(parents=True, exist_ok=True)
    subprocess.run([doxygen, "-"], input=settings, check=True, text=True)
    for file in sorted(pathlib.Path(folder, "xml").glob("*.xml")):
        for compound in ElementTree.parse(file).getroot().iter("compounddef"):
            if compound.get("kind") in ("class", "struct", "namespace"):
                yield compound


def is_for_libraries_to_define(member):
    arguments = member.findtext("argsstring")
    has_body = "bodystart" in member.find("location").attrib
    return not has_body and member.get("inline") == "no" and not re.search(r"=\s*(0|default|delete)$", arguments)


def main(nm, doxygen, doxyfile, folder, *libraries):
    compounds = list(reference(doxygen, doxyfile, folder))
    classes = {plain(compound.findtext("compoundname")) for compound in compounds}
    declared, defined_elsewhere = set(), set()
    for compound in compounds:
        for member in compound.iter("memberdef"):
            if member.get("prot") != "private" and member.get("kind") in ("function", "variable"):
                name = plain(compound.findtext("compoundname") + "::" + member.findtext("name"))
                declared.add(name)
                if (member.get("kind") == "function" and is_for_libraries_to_define(member)
                        and not name.startswith(HEADERS_ALONE)):
                    defined_elsewhere.add(name)
    names = set().union(*(exported(nm, library) for library in libraries))
    functions = {plain(name) for name in names if not name.startswith(KINDS)}
    types = {plain(name.split(" for ")[1]) for name in names if name.startswith(KINDS)}
    assert len(defined_elsewhere) > 60, "the headers were not understood"
    complaints = [f"exported and not declared: {name}" for name in sorted(functions - declared - INSIDE)]
    complaints += [f"declared and not exported: {name}" for name in sorted(defined_elsewhere - functions)]
    complaints += [f"a type that is not declared: {name}" for name in sorted(types - classes)]
    sys.exit("\n".join(complaints) or print(f"{len(names)} symbols, all of them declared"))


main(*sys.argv[1:])
