# SPDX-License-Identifier: MIT
"""The shared library exports what its header declares, and nothing else: exports_test.py NM LIBRARY HEADER"""
import re
import subprocess
import sys

nm, library, header = sys.argv[1:]
listed = subprocess.run([nm, "--dynamic", "--defined-only", library], check=True, capture_output=True, text=True).stdout
exported = {line.split()[-1].split("@")[0] for line in listed.splitlines()}
declared = set(re.findall(r"BOXSTREAM_C_API[^;(]*?(boxstream_\w+)\(", open(header).read()))
assert len(declared) > 20, "the header was not understood"
assert exported == declared, f"exported alone: {exported - declared}, declared alone: {declared - exported}"
